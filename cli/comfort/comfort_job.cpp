// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/comfort_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cli/console/console.h"
#include "ods/base/text.h"
#include "ods/image/image_file.h"

namespace {

constexpr const char* kExamples =
    "  ods comfort picture.exr                       by its depth layer\n"
    "  ods comfort scene.glb --position 0,1.6,0      before anything is rendered\n"
    "  ods comfort picture.exr --heat heat_360_TB.png\n"
    "  ods comfort scene.glb --rules google || echo move the camera";

constexpr const char* kSummary =
    "Judges what a stereo 360 picture does to its viewer's eyes: by the depth layer of a picture, or in a scene "
    "before\n"
    "it is rendered. Lists the things that strain most, where they are, and what would help. docs/comfort.md explains\n"
    "the strains and their limits. Exit code 1: something is an error; cautions and warnings do not count.";

// Headsets whose focus is known from their makers or from measurements that name it.
struct FocusRow {
  std::string_view name;
  float metres;
};
constexpr FocusRow kFocusTable[] = {
    {"quest-2", 1.3f}, {"rift", 2.0f}, {"infinity", std::numeric_limits<float>::infinity()}};

float parse_focus(const std::string& word) {
  for (const FocusRow& row : kFocusTable) {
    if (word == row.name) return row.metres;
  }
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= 0.2f) return numbers[0];
  throw UsageError(
      fmt::format("--focus is a distance in metres from 0.2 on, quest-2, rift or infinity, not '{}'", word));
}

void parse_rules(const std::string& word, ods::ComfortOptions& comfort) {
  constexpr std::string_view kSphere = "safe-sphere:";
  if (word == "strain") return void(comfort.rules = ods::ComfortRules::kStrain);
  if (word == "google") return void(comfort.rules = ods::ComfortRules::kGoogle);
  if (word.starts_with(kSphere)) {
    const std::vector<float> numbers = parse_numbers(word.substr(kSphere.size()));
    if (numbers.size() == 1 && numbers[0] > 0.0f) {
      comfort.rules = ods::ComfortRules::kSafeSphere;
      comfort.safe_radius = numbers[0];
      return;
    }
  }
  throw UsageError(fmt::format("--rules is strain, google or safe-sphere:METRES, not '{}'", word));
}

// The file says how a picture was made.
void refuse_camera(const Options& options, const ComfortJob& job) {
  const std::vector<std::string> own = {"",       "--rules", "--focus", "--viewer-ipd", "--gaze",
                                        "--heat", "--json",  "-q",      "--quiet",      "--no-color"};
  for (const GivenWord& word : options.given_words()) {
    if (std::ranges::find(own, word.name) != own.end()) continue;
    throw UsageError(fmt::format("{} is for scenes, and '{}' is a picture", word.name, job.scene.name));
  }
}

}  // namespace

bool is_picture(const ComfortJob& job) {
  return ods::format_of_path(job.scene.name).has_value();
}

bool read_comfort_job(ComfortJob& job, int argc, char** argv) {
  ods::Viewer& viewer = job.comfort.viewer;
  Options options("comfort", kSummary, kExamples);
  add_scene_argument(options, job.scene, [&](const ForeignScene& scene) { take_camera(job.camera, scene); });
  options.group("Viewer");
  options.custom(
      "--focus", "METRES", "1.3", [&](const std::string& word) { viewer.focus = parse_focus(word); },
      "where the headset's lenses focus: metres, quest-2 (1.3), rift (2), infinity");
  options.number("--viewer-ipd", viewer.ipd, 0.04f, 0.09f, "distance between the viewer's pupils, metres");
  options.number("--gaze", viewer.gaze_degrees, 1.0f, 45.0f, "degrees that the eyes turn before the head does");
  options.custom(
      "--rules", "RULES", "strain", [&](const std::string& word) { parse_rules(word, job.comfort); },
      "strain: each strain by its own limits; google: 0.6 m at the horizon to 3.5 m at the poles; safe-sphere:METRES: "
      "nothing nearer");
  options.group("Output");
  options.text("--heat", ValueKind::output_file(), job.heat,
               "save the picture with what strains in yellow, orange, red");
  options.number("--width", job.width, 64, 8192, "width of the pictures of a scene that are judged");
  options.flag("--json", job.json, "print JSON");
  add_camera_options(options, job.camera, job.scene.blender);
  options.group("Console");
  add_console_options(options);
  if (!options.parse(argc, argv)) return false;
  if (is_picture(job)) {
    refuse_camera(options, job);
    return true;
  }
  job.scene.has_places = job.camera.position.has_value();
  job.scene.camera = job.camera.view_point;
  int height = 0;
  finish_camera_options(job.camera, job.width, height);
  return true;
}
