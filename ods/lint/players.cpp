// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/lint/players.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/camera/codec_level.h"
#include "ods/video/container/complete_metadata.h"

namespace ods {

constexpr double kUsualFps = 30.0;  // for a video that does not specify it

static bool is_matroska(const VideoFile& video) {
  return video.container == Container::kMatroska || video.container == Container::kWebm;
}

// A player's interpretation: mono without stereo metadata, flat without projection metadata.
static std::string shown_as(SphericalMetadata metadata) {
  metadata.stereo = metadata.stereo.value_or(VideoStereo::kOneView);
  metadata.projection = metadata.projection.value_or(VideoProjection::kFlat);
  return metadata_text(metadata);
}

static PlayerView v2_view(const VideoFile& video, const VideoTrack& track) {
  const char* place = is_matroska(video) ? "from StereoMode and Projection" : "from st3d and sv3d";
  if (track.v2) return {"reads V2", shown_as(*track.v2), place};
  if (track.v1) return {"reads V2", shown_as(*track.v1), "from V1, without V2"};
  return {"reads V2", shown_as({}), "it has neither V2 nor V1"};
}

static PlayerView v1_view(const VideoTrack& track) {
  if (track.v1) return {"reads only V1", shown_as(*track.v1), "from V1"};
  return {"reads only V1", shown_as({}), "it has no V1"};
}

static PlayerView apple_view(const VideoTrack& track) {
  if (track.vexu) return {"is Apple's", shown_as(*track.vexu), "from vexu"};
  return {"is Apple's", shown_as({}), "it has no vexu"};
}

static bool is_named(const NameWords& words) {
  return !words.layout_token.empty() || words.projection != nullptr;
}

static PlayerView name_view(const std::string& path) {
  const NameWords words = read_name(path);
  if (!is_named(words)) {
    return {"goes by the name", "mono, flat", "its name has no token for it"};
  }
  std::string text(words.layout ? layout_name(*words.layout) : "mono");
  text += fmt::format(", {}", words.projection != nullptr ? words.projection->name : "lat-long or flat");
  return {"goes by the name", text, fmt::format("its name ends in {}{}", words.projection_token, words.layout_token)};
}

static PlayerView shape_view(Extent size) {
  if (size.width == size.height) return {"goes by the shape", "top-bottom, lat-long", "it is square"};
  if (size.width == 2 * size.height) return {"goes by the shape", "mono, lat-long", "it is twice as wide as high"};
  return {"goes by the shape", "mono, flat", "it has the shape of neither one nor two spheres"};
}

std::vector<PlayerView> video_views(const VideoFile& video, const VideoTrack& track, const std::string& path) {
  std::vector<PlayerView> views{v2_view(video, track)};
  if (!is_matroska(video) || track.v1) views.push_back(v1_view(track));
  if (!is_matroska(video)) views.push_back(apple_view(track));
  views.push_back(name_view(path));
  views.push_back(shape_view(track.size));
  return views;
}

// --- warnings

static std::optional<Codec> codec_of(const std::string& name) {
  for (const char* word : {"avc1", "avc3", "V_MPEG4/ISO/AVC"}) {
    if (name == word) return Codec::kH264;
  }
  for (const char* word : {"hvc1", "hev1", "V_MPEGH/ISO/HEVC"}) {
    if (name == word) return Codec::kHevc;
  }
  for (const char* word : {"av01", "V_AV1"}) {
    if (name == word) return Codec::kAv1;
  }
  for (const char* word : {"vp09", "V_VP9"}) {
    if (name == word) return Codec::kVp9;
  }
  return std::nullopt;
}

static void warn_of_size(const VideoTrack& track, std::vector<std::string>& warnings) {
  const std::optional<Codec> codec = codec_of(track.codec);
  const double fps = track.fps > 0.0 ? track.fps : kUsualFps;
  if (!codec || track.size.width == 0 || track.size.height == 0) return;
  if (!smallest_level(*codec, track.size, fps).empty()) return;
  warnings.push_back(fmt::format("no level of {} holds {}x{} at {:.4g} pictures a second: many players will refuse it",
                                 codec_name(*codec), track.size.width, track.size.height, fps));
}

static std::string same_words(std::string text) {
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"lat-long 180x180", "vr180"},
                                 {"side-by-side-half", "side-by-side"},
                                 {"top-bottom-half", "top-bottom"}}) {
    if (const size_t at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
  }
  return text;
}

// Returns whether two kinds of players show the same. A name without a projection agrees with both projections that it
// leaves open.
static bool agree(const std::string& a, const std::string& b) {
  const std::string one = same_words(a), other = same_words(b);
  const size_t open = other.find("lat-long or flat");
  if (open == std::string::npos) return one == other;
  return one == other.substr(0, open) + "lat-long" || one == other.substr(0, open) + "flat";
}

// Returns whether players that go by the name see something else than `is`.
static bool contradicts_name(const std::string& path, const std::string& is) {
  return is_named(read_name(path)) && !agree(is, name_view(path).takes_it_for);
}

static std::string name_warning(const std::string& path, const std::string& is) {
  return fmt::format("its name declares {}, the file {}: players differ", name_view(path).takes_it_for, is);
}

bool name_misleads(const VideoFile& video, const VideoTrack& track, const std::string& path) {
  return contradicts_name(path, v2_view(video, track).takes_it_for);
}

// Advises ods inject if it helps, with the necessary options: " (ods inject --track 2 adds it)".
static std::string advice(const VideoFile& video, const VideoTrack& track, const std::string& path,
                          std::string_view what) {
  std::vector<std::string> guesses;
  try {
    if (!can_express(video.container, track, complete_metadata({}, track, path, guesses))) return "";
  } catch (const Error&) {
    return "";
  }
  const std::string which = video.tracks.size() > 1 ? fmt::format(" `track` {}", track.id) : "";
  std::string options;
  for (const MetadataConflict& conflict : find_conflicts({}, track, path)) {
    options += fmt::format("{}{}", options.empty() ? ", with the true value: " : ", and ", conflict.options);
  }
  return fmt::format(" (ods inject{} {}{})", which, what, options);
}

std::vector<std::string> video_warnings(const VideoFile& video, const VideoTrack& track, const std::string& path) {
  std::vector<std::string> warnings;
  const PlayerView v2 = v2_view(video, track);
  if (track.layers) {
    warnings.emplace_back("its eyes are layers of its stream (MV-HEVC): players that do not support this see only one");
  }
  const std::string make_one = advice(video, track, path, "makes them one");
  if (track.v1 && track.v2 && !agree(shown_as(*track.v1), shown_as(*track.v2))) {
    warnings.push_back(fmt::format("its V1 declares {}, its V2 {}: players differ{}", metadata_text(*track.v1),
                                   metadata_text(*track.v2), make_one));
  }
  if (track.v2 && !track.v1 && !is_matroska(video) && fits_v1(*track.v2)) {
    warnings.push_back("it has no V1: older players show it flat" + advice(video, track, path, "adds it"));
  }
  if (track.v1 && !track.v2) warnings.push_back("it has no V2" + advice(video, track, path, "adds it"));
  if (track.v2 && track.vexu && !agree(shown_as(*track.vexu), v2.takes_it_for)) {
    warnings.push_back(fmt::format("its vexu declares {}, its V2 {}: players differ{}", metadata_text(*track.vexu),
                                   metadata_text(*track.v2), make_one));
  }
  if (name_misleads(video, track, path)) {
    warnings.push_back(
        name_warning(path, track.v2 || track.v1 ? v2.takes_it_for : "nothing" + advice(video, track, path, "tags it")));
  }
  const std::optional<SphericalMetadata> said = declared_metadata(track);
  const std::string fault = said ? shape_fault(*said, track) : "";
  if (!fault.empty()) warnings.push_back(fault);
  warn_of_size(track, warnings);
  return warnings;
}

// --- pictures --------------------------------------------------------------------------------------------------------

static std::string picture_text(const StereoFormat& format) {
  if (format.front_and_back) return "two fisheyes, ahead and back";
  if (format.is_photo) return fmt::format("both eyes, {}", projection_name(format.camera.projection));
  return fmt::format("{}, {}", format.layout.layout ? layout_name(*format.layout.layout) : "mono",
                     projection_name(format.camera.projection));
}

std::vector<PlayerView> picture_views(const FileInfo& info, const StereoFormat& format, bool has_gpano,
                                      const std::string& path) {
  PlayerView gpano{"reads GPano", "mono, flat", "it has no GPano"};
  if (has_gpano) gpano.takes_it_for = "mono, lat-long", gpano.reason = "from GPano, which cannot express stereo";
  const bool is_unknown =
      format.is_open && format.layout.source == FormatSource::kNothing && format.camera.projection.kind == kPerspective;
  const std::string reason = is_unknown ? "nothing tells what it shows: it looks flat" : format.layout.reason;
  std::vector<PlayerView> views{{"ods", picture_text(format), reason}, gpano};
  if (format.is_photo && !info.is_pair) {
    views.push_back({"reads VR photos", picture_text(format), "GImage has the right eye"});
  }
  views.push_back(name_view(path));
  views.push_back(shape_view({info.width, info.height}));
  return views;
}

std::vector<std::string> picture_warnings(const FileInfo& info, const StereoFormat& format, bool has_gpano,
                                          const std::string& path) {
  std::vector<std::string> warnings;
  const std::string is = picture_text(format);
  if (format.is_photo || names_eye(path)) return warnings;
  if (has_gpano && format.layout.layout) {
    warnings.push_back("it has GPano and holds two eyes: many viewers show both as one sphere, stretched");
  }
  const PlayerView shape = shape_view({info.width, info.height});
  if (contradicts_name(path, is)) warnings.push_back(name_warning(path, is));
  if (!is_named(read_name(path)) && format.layout.layout && !agree(is, shape.takes_it_for)) {
    warnings.push_back(
        fmt::format("players that rely on the name or shape do not recognise it as {} (a name that ends in "
                    "_360_TB, _180_LR ... is read by most)",
                    is));
  }
  return warnings;
}

}  // namespace ods
