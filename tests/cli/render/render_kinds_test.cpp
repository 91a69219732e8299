// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of the kinds that users bring, rendered with no option but the size: what is told of them, and whether there
// is something to see.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "ods/image/image_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/kinds_of_scene.h"
#include "tests/support/scene_file.h"

namespace ods::kinds_of_scene_test {

class KindsOfScene : public Cli, public ::testing::WithParamInterface<size_t> {
 protected:
  const KindOfScene& kind() const { return kinds_of_scene()[GetParam()]; }

  std::string write_scene() const {
    const Binary bytes = glb_of(kind().make());
    const std::string path = folder.path("scene.glb");
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    return path;
  }
};

// The brightness of a picture on a screen, 0..1: the values that only a tenth, half and nine tenths of its pixels
// exceed. Rows near the poles count less, as they are smaller.
struct Brightness {
  double high, middle, low;
};

Brightness brightness_of(const Image& picture) {
  std::vector<std::pair<double, double>> values;  // with their weights
  const int rows = picture.height / 2;            // of an eye
  double whole = 0.0;
  for (int y = 0; y < picture.height; y++) {
    const double weight = std::sin(3.14159265 * (y % rows + 0.5) / rows);
    for (int x = 0; x < picture.width; x++) {
      const float* p = picture.at(x, y);
      values.emplace_back(0.2126 * double{p[0]} + 0.7152 * double{p[1]} + 0.0722 * double{p[2]}, weight);
      whole += weight;
    }
  }
  std::sort(values.begin(), values.end(), std::greater<>());
  const auto exceeded_by = [&](double share) {
    double sum = 0.0;
    for (const auto& [value, weight] : values) {
      if ((sum += weight) >= share * whole) return value;
    }
    return values.back().first;
  };
  return {exceeded_by(0.1), exceeded_by(0.5), exceeded_by(0.9)};
}

TEST_P(KindsOfScene, AreRecognisedAndLookGoodWithoutAnOption) {
  const std::string scene = write_scene(), picture = folder.path("picture.png");
  ASSERT_EQ(run("info --json " + scene), 0) << err;
  const GltfJson json = GltfJson::parse(out);
  EXPECT_EQ(json["kind"], scene_kind_name(kind().kind));
  EXPECT_GE(json["nearest_surface"].get<double>(), double{kElbowRoom});
  const double height = json["bounds"]["high"][1].get<double>() - json["bounds"]["low"][1].get<double>();
  EXPECT_GT(height, 0.3) << "in metres";
  EXPECT_LT(height, 100.0) << "in metres";
  ASSERT_EQ(run("render " + scene + " -o " + picture + " --width 128 --samples 4"), 0) << err;
  EXPECT_NE(err.find(kind().note), std::string::npos) << err;
  EXPECT_EQ(err.find("warning"), std::string::npos) << err;
  const Brightness seen = brightness_of(read_image(picture));
  EXPECT_GT(seen.high, 0.03) << "black";
  EXPECT_LT(seen.middle, 0.7) << "blown out";
  EXPECT_LT(seen.low, 0.35) << "without contrast";
  EXPECT_EQ(run("lint " + picture), 0) << out;
  EXPECT_NE(out.find("no fault found"), std::string::npos) << out;
}

INSTANTIATE_TEST_SUITE_P(All, KindsOfScene, ::testing::Range<size_t>(0, kinds_of_scene().size()), [](const auto& test) {
  std::string name = kinds_of_scene()[test.param].name;
  std::erase(name, '-');
  return name;
});

}  // namespace ods::kinds_of_scene_test
