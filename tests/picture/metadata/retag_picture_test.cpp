// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures that already have metadata, and get others: only the requested ones change.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "ods/image/format/exr_header.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/metadata/tag_picture.h"
#include "ods/picture/save.h"
#include "tests/support/temporary_folder.h"

namespace ods::retag_picture_test {

Picture gradient(const std::vector<int>& eyes) {
  Picture picture;
  for (int eye : eyes) {
    EyeImage& image = picture.eyes.emplace_back();
    image.eye = eye;
    image.radiance = Image(16, 8, 3);
    for (size_t i = 0; i < image.radiance.pixels.size(); i++) {
      image.radiance.pixels[i] = static_cast<float>(i % 97) / 97.0f;
    }
  }
  return picture;
}
// The known format of the picture with another yaw, as in ods inject.
void turn(const std::string& path, float yaw) {
  std::vector<std::string> guesses;
  PictureTag tag = complete_tag({}, path, guesses);
  tag.camera.yaw = yaw;
  tag_picture(path, path, tag);
}

TEST(RetagPicture, OnlyWhatIsAskedForChangesInGpano) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.jpg");
  save_picture(gradient({kMono}), {}, path);
  const Extent size{read_info(path).width, read_info(path).height};
  std::vector<Attribute> crop = {{"GPano:ProjectionType", std::string("equirectangular")},
                                 {"GPano:CroppedAreaImageWidthPixels", size.width},
                                 {"GPano:CroppedAreaImageHeightPixels", size.height},
                                 {"GPano:FullPanoWidthPixels", size.width + 3},
                                 {"GPano:FullPanoHeightPixels", 3 * size.height},
                                 {"GPano:CroppedAreaLeftPixels", 1},
                                 {"GPano:CroppedAreaTopPixels", 5},
                                 {"GPano:PosePitchDegrees", std::string("12.50")},
                                 {"GPano:PoseRollDegrees", -3.25f},
                                 {"GPano:InitialViewHeadingDegrees", 77},
                                 {"GPano:StitchingSoftware", std::string("Hugin & <friends>")}};
  {
    const FileInput file(path);
    AtomicFile to(path);
    write_xmp(file, to, make_xmp(crop));
    to.commit();
  }
  Sidecar sidecar;  // of the whole sphere: the picture's own metadata are better
  sidecar.eyes = {kMono};
  save_sidecar(sidecar, folder.path("a.camera.json"));
  const auto properties = [&] {
    std::map<std::string, std::string> all;
    for (const Attribute& each : gpano_properties(read_xmp(path))) all[each.name] = std::get<std::string>(each.value);
    return all;
  };
  std::map<std::string, std::string> requested = properties();
  EXPECT_EQ(requested.at("GPano:StitchingSoftware"), "Hugin & <friends>");
  const std::string before = folder.read("a.jpg");
  std::vector<std::string> guesses;
  tag_picture(path, path, complete_tag({}, path, guesses));
  EXPECT_TRUE(folder.read("a.jpg") == before) << "it says all that already";
  turn(path, 30.0f);
  requested["GPano:PoseHeadingDegrees"] = "30";
  EXPECT_EQ(properties(), requested);
}

TEST(RetagPicture, OnlyWhatIsAskedForChangesInAnExr) {
  const TemporaryFolder folder;
  for (const Layout layout : {Layout::kTopBottom, Layout::kMultiview}) {
    const std::string path = folder.path("a.exr");
    StereoCamera camera;
    camera.ipd = 0.07f, camera.position = vec3(1.0f, 2.0f, 3.0f), camera.pitch = 5.0f, camera.neck = 0.1f;
    camera.top.mode = kMergeCosine;
    camera.head_tilt_map = std::make_shared<Image>(2, 1, 1);
    SaveOptions options;
    options.layout = layout;
    save_picture(gradient({kLeft, kRight}), camera, options, path);
    ExrHeader header = read_exr_header(FileInput(path));
    header.attributes.push_back(exr_attribute({"ods:somebody", std::string("else")}));
    const auto is_bottom = [](const ExrAttribute& each) { return each.name == "ods:poleMergeBottom"; };
    std::find_if(header.attributes.begin(), header.attributes.end(), is_bottom)->value = "map";
    const FileInput file(path);
    AtomicFile to(path);
    write_exr_header(file, to, header);
    to.commit();
    turn(path, 30.0f);
    const std::vector<ExrAttribute> after = read_exr_header(FileInput(path)).attributes;
    std::string names, requested;
    for (const ExrAttribute& each : after) names += each.name + " ";
    for (const ExrAttribute& each : header.attributes) requested += each.name + " ";
    ASSERT_EQ(names, requested);
    for (size_t i = 0; i < after.size(); i++) {
      EXPECT_EQ(after[i].name, header.attributes[i].name);
      EXPECT_EQ(after[i].value == header.attributes[i].value, after[i].name != "ods:yaw") << after[i].name;
    }
  }
}

// Metadata that do not apply to the new projection are removed.
TEST(RetagPicture, AnExrLosesTheNumbersOfAnotherLens) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.exr");
  StereoCamera camera;
  camera.projection = find_projection("fisheye-polynomial")->setting;
  save_picture(gradient({kMono}), camera, {}, path);
  ASSERT_TRUE(read_info(path).numbers.contains("ods:sensor"));
  PictureTag tag;
  tag.eye = kMono, tag.has_camera = true;
  tag_picture(path, path, tag);
  for (const char* name : {"ods:sensor", "ods:lensK1", "ods:fov", "ods:look"}) {
    EXPECT_FALSE(read_info(path).numbers.contains(name)) << name;
  }
}

TEST(RetagPicture, AnExrKeepsAPositionOfWhichNobodyKnowsTheEyes) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.exr");
  save_picture(gradient({kMono}), StereoCamera(), {}, path);
  ExrHeader header = read_exr_header(FileInput(path));
  std::erase_if(header.attributes, [](const ExrAttribute& each) { return each.name == "ods:ipd"; });
  const FileInput file(path);
  AtomicFile to(path);
  write_exr_header(file, to, header);
  to.commit();
  turn(path, 30.0f);
  const FileInfo info = read_info(path);
  EXPECT_TRUE(info.numbers.contains("ods:position"));
  EXPECT_FALSE(info.numbers.contains("ods:ipd"));
  EXPECT_EQ(info.text.at("textureformat"), "LatLong Environment");
}

}  // namespace ods::retag_picture_test
