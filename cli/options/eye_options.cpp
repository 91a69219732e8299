// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/eye_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/camera/camera_fields.h"
#include "ods/camera/camera_preset.h"
#include "ods/comfort/strain.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"
#include "ods/picture/metadata/sidecar.h"

using ods::CameraField, ods::StereoCamera, ods::PoleMergeSetting, ods::vec3;

namespace {

// The text before the first comma, and the numbers after it.
struct WordAndNumbers {
  std::string word;
  std::vector<float> numbers;
  bool legal = true;
};

WordAndNumbers split(const std::string& text) {
  const size_t comma = std::min(text.find(','), text.size());
  WordAndNumbers parts{text.substr(0, comma), {}, true};
  if (comma < text.size()) parts.numbers = parse_numbers(text.substr(comma + 1));
  parts.legal = parts.numbers.empty() == (comma == text.size());
  return parts;
}

std::string merge_names() {
  return fmt::format("{}", fmt::join(ods::names_of(ods::kMergeTable), ", "));
}

// MODE[,START[,END[,EXPONENT]]]
PoleMergeSetting parse_merge(const std::string& name, const std::string& text) {
  const WordAndNumbers parts = split(text);
  const std::vector<float>& numbers = parts.numbers;
  const auto mode = ods::merge_of(parts.word);
  PoleMergeSetting merge;
  if (numbers.size() > 0) merge.start = numbers[0];
  if (numbers.size() > 1) merge.end = numbers[1];
  if (numbers.size() > 2) merge.exponent = numbers[2];
  const bool legal = mode && parts.legal && numbers.size() <= 3 && merge.start < merge.end &&
                     range_of(CameraField::kTopMergeStart).contains(merge.start) &&
                     range_of(CameraField::kTopMergeEnd).contains(merge.end) &&
                     range_of(CameraField::kTopMergeExponent).contains(merge.exponent);
  if (!legal) {
    throw UsageError(
        fmt::format("{} is {}, then ,START,END in degrees (0 <= START < END <= 90) and ,EXP (0.000001 to 100), "
                    "not '{}'",
                    name, merge_names(), text));
  }
  merge.mode = *mode;
  return merge;
}

// parallel, toe-in,METRES or shift,METRES
CameraChanges::Convergence parse_convergence(const std::string& text) {
  const WordAndNumbers parts = split(text);
  for (int mode : ods::kConvergences) {
    if (parts.word != ods::convergence_name(mode) || !parts.legal || parts.numbers.size() > 1) continue;
    if (parts.numbers.empty()) return {mode, std::nullopt};
    if (range_of(CameraField::kConvergenceDistance).contains(parts.numbers[0])) return {mode, parts.numbers[0]};
  }
  throw UsageError(
      fmt::format("--convergence is parallel, toe-in,METRES or shift,METRES (0.001 to a million), not '{}'", text));
}

// Returns nullopt for the camera's own axis.
std::optional<vec3> parse_axis(const std::string& text) {
  if (text == "camera") return std::nullopt;
  std::vector<float> numbers = text == "world" ? std::vector<float>{0.0f, 1.0f, 0.0f} : parse_numbers(text);
  const bool three = numbers.size() == 3;
  const float size = three ? std::hypot(numbers[0], numbers[1], numbers[2]) : 0.0f;
  if (!(size > 1e-6f && size < range_of(CameraField::kAxis).maximum)) {
    throw UsageError(fmt::format("--axis is camera, world or a direction X,Y,Z, not '{}'", text));
  }
  return vec3(numbers[0], numbers[1], numbers[2]) / size;
}

ods::vec2 parse_lens(const std::string& text) {
  const std::vector<float> numbers = parse_numbers(text);
  const bool legal = numbers.size() == 2 && range_of(CameraField::kLensRadius).contains(numbers[0]) &&
                     range_of(CameraField::kFocusDistance).contains(numbers[1]);
  if (!legal) throw UsageError(fmt::format("--lens is RADIUS,FOCUS in metres, as 0.005,2, not '{}'", text));
  return {numbers[0], numbers[1]};
}

// NAME[:PARAMETER=VALUE,...]
CameraChanges::Preset parse_camera_preset(const std::string& text) {
  const size_t colon = std::min(text.find(':'), text.size());
  const std::string name = text.substr(0, colon);
  const ods::CameraPreset* preset = ods::find_camera_preset(name);
  if (!preset) {
    const std::vector<std::string> names = ods::names_of(ods::camera_presets());
    throw UsageError(fmt::format("--camera-preset: there is no preset '{}'{}; choose one of {}", name,
                                 ods::did_you_mean(name, names), fmt::join(names, ", ")));
  }
  std::map<std::string, std::string> given;
  for (size_t at = colon + 1; at < text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    const std::string pair = text.substr(at, end - at);
    const size_t equals = pair.find('=');
    if (equals == std::string::npos)
      throw UsageError(fmt::format("--camera-preset {}: '{}' is not PARAMETER=VALUE", name, pair));
    given[pair.substr(0, equals)] = pair.substr(equals + 1);
    at = end + 1;
  }
  try {
    return {ods::camera_like(*preset, given),
            preset->exact ? "" : fmt::format("{} is only approximated: {}", preset->system, preset->note)};
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--camera-preset ") + error.what());
  }
}

}  // namespace

void add_camera_preset_option(Options& options, CameraChanges& changes) {
  options.custom(
      "--camera-preset", "SYSTEM[:PARAMETER=VALUE,..]", "",
      [&](const std::string& text) { changes.preset = parse_camera_preset(text); },
      "match the camera of another renderer, using its own parameters: google, povray, arnold, cycles, ospray, ...; "
      "the options below override it");
  options.offer("--camera-preset", ods::names_of(ods::camera_presets()));
}

std::optional<float> parse_auto_merge(const std::string& text) {
  const WordAndNumbers parts = split(text);
  if (parts.word != "auto") return std::nullopt;
  if (!parts.legal || parts.numbers.size() > 1) throw UsageError("--merge auto is auto or auto,MINUTES");
  const float limit = parts.numbers.empty() ? static_cast<float>(ods::kFusionLimit) : parts.numbers[0];
  if (!(limit >= 1.0f && limit <= 600.0f)) throw UsageError("--merge auto takes 1 to 600 minutes of arc");
  return limit;
}

void add_circle_options(Options& options, CameraOptions& camera) {
  CameraChanges& changes = camera.changes;
  options.group("Eyes");
  for (const ods::CameraFieldRow& row : ods::camera_fields()) {
    if (row.help.empty()) continue;
    options.number(fmt::format("--{}", row.setting), changes.numbers[row.member], row.range.minimum, row.range.maximum,
                   std::string(row.help), fmt::format("{}", *row.numbers(camera.stereo)[0]));
  }
  const bool may_follow_depth = camera.may_follow_depth;
  const char* merge_unit = "MODE[,START[,END[,EXP]]]";
  const std::string automatic = may_follow_depth
                                    ? fmt::format(
                                          "; auto[,MINUTES]: as much stereo as the scene's depth allows, so that eyes "
                                          "turn apart by no more than {} minutes of arc",
                                          ods::kFusionLimit)
                                    : "";
  options.custom(
      "--merge", merge_unit, same_merge(camera.stereo.top, ods::kUsualMerge) ? "cosine,60,90,1" : "none,60,90,1",
      [&changes, may_follow_depth](const std::string& text) {
        changes.merge_limit = may_follow_depth ? parse_auto_merge(text) : std::nullopt;
        changes.merge.reset();
        if (!changes.merge_limit) changes.merge = parse_merge("--merge", text);
      },
      fmt::format("reduce the eye distance to 0 towards the poles, so that one can look up and down: {}; between the "
                  "elevations START and END, degrees; EXP is the curve's exponent. none: the pure model{}",
                  merge_names(), automatic));
  options.custom(
      "--merge-top", merge_unit, "",
      [&](const std::string& text) { changes.merge_top = parse_merge("--merge-top", text); },
      "--merge of the upper pole only");
  options.custom(
      "--merge-bottom", merge_unit, "",
      [&](const std::string& text) { changes.merge_bottom = parse_merge("--merge-bottom", text); },
      "--merge of the lower pole only");
  options.text("--merge-map", ValueKind::input_file(), changes.merge_map,
               "lat-long picture for --merge map: white is full stereo, black is none");
  options.flag("--merge-map-inverted", changes.merge_map_inverted,
               "invert the map: black is full stereo, as in Arnold's manual");
  options.text(
      "--head-tilt-map", ValueKind::input_file(), changes.head_tilt_map,
      "lat-long picture that tilts the head: white 90 degrees to the right, mid-grey not at all, black 90 degrees "
      "to the left");
  options.custom(
      "--convergence", "MODE[,METRES]", "parallel",
      [&](const std::string& text) { changes.convergence = parse_convergence(text); },
      "parallel; toe-in: the eyes' rays meet at METRES; shift: the pictures are shifted sideways so that points at "
      "METRES coincide");
}

void add_eye_options(Options& options, CameraOptions& camera) {
  CameraChanges& changes = camera.changes;
  add_circle_options(options, camera);
  options.custom(
      "--axis", "AXIS", "camera", [&](const std::string& text) { changes.axis = parse_axis(text); },
      "normal of the viewing circle: the camera's up axis, the world's up axis, or X,Y,Z");
  options.custom(
      "--lens", "RADIUS,FOCUS", "", [&](const std::string& text) { changes.lens = parse_lens(text); },
      "depth of field: radius of the lens and focus distance, in metres");
  options.flag("--left-handed", changes.left_handed,
               "swap front and back, for a left-handed world that was not converted");
}

// Numbers, not light: of any format a pixel's value is the one that is stored, 0..1. NaN becomes `fallback`.
static std::shared_ptr<const ods::Image> read_map(const std::string& path, float fallback, bool inverted = false) {
  const ods::FileInfo info = ods::read_info(path);
  if (int64_t{info.width} * info.height > ods::kLargestMap) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("'{}' has {}x{} pixels: a map has at most {}; 4096x2048 are enough", path, info.width,
                                 info.height, ods::kLargestMap));
  }
  std::string color_fault;
  const ods::Image picture = ods::read_image(path, &color_fault);
  if (!color_fault.empty()) warn(fmt::format("'{}': {}", path, color_fault));
  auto map = std::make_shared<ods::Image>(picture.width, picture.height, 1);
  for (size_t i = 0; i < map->pixels.size(); i++) {
    const float light = picture.pixels[3 * i];
    const float stored = std::clamp(info.is_float ? light : ods::srgb_encode(light), 0.0f, 1.0f);
    map->pixels[i] = std::isnan(stored) ? fallback : inverted ? 1.0f - stored : stored;
  }
  return map;
}

std::string merge_curve_text(const ods::Image& map) {
  const auto full = [&](int from, int step) {
    int row = from;
    while (row > 0 && row + 1 < map.height && map.at(0, row)[0] == 1.0f) row += step;
    return std::abs(90 - row);
  };
  return fmt::format("full stereo up to {} degrees up and {} down, {:.0f} % straight up, {:.0f} % straight down",
                     full(89, -1), full(90, 1), 100.0f * map.at(0, 0)[0], 100.0f * map.at(0, map.height - 1)[0]);
}

std::string merge_by_depth_text(const ods::Image& map) {
  return "merge by depth: " + merge_curve_text(map);
}

void read_maps(const CameraChanges& changes, StereoCamera& camera) {
  if (changes.merge_limit && !changes.merge_map.empty()) {
    throw UsageError("--merge auto and --merge-map exclude each other");
  }
  const bool wanted = camera.top.mode == ods::kMergeMap || camera.bottom.mode == ods::kMergeMap;
  if (changes.merge_map.empty() && wanted && !camera.merge_map) {
    throw UsageError("--merge map needs a picture: --merge-map FILE");
  }
  if (changes.merge_map.empty() && changes.merge_map_inverted) {
    throw UsageError("--merge-map-inverted needs a picture: --merge-map FILE");
  }
  if (!changes.merge_map.empty()) {
    if (!wanted) camera.top.mode = camera.bottom.mode = ods::kMergeMap;
    camera.merge_map = read_map(changes.merge_map, 0.0f, changes.merge_map_inverted);
  }
  if (!changes.head_tilt_map.empty()) camera.head_tilt_map = read_map(changes.head_tilt_map, 0.5f);
}

StereoCamera changed(StereoCamera camera, const CameraChanges& changes) {
  if (changes.preset) camera = changes.preset->camera;
  for (const auto& [field, value] : changes.numbers) {
    if (value) *numbers_of(camera, field)[0] = *value;
  }
  if (changes.merge) camera.top = camera.bottom = *changes.merge;
  if (changes.merge_top) camera.top = *changes.merge_top;
  if (changes.merge_bottom) camera.bottom = *changes.merge_bottom;
  if (changes.convergence) {
    camera.convergence = changes.convergence->mode;
    camera.convergence_distance = changes.convergence->distance.value_or(camera.convergence_distance);
  }
  if (changes.axis) camera.axis = *changes.axis;
  if (changes.lens) camera.lens_radius = changes.lens->x, camera.focus_distance = changes.lens->y;
  camera.mirrored |= changes.left_handed;
  camera.projection = changed(camera.projection, changes.projection);
  return camera;
}
