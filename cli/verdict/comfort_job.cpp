// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verdict/comfort_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/layout_options.h"
#include "cli/options/projection_options.h"
#include "ods/base/text.h"
#include "ods/image/image_file.h"
#include "ods/video/container/video_file.h"

namespace {

constexpr const char* kComfortExamples =
    "  ods comfort picture.exr                       by its depth layer\n"
    "  ods comfort picture_360_TB.jpg                by matching its eyes\n"
    "  ods comfort video_360_TB.mp4 --html report.html\n"
    "  ods comfort scene.glb --position 0,1.6,0      before anything is rendered\n"
    "  ods comfort picture.exr --heat heat_360_TB.png\n"
    "  ods comfort scene.glb --rules google || echo move the camera";

constexpr const char* kComfortSummary =
    "Judges how a stereo 360 picture strains its viewer's eyes: by its depth layer, or, if it has none, by matching\n"
    "its eyes. Judges a scene before it is rendered, too. Lists what strains most, where it is, and what would help.\n"
    "docs/comfort.md explains the strains and their limits. Exit code 5: something is an error; cautions and warnings\n"
    "do not count.";

// The distances at which the lenses of headsets focus.
struct FocusRow {
  std::string_view name;
  float metres;
};
constexpr FocusRow kFocusTable[] = {{"quest-2", 1.3f},  // developers' guides quote it
                                    {"quest-3", 1.3f},  // provisional: as its predecessor
                                    {"rift", 2.0f},     // Abrash, Oculus Connect 3, 2016
                                    {"infinity", std::numeric_limits<float>::infinity()}};

float parse_focus(const std::string& word) {
  for (const FocusRow& row : kFocusTable) {
    if (word == row.name) return row.metres;
  }
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= 0.2f) return numbers[0];
  throw UsageError(
      fmt::format("--focus is a distance in metres from 0.2 on, quest-2, quest-3, rift or infinity, not '{}'", word));
}

// "63mm", "0.063".
float parse_viewer_ipd(const std::string& word) {
  const bool is_millimetres = word.ends_with("mm");
  const std::vector<float> numbers = parse_numbers(is_millimetres ? word.substr(0, word.size() - 2) : word);
  const float metres = numbers.size() == 1 ? numbers[0] * (is_millimetres ? 0.001f : 1.0f) : 0.0f;
  if (metres >= 0.04f && metres <= 0.09f) return metres;
  throw UsageError(fmt::format("--viewer-ipd is 40mm to 90mm, or 0.04 to 0.09 metres, not '{}'", word));
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

// The file records how a picture was made.
void refuse_camera(const ComfortJob& job) {
  const std::vector<std::string> own = {"",       "--rules", "--focus",    "--viewer-ipd", "--gaze",
                                        "--heat", "--html",  "--json",     "--layout",     "--projection",
                                        "-q",     "--quiet", "--no-color", "--progress",   "--head-roll"};
  for (const GivenWord& word : job.given) {
    if (std::ranges::find(own, word.name) != own.end()) continue;
    throw UsageError(fmt::format("{} is for scenes, and '{}' is a {}", word.name, job.scene.name,
                                 job.input == ComfortInput::kVideo ? "video" : "picture"));
  }
}

// A picture by its name or its first bytes.
ComfortInput input_of(const std::string& path) {
  if (ods::names_picture(path)) return ComfortInput::kPicture;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return ComfortInput::kScene;
  if (ods::format_of_file(ods::FileInput(path))) return ComfortInput::kPicture;
  return ods::is_video(path) ? ComfortInput::kVideo : ComfortInput::kScene;
}

}  // namespace

ComfortJob parse_comfort(Options& options) {
  ComfortJob job;
  ods::Viewer& viewer = job.comfort.viewer;
  options.describe(kComfortSummary, kComfortExamples);
  add_scene_argument(options, job.scene);
  options.optional_argument(ValueKind::input_file("RIGHT"), job.right,
                            "the right eye's picture, if the first one is the left eye's");
  options.group("Viewer");
  options.custom(
      "--focus", "METRES", "1.3", [&](const std::string& word) { viewer.focus = parse_focus(word); },
      "where the headset's lenses focus: metres, quest-2 (1.3), quest-3 (1.3, provisional), rift (2), infinity");
  options.custom(
      "--viewer-ipd", "METRES", "0.065", [&](const std::string& word) { viewer.ipd = parse_viewer_ipd(word); },
      "the viewer's pupil distance, e.g. 0.05 (child) to 0.075 (large adult); 50mm also works");
  options.number("--gaze", viewer.gaze_degrees, 1.0f, 45.0f, "degrees that the eyes turn before the head does");
  options.number("--head-roll", viewer.roll_degrees, 0.0f, 45.0f,
                 "degrees that the line through the ears may be out of level");
  options.custom(
      "--rules", "RULES", "strain", [&](const std::string& word) { parse_rules(word, job.comfort); },
      "strain: each strain by its own limits; google: 0.6 m at the horizon to 3.5 m at the poles; safe-sphere:METRES: "
      "nothing nearer");
  options.group("Output");
  options.text("--heat", ValueKind::output_file(), job.heat,
               "save the picture with straining areas marked yellow, orange and red");
  options.text("--html", ValueKind::output_file(), job.html,
               "save the report as one page with pictures and, for a video, curves");
  options.number("--width", job.width, 64, 8192, "width of the pictures of a scene that are judged");
  options.flag("--json", job.json, "print JSON");
  add_input_layout_option(options, job.format.layout, "layout of a picture's eyes, if it is not detected");
  add_camera_options(options, job.camera);
  options.group("Console");
  add_progress_options(options, job.progress);
  options.parse();
  job.scene.has_places = job.camera.position.has_value();
  job.scene.camera = job.camera.view_point;
  job.given = options.given_words();
  return job;
}

// Finds the other files of a picture that is several.
static void join_files(ComfortJob& job) {
  std::string& name = job.scene.name;
  std::error_code ignored;
  if (job.right.empty() && !ods::names_picture(name) && !std::filesystem::is_directory(name, ignored)) return;
  std::vector<std::string> files{name};
  if (!job.right.empty()) files.push_back(job.right);
  ods::FormatHint known = job.format;
  known.projection = job.camera.changes.projection.named;
  name = joined_input(files, known);
}

void settle_input(ComfortJob& job) {
  join_files(job);
  job.input = input_of(job.scene.name);
  if (job.input == ComfortInput::kScene) {
    int height = 0;
    read_foreign(job.scene);
    take_base(job.camera, job.scene.foreign, job.scene.blender);
    return finish_camera_options(job.camera, job.width, height);
  }
  if (job.input == ComfortInput::kVideo && !job.heat.empty()) {
    throw UsageError("--heat is for pictures and scenes: --html shows a video's");
  }
  refuse_camera(job);
  if (job.camera.changes.projection.named) job.format.projection = *job.camera.changes.projection.named;
}
