// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/depth_input.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "ods/comfort/merge_from_depth.h"

namespace {

std::string meanings() {
  std::string text;
  for (const ods::DepthKindRow& row : ods::kDepthKindTable) {
    if (row.name == row.meaning) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", row.name, row.meaning);
  }
  return text;
}

}  // namespace

void add_depth_options(Options& options, DepthInput& depth) {
  ods::DepthOptions& how = depth.options;
  options.group("Depth from another file, to move the eyes");
  options.text(
      "--depth", ValueKind::input_file(), depth.path,
      "how far everything in the picture is: a grey .png or .tif of 16 bits, .exr, .pfm, .npy, of any size; for "
      "frames and videos frames (####) or a video; %V: a file per eye");
  options.choice("--depth-kind", how.format.kind, ods::kDepthKindTable,
                 "the meaning of its numbers; floats are metres by default. " + meanings());
  options.number("--near", how.format.nearest, 1e-3f, 1e6f, "distance of its near end, metres");
  options.number("--far", how.format.farthest, 1e-3f, 1e9f,
                 "distance of its far end, metres; for inverse, infinite by default");
  options.choice("--depth-along", how.format.along, ods::kDepthAlongTable,
                 "whether distances are from the eye (ray), or along the axis of the lens or the cube's face (axis)");
  options.choice("--depth-edges", how.edges, ods::kDepthEdgesTable,
                 "sharp: soft edges become as sharp as the picture's; soft: depth is used as it is");
  options.number("--eye-height", how.eye_height, 0.01f, 1e4f,
                 "height of the camera above the floor, metres: gives relative depth its scale");
}

std::vector<std::string> depth_option_names() {
  return {"--depth-kind", "--near", "--far", "--depth-along", "--depth-edges", "--eye-height"};
}

void give_depth(const DepthInput& depth, ods::StoredPicture& picture) {
  note_depth(ods::add_depth(picture, ods::read_depth(depth.path, picture), depth.options));
}

void note_depth(const ods::DepthReport& report) {
  for (const std::string& words : report.warnings) warn(words);
  for (const std::string& words : report.notes) note(words);
}

void use_shares(std::vector<float> shares, ods::StereoCamera& camera) {
  ods::Image map = ods::merge_map_of(std::move(shares));
  note(merge_by_depth_text(map));
  ods::use_merge_map(camera, std::move(map));
}
