// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the metadata first, and the pixels only if necessary.
#include <fmt/format.h>

#include "ods/base/error.h"
#include "ods/files/private_folder.h"
#include "ods/identify/identify.h"
#include "ods/identify/lenses.h"
#include "ods/video/container/complete_metadata.h"
#include "ods/video/video_input.h"

namespace ods {

StoredPicture open_whole(const std::string& path) {
  OpenOptions open;
  open.color_only = true;
  open.format.layout = Layout::kSeparate;
  open.format.projection = ProjectionSetting();  // any: the pixels are used as stored
  open.scratch_folder = temporary_folder();
  return open_picture(path, open);
}

FormatHint with_words(const FormatHint& known, const StereoFormat& format) {
  FormatHint all = known;
  if (format.layout.source < LayoutSource::kPixels) {
    all.one_eye = !format.layout.layout;
    all.layout = format.layout.layout;
  }
  return all;
}

// Returns whether the pixels contradict the format that the aspect ratio suggests.
static bool excludes_shape(const Identity& identity, const StereoFormat& format) {
  constexpr double kExcluded = 0.05;
  double certainty = 0.0;
  for (const Reading& reading : identity.readings) {
    const bool same = reading.layout == format.layout.layout &&
                      projection_name(reading.projection) == projection_name(format.camera.projection);
    certainty += same ? reading.certainty : 0.0;
  }
  return certainty < kExcluded;
}

FormatHint with_seen(const FormatHint& known, const StereoFormat& format, const Identity& identity) {
  FormatHint all = known;
  if (!identity.is_likely()) return all;
  const bool has_shape = format.layout.source == LayoutSource::kShape;
  if (has_shape && !identity.is_sure() && !excludes_shape(identity, format)) return all;
  const Reading& best = identity.best();
  all.bars = identity.bars;
  const std::string bars = identity.bars.any() ? ", inside black bars" : "";
  all.seen =
      SeenFormat{best.layout, best.projection, fmt::format("{}{} ({:.2f})", identity.reason, bars, best.certainty)};
  return all;
}

std::optional<Identity> identify_if_open(const std::string& path, const StereoFormat& format, const FormatHint& known) {
  if (names_eye(path) || !format.is_open) return std::nullopt;
  return identify(open_whole(path), with_words(known, format));
}

std::optional<Identity> identify_video(const std::string& path, uint64_t track, const FormatHint& known) {
  constexpr int kMaxFrames = 61, kStep = 20;  // films start with dark frames
  std::optional<Identity> best;
  try {
    VideoDecoder decoder(path, track);
    VideoInput video;
    video.prototype.size = decoder.stream().size;
    video.prototype.eyes.resize(1);
    for (int i = 0; i < kMaxFrames; i++) {
      const std::optional<DecodedFrame> frame = decoder.next();
      if (!frame) break;
      if (i % kStep != 0) continue;
      Identity identity = identify(picture_of(video, decoder.stream(), *frame), known);
      const bool is_better = !best || best->readings.empty() ||
                             (!identity.readings.empty() && identity.best().certainty > best->best().certainty);
      if (is_better) best = std::move(identity);
      if (best->is_sure()) break;
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
  }
  return best;
}

// Rejects a picture if none of its readings is likely.
static void refuse_unlikely(const std::string& path, const Identity& identity) {
  if (identity.is_likely()) return;
  throw Error(ErrorKind::kInput,
              fmt::format("the format of '{}' is ambiguous: it may be {}", path, doubt_text(identity)));
}

// Rejects a picture that shows nothing and whose aspect ratio suggests nothing.
static void refuse_shapeless(const std::string& path, const StereoFormat& format) {
  if (format.layout.source != LayoutSource::kNothing) return;
  throw Error(ErrorKind::kInput,
              fmt::format("the format of '{}' is not recorded, and its pixels show too little: specify it with "
                          "`layout` and `projection`",
                          path));
}

static FormatHint identified_picture(const std::string& path, const FormatHint& known,
                                     std::vector<std::string>& notes) {
  if (names_eye(path)) return known;
  const StereoFormat format = find_format(read_info(path), path, known);
  const std::optional<Identity> identity = identify_if_open(path, format, known);
  if (!identity) return known;
  if (identity->readings.empty()) {
    refuse_shapeless(path, format);
    notes.emplace_back(
        "taken for what its shape suggests, because its pixels show too little: if it is something else, "
        "specify it with `layout` and `projection`");
    return known;
  }
  refuse_unlikely(path, *identity);
  if (const std::string doubt = doubt_text(*identity); !doubt.empty()) notes.push_back(doubt);
  return with_seen(known, format, *identity);
}

static FormatHint identified_film(const std::string& path, const FormatHint& known, std::vector<std::string>& notes) {
  const VideoFile info = read_video_file(path);
  const VideoTrack& track = choose_track(info, {}, path);
  if (track.layers) return known;  // its metadata specifies the eyes
  SphericalMetadata told;
  if (known.layout) {
    told.stereo = *known.layout == Layout::kSeparate ? VideoStereo::kOneView : video_stereo(*known.layout);
  }
  if (known.projection) told.projection = VideoProjection::kOther;
  if (!is_told_by_shape(told, track, path)) return known;
  const std::optional<Identity> identity = identify_video(path, track.id, known);
  if (!identity || identity->readings.empty()) return known;
  refuse_unlikely(path, *identity);
  if (!identity->is_sure()) {
    notes.push_back(doubt_text(*identity));
    return known;
  }
  const Reading& best = identity->best();
  notes.push_back(fmt::format("{}: {} ({:.2f})", reading_text(best), identity->reason, best.certainty));
  FormatHint all = known;
  all.layout = best.layout.value_or(Layout::kSeparate);
  all.projection = best.projection;
  all.bars = identity->bars;
  return all;
}

FormatHint identified(const std::string& path, const FormatHint& known, std::vector<std::string>& notes) {
  const bool is_film = !names_eye(path) && is_video(path);
  // Before the other evidence of the pixels, because two circles are ambiguous.
  const FormatHint all = with_lenses(path, known, notes);
  if (!all.lenses.empty()) return all;
  return (is_film ? identified_film : identified_picture)(path, all, notes);
}

}  // namespace ods
