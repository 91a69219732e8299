// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos with format metadata, as written by other programs and by us, for tests of how the metadata is handled.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "ods/video/container/apple.h"
#include "ods/video/container/complete_metadata.h"
#include "tests/support/made_videos.h"
#include "tests/support/temporary_folder.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/spherical.h>
#include <libavutil/stereo3d.h>
}

namespace ods::made {

// A video and the bytes that are kept unless another format is requested.
struct Tagged {
  std::string title;
  std::string name;  // name of its file
  std::string video;
  std::vector<std::string> kept;
};

// --- boxes, as written by other programs -----------------------------------------------------------------------------

inline std::string st3d(int mode) {
  return box("st3d", number(0, 4) + number(static_cast<uint64_t>(mode), 1));
}

inline std::string sv3d(const std::string& source, const std::string& data, double yaw = 0.0, double pitch = 0.0,
                        double roll = 0.0) {
  std::string pose(4, '\0');
  for (double angle : {yaw, pitch, roll}) pose += number(static_cast<uint32_t>(std::lround(angle * 65536.0)), 4);
  return box("sv3d", box("svhd", number(0, 4) + source + '\0') + box("proj", box("prhd", pose) + data));
}

inline std::string equi(uint64_t top, uint64_t bottom, uint64_t left, uint64_t right) {
  return box("equi", number(0, 4) + number(top, 4) + number(bottom, 4) + number(left, 4) + number(right, 4));
}

constexpr uint64_t kQuarter = 0x40000000;
inline const std::string kWhole = equi(0, 0, 0, 0), kHalf = equi(0, 0, kQuarter, kQuarter);
inline const std::string kCube = box("cbmp", number(0, 4) + number(0, 4) + number(16, 4));  // with padding
inline const std::string kMesh = box("mshp", number(0, 4) + number(0x12345678, 4) + "raw meshes of a camera");

// Metadata as written by google/spatial-media: with a head, over several lines, and more than we write.
inline std::string v1(const std::string& stereo, const std::string& more = "") {
  std::string xml =
      "<?xml version=\"1.0\"?><rdf:SphericalVideo\nxmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"\n"
      "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">"
      "<GSpherical:Spherical>true</GSpherical:Spherical><GSpherical:Stitched>true</GSpherical:Stitched>"
      "<GSpherical:StitchingSoftware>Spherical Metadata Tool</GSpherical:StitchingSoftware>"
      "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>"
      "<GSpherical:SourceCount>6</GSpherical:SourceCount>";
  if (!stereo.empty()) xml += "<GSpherical:StereoMode>" + stereo + "</GSpherical:StereoMode>";
  return xml + more + "</rdf:SphericalVideo>";
}

inline std::string v1_box(const std::string& stereo, const std::string& more = "") {
  return box("uuid", std::string(kV1Id) + v1(stereo, more));
}

inline const std::string kCrop =
    "<GSpherical:CroppedAreaImageWidthPixels>512</GSpherical:CroppedAreaImageWidthPixels>"
    "<GSpherical:CroppedAreaImageHeightPixels>128</GSpherical:CroppedAreaImageHeightPixels>"
    "<GSpherical:FullPanoWidthPixels>512</GSpherical:FullPanoWidthPixels>"
    "<GSpherical:FullPanoHeightPixels>256</GSpherical:FullPanoHeightPixels>"
    "<GSpherical:CroppedAreaLeftPixels>0</GSpherical:CroppedAreaLeftPixels>"
    "<GSpherical:CroppedAreaTopPixels>64</GSpherical:CroppedAreaTopPixels>";

inline std::string vexu(int flags, const std::string& kind, const std::string& packing) {
  const std::string none(4, '\0');
  const std::string eyes = box("stri", none + number(static_cast<uint64_t>(flags), 1)) + box("hero", none + "\2") +
                           box("cams", box("blin", none + number(63500, 4))) +
                           box("cmfy", box("dadj", none + number(200, 4)));
  return box("vexu",
             box("eyes", eyes) + box("proj", box("prji", none + kind)) + box("pack", box("pkin", none + packing))) +
         box("hfov", number(180000, 4));
}

inline Tagged boxes(const std::string& title, int width, int height, const std::string& entry,
                    const std::string& track = "", std::vector<std::string> kept = {}) {
  Mp4Options options;
  options.widths = {width};
  options.height = height;
  options.entry_boxes = entry;
  options.track_boxes = track;
  options.sound_boxes = box("chan", "somebody's");
  return {title, "video.mp4", mp4(options), std::move(kept)};
}

inline std::vector<Tagged> videos_of_boxes() {
  const std::string google = "Spherical Metadata Tool";
  const std::string tb = st3d(1) + sv3d(google, kWhole), vr180 = st3d(2) + sv3d("Camera", kHalf, 10.0, -5.5, 2.25);
  Mp4Options sound;
  sound.entry_boxes = tb;
  sound.sound_boxes = box("SA3D", number(0, 2) + number(1, 4) + number(0, 2) + number(4, 4) + number(3, 4) +
                                      number(2, 4) + number(1, 4) + number(0, 4));
  Mp4Options two;
  two.entry_boxes = tb;
  two.widths = {512, 128};
  const std::string apple = vexu(3, "hequ", "side");
  return {
      boxes("V2, top-bottom", 256, 256, tb),
      boxes("V2, mono without st3d", 512, 256, sv3d(google, kWhole)),
      boxes("V2, side-by-side of a half", 512, 256, vr180),
      boxes("V2, cross-eyed", 1024, 256, st3d(4) + sv3d("", kWhole, -90.0)),
      boxes("V2, cropped", 256, 128, st3d(0) + sv3d(google, equi(0x12345678, 0x2468ace0, 7, 9))),
      boxes("V2, a padded cubemap", 384, 256, st3d(0) + sv3d("Cubes", kCube, 0.0, 0.0, 90.0), "", {kCube}),
      boxes("V2, a mesh", 512, 256, st3d(3) + sv3d("Camera", kMesh), "", {kMesh}),
      boxes("V2, flat stereo", 512, 256, st3d(2)),
      boxes("V1, top-bottom", 256, 256, "", v1_box("top-bottom"), {"<GSpherical:SourceCount>6<"}),
      boxes("V1, without a word on stereo", 512, 256, "", v1_box("", "<GSpherical:Timestamp>1</GSpherical:Timestamp>"),
            {"<GSpherical:Timestamp>1<"}),
      boxes("V1, heading", 512, 256, "",
            v1_box("mono", "<GSpherical:InitialViewHeadingDegrees>270</GSpherical:InitialViewHeadingDegrees>")),
      boxes("V1, cropped", 512, 128, "", v1_box("mono", kCrop), {kCrop}),
      boxes("both", 256, 256, tb, v1_box("top-bottom"), {"<GSpherical:SourceCount>6<"}),
      boxes("V2 and a cropped V1", 512, 128, st3d(0) + sv3d(google, equi(kQuarter, kQuarter, 0, 0)),
            v1_box("mono", kCrop), {kCrop}),
      boxes("V2 and vexu", 512, 256, st3d(2) + sv3d("Camera", kHalf) + apple, "", {apple}),
      boxes("vexu alone", 512, 256, apple, "", {apple}),
      {"ambisonics in another order", "video.mp4", mp4(sound), {}},
      {"two tracks", "video.mp4", mp4(two), {}},
  };
}

// --- Matroska --------------------------------------------------------------------------------------------------------

inline std::string projection(int type, const std::string& body, float yaw = 0.0f) {
  uint32_t bits = 0;
  std::memcpy(&bits, &yaw, sizeof(bits));
  std::string children = element(0x7671, number(static_cast<uint64_t>(type), 1)) + element(0x7672, body);
  if (yaw != 0.0f) children += element(0x7673, number(bits, 4));
  return element(0x7670, children);
}

inline Tagged tagged_matroska(const std::string& title, int width, int height, const std::string& video) {
  MatroskaOptions options;
  options.width = width;
  options.height = height;
  options.room = 3000;
  options.records_position = false;
  options.video = video;
  return {title, "video.mkv", made::matroska(options), {}};
}

inline std::vector<Tagged> videos_of_elements() {
  const std::string none(4, '\0'), whole(20, '\0');
  const std::string half = none + number(0, 8) + number(kQuarter, 4) + number(kQuarter, 4);
  const std::string stereo = element(0x53b8, number(3, 1)), shown = element(0x54ba, number(128, 2));
  return {
      tagged_matroska("Matroska, top-bottom", 256, 256, stereo + projection(1, whole)),
      tagged_matroska("Matroska, with a size to display", 256, 256, shown + stereo + projection(1, whole, 12.5f)),
      tagged_matroska("Matroska, side-by-side of a half", 512, 256,
                      element(0x53b8, number(1, 1)) + projection(1, half)),
      tagged_matroska("Matroska, bottom-top", 256, 256, element(0x53b8, number(2, 1)) + projection(1, whole)),
      tagged_matroska("Matroska, a padded cubemap", 384, 256, projection(2, none + number(0, 4) + number(16, 4))),
      tagged_matroska("Matroska, a mesh", 512, 256, projection(3, "any mesh")),
      tagged_matroska("Matroska, flat stereo", 512, 256, element(0x53b8, number(1, 1))),
      tagged_matroska("Matroska, mono by its projection alone", 512, 256, projection(1, whole)),
      tagged_matroska("Matroska, said to be flat", 512, 256, element(0x53b8, number(1, 1)) + projection(0, "")),
  };
}

// --- videos of our own and of FFmpeg's -------------------------------------------------------------------------------

inline std::vector<Tagged> videos_of_ours(const TemporaryFolder& folder) {
  std::vector<Tagged> cases;
  for (VideoStereo stereo : {VideoStereo::kOneView, VideoStereo::kTopBottom, VideoStereo::kSideBySide,
                             VideoStereo::kRightLeft, VideoStereo::kBottomTop}) {
    for (const char* shown : {"lat-long", "vr180", "cubemap", "flat"}) {
      for (const char* name : {"own.mp4", "own.mkv"}) {
        SphericalMetadata metadata;
        metadata.stereo = stereo;
        metadata.source = "Omnistereo";
        if (const NamedProjection* named = find_projection(shown)) set_projection(metadata, named->setting);
        if (!metadata.projection)
          metadata.projection = *shown == 'f' ? VideoProjection::kFlat : VideoProjection::kCubemap;
        const bool is_mp4 = std::string(name).ends_with("4");
        if (is_mp4 && !fits_v2(metadata)) continue;
        metadata.for_apple = is_mp4 && fits_vexu(metadata) && stereo == VideoStereo::kTopBottom;
        metadata.ipd = metadata.for_apple ? 0.0625 : 0.0;
        metadata.yaw = metadata.projection == VideoProjection::kFlat ? 0.0 : -20.0;
        Mp4Options box_options;
        MatroskaOptions options;
        const bool is_stacked = stereo == VideoStereo::kTopBottom || stereo == VideoStereo::kBottomTop;
        box_options.widths = {options.width = is_stacked ? 256 : 512};
        box_options.height = options.height = 256;
        box_options.sound_boxes = box("chan", "x");
        folder.write(name, is_mp4 ? mp4(box_options) : matroska(options));
        tag_video(folder.path(name), folder.path(name), 1, metadata);
        cases.push_back({"ours: " + metadata_text(metadata), name, folder.read(name), {}});
      }
    }
  }
  return cases;
}

inline void add_side_data(AVStream* stream, AVPacketSideDataType type, uint8_t* data, size_t size) {
#if LIBAVFORMAT_VERSION_MAJOR >= 61
  AVCodecParameters* all = stream->codecpar;
  ASSERT_NE(av_packet_side_data_add(&all->coded_side_data, &all->nb_coded_side_data, type, data, size, 0), nullptr);
#else
  ASSERT_EQ(av_stream_add_side_data(stream, type, data, size), 0);
#endif
}

// A video written by libavformat, with one packet that is not decoded.
inline std::string muxed(const std::string& path, int width, int height, AVStereo3DType eyes, bool has_sphere,
                         AVSphericalProjection sphere, bool has_stereo = true) {
  AVFormatContext* video = nullptr;
  avformat_alloc_output_context2(&video, nullptr, nullptr, path.c_str());
  video->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;
  AVStream* stream = avformat_new_stream(video, nullptr);
  stream->time_base = {1, 25};
  stream->codecpar->codec_type = AVMEDIA_TYPE_VIDEO;
  stream->codecpar->codec_id = AV_CODEC_ID_MPEG4;
  stream->codecpar->width = width;
  stream->codecpar->height = height;
  AVStereo3D* stereo = av_stereo3d_alloc();
  stereo->type = eyes;
  if (has_stereo) {
    add_side_data(stream, AV_PKT_DATA_STEREO3D, reinterpret_cast<uint8_t*>(stereo), sizeof(*stereo));
  } else {
    av_free(stereo);
  }
  size_t size = 0;
  AVSphericalMapping* mapping = av_spherical_alloc(&size);
  mapping->projection = sphere;
  mapping->yaw = 30 << 16, mapping->pitch = -(7 << 16);
  if (sphere == AV_SPHERICAL_CUBEMAP) mapping->padding = 4;
  if (sphere == AV_SPHERICAL_EQUIRECTANGULAR_TILE) mapping->bound_left = mapping->bound_right = 0x40000000;
  if (has_sphere) {
    add_side_data(stream, AV_PKT_DATA_SPHERICAL, reinterpret_cast<uint8_t*>(mapping), size);
  } else {
    av_free(mapping);
  }
  EXPECT_GE(avio_open(&video->pb, path.c_str(), AVIO_FLAG_WRITE), 0);
  EXPECT_GE(avformat_write_header(video, nullptr), 0);
  AVPacket* packet = av_packet_alloc();
  av_new_packet(packet, 16);
  std::memcpy(packet->data, "sixteen bytes...", 16);
  packet->pts = packet->dts = 0;
  packet->flags = AV_PKT_FLAG_KEY;
  EXPECT_GE(av_interleaved_write_frame(video, packet), 0);
  av_packet_free(&packet);
  EXPECT_GE(av_write_trailer(video), 0);
  avio_closep(&video->pb);
  avformat_free_context(video);
  return path;
}

inline std::vector<Tagged> videos_of_ffmpeg(const TemporaryFolder& folder) {
  std::vector<Tagged> cases;
  for (const std::string name : {"ffmpeg.mp4", "ffmpeg.mkv"}) {
    const auto add = [&](const char* title, int width, int height, AVStereo3DType eyes, bool has_sphere,
                         AVSphericalProjection sphere) {
      muxed(folder.path(name), width, height, eyes, has_sphere, sphere);
      cases.push_back({std::string("FFmpeg: ") + title, name, folder.read(name), {}});
    };
    add("top-bottom", 256, 256, AV_STEREO3D_TOPBOTTOM, true, AV_SPHERICAL_EQUIRECTANGULAR);
    add("mono", 512, 256, AV_STEREO3D_2D, true, AV_SPHERICAL_EQUIRECTANGULAR);
    add("a half", 512, 256, AV_STEREO3D_SIDEBYSIDE, true, AV_SPHERICAL_EQUIRECTANGULAR_TILE);
    add("a cubemap", 384, 256, AV_STEREO3D_2D, true, AV_SPHERICAL_CUBEMAP);
    add("flat stereo", 512, 256, AV_STEREO3D_SIDEBYSIDE, false, AV_SPHERICAL_EQUIRECTANGULAR);
  }
  return cases;
}

// --- videos tagged by other programs -------------------------------------------------------------------------------

inline bool runs(const std::string& words) {
  return std::system((words + " >/dev/null 2>&1").c_str()) == 0;
}

// Videos as written by exiftool and mkvpropedit; none for a program that is not installed.
inline std::vector<Tagged> videos_of_tools(const TemporaryFolder& folder) {
  std::vector<Tagged> cases;
  const auto add = [&](const std::string& title, const std::string& name, int width, int height,
                       const std::string& words) {
    muxed(folder.path(name), width, height, AV_STEREO3D_2D, false, AV_SPHERICAL_EQUIRECTANGULAR, false);
    EXPECT_TRUE(runs(words + " " + folder.path(name))) << words;
    cases.push_back({title, name, folder.read(name), {}});
  };
  if (runs("exiftool -ver")) {
    const std::string sphere =
        "exiftool -overwrite_original -XMP-GSpherical:Spherical=true -XMP-GSpherical:Stitched=true "
        "-XMP-GSpherical:StitchingSoftware=Camera -XMP-GSpherical:ProjectionType=equirectangular";
    add("exiftool: top-bottom", "ffmpeg.mp4", 256, 256, sphere + " -XMP-GSpherical:StereoMode=top-bottom");
    add("exiftool: mono with a heading", "ffmpeg.mp4", 512, 256,
        sphere + " -XMP-GSpherical:StereoMode=mono -XMP-GSpherical:InitialViewHeadingDegrees=90");
  }
  if (runs("mkvpropedit --version")) {
    // Options come after the file.
    const auto edit = [&](const std::string& title, int width, int height, const std::string& sets) {
      muxed(folder.path("ffmpeg.mkv"), width, height, AV_STEREO3D_2D, false, AV_SPHERICAL_EQUIRECTANGULAR, false);
      EXPECT_TRUE(runs("mkvpropedit " + folder.path("ffmpeg.mkv") + " --edit track:v1 " + sets)) << sets;
      cases.push_back({title, "ffmpeg.mkv", folder.read("ffmpeg.mkv"), {}});
    };
    const std::string whole(40, '0');
    edit("mkvpropedit: top-bottom", 256, 256,
         "--set stereo-mode=3 --set projection-type=1 --set projection-private=" + whole);
    edit("mkvpropedit: a turned half", 512, 256,
         "--set stereo-mode=1 --set projection-type=1 --set projection-pose-yaw=30 --set "
         "projection-private=000000000000000000000000" +
             std::string("4000000040000000"));
    edit("mkvpropedit: stereo alone", 512, 256, "--set stereo-mode=1");
  }
  return cases;
}

}  // namespace ods::made
