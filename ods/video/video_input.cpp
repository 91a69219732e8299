// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/video_input.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "ods/base/error.h"
#include "ods/files/scratch.h"
#include "ods/image/format/pixel_place.h"
#include "ods/picture/metadata/phone_window.h"
#include "ods/picture/stored_lenses.h"
#include "ods/video/container/complete_metadata.h"
#include "ods/video/container/mesh_box.h"
#include "ods/video/joined_tracks.h"

namespace ods {

static Error unusable(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot use '{}': {}", path, why));
}

// --- format ----------------------------------------------------------------------------------------------------------

// Returns nullopt for mono.
static std::optional<Layout> layout_of_video(VideoStereo stereo, const std::string& path) {
  if (stereo == VideoStereo::kOneView) return Layout::kSeparate;
  const EyeArrangement eyes = arrangement_of(stereo);
  if (eyes.is_halves()) return layout_with(eyes);
  throw unusable(path, fmt::format("its layout is {}", stereo_name(stereo)));
}

static ProjectionSetting projection_of(const SphericalMetadata& metadata, const std::string& path) {
  if (metadata.projection != VideoProjection::kEquirect) {
    throw unusable(path, fmt::format("it claims to be {}; ods reads videos in lat-long and parts of it (`projection` "
                                     "overrides a wrong claim)",
                                     projection_name(*metadata.projection)));
  }
  const auto part = [](uint32_t bound, double whole) { return static_cast<float>(bound / 4294967296.0 * whole); };
  ProjectionSetting projection;
  projection.latitude = vec2(-90.0f + part(metadata.bounds[1], 180.0), 90.0f - part(metadata.bounds[0], 180.0));
  projection.longitude = vec2(-180.0f + part(metadata.bounds[2], 360.0), 180.0f - part(metadata.bounds[3], 360.0));
  return projection;
}

// The decoded form of a track whose eyes are layers. `known` contains the caller's settings.
static VideoTrack decoded_track(const VideoTrack& stored, const FormatHint& known, VideoInput& video) {
  VideoTrack track = stored;
  if (!track.layers) return track;
  track.vexu = track.layers->beside;
  if (known.layout) {
    track.vexu->stereo = VideoStereo::kOneView;
    return track;
  }
  if (!can_decode_both_views()) {
    throw unusable(
        video.path,
        "its eyes are layers of its stream (MV-HEVC, a spatial video of a phone), which this machine's FFmpeg does not "
        "take apart. 7.1 does: ffmpeg -i VIDEO -filter_complex '[0:v:view:0][0:v:view:1]hstack' FLAT_SBS.mp4; "
        "`layout` separate takes the first eye alone");
  }
  video.views = track.layers->right_first ? Views::kRightAndLeft : Views::kLeftAndRight;
  track.size.width *= 2;
  for (std::optional<SphericalMetadata>* said : {&track.v1, &track.v2}) {
    if (*said) (*said)->stereo = VideoStereo::kSideBySide;
  }
  return track;
}

// Eyes whose rows or columns alternate become two halves of the decoded frames. Returns their layout, or nullopt.
static std::optional<Layout> split_layout(const VideoTrack& track, const FormatHint& known, VideoInput& video) {
  const std::optional<SphericalMetadata> said = declared_metadata(track);
  const EyeArrangement eyes = known.layout           ? arrangement_of(*known.layout)
                              : said && said->stereo ? arrangement_of(*said->stereo)
                                                     : EyeArrangement();
  if (eyes.how != EyePacking::kRows && eyes.how != EyePacking::kColumns) return std::nullopt;
  video.views = eyes.how == EyePacking::kRows ? Views::kRows : Views::kColumns;
  return layout_with({eyes.how == EyePacking::kRows ? EyePacking::kStacked : EyePacking::kBeside, eyes.right_first});
}

static SphericalMetadata metadata_of(const VideoTrack& track, const FormatHint& known, const std::string& path,
                                     std::vector<std::string>& guesses) {
  SphericalMetadata metadata = track.v2 ? *track.v2 : track.v1.value_or(SphericalMetadata());
  if (known.layout)
    metadata.stereo = *known.layout == Layout::kSeparate ? VideoStereo::kOneView : video_stereo(*known.layout);
  if (known.projection && can_say_projection(*known.projection)) {
    set_projection(metadata, *known.projection);
  } else if (known.projection) {
    metadata.projection = VideoProjection::kOther;
  }
  return complete_metadata(metadata, track, path, guesses);
}

// V2's yaw turns the picture to the left, so the view moves to the right.
static void set_orientation(StereoCamera& stereo, const SphericalMetadata& metadata) {
  stereo.yaw = -static_cast<float>(metadata.yaw);
  stereo.pitch = static_cast<float>(metadata.pitch);
  stereo.roll = static_cast<float>(metadata.roll);
}

// Sets the metadata of a lat-long that covers the directions of these meshes.
static void set_lat_long(SphericalMetadata& metadata, const std::vector<TextureMesh>& eyes, Layout layout) {
  const bool is_half = std::all_of(eyes.begin(), eyes.end(), is_front_half);
  set_projection(metadata, find_projection(is_half ? "vr180" : "lat-long")->setting);
  metadata.stereo = layout == Layout::kSeparate ? VideoStereo::kOneView : video_stereo(layout);
}

// Reads the mesh of a video that has one. If it cannot be read, V1 is used.
static void take_mesh(VideoInput& video, const VideoTrack& track) {
  std::vector<std::string>& notes = video.prototype.guesses;
  try {
    if (track.mesh.empty()) throw MalformedFile("its projection is a mesh, but the mesh is missing");
    const ProjectionMeshes meshes = parse_mesh_box(track.mesh);
    const MeshedEyes eyes = eyes_of_meshes(meshes, *video.metadata.stereo);
    if (!meshes.fits_checksum)
      notes.emplace_back("the checksum of its mesh does not match: another program changed it");
    for (const TextureMesh& eye : eyes.eyes) video.prototype.maps.push_back(make_map(eye));
    set_lat_long(video.metadata, eyes.eyes, eyes.layout);
    notes.push_back(fmt::format("it has its camera's lenses as a mesh ({} triangles)", eyes.eyes[0].triangles.size()));
  } catch (const MalformedFile& fault) {
    if (!track.v1 || track.v1->projection != VideoProjection::kEquirect) {
      throw unusable(video.path, fmt::format("{}; specify `projection` and `layout`", fault.what()));
    }
    notes.push_back(fmt::format("{}: using its V1 metadata, {}", fault.what(), metadata_text(*track.v1)));
    video.metadata = *track.v1;
    if (!video.metadata.stereo) video.metadata.stereo = VideoStereo::kOneView;
  }
}

VideoInput open_video(const std::string& path, const FormatHint& given) {
  const VideoFile info = read_video_file(path);
  VideoInput video;
  video.path = path;
  FormatHint known = given;
  const ChosenPictures chosen = choose_pictures(info, known.layout, path);
  video.views = chosen.views;
  video.other_track = chosen.other;
  if (!known.layout) known.layout = chosen.layout;
  if (!known.projection) known.projection = chosen.projection;
  const VideoTrack track = decoded_track(chosen.track, known, video);
  if (const std::optional<Layout> split = split_layout(track, known, video)) known.layout = split;
  video.track = track.id;
  video.fps = track.fps;
  StoredPicture& prototype = video.prototype;
  video.metadata = metadata_of(track, known, path, prototype.guesses);
  if (video.metadata.projection == VideoProjection::kMesh) take_mesh(video, track);
  FileInfo file;
  file.width = track.size.width;
  file.height = track.size.height;
  file.is_float = true;  // skips the search for a picture's XMP
  FormatHint all;
  all.layout = known.layout ? known.layout : layout_of_video(*video.metadata.stereo, path);
  prototype.layout = *all.layout;
  prototype.layout_reason = "according to the video";
  const std::optional<Extent> eye = unpacked_size(prototype.layout, track.size);
  if (!eye) {
    throw unusable(path, fmt::format("{}x{} pixels are not two eyes, {}", track.size.width, track.size.height,
                                     layout_name(prototype.layout)));
  }
  if ((eye->width | eye->height) % 2 != 0) {
    throw unusable(path, fmt::format("its eyes of {}x{} pixels share chroma samples: their sides are odd", eye->width,
                                     eye->height));
  }
  prototype.size = *eye;
  if (track.pixel_aspect != 1.0) file.numbers[std::string(kPixelAspect)] = {static_cast<float>(track.pixel_aspect)};
  const Extent shown = shown_eye(file, prototype.layout);
  const bool is_window = track.layers && video.metadata.projection == VideoProjection::kFlat;
  all.projection = known.projection ? with_shape(*known.projection, shown)
                   : is_window      ? phone_window(track.layers->fov, shown, prototype.guesses)
                                    : projection_of(video.metadata, path);
  const StereoFormat format = find_format(file, path, all);
  prototype.camera = format.camera;
  prototype.has_ipd = format.has_ipd;
  set_orientation(prototype.camera, video.metadata);
  if (video.metadata.ipd > 0.0) {
    prototype.camera.ipd = static_cast<float>(video.metadata.ipd);
    prototype.has_ipd = true;
  }
  prototype.eyes.resize(prototype.layout == Layout::kSeparate ? 1 : 2);
  for (size_t i = 0; prototype.eyes.size() == 2 && i < 2; i++) prototype.eyes[i].eye = i == 0 ? kLeft : kRight;
  take_lenses(prototype, known, shown, path);
  return video;
}

// --- its pictures ----------------------------------------------------------------------------------------------------

static uint16_t code16(float code) {
  return static_cast<uint16_t>(std::clamp(code, 0.0f, 1.0f) * 65535.0f + 0.5f);
}

static uint16_t alpha16(const DecodedFrame& frame, int x, int y) {
  const std::byte* row = frame.alpha + static_cast<size_t>(y) * frame.alpha_stride;
  const int bits = frame.planes.bits, maximum = (1 << bits) - 1;
  if (bits == 8) return static_cast<uint16_t>(static_cast<int>(row[x]) * 257);
  uint16_t value;
  std::memcpy(&value, row + 2 * static_cast<size_t>(x), sizeof(value));
  return static_cast<uint16_t>((std::min<int>(value, maximum) * 65535 + maximum / 2) / maximum);
}

StoredPicture picture_of(const VideoInput& video, const VideoStream& stream, const DecodedFrame& frame) {
  StoredPicture picture = video.prototype;
  const Extent eye = picture.size;
  const size_t channels = stream.has_alpha ? 4 : 3;
  const size_t row_bytes = static_cast<size_t>(eye.width) * channels * sizeof(uint16_t);
  const size_t eye_bytes = row_bytes * static_cast<size_t>(eye.height);
  picture.memory = std::make_shared<Scratch>(eye_bytes * picture.eyes.size(), "", 0);
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    const EyeCorner corner = eye_corner(picture.layout, eye, static_cast<int>(i));
    const Planes planes = frame.planes.at(corner.x, corner.y);
    std::byte* const to = picture.memory->data() + i * eye_bytes;
    tbb::parallel_for(0, eye.height, [&](int y) {
      std::vector<float> row(3 * static_cast<size_t>(eye.width));
      get_codes(planes, eye, stream.color, y, 0, row);
      auto* out = reinterpret_cast<uint16_t*>(to + static_cast<size_t>(y) * row_bytes);
      for (int x = 0; x < eye.width; x++) {
        for (int c = 0; c < 3; c++) *out++ = code16(row[static_cast<size_t>(c * eye.width + x)]);
        if (channels == 4) *out++ = alpha16(frame, corner.x + x, corner.y + y);
      }
    });
    LayerPixels layer{{"R", "G", "B"}, LayerRule::kLight, SampleType::kUint16, to, 0, 0};
    if (channels == 4) layer.channels.emplace_back("A");
    layer.pixel_stride = static_cast<ptrdiff_t>(channels * sizeof(uint16_t));
    layer.row_stride = static_cast<ptrdiff_t>(row_bytes);
    picture.eyes[i].layers.push_back(layer);
  }
  return picture;
}

}  // namespace ods
