// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Google's mesh projection: meshes packed by a writer that follows the specification bit by bit are unpacked, in every
// kind of triangle list and both encodings; meshes that a camera would not write are refused with a message.
#include "ods/video/container/mesh_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "ods/base/bytes.h"
#include "ods/base/checksum.h"
#include "ods/base/error.h"
#include "ods/video/video_input.h"
#include "tests/support/made_videos.h"
#include "tests/support/mesh_writer.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// The place of a direction in a fisheye of 180 degrees.
vec2 fisheye_uv(vec3 d) {
  const float across = length(vec2(d.x, d.y)), r = atan(across, -d.z) / (0.5f * kPi);
  const float scale = across > 0.0f ? r / across : 0.0f;
  return {0.5f + 0.5f * scale * d.x, 0.5f - 0.5f * scale * d.y};
}

// The largest distance from that in the middle 160 degrees; 9: somewhere it shows nothing.
float worst(const DirectionMap& map) {
  float maximum = 0.0f;
  for (int i = 0; i < 60 * 60; i++) {
    const float off = 1.4f * static_cast<float>(i / 60 + 1) / 60.0f,
                around = 2.0f * kPi * static_cast<float>(i % 60) / 60.0f;
    const vec3 d(std::sin(off) * std::cos(around), std::sin(off) * std::sin(around), -std::cos(off));
    const ImagePoint point = map.place(d);
    if (!point.seen) return 9.0f;
    maximum = std::max(maximum, length(point.uv - fisheye_uv(d)));
  }
  return maximum;
}

std::string fault_of(const std::string& body) {
  try {
    parse_mesh_box(body);
  } catch (const MalformedFile& fault) {
    return fault.what();
  }
  return "";
}

// --- meshes ----------------------------------------------------------------------------------------------------------

TEST(MeshBox, BothEncodingsSayTheSame) {
  for (const bool packs : {false, true}) {
    const ProjectionMeshes meshes = parse_mesh_box(box_body({fisheye_mesh(41)}, packs));
    ASSERT_EQ(meshes.eyes.size(), 1u);
    EXPECT_TRUE(meshes.fits_checksum);
    EXPECT_EQ(meshes.eyes[0].vertices.size(), 41u * 41u);
    EXPECT_EQ(meshes.eyes[0].triangles.size(), 2u * 40u * 40u);
    EXPECT_TRUE(is_front_half(meshes.eyes[0]));
    EXPECT_LT(worst(*make_map(meshes.eyes[0])), 2e-3f) << "chords of a grid of 4.5 degrees";
  }
}

TEST(MeshBox, FinerGridsAreNearerToTheLens) {
  const auto error = [](int grid) {
    return worst(*make_map(parse_mesh_box(box_body({fisheye_mesh(grid)}, true)).eyes[0]));
  };
  const float coarse = error(21), fine = error(161);
  EXPECT_LT(fine, coarse / 20.0f) << coarse << " " << fine;
  EXPECT_LT(fine, 1e-4f);
}

TEST(MeshBox, TrianglesStripsAndFansAreTheSameSquare) {
  const std::vector<GlVertex> square = {{-1, -1, -1, 0, 0}, {1, -1, -1, 1, 0}, {-1, 1, -1, 0, 1}, {1, 1, -1, 1, 1}};
  const List lists[] = {{0, 0, {0, 1, 2, 2, 1, 3}}, {0, 1, {0, 1, 2, 3}}, {0, 2, {0, 1, 3, 2}}};
  for (const List& list : lists) {
    const TextureMesh mesh = parse_mesh_box(box_body({mesh_body(square, {list})}, false)).eyes[0];
    ASSERT_EQ(mesh.triangles.size(), 2u) << list.type;
    const auto map = make_map(mesh);
    for (const vec2 at : {vec2(0.0f, 0.0f), vec2(0.5f, 0.25f), vec2(-0.9f, 0.9f), vec2(0.99f, -0.99f)}) {
      const ImagePoint point = map->place(vec3(at.x, at.y, -1.0f) * 3.0f);
      ASSERT_TRUE(point.seen) << list.type;
      EXPECT_NEAR(point.uv.x, 0.5f + 0.5f * at.x, 1e-6f);
      EXPECT_NEAR(point.uv.y, 0.5f - 0.5f * at.y, 1e-6f) << "v is from the bottom there, from the top here";
    }
    EXPECT_FALSE(map->place({0.0f, 0.0f, 1.0f}).seen);
    EXPECT_FALSE(map->place({1.1f, 0.0f, -1.0f}).seen);
  }
}

TEST(MeshBox, OtherTexturesAreLeftOut) {
  const std::vector<GlVertex> square = {{-1, -1, -1, 0, 0}, {1, -1, -1, 1, 0}, {-1, 1, -1, 0, 1}, {1, 1, -1, 1, 1}};
  const std::string body = box_body({mesh_body(square, {{1, 0, {0, 1, 2}}, {0, 0, {2, 1, 3}}})}, false);
  EXPECT_EQ(parse_mesh_box(body).eyes[0].triangles.size(), 1u);
}

// A cube around the viewer: every direction meets exactly its face.
TEST(MeshBox, AWholeSphereOfTrianglesHasNoGaps) {
  TextureMesh mesh;
  for (int i = 0; i < 8; i++) {
    mesh.vertices.push_back({vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f), vec2(0.5f)});
  }
  for (const auto& [a, b, c, d] :
       {std::array<uint32_t, 4>{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 4, 5}, {2, 3, 6, 7}, {0, 2, 4, 6}, {1, 3, 5, 7}}) {
    mesh.triangles.push_back({a, b, c}), mesh.triangles.push_back({b, c, d});
  }
  ASSERT_EQ(mesh_fault(mesh), "");
  EXPECT_FALSE(is_front_half(mesh));
  const auto map = make_map(mesh);
  for (int i = 0; i < 200 * 100; i++) {
    const float theta = 2.0f * kPi * static_cast<float>(i % 200) / 200.0f,
                phi = kPi * (static_cast<float>(i / 200) / 99.0f - 0.5f);
    const vec3 d(std::cos(phi) * std::sin(theta), std::sin(phi), -std::cos(phi) * std::cos(theta));
    ASSERT_TRUE(map->place(d).seen) << d.x << " " << d.y << " " << d.z;
  }
}

// --- eyes ------------------------------------------------------------------------------------------------------------

TEST(MeshBox, EyesShareTheFrameAsTheStereoSays) {
  const ProjectionMeshes one = parse_mesh_box(box_body({fisheye_mesh(41)}, true));
  const ProjectionMeshes two = parse_mesh_box(box_body({fisheye_mesh(41), fisheye_mesh(21)}, true));
  for (const auto& [stereo, layout] : {std::pair{VideoStereo::kSideBySide, Layout::kSideBySide},
                                       {VideoStereo::kTopBottom, Layout::kTopBottom},
                                       {VideoStereo::kRightLeft, Layout::kCrossEyed}}) {
    const MeshedEyes both = eyes_of_meshes(one, stereo), each = eyes_of_meshes(two, stereo);
    EXPECT_EQ(both.layout, layout);
    ASSERT_EQ(both.eyes.size(), 2u);
    EXPECT_EQ(both.eyes[1].vertices.size(), 41u * 41u);
    EXPECT_EQ(each.eyes[1].vertices.size(), 21u * 21u);
  }
  EXPECT_EQ(eyes_of_meshes(two, VideoStereo::kOneView).eyes.size(), 1u);
  EXPECT_THROW(eyes_of_meshes(one, VideoStereo::kCustom), MalformedFile);
  EXPECT_THROW(eyes_of_meshes(two, VideoStereo::kCustom), MalformedFile) << "both from the whole frame";
}

TEST(MeshBox, CustomStereoIsWhereTheMeshesAre) {
  struct Case {
    Layout layout;
    std::string left, right;
  };
  const Case cases[] = {
      {Layout::kSideBySide, fisheye_mesh(41, 0.0f, 0.5f), fisheye_mesh(41, 0.5f, 1.0f)},
      {Layout::kCrossEyed, fisheye_mesh(41, 0.5f, 1.0f), fisheye_mesh(41, 0.0f, 0.5f)},
      {Layout::kTopBottom, fisheye_mesh(41, 0.0f, 1.0f, 0.5f, 1.0f), fisheye_mesh(41, 0.0f, 1.0f, 0.0f, 0.5f)},
      {Layout::kBottomTop, fisheye_mesh(41, 0.0f, 1.0f, 0.0f, 0.5f), fisheye_mesh(41, 0.0f, 1.0f, 0.5f, 1.0f)}};
  for (const Case& each : cases) {
    const MeshedEyes eyes =
        eyes_of_meshes(parse_mesh_box(box_body({each.left, each.right}, true)), VideoStereo::kCustom);
    EXPECT_EQ(eyes.layout, each.layout);
    for (const TextureMesh& eye : eyes.eyes) EXPECT_LT(worst(*make_map(eye)), 2e-3f) << layout_name(each.layout);
  }
}

// --- videos ----------------------------------------------------------------------------------------------------------

class MeshVideo : public testing::Test {
 protected:
  void write(int stereo, const std::string& mesh, const std::string& v1 = "") const {
    const std::string none(4, '\0');
    made::Mp4Options options;
    options.widths = {256}, options.height = 128;
    options.entry_boxes =
        made::box("st3d", none + made::number(static_cast<uint64_t>(stereo), 1)) +
        made::box("sv3d", made::box("svhd", none + std::string("camera\0", 7)) +
                              made::box("proj", made::box("prhd", std::string(16, '\0')) + made::box("mshp", mesh)));
    if (!v1.empty()) options.track_boxes = made::box("uuid", std::string(kV1Id) + v1);
    folder.write("a.mp4", made::mp4(options));
  }
  std::string error() const {
    try {
      open_video(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder;
  std::string path = folder.path("a.mp4");
};

TEST_F(MeshVideo, IsReadAsWhatItIs) {
  write(2, box_body({fisheye_mesh(41), fisheye_mesh(41)}, true));
  const VideoInput video = open_video(path);
  ASSERT_EQ(video.prototype.maps.size(), 2u);
  ASSERT_EQ(video.prototype.eyes.size(), 2u);
  EXPECT_EQ(video.prototype.layout, Layout::kSideBySide);
  EXPECT_TRUE(is_vr180(video.prototype.camera.projection));
  EXPECT_LT(worst(*video.prototype.maps[1]), 2e-3f);
  std::string all;
  for (const std::string& guess : video.prototype.guesses) all += guess;
  EXPECT_NE(all.find("mesh"), std::string::npos) << all;
}

TEST_F(MeshVideo, AWrongChecksumIsAWarning) {
  std::string mesh = box_body({fisheye_mesh(41)}, true);
  mesh[7] = static_cast<char>(mesh[7] ^ 1);
  EXPECT_FALSE(parse_mesh_box(mesh).fits_checksum);
  write(2, mesh);
  EXPECT_EQ(open_video(path).prototype.maps.size(), 2u);
}

TEST_F(MeshVideo, V1TellsWhereTheMeshIsBroken) {
  const std::string broken = made::number(0, 8) + "raw " + made::box("mesh", "no mesh");
  write(2, broken);
  EXPECT_NE(error().find("mesh"), std::string::npos) << error();
  EXPECT_EQ(error().find('\n'), std::string::npos);
  const auto element = [](const std::string& name, const std::string& value) {
    return "<GSpherical:" + name + ">" + value + "</GSpherical:" + name + ">";
  };
  write(2, broken,
        "<rdf:SphericalVideo>" + element("Spherical", "true") + element("Stitched", "true") +
            element("ProjectionType", "equirectangular") + element("StereoMode", "left-right") +
            element("CroppedAreaImageWidthPixels", "128") + element("CroppedAreaImageHeightPixels", "128") +
            element("FullPanoWidthPixels", "256") + element("FullPanoHeightPixels", "128") +
            element("CroppedAreaLeftPixels", "64") + element("CroppedAreaTopPixels", "0") + "</rdf:SphericalVideo>");
  const VideoInput video = open_video(path);
  EXPECT_TRUE(video.prototype.maps.empty());
  EXPECT_TRUE(is_vr180(video.prototype.camera.projection));
  EXPECT_EQ(video.prototype.layout, Layout::kSideBySide);
}

// --- what no camera writes -------------------------------------------------------------------------------------------

TEST(MeshBox, WhatMakesNoSenseIsRefusedInWords) {
  const GlVertex corner{-1, -1, -1, 0, 0};
  const std::vector<GlVertex> square = {corner, {1, -1, -1, 1, 0}, {-1, 1, -1, 0, 1}, {1, 1, -1, 1, 1}};
  const List list{0, 0, {0, 1, 2}};
  std::vector<GlVertex> nan = square, infinite = square;
  nan[1].y = NAN, infinite[1].x = INFINITY;
  const std::string good = mesh_body(square, {list});
  EXPECT_EQ(fault_of(box_body({good}, false)), "");
  std::string many = good, count = good;
  count.replace(0, 4, "\x7f\xff\xff\xff");
  many.replace(4 + 4 * static_cast<size_t>(static_cast<unsigned char>(good[3])), 4, made::number(1000000, 4));
  const std::pair<std::string, const char*> cases[] = {
      {box_body({}, false), "the mesh is missing"},
      {box_body({""}, false), "cut short"},
      {box_body({mesh_body(nan, {list})}, false), "NaN or infinite"},
      {box_body({mesh_body(infinite, {list})}, true), "NaN or infinite"},
      {box_body({mesh_body(square, {})}, false), "no triangle"},
      {box_body({mesh_body(square, {{0, 0, {0, 1}}})}, false), "no triangle"},
      {box_body({mesh_body(square, {{0, 7, {0, 1, 2}}})}, false), "unknown primitive type"},
      {box_body({mesh_body(square, {{0, 0, {3, 6, 6}}})}, false), "index of nothing"},
      {box_body({many}, false), "200000"},
      {box_body({count}, false), "fewer than it claims"},
      {made::number(0, 8) + "zip ", "unknown encoding"},
      {made::number(0, 8) + "dfl8" + std::string(20, '\xff'), "cannot be unpacked"},
      {made::number(0, 3), ""},
  };
  for (const auto& [body, words] : cases) {
    const std::string fault = fault_of(body);
    EXPECT_NE(fault, "") << words;
    EXPECT_NE(fault.find(words), std::string::npos) << fault;
  }
  for (size_t size = 0; size < good.size(); size++) {
    EXPECT_NE(fault_of(box_body({good.substr(0, size)}, false)), "") << size;
  }
}

// A corner that is nearly in the plane between two faces; the fuzzer found it.
TEST(MeshBox, CornersFarAsideOfAFaceHaveACell) {
  constexpr char kFound[] =
      "\x00\x00\x00\x00\x5c\x29\x9a\x24\x72\x61\x77\x20\x00\x00\x00\x3f\x6d\x65\x73\x68"
      "\x00\x00\x00\x06\x80\x00\x00\x00\xbf\x80\x3d\x20\x30\x3b\xbd\x2e\x3f\x00\x4b\x00"
      "\xda\x00\x00\x00\x3f\x80\x00\x00\x00\x00\x00\x04\x02\x46\x88\x00\x00\x78\x00\x28"
      "\x00\x00\x00\x00\x00\x01\x00\x00\x00\x00\x00\x06\x09\x03\x00";
  const std::string found(kFound, sizeof kFound - 1);
  const ProjectionMeshes meshes = parse_mesh_box(found);
  ASSERT_FALSE(meshes.eyes.empty());
  for (const TextureMesh& mesh : meshes.eyes) EXPECT_TRUE(make_map(mesh));
}

TEST(MeshBox, MeshesOfNoUseAreRefused) {
  TextureMesh mesh;
  EXPECT_NE(mesh_fault(mesh), "");
  mesh.vertices.assign(3, {vec3(0.0f), vec2(0.0f)});
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(mesh_fault(mesh), "");
  EXPECT_FALSE(make_map(mesh)->place({0.0f, 0.0f, -1.0f}).seen) << "all of it is where the viewer is";
  mesh.triangles = {{0, 1, 3}};
  EXPECT_NE(mesh_fault(mesh), "");
  mesh.vertices.assign(1000000, {vec3(1.0f), vec2(0.0f)});
  EXPECT_NE(mesh_fault(mesh).find("200000"), std::string::npos);
}

}  // namespace
}  // namespace ods
