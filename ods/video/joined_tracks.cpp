// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/joined_tracks.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/camera/file_names.h"

namespace ods {

// --- frames ----------------------------------------------------------------------------------------------------------

namespace {

// A plane of one of two pictures, and of the joined one.
struct JoinedPlane {
  const std::byte* from[2] = {};
  size_t stride[2] = {};
  std::byte* to = nullptr;
  size_t to_stride = 0;
  Extent share{1, 1};  // luma samples for each of its own
};

// The samples of an outer face that one of its own samples is made of, and their weights: from both halves where they
// overlap.
struct FaceTaps {
  std::array<int, 8> places{};
  std::array<float, 8> weights{};
};

}  // namespace

// A picture of this size without gaps, with the properties of `model`, and its planes beside those of two pictures.
static DecodedFrame joined_frame(const DecodedFrame& model, const DecodedFrame& other, Extent size,
                                 std::vector<JoinedPlane>& planes) {
  const size_t sample = model.planes.bits > 8 ? 2 : 1;
  const Extent block = chroma_block(model.planes.chroma);
  const bool has_alpha = model.alpha != nullptr && other.alpha != nullptr;
  DecodedFrame whole = model;
  std::vector<size_t> begins;
  size_t bytes = 0;
  for (size_t i = 0; i < (has_alpha ? 4u : 3u); i++) {
    JoinedPlane plane;
    if (i == 1 || i == 2) plane.share = block;
    for (const size_t k : {size_t{0}, size_t{1}}) {
      const DecodedFrame& part = k == 0 ? model : other;
      plane.from[k] = i < 3 ? part.planes.first[i] : part.alpha;
      plane.stride[k] = i < 3 ? part.planes.stride[i] : part.alpha_stride;
    }
    plane.to_stride = sample * static_cast<size_t>(size.width / plane.share.width);
    begins.push_back(bytes);
    bytes += plane.to_stride * static_cast<size_t>(size.height / plane.share.height);
    planes.push_back(plane);
  }
  const auto memory = std::make_shared<std::vector<std::byte>>(bytes);
  for (size_t i = 0; i < planes.size(); i++) {
    planes[i].to = memory->data() + begins[i];
    if (i < 3) whole.planes.first[i] = planes[i].to, whole.planes.stride[i] = planes[i].to_stride;
    if (i == 3) whole.alpha = planes[i].to, whole.alpha_stride = planes[i].to_stride;
  }
  whole.memory = memory;
  return whole;
}

// Catmull-Rom between four samples of one half; at a whole position it is that sample.
static void add_half(float at, int begin, int end, float share, size_t slot, FaceTaps& taps) {
  const float center = std::floor(at), t = at - center;
  const float weights[] = {t * (-0.5f + t * (1.0f - 0.5f * t)), 1.0f + t * t * (-2.5f + 1.5f * t),
                           t * (0.5f + t * (2.0f - 1.5f * t)), t * t * (-0.5f + 0.5f * t)};
  for (size_t i = 0; i < 4; i++) {
    taps.places[slot + i] = std::clamp(static_cast<int>(center) - 1 + static_cast<int>(i), begin, end - 1);
    taps.weights[slot + i] = share * weights[i];
  }
}

// The samples of a joined outer face. width: of both stored halves together.
static std::vector<FaceTaps> taps_of_face(int face, int width, int overlap) {
  const int half = width / 2;
  const auto stretch = static_cast<float>(width - overlap) / static_cast<float>(face);
  std::vector<FaceTaps> taps(static_cast<size_t>(face));
  for (int x = 0; x < face; x++) {
    const float at = (static_cast<float>(x) + 0.5f) * stretch;  // from the face's edge, without the overlap
    const float share = std::clamp((at - static_cast<float>(half - overlap)) / static_cast<float>(overlap), 0.0f, 1.0f);
    FaceTaps& own = taps[static_cast<size_t>(x)];
    add_half(at - 0.5f, 0, half, 1.0f - share, 0, own);
    add_half(at - 0.5f + static_cast<float>(overlap), half, width, share, 4, own);
  }
  return taps;
}

template <typename T>
static void join_row(const std::byte* from, const std::vector<FaceTaps>& taps, int side, int maximum, std::byte* to) {
  const T* in = reinterpret_cast<const T*>(from);
  T* out = reinterpret_cast<T*>(to);
  const auto face = static_cast<ptrdiff_t>(taps.size());
  for (const ptrdiff_t outer : {ptrdiff_t{0}, ptrdiff_t{2}}) {
    const T* const begin = in + (outer == 0 ? 0 : side + face);
    for (ptrdiff_t x = 0; x < face; x++) {
      const FaceTaps& own = taps[static_cast<size_t>(x)];
      float sum = 0.5f;
      for (size_t i = 0; i < 8; i++) sum += own.weights[i] * static_cast<float>(begin[own.places[i]]);
      out[outer * face + x] = static_cast<T>(std::clamp(sum, 0.0f, static_cast<float>(maximum)));
    }
  }
  std::memcpy(out + face, in + side, static_cast<size_t>(face) * sizeof(T));
}

DecodedFrame join_rows(const DecodedFrame& upper, const DecodedFrame& lower, const FaceRows& rows) {
  std::vector<JoinedPlane> planes;
  DecodedFrame whole = joined_frame(upper, lower, rows.whole(), planes);
  const auto join = upper.planes.bits > 8 ? join_row<uint16_t> : join_row<uint8_t>;
  const int maximum = (1 << upper.planes.bits) - 1;
  for (const JoinedPlane& plane : planes) {
    const int across = plane.share.width, face = rows.track.height / across;
    const int side = (rows.track.width - rows.track.height) / 2 / across;
    const std::vector<FaceTaps> taps = taps_of_face(face, side, rows.overlap / across);
    const int height = rows.track.height / plane.share.height;
    tbb::parallel_for(0, 2 * height, [&](int y) {
      const int part = y / height;
      const std::byte* row = plane.from[part] + static_cast<size_t>(y % height) * plane.stride[part];
      join(row, taps, side, maximum, plane.to + static_cast<size_t>(y) * plane.to_stride);
    });
  }
  return whole;
}

DecodedFrame join_eyes(const DecodedFrame& left, const DecodedFrame& right, Extent eye) {
  std::vector<JoinedPlane> planes;
  DecodedFrame whole = joined_frame(left, right, {2 * eye.width, eye.height}, planes);
  for (const JoinedPlane& plane : planes) {
    const size_t bytes = plane.to_stride / 2;
    for (size_t y = 0; y < static_cast<size_t>(eye.height / plane.share.height); y++) {
      std::byte* const row = plane.to + y * plane.to_stride;
      for (const size_t k : {size_t{0}, size_t{1}})
        std::memcpy(row + k * bytes, plane.from[k] + y * plane.stride[k], bytes);
    }
  }
  return whole;
}

// --- tracks ----------------------------------------------------------------------------------------------------------

// The sizes of the camera's modes: 5.6K, and 3K.
std::optional<FaceRows> face_rows_of(Extent track) {
  for (const FaceRows& rows : {FaceRows{{4096, 1344}, 64}, FaceRows{{2272, 736}, 32}}) {
    if (rows.track.width == track.width && rows.track.height == track.height) return rows;
  }
  return std::nullopt;
}

static bool are_alike(const VideoTrack& one, const VideoTrack& other) {
  return one.size.width == other.size.width && one.size.height == other.size.height;
}

Extent joined_size(Extent track, Views views) {
  if (views == Views::kFaceRows) return face_rows_of(track).value().whole();
  return {2 * track.width, track.height};
}

uint64_t other_track(const std::string& path, uint64_t track) {
  const VideoFile video = read_video_file(path);
  const VideoTrack& one = choose_track(video, static_cast<int>(track), path);
  for (const VideoTrack& other : video.tracks) {
    const bool is_partner = one.eye ? other.eye == 1 - *one.eye : other.id != track;
    if (is_partner && are_alike(one, other)) return other.id;
  }
  throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': it has no other track of the size of {}", path, track));
}

std::optional<DecodedFrame> join_next(const DecodedFrame& picture, const VideoStream& stream, VideoDecoder& other,
                                      Extent track, Views views, const std::string& path) {
  const auto fail = [&](const char* why) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}", path, why));
  };
  const VideoStream& second = other.stream();
  if (second.size.width != track.width || second.size.height != track.height || second.bits != stream.bits ||
      second.chroma != stream.chroma || second.has_alpha != stream.has_alpha) {
    fail("its two tracks have different formats");
  }
  const double half = 0.5 / stream.rate.value();
  const double time = static_cast<double>(picture.time.start) / stream.clock.value();
  const auto time_of = [&](const DecodedFrame& frame) {
    return static_cast<double>(frame.time.start) / second.clock.value();
  };
  std::optional<DecodedFrame> partner = other.next();
  while (partner && time_of(*partner) < time - half) partner = other.next();
  if (!partner) return std::nullopt;
  if (time_of(*partner) > time + half) fail("a picture of one of its two tracks is missing in the other one");
  if (views == Views::kFaceRows) return join_rows(picture, *partner, face_rows_of(track).value());
  return join_eyes(picture, *partner, track);
}

static ChosenPictures joined_eyes(const VideoTrack& left, const VideoTrack& right, Layout layout) {
  ChosenPictures chosen{left, Views::kTwoTracks, right.id, layout};
  chosen.track.size.width *= 2;
  chosen.note = fmt::format("its eyes are two tracks: {} and {} of the same size", left.id, right.id);
  const VideoStereo stereo = *stereo_with(arrangement_of(layout));
  for (std::optional<SphericalMetadata>* said : {&chosen.track.v1, &chosen.track.v2, &chosen.track.vexu}) {
    if (*said) (*said)->stereo = stereo;
  }
  return chosen;
}

// The two tracks that the container combines to a stereo pair, or else those of the largest pictures; empty if there
// are more, or only one.
static std::vector<const VideoTrack*> pair_in(const VideoFile& video) {
  const auto pixels = [](const VideoTrack& track) { return int64_t{track.size.width} * track.size.height; };
  const bool has_planes =
      std::ranges::any_of(video.tracks, [](const VideoTrack& track) { return track.eye.has_value(); });
  std::vector<const VideoTrack*> tracks;
  for (const VideoTrack& track : video.tracks) {
    if (has_planes && !track.eye) continue;
    if (!tracks.empty() && pixels(track) < pixels(*tracks[0])) continue;
    if (!tracks.empty() && pixels(track) > pixels(*tracks[0])) tracks.clear();
    tracks.push_back(&track);
  }
  return tracks.size() == 2 && are_alike(*tracks[0], *tracks[1]) ? tracks : std::vector<const VideoTrack*>();
}

ChosenPictures choose_pictures(const VideoFile& video, std::optional<Layout> layout, const std::string& path) {
  const std::vector<const VideoTrack*> pair = pair_in(video);
  if (pair.empty()) return {choose_track(video, {}, path)};
  const VideoTrack &one = *pair[0], &other = *pair[1];
  if (const std::optional<FaceRows> rows = face_rows_of(one.size)) {
    ChosenPictures chosen{one, Views::kFaceRows, other.id, Layout::kSeparate};
    chosen.track.size = rows->whole();
    chosen.projection = find_projection("eac")->setting;
    chosen.note = "a cube in two tracks, as GoPro's MAX stores it";
    return chosen;
  }
  if (small_letters(path).ends_with(".insv")) {  // how the lenses look is for their pixels to tell
    ChosenPictures chosen = joined_eyes(one, other, Layout::kSideBySide);
    chosen.layout.reset(), chosen.note = "its two lenses are two tracks, as Insta360 stores them";
    return chosen;
  }
  if (layout == Layout::kSeparate) return {one};
  const auto eye_of = [](const VideoTrack& track) { return track.eye ? track.eye : eye_of_words(track.name); };
  const std::optional<int> first = eye_of(one), second = eye_of(other);
  const bool is_told = first && second && *first != *second;
  if (layout && layout != Layout::kSideBySide && layout != Layout::kCrossEyed) return {choose_track(video, {}, path)};
  if (is_told) {
    return *first == kLeft ? joined_eyes(one, other, layout.value_or(Layout::kSideBySide))
                           : joined_eyes(other, one, layout.value_or(Layout::kSideBySide));
  }
  if (layout) return joined_eyes(one, other, *layout);
  return {choose_track(video, {}, path)};
}

}  // namespace ods
