// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/view_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/console.h"
#include "cli/console/options.h"
#include "cli/options/layout_options.h"
#include "cli/options/projection_options.h"
#include "cli/view/objects.h"
#include "ods/base/text.h"
#include "ods/camera/file_names.h"
#include "ods/image/format/file_format.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/video/container/video_file.h"
#include "ods/view/layered_file.h"

using ods::ViewItem;

namespace {

constexpr const char* kViewExamples =
    "  ods view picture_360_TB.png\n"
    "  ods view video_360_TB.mp4 other.exr folder/\n"
    "  ods view picture.png --lan\n"
    "  ods view scene.glb                        the studio: the scene, rendered while you look\n"
    "  ods view scene.layers.glb                 a layered scene, in which the head moves\n"
    "  ods view scene.layers.glb --with robot.glb --at 0.4,0,-1\n"
    "  ods view picture_360_TB.exr --with robot.glb --at 0.4,0,-1   a picture with depth\n"
    "  ods view tour.json                        panoramas with ways between them, a compass and a plan\n"
    "  ods view picture_360_TB.png --export site/ --title \"The harbour\" --lang de";

constexpr const char* kViewSummary =
    "Shows stereo 360 pictures and videos around you: in the browser, and with one click in the headset. --lan is for\n"
    "headsets on the same network. --export writes the viewer as a folder for any web host. docs/view.md has the keys.";

constexpr size_t kMaxItems = 2000;

// Returns whether the studio opens it: a scene's file, or a built-in scene whose name no file has.
bool names_scene(const std::string& path) {
  if (ods::is_layered_scene(path)) return false;
  const std::string extension = ods::small_letters(std::filesystem::path(path).extension().string());
  if (extension == ".glb" || extension == ".gltf" || extension == ".zip" || is_foreign_scene(path)) return true;
  return ods::find_builtin(path) && !std::filesystem::exists(path);
}

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (!entry.is_regular_file() || entry.path().filename().string().starts_with('.')) continue;
    if (ods::names_picture(path) || ods::is_video(path) || ods::is_layered_scene(path)) paths.push_back(path);
  }
  std::ranges::sort(paths);
  return paths;
}

// A path joined with those that belong to the same picture. Adds all of them to `taken`.
std::string with_companions(const std::string& path, const ods::FormatHint& known, std::set<std::string>& taken) {
  const std::string name = ods::is_layered_scene(path) ? path : joined_input({path}, known);
  if (!ods::names_files(name)) return name;
  for (std::string& file : ods::files_of(name)) taken.insert(std::move(file));
  return name;
}

void add_folder(const std::string& folder, const ods::FormatHint& known, std::vector<ViewItem>& items) {
  std::vector<std::string> faults;
  const size_t before = items.size();
  std::set<std::string> taken;
  for (const std::string& path : files_in(folder)) {
    if (taken.contains(path)) continue;
    if (items.size() == kMaxItems) {
      warn(fmt::format("'{}' has more than {} files: the rest is left out", folder, kMaxItems));
      break;
    }
    try {
      items.push_back(ods::open_view_item(with_companions(path, known, taken), known));
    } catch (const ods::Error& error) {
      if (error.kind() != ods::ErrorKind::kInput) throw;
      faults.emplace_back(error.what());
    }
  }
  if (items.size() == before) {
    throw ods::Error(ods::ErrorKind::kInput,
                     faults.empty() ? fmt::format("'{}' has no picture and no video", folder) : faults.front());
  }
  if (!faults.empty()) note(fmt::format("'{}': {} left out; the first: {}", folder, faults.size(), faults.front()));
}

void note_guesses(const ViewItem& item) {
  for (const std::string& guess : item.picture.guesses) note(fmt::format("'{}' is {}", item.path, guess));
}

// The paths, with those that belong to one picture joined.
std::vector<std::string> with_companions(const ViewJob& job) {
  std::vector<std::string> paths;
  std::set<std::string> taken;
  for (const std::string& path : job.paths) {
    if (!taken.contains(path)) paths.push_back(with_companions(path, job.known, taken));
  }
  return paths;
}

}  // namespace

ViewJob parse_view(Options& options) {
  ViewJob job;
  options.describe(kViewSummary, kViewExamples);
  options.arguments(
      ValueKind::input_file("FILE"), job.paths,
      "pictures, videos, layered scenes, and folders of them (%V in a name: one file per eye), or a scene, or a tour");
  options.group("Objects in a layered scene, or in a picture with depth");
  add_object_options(options, job.objects, "the layered scene or the picture");
  add_depth_options(options, job.depth);
  options.group("Input, if it is not detected");
  add_input_layout_option(options, job.known.layout, "how both eyes share the file");
  options.custom(
      "--projection", "NAME", "",
      [&](const std::string& name) { job.known.projection = projection_by_name("--projection", name); },
      "its projection");
  add_lens_options(options, job.known);
  options.group("Page");
  options.flag("--lan", job.lan, "let a headset or phone on the same network see it: https, with a QR code");
  options.flag("--keep-secret", job.keep_secret,
               "with --lan: the same address the next time; by default it is new each time");
  options.number("--port", job.port, 1, 65535, "port of the server; by default 8360, or any if that is taken");
  bool stay = false;
  options.flag("--no-browser", stay, "only print the address");
  options.text("--export", ValueKind::output_folder(), job.folder,
               "write the viewer and the files into this folder instead");
  options.text("--title", "TEXT", job.texts.title, "with --export: what the page and links to it are called");
  const std::vector<std::string> languages = page_languages();
  options.text("--lang", "LANGUAGE", job.texts.language,
               fmt::format("with --export: the page's language: {}", fmt::join(languages, ", ")));
  options.group("Console");
  add_console_options(options);
  options.parse();
  if (job.paths.empty()) throw UsageError("name a picture, a video, a folder or a scene: ods view picture_360_TB.png");
  if (job.keep_secret && !job.lan) throw UsageError("--keep-secret is for --lan: other addresses are kept anyway");
  if (!job.folder.empty() && (job.lan || job.port)) {
    throw UsageError("--export serves nothing: leave --lan and --port out");
  }
  const bool has_texts = !job.texts.title.empty() || job.texts.language != PageTexts().language;
  if (has_texts && job.folder.empty()) throw UsageError("--title and --lang are for --export");
  if (std::ranges::find(languages, job.texts.language) == languages.end()) {
    throw UsageError(fmt::format("--lang must be one of {}", fmt::join(languages, ", ")));
  }
  placed_objects(job.objects);
  if (job.depth.path.empty()) options.refuse(depth_option_names(), "goes with --depth FILE");
  finish_lens_options(job.known);
  job.browser = !stay;
  return job;
}

void find_scene(ViewJob& job) {
  const auto scene = std::ranges::find_if(job.paths, names_scene);
  if (scene == job.paths.end()) return;
  job.scene = *scene;
  job.paths.erase(scene);
  if (std::ranges::any_of(job.paths, names_scene)) throw UsageError("the studio shows one scene at a time");
  if (!job.folder.empty()) throw UsageError("--export writes pictures and videos: render the scene first");
}

void find_tour(ViewJob& job) {
  const auto found = std::ranges::find_if(job.paths, ods::names_tour);
  if (found == job.paths.end()) return;
  if (job.paths.size() > 1) throw UsageError("a tour is shown alone: its file lists its panoramas");
  if (!job.objects.files.empty()) throw UsageError("--with is for a layered scene, not for a tour");
  const std::string path = *found;
  job.tour = ods::read_tour(path);
  job.paths.clear();
  for (const ods::TourStop& stop : job.tour->panoramas) job.paths.push_back(stop.file);
}

std::vector<ViewItem> open_items(const ViewJob& job) {
  std::vector<ViewItem> items;
  for (const std::string& path : with_companions(job)) {
    if (std::filesystem::is_directory(path)) {
      add_folder(path, job.known, items);
    } else if (ods::is_layered_scene(path)) {
      items.push_back(ods::open_view_item(path, job.known));
      note_guesses(items.back());
    } else {
      ods::MediaFile media = open_input(path, {.known = job.known, .color_only = true});
      const ods::FormatHint known = media.hint;
      const bool is_video = media.video.has_value();
      std::optional<ods::PictureReader> reader;
      if (!is_video) reader = reader_of(std::move(media));
      items.push_back(ods::open_view_item(path, known, std::move(reader)));
      note_guesses(items.back());
    }
  }
  add_objects(job.objects, job.depth, items);
  if (items.size() == 1 && !job.texts.title.empty()) items[0].title = job.texts.title;  // instead of its file's name
  if (!job.tour) return items;
  if (items.size() != job.tour->panoramas.size()) {
    throw ods::Error(ods::ErrorKind::kInput,
                     "two panoramas of the tour are the eyes of one: join them, as ods convert does, or rename them");
  }
  ods::add_tour(*job.tour, items);
  return items;
}
