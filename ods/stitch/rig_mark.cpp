// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/rig_mark.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "ods/base/decimal.h"
#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/md5.h"
#include "ods/stitch/slit_file.h"

namespace ods {

static constexpr const char* kVersion = "2";

// Turns -0, which a file may contain, into 0.
static double number(float value) {
  return decimal(value) + 0.0;
}

static std::string numbers(const std::vector<float>& values) {
  std::string text;
  for (const float value : values) text += fmt::format("{}{}", text.empty() ? "" : ",", number(value));
  return text;
}

// The pixel aspect (height over width) of a view. Rounded, because the file stores the angle across, but the aspect is
// computed from two such numbers.
static double pixel_aspect(const SlitRig& rig) {
  const double wide = static_cast<double>(rig.view.width) / static_cast<double>(rig.view.height);
  return std::round(1e3 * wide / static_cast<double>(rig.views[0].projection.aspect)) * 1e-3;
}

static std::string views_hash(const SlitRig& rig) {
  std::string text = fmt::format("{} {}x{} {} {:.3f}\n", view_depth_name(rig.options.depth), rig.view.width,
                                 rig.view.height, number(rig.views[0].projection.fov), pixel_aspect(rig));
  for (size_t i = 0; i < rig.views.size(); i++) text += numbers(view_matrix(rig, i)) + "\n";
  return md5(text);
}

static std::string camera_text(const StereoCamera& camera) {
  std::string text;
  for (const auto& [name, value] : camera_settings(camera)) {
    if (!value.empty()) text += fmt::format(" {}={}", name, value);
  }
  if (camera.mirrored) text += " mirrored=true";
  if (camera.merge_map) text += " merge-map=" + md5(numbers(camera.merge_map->pixels));
  return text;
}

std::string rig_mark(const SlitRig& rig) {
  const SlitOptions& options = rig.options;
  std::vector<std::string_view> eyes;
  for (const int eye : rig.eyes) eyes.push_back(eye_name(eye));
  return fmt::format(
      "ods-rig={} views={} slits={} pitches={} caps={} blend={} padding={} scale={} depth={} view={}x{} fov={} "
      "picture={}x{} eyes={}{}",
      kVersion, views_hash(rig), options.slits, options.pitches, options.caps, number(options.blend), options.padding,
      number(options.scale), view_depth_name(options.depth), rig.view.width, rig.view.height,
      number(rig.views[0].projection.fov), rig.eye.width, rig.eye.height, fmt::join(eyes, ","),
      camera_text(rig.camera));
}

// --- comparing ------------------------------------------------------------------------------------------------------

// Key-value pairs in order; a repeated key is ignored.
static std::vector<std::pair<std::string, std::string>> words_of(const std::string& mark) {
  std::vector<std::pair<std::string, std::string>> words;
  std::istringstream stream(mark);
  for (std::string word; stream >> word;) {
    const size_t at = word.find('=');
    if (at != std::string::npos) words.emplace_back(word.substr(0, at), word.substr(at + 1));
  }
  return words;
}

static std::string value_of(const std::string& mark, const std::string& name) {
  for (const auto& [key, value] : words_of(mark)) {
    if (key == name) return value;
  }
  return "";
}

std::string mark_file_text(const std::string& mark) {
  const size_t rest = mark.find(" slits=");
  return fmt::format("\"{}\"\n{}\n", mark.substr(0, rest), mark.substr(rest + 1));
}

std::string mark_in_file(const std::string& text) {
  std::string mark = one_line(text);
  std::erase(mark, '"');
  return mark;
}

std::string mark_difference(const std::string& mark, const std::string& expected) {
  constexpr size_t kMaxReported = 5, kLongest = 64;
  if (mark == expected) return "";
  const std::string version = value_of(mark, "ods-rig");
  if (version.empty() || value_of(mark, "views").empty()) return "the mark is damaged";
  if (version != kVersion) return "the mark was written by another version of ods";
  if (value_of(mark, "views") == value_of(expected, "views")) return "";
  const auto said = [&](const std::string& value) { return value.empty() ? "not given" : value.substr(0, kLongest); };
  std::vector<std::string> parts;
  const auto compare = [&](const std::string& name) {
    const std::string theirs = value_of(mark, name), ours = value_of(expected, name);
    if (theirs != ours)
      parts.push_back(fmt::format("{} is {}, not {}", name.substr(0, kLongest), said(theirs), said(ours)));
  };
  for (const auto& [name, value] : words_of(expected)) {
    if (name != "views") compare(name);
  }
  for (const auto& [name, value] : words_of(mark)) {
    if (value_of(expected, name).empty()) compare(name);
  }
  if (parts.empty()) return "the views have other positions or directions";
  const size_t more = parts.size() - std::min(parts.size(), kMaxReported);
  parts.resize(parts.size() - more);
  return fmt::format("{}{}", fmt::join(parts, "; "), more > 0 ? fmt::format("; and {} more", more) : "");
}

void check_rig_mark(const std::string& mark, const std::string& expected, const std::string& name) {
  const std::string difference = mark_difference(mark, expected);
  if (difference.empty()) return;
  throw Error(ErrorKind::kInput,
              fmt::format("'{}': the views belong to another rig ({}): render them with this rig, or use theirs", name,
                          difference));
}

}  // namespace ods
