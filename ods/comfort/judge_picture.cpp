// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/judge_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "ods/base/error.h"
#include "ods/comfort/areas.h"
#include "ods/comfort/matched.h"
#include "ods/convert/reproject.h"
#include "ods/convert/unwrap.h"
#include "ods/depth/floor.h"
#include "ods/files/scratch.h"
#include "ods/identify/open_media.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"
#include "ods/picture/cryptomatte.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/stored_picture.h"

namespace ods {

namespace {

constexpr int kMaxWidth = 2048;  // of judged pictures

// The colours of an eye: the nearest pixels.
Image colors_of(const StoredPicture& picture, size_t eye, Extent size) {
  Image light(size.width, size.height, 3);
  const Extent stored = picture.size;
  read_colors(picture, eye, [&](int from, const std::vector<float>& row) {
    const int y = static_cast<int>(int64_t{from} * size.height / stored.height);
    for (int x = 0; x < size.width; x++) {
      std::copy_n(&row[3 * static_cast<size_t>(int64_t{x} * stored.width / size.width)], 3, light.at(x, y));
    }
  });
  return light;
}

// numbers: of the thing in each pixel; chosen: the pixels that are judged.
void name_things(SeenDepth& seen, const Image& numbers, const std::vector<size_t>& chosen, const Cryptomatte& matte) {
  if (numbers.pixels.empty() || matte.names.empty()) return;
  std::map<float, int> places;
  for (const auto& [number, name] : matte.names) {
    if (name.empty()) continue;
    places[number] = static_cast<int>(seen.names.size());
    seen.names.push_back(name);
  }
  for (const size_t pixel : chosen) {
    const auto found = places.find(numbers.pixels[pixel]);
    seen.things.push_back(found == places.end() ? -1 : found->second);
  }
}

// A picture, without the channels that are not needed.
struct Opened {
  std::string path;
  StoredPicture picture;
  std::optional<Cryptomatte> matte;
  bool has_light = false;   // its colours were read
  bool lacks_map = false;   // the merge map is missing, so the depth alone does not determine what the eyes show
  bool is_foreign = false;  // it has two eyes and depth, but does not record how the eyes were placed
};

Opened open_to_judge(const std::string& path, const JudgePictureOptions& options, std::vector<std::string>& notes) {
  MediaFile media = open_media(path, {.known = options.format, .scratch_folder = options.scratch_folder});
  refuse_unlikely(media);
  for (const std::string& doubt : media.notes) notes.push_back(fmt::format("'{}' is {}", path, doubt));
  PictureReader reader = reader_of(std::move(media));
  const StoredPicture& header = reader.header();
  const std::optional<size_t> layer = depth_layer(header);
  Opened opened;
  opened.path = path;
  if (layer) {
    const FileInfo& info = reader.info();
    const bool has_two = header.eyes.size() == 2;
    opened.matte = find_cryptomatte(info, path);
    opened.lacks_map = has_two && lacks_merge_map(info, header.camera);
    opened.is_foreign = has_two && !header.has_ipd;
  }
  opened.has_light = !layer || opened.lacks_map || opened.is_foreign || options.wants_light;
  const std::string depth = layer ? header.eyes[0].layers[*layer].channels[0] : "";
  const std::string matte = opened.matte ? matte_channel(header, *opened.matte) : "";
  const std::vector<std::string> colors = header.eyes[0].layers[0].channels;
  const auto wants = [&](const std::string& channel) {
    if (channel == depth || channel == matte) return true;
    return opened.has_light && std::ranges::find(colors, channel) != colors.end();
  };
  const std::string& scratch = options.scratch_folder;
  const bool has_maps = !header.maps.empty();
  opened.picture = has_maps ? reader.read(scratch) : reader.read(scratch, wants);
  notes.insert(notes.end(), opened.picture.guesses.begin(), opened.picture.guesses.end());
  if (has_maps) opened.picture = unwrapped(opened.picture);
  return opened;
}

JudgedPicture judge_by_matching(const Opened& opened, const ComfortOptions& options) {
  const StoredPicture& picture = opened.picture;
  if (picture.eyes.size() != 2) {
    throw Error(
        ErrorKind::kInput,
        fmt::format("'{}' has one eye and no depth (a layer Z, metres along the ray): its distances are unknown. "
                    "If it has two eyes, use `layout`",
                    opened.path));
  }
  check_matchable(picture.camera.projection, picture.size.width, opened.path);
  const MatchedEyes matched = match_eyes_for_depth(grey_eyes(picture), picture.camera, picture.is_float);
  if (matched.share < kMinMatched) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' has no depth, and only {:.1f} % of its eyes could be matched: see what ods lint "
                            "reports, or use `layout`",
                            opened.path, 100.0 * matched.share));
  }
  JudgedPicture judged;
  judged.verdict = judge_comfort(matched.seen, options, matched);
  judged.camera = matched.seen[0].camera;
  for (const Image& grey : matched.grey) judged.light.push_back(light_of(grey));
  if (!picture.has_ipd) judged.notes.emplace_back("the eye distance is not recorded: distances assume 65 mm");
  return judged;
}

void check_depth(const SeenDepth& seen, const std::string& path, std::vector<std::string>& warnings) {
  const auto warn = [&](const std::string& text) {
    const std::string warning = fmt::format("'{}': {}", path, text);
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);  // of the other eye
  };
  Image nearness = seen.depth;
  bool has_any = false, has_surface = false;
  for (float& depth : nearness.pixels) {
    has_any = has_any || depth > 0.0f;
    has_surface = has_surface || is_surface(depth);
    depth = inverse_depth(depth);
  }
  if (!has_any) {
    throw Error(ErrorKind::kInput, fmt::format("'{}': its layer of depth (Z) is 0, negative or NaN everywhere: render "
                                               "it again, or judge its eyes, saved without it",
                                               path));
  }
  if (!has_surface) warn("its layer of depth (Z) is infinite everywhere: there is nothing to judge");
  if (looks_inverted(nearness, make_camera(seen.camera), seen.eye)) {
    warn("its depth (Z) looks inverted, near sky and far floor: Z is metres along the line of sight");
  }
}

// Measures the eyes from the pixels, and judges by that.
void measure_camera(JudgedPicture& judged, const Opened& opened, std::vector<SeenDepth>& eyes) {
  judged.measured = measure_eyes(grey_eyes(opened.picture), eyes[0], opened.picture.is_float);
  if (!judged.measured || !judged.measured->is_known) {
    judged.notes.push_back(fmt::format(
        "'{}': a pole merge is neither recorded nor measurable: judged as if there were none", opened.path));
  }
  if (!judged.measured) return;
  judged.camera = judged.measured->camera;
  for (SeenDepth& seen : eyes) seen.camera = judged.camera;
}

JudgedPicture judge_by_depth(const Opened& opened, const JudgePictureOptions& options) {
  const StoredPicture& picture = opened.picture;
  JudgedPicture judged;
  judged.camera = picture.camera;
  std::vector<SeenDepth> eyes;
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    std::vector<size_t> chosen;
    Image depth = nearest_of_blocks(depth_of_eye(picture, i), kMaxWidth, &chosen);
    SeenDepth& seen = eyes.emplace_back(SeenDepth{picture.camera, picture.eyes[i].eye, std::move(depth), {}, {}});
    check_depth(seen, opened.path, judged.warnings);
    if (opened.matte) name_things(seen, matte_of_eye(picture, i, *opened.matte), chosen, *opened.matte);
    if (opened.has_light) judged.light.push_back(colors_of(picture, i, {seen.depth.width, seen.depth.height}));
    if (picture.memory) picture.memory->release();
  }
  if (opened.matte && opened.matte->names.empty()) {
    judged.notes.push_back(
        fmt::format("'{}': its Cryptomatte has no list of names, so what strains is an area", opened.path));
  }
  if (opened.is_foreign) measure_camera(judged, opened, eyes);
  judged.verdict = judge_comfort(eyes, options.comfort);
  if (judged.verdict.unknown > 0.0) {
    judged.warnings.push_back(fmt::format("'{}': {:.3g} % of the pixels have no depth, and are not judged", opened.path,
                                          100.0 * judged.verdict.unknown));
  }
  return judged;
}

// If the merge map is missing, the eyes are matched although there is depth.
JudgedPicture judge_opened(const Opened& opened, const JudgePictureOptions& options) {
  if (!depth_layer(opened.picture)) return judge_by_matching(opened, options.comfort);
  if (!opened.lacks_map) return judge_by_depth(opened, options);
  try {
    JudgedPicture judged = judge_by_matching(opened, options.comfort);
    judged.why_matched = "Its merge map is missing, so its depth does not determine what the eyes see";
    return judged;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    JudgedPicture judged = judge_by_depth(opened, options);
    judged.warnings.push_back(fmt::format(
        "'{}': its merge map is missing, and its eyes cannot be matched: judged as if it had no merge", opened.path));
    return judged;
  }
}

}  // namespace

JudgedPicture judge_picture(const std::string& path, const JudgePictureOptions& options) {
  std::vector<std::string> notes;
  const Opened opened = open_to_judge(path, options, notes);
  JudgedPicture judged = judge_opened(opened, options);
  judged.notes.insert(judged.notes.begin(), notes.begin(), notes.end());
  return judged;
}

Image light_of(const Image& grey) {
  Image light(grey.width, grey.height, 3);
  for (size_t i = 0; i < light.pixels.size(); i++) {
    const float shown = grey.pixels[i / 3];
    light.pixels[i] = shown > 0.0f ? srgb_decode(shown) : 0.0f;
  }
  return light;
}

}  // namespace ods
