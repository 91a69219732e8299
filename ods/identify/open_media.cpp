// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/open_media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/camera/file_names.h"
#include "ods/files/private_folder.h"
#include "ods/files/scratch.h"
#include "ods/identify/lenses.h"
#include "ods/identify/marks.h"
#include "ods/identify/thumbnail.h"
#include "ods/image/format/pixel_place.h"
#include "ods/video/container/complete_metadata.h"
#include "ods/video/footage.h"
#include "ods/video/joined_tracks.h"
#include "ods/video/make_video.h"

namespace ods {

// --- the pixels ------------------------------------------------------------------------------------------------------

namespace {

// Frames of a video, each as one picture with one eye: the first one, and a few more because videos start with dark
// frames.
class SomeFrames {
 public:
  SomeFrames(const std::string& path, uint64_t track, Views views) : decoder_(path, track, views) {
    video_.prototype.size = decoder_.stream().size;
    video_.prototype.eyes.resize(1);
  }

  // The packing of the eyes in the stream; known after next().
  std::optional<VideoStereo> packing() const { return packing_; }

  std::optional<StoredPicture> next() {
    constexpr int kStep = 20, kMaxFrames = 4;
    if (count_ == kMaxFrames) return std::nullopt;
    for (int skipped = count_++ == 0 ? kStep - 1 : 0; skipped < kStep - 1; skipped++) {
      if (!decoder_.next()) return std::nullopt;
    }
    const std::optional<DecodedFrame> frame = decoder_.next();
    if (!frame) return std::nullopt;
    packing_ = frame->packing;
    return picture_of(video_, decoder_.stream(), *frame);
  }

 private:
  VideoDecoder decoder_;
  VideoInput video_;
  std::optional<VideoStereo> packing_;
  int count_ = 0;
};

}  // namespace

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

// Adds the certainty of each order of the eyes to the one that players assume.
static Identity in_order_of_players(Identity identity) {
  std::vector<Reading>& readings = identity.readings;
  for (size_t i = 0; i < readings.size(); i++) {
    if (!readings[i].layout) continue;
    EyeArrangement eyes = arrangement_of(*readings[i].layout);
    eyes.right_first = false;
    readings[i].layout = layout_with(eyes);
    for (size_t k = 0; k < i; k++) {
      if (readings[k].layout != readings[i].layout || !(readings[k].projection == readings[i].projection)) continue;
      readings[k].certainty += std::exchange(readings[i].certainty, 0.0);
    }
  }
  std::stable_sort(readings.begin(), readings.end(),
                   [](const Reading& a, const Reading& b) { return a.certainty > b.certainty; });
  return identity;
}

// --- pictures --------------------------------------------------------------------------------------------------------

// `format` was found without the pixels.
static bool convinces(const Identity& identity, const StereoFormat& format) {
  const bool has_shape = format.layout.source == FormatSource::kShape;
  return identity.is_likely() && (!has_shape || identity.is_sure() || excludes_shape(identity, format));
}

static SeenFormat seen_format(const Identity& identity) {
  const Reading& best = identity.best();
  const char* const bars = identity.bars.any() ? ", inside black bars" : "";
  return {best.layout, best.projection, fmt::format("{}{} ({:.2f})", identity.reason, bars, best.certainty)};
}

// Six files are a cube only if their edges continue in each other.
static void check_faces(MediaFile& media) {
  constexpr double kDisjoint = -0.3;
  if (!names_faces(media.path) || media.hint.projection) return;
  const Image shown_faces = shown(make_thumbnail(media.reader->whole()).light);
  if (faces_join(shown_faces, media.format.camera.projection) > kDisjoint) return;
  throw Error(
      ErrorKind::kInput,
      fmt::format("the six faces of '{}' do not continue at each other's edges, so their order or direction is "
                  "another one: rename or turn them, or specify `projection` cube-3x2 to read them all the same",
                  media.path));
}

// The picture with square pixels, wider or higher than the file.
static StoredPicture with_square_pixels(const StoredPicture& whole, double aspect) {
  if (aspect == 1.0) return whole;
  const LayerPixels& from = whole.eyes[0].layers[0];
  StoredPicture square = whole;
  int& side = aspect > 1.0 ? square.size.width : square.size.height;
  side = std::max(1, static_cast<int>(std::lround(side * std::max(aspect, 1.0 / aspect))));
  const auto pixel = static_cast<size_t>(from.pixel_stride), columns = static_cast<size_t>(square.size.width);
  square.memory = std::make_shared<Scratch>(pixel * columns * static_cast<size_t>(square.size.height), "", 0);
  std::byte* to = square.memory->data();
  for (int y = 0; y < square.size.height; y++) {
    const std::byte* row = from.first + int64_t{y} * whole.size.height / square.size.height * from.row_stride;
    for (int x = 0; x < square.size.width; x++, to += pixel) {
      std::memcpy(to, row + int64_t{x} * whole.size.width / square.size.width * from.pixel_stride, pixel);
    }
  }
  LayerPixels& layer = square.eyes[0].layers[0];
  layer.first = square.memory->data(), layer.row_stride = static_cast<ptrdiff_t>(pixel * columns);
  return square;
}

// Identifies a picture whose pixels may not be square.
static Identity identify_shown(const StoredPicture& whole, const FormatHint& known, double aspect) {
  Identity identity = identify(with_square_pixels(whole, aspect), known);
  if (aspect != 1.0) identity.bars = {};
  return identity;
}

// Both files of a pair as halves of one picture, the left one as it was decoded; nullopt if they differ in kind.
static std::optional<StoredPicture> as_halves(const StoredPicture& left, const std::string& path) {
  OpenOptions options;
  options.color_only = true;
  const StoredPicture right = PictureReader::without_format(path_for_eye(path, kRight), options).whole();
  const LayerPixels &one = left.eyes[0].layers[0], &other = right.eyes[0].layers[0];
  const bool fits = one.sample == other.sample && one.channels == other.channels;
  if (!fits || left.size.width != right.size.width || left.size.height != right.size.height) return std::nullopt;
  const size_t row = static_cast<size_t>(left.size.width) * static_cast<size_t>(one.pixel_stride);
  StoredPicture both = left;
  both.size.width *= 2;
  both.memory = std::make_shared<Scratch>(2 * row * static_cast<size_t>(left.size.height), options.scratch_folder,
                                          options.max_in_memory);
  std::byte* to = both.memory->data();
  for (ptrdiff_t y = 0; y < left.size.height; y++) {
    for (const LayerPixels* eye : {&one, &other}) {
      std::memcpy(to, eye->first + y * eye->row_stride, row);
      to += row;
    }
  }
  LayerPixels& colors = both.eyes[0].layers[0];
  colors.first = both.memory->data(), colors.row_stride = static_cast<ptrdiff_t>(2 * row);
  return both;
}

// Identifies a pair; the order of its eyes is known.
static Identity identify_pair(const StoredPicture& left, const MediaFile& media) {
  FormatHint known = media.hint;
  const std::optional<StoredPicture> both = as_halves(left, media.path);
  known.one_eye = !both;
  known.layout = both ? std::optional(Layout::kSideBySide) : std::nullopt;
  const double aspect = pixel_aspect(media.reader->info());
  Identity identity = in_order_of_players(identify_shown(both ? *both : left, known, aspect));
  for (Reading& reading : identity.readings) reading.layout = Layout::kSeparate;
  identity.bars = {};
  return identity;
}

// Identifies the picture of one file. A name with "mono" may mean that both eyes of the file are the same picture, for
// viewers that want two: if the pixels rule out one eye, the name does not count.
static Identity identify_file(const StoredPicture& whole, const MediaFile& media) {
  const LayoutGuess& layout = media.format.layout;
  const double aspect = pixel_aspect(media.reader->info());
  FormatHint known = media.hint;
  if (layout.source < FormatSource::kPixels) {
    known.one_eye = !layout.layout;
    known.layout = layout.layout;
  }
  const Identity identity = identify_shown(whole, known, aspect);
  if (layout.source != FormatSource::kName || layout.layout || identity.is_likely()) return identity;
  Identity doubled = identify_shown(whole, media.hint, aspect);
  if (!doubled.is_likely() || !doubled.best().layout) return identity;
  doubled.reason += ", so its name means that both eyes are the same";
  return doubled;
}

// The pixels of two views are not examined: they have the layout in their metadata.
static void look_at_picture(MediaFile& media, bool left_first) {
  const StereoFormat& format = media.format;
  if (names_faces(media.path)) return check_faces(media);
  if (format.layout.layout == Layout::kMultiview) return;
  const bool is_square = pixel_aspect(media.reader->info()) == 1.0;
  const bool may_have_lenses = is_square && wants_lenses(media.hint, media.path, format.is_open);
  if (!may_have_lenses && !format.is_open) return;
  const StoredPicture whole = media.reader->whole();
  if (may_have_lenses) media.hint = with_lenses(whole, media.path, media.hint, media.notes);
  if (!media.hint.lenses.empty() || !format.is_open) return;
  media.identity = names_eye(media.path) ? identify_pair(whole, media) : identify_file(whole, media);
  if (left_first) media.identity = in_order_of_players(std::move(*media.identity));
  if (whole.memory) whole.memory->release();
  if (media.identity->readings.empty()) {
    media.notes.emplace_back(
        "taken for what its shape suggests, because its pixels show too little: if it is something else, "
        "specify it with `layout` and `projection`");
  } else if (const std::string doubt = doubt_text(*media.identity); !doubt.empty()) {
    media.notes.push_back(doubt);
  }
  if (!convinces(*media.identity, format)) return;
  media.hint.bars = media.identity->bars;
  media.hint.seen = seen_format(*media.identity);
  media.hint.seen->denies_name = !format.layout.layout && media.hint.seen->layout;
}

static void open_picture_media(MediaFile& media, const MediaOptions& options) {
  OpenOptions open;
  open.color_only = options.color_only;
  open.scratch_folder = options.scratch_folder.empty() ? temporary_folder_if_any() : options.scratch_folder;
  media.reader = PictureReader::without_format(media.path, open);
  const auto find = [&] { return find_format(media.reader->info(), media.path, media.hint); };
  media.format = find();
  look_at_picture(media, options.left_first);
  if (media.hint.seen || !media.hint.lenses.empty()) media.format = find();
}

// --- videos ----------------------------------------------------------------------------------------------------------

// Returns whether the metadata leaves the format open. V1 metadata of a video that was not stitched only excludes
// formats.
static bool may_show_lenses(const VideoTrack& track, const std::string& path) {
  const std::optional<SphericalMetadata> said = declared_metadata(track);
  return said ? said->projection == VideoProjection::kOther : is_told_by_shape({}, track, path);
}

static bool is_open(const MediaFile& media) {
  SphericalMetadata told;
  const FormatHint& known = media.hint;
  if (known.one_eye) told.stereo = VideoStereo::kOneView;
  if (known.layout) {
    told.stereo = stereo_with(arrangement_of(*known.layout)).value_or(VideoStereo::kOther);
  }
  if (known.projection) told.projection = VideoProjection::kOther;
  return !media.track.layers && is_told_by_shape(told, media.track, media.path);
}

static std::optional<Identity> identify_frames(SomeFrames& frames, std::optional<StoredPicture> frame,
                                               const FormatHint& known, double aspect) {
  std::optional<Identity> best;
  for (; frame; frame = frames.next()) {
    Identity identity = identify_shown(*frame, known, aspect);
    const bool is_better = !best || best->readings.empty() ||
                           (!identity.readings.empty() && identity.best().certainty > best->best().certainty);
    if (is_better) best = std::move(identity);
    if (best->is_sure()) break;
  }
  return best;
}

// The frame packing of H.264 and HEVC is the video's own metadata, which players of flat videos read.
static void take_packing(MediaFile& media, VideoStereo packing) {
  const std::optional<Layout> layout = layout_with(arrangement_of(packing));
  if (!layout || *layout == Layout::kSeparate) return;
  media.hint.layout = layout;
  media.notes.push_back(fmt::format("{}, according to the frame packing of its stream", stereo_name(packing)));
}

static void look_at_frames(MediaFile& media) {
  const bool is_known = media.hint.layout || media.hint.one_eye || media.track.layers || declared_metadata(media.track);
  const bool wants =
      media.track.pixel_aspect == 1.0 && wants_lenses(media.hint, media.path, may_show_lenses(media.track, media.path));
  if (is_known && !wants && !is_open(media)) return;
  try {
    SomeFrames frames(media.path, media.track.id, media.views);
    std::optional<StoredPicture> first = frames.next();
    if (!is_known && frames.packing()) take_packing(media, *frames.packing());
    const bool is_square = media.track.pixel_aspect == 1.0;
    if (first && is_square && wants_lenses(media.hint, media.path, may_show_lenses(media.track, media.path)))
      media.hint = with_lenses(*first, media.path, media.hint, media.notes);
    if (media.hint.lenses.empty() && is_open(media))
      media.identity = identify_frames(frames, std::move(first), media.hint, media.track.pixel_aspect);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;  // frames that cannot be decoded show nothing
  }
}

// The eyes in two tracks have the layout in which they are joined.
static void take_chosen(const ChosenPictures& chosen, MediaFile& media) {
  media.track = chosen.track;
  media.views = chosen.views;
  if (!media.hint.layout && !media.hint.one_eye) media.hint.layout = chosen.layout;
  if (!media.hint.projection) media.hint.projection = chosen.projection;
  if (chosen.note) media.notes.push_back(*chosen.note);
  if (small_letters(media.path).ends_with(".lrv"))
    media.notes.emplace_back("a camera's preview of low resolution: the recording beside it has the same number");
}

static void open_video_media(MediaFile& media, const MediaOptions& options) {
  media.video = read_video_file(media.path);
  if (options.track) {
    media.track = choose_track(*media.video, options.track, media.path);
  } else {
    take_chosen(choose_pictures(*media.video, options.known.layout, media.path), media);
  }
  look_at_frames(media);
  if (!media.identity || media.identity->readings.empty()) return;
  if (!media.identity->is_sure()) return media.notes.push_back(doubt_text(*media.identity));
  const Reading& best = media.identity->best();
  media.notes.push_back(fmt::format("{}: {} ({:.2f})", reading_text(best), media.identity->reason, best.certainty));
  if (!are_tracks(media.views)) media.hint.layout = best.layout.value_or(Layout::kSeparate);
  media.hint.projection = best.projection;
  media.hint.bars = media.identity->bars;
}

// --- both ------------------------------------------------------------------------------------------------------------

MediaFile open_media(const std::string& path, const MediaOptions& options) {
  MediaFile media;
  media.path = footage_kind(path) == FootageKind::kFrames ? find_frames(path, {}).path(0) : path;
  media.hint = options.known;
  const bool is_video = footage_kind(media.path) == FootageKind::kVideo;
  (is_video ? open_video_media : open_picture_media)(media, options);
  return media;
}

std::string reading_fault(const std::string& path, uint64_t track) {
  try {
    const VideoDecoder decoder(path, track);
    return {};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return error.what();
  }
}

void refuse_unlikely(const MediaFile& media) {
  if (!media.identity || media.identity->is_likely()) return;
  if (!media.identity->readings.empty()) {
    throw Error(ErrorKind::kInput,
                fmt::format("the format of '{}' is ambiguous: it may be {}", media.path, doubt_text(*media.identity)));
  }
  if (media.video || media.format.layout.source != FormatSource::kNothing) return;
  throw Error(ErrorKind::kInput,
              fmt::format("the format of '{}' is not recorded, and its pixels show too little: specify it with "
                          "`layout` and `projection`",
                          media.path));
}

void expect_picture(const MediaFile& media) {
  if (media.reader) return;
  throw Error(ErrorKind::kInput, fmt::format("'{}' is a video, and a picture is expected", media.path));
}

PictureReader reader_of(MediaFile media) {
  expect_picture(media);
  media.reader->set_format(media.hint);
  return std::move(*media.reader);
}

}  // namespace ods
