// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/face_files.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/picture/load_eyes.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// A face by the definition in face_files.h: where its middle, its right edge and its upper edge are for a viewer whose
// right is x, whose up is y, and who looks along -z.
struct Face {
  vec3 middle, right, top;
};
constexpr int kSide = 8;

std::vector<Face> faces() {
  const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {{x, z, y}, {-x, -z, y}, {y, x, z}, {-y, x, -z}, {-z, x, y}, {z, -x, y}};
}

class FaceFiles : public testing::Test {
 protected:
  // Each pixel has its direction as its colour.
  void write(const std::string& name, const Face& face, int width = kSide, int height = kSide) const {
    FileHeader header;
    header.format = *format_of_path(name);
    header.width = width, header.height = height;
    header.channels = {{"R", SampleType::kFloat}, {"G", SampleType::kFloat}, {"B", SampleType::kFloat}};
    AtomicFile file(folder.path(name));
    write_image(file, header, [&](int row, std::span<float> to) {
      for (int column = 0; column < width; column++) {
        const float u = 2.0f * (static_cast<float>(column) + 0.5f) / static_cast<float>(width) - 1.0f;
        const float v = 1.0f - 2.0f * (static_cast<float>(row) + 0.5f) / static_cast<float>(height);
        const vec3 d = normalize(face.middle + u * face.right + v * face.top);
        for (int c = 0; c < 3; c++) to[static_cast<size_t>(3 * column + c)] = d[c];
      }
    });
    file.commit();
  }
  std::string error(const std::string& name) const {
    try {
      open_faces(folder.path(name));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder;
};

// Each place of the assembled cube shows what its projection says.
TEST_F(FaceFiles, EveryPixelIsWhereItsDirectionIs) {
  const std::vector<Face> all = faces();
  const FaceWords& words = kFaceWordsTable[0];
  for (const std::string eye : {"left", "right"}) {
    for (size_t i = 0; i < all.size(); i++) write(eye + "_" + std::string(words.words[i]) + ".exr", all[i]);
  }
  for (const std::string name : {"left_{px|nx|py|ny|pz|nz}.exr", "{left|right}_{px|nx|py|ny|pz|nz}.exr"}) {
    const StoredPicture picture = open_picture(folder.path(name));
    EXPECT_EQ(projection_name(picture.camera.projection), "cube-3x2");
    const LoadedEyes loaded = load_eyes(folder.path(name));
    ASSERT_EQ(loaded.eyes.size(), name[0] == '{' ? 2u : 1u);
    const Projection projection = make_projection(picture.camera.projection);
    for (const Image& eye : loaded.eyes) {
      ASSERT_EQ(eye.width, 3 * kSide);
      ASSERT_EQ(eye.height, 2 * kSide);
      for (int y = 0; y < eye.height; y++) {
        for (int x = 0; x < eye.width; x++) {
          const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(eye.width),
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(eye.height));
          const vec3 looks = look_of(projection, uv, uv).direction;
          const float* color = eye.at(x, y);
          EXPECT_NEAR(length(vec3(color[0], color[1], color[2]) - looks), 0.0f, 1e-3f) << x << " " << y;
        }
      }
    }
  }
}

TEST_F(FaceFiles, SquaresOfOneSizeOnly) {
  for (size_t i = 0; i < kFaceCount; i++) write(std::string(kFaceWordsTable[0].words[i]) + ".exr", faces()[i]);
  const std::string name = "{px|nx|py|ny|pz|nz}.exr";
  EXPECT_EQ(error(name), "");
  write("ny.exr", faces()[3], kSide, kSide + 1);
  EXPECT_NE(error(name).find("8x9"), std::string::npos) << error(name);
  write("ny.exr", faces()[3], 2 * kSide, 2 * kSide);
  EXPECT_NE(error(name).find("16x16"), std::string::npos) << error(name);
  folder.write("ny.exr", "no picture");
  EXPECT_NE(error(name).find("ny.exr"), std::string::npos) << error(name);
}

}  // namespace
}  // namespace ods
