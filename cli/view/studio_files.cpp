// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio's files: files that are dropped onto the page, and the cameras that it saves.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/console.h"
#include "cli/view/render_arguments.h"
#include "cli/view/studio.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/atomic_file.h"
#include "ods/files/read_file.h"

namespace {

constexpr size_t kMaxCameraBytes = size_t{64} << 20;  // bytes

// The name of a file, without its folder and without characters that confuse a terminal.
std::string plain_name(const std::string& given) {
  std::string name = given.substr(given.find_last_of("/\\") + 1);
  std::erase_if(name, [](unsigned char c) { return std::iscntrl(c) != 0; });
  return name;
}

bool has_same_bytes(const std::string& one, const std::string& other) {
  namespace fs = std::filesystem;
  if (!fs::is_regular_file(fs::symlink_status(one)) || fs::file_size(one) != fs::file_size(other)) return false;
  using Bytes = std::istreambuf_iterator<char>;
  std::ifstream a(one, std::ios::binary), b(other, std::ios::binary);
  return std::equal(Bytes(a), Bytes(), Bytes(b), Bytes());
}

// Returns false if something has the name already.
bool copy_as_new(const std::string& from, const std::string& to) {
  const ods::PrivateFolder folder(".ods-view-");
  std::filesystem::copy_file(from, folder.path() + "/copy");
  return ods::rename_as_new(folder.path() + "/copy", to);
}

}  // namespace

// The name of the scene that the user knows.
std::string Studio::title() const {
  return dropped_scene_.path.empty() ? source_.name : dropped_scene_.name;
}

// The value of --env for the page's settings. is_shown: as for words().
std::string Studio::environment_of(const Settings& settings, bool is_shown) const {
  const std::string& word = settings.environment;
  if (word == "sky") return sky_word(settings.sky);
  if (!dropped_light_.path.empty() && word == dropped_light_.name) {
    return is_shown ? dropped_light_.shown() : dropped_light_.path;
  }
  return word == "auto" ? "" : word;
}

// The files that a command for the user reads, and that are not in his folder until Save camera writes them.
std::string Studio::missing_files(const std::vector<std::string>& command) const {
  std::vector<std::string> files;
  for (const Drop* const drop : {&dropped_scene_, &dropped_light_}) {
    const bool is_read = std::ranges::find(command, drop->name) != command.end();
    if (is_read && !drop->path.empty() && drop->kept.empty()) files.push_back(drop->name);
  }
  const auto is_map = [](const std::string& word) { return word.ends_with("-map"); };
  if (std::ranges::any_of(command, is_map)) files.emplace_back("maps");
  return fmt::format("{}", fmt::join(files, " and "));
}

// A message for the page, without names of our own files: they mean nothing to its user, and would reveal paths of this
// machine.
std::string Studio::without_paths(std::string text) const {
  text = with_options(text);
  const auto replace = [&](const std::string& path, const std::string& name) {
    for (size_t at = 0; !path.empty() && (at = text.find(path, at)) != std::string::npos; at += name.size()) {
      text.replace(at, path.size(), name);
    }
  };
  replace(dropped_scene_.path, dropped_scene_.name);
  replace(dropped_light_.path, dropped_light_.name);
  replace(drops_.path() + "/", "");
  replace(drops_.path(), "what was dropped");
  return text;
}

void Studio::discard(const Drop& drop) {
  std::error_code ignored;
  if (!drop.path.empty()) std::filesystem::remove(drop.path, ignored);
}

// Copies a dropped file into the folder where ods view was started, unless its bytes are there under its name.
void Studio::keep(Drop& drop) {
  if (drop.path.empty() || !drop.kept.empty()) return;
  const std::filesystem::path plain(drop.name.find_first_not_of("-.") == 0 ? drop.name : "dropped-" + drop.name);
  for (int i = 1; drop.kept.empty(); i++) {
    const std::string end = plain.extension().string();
    const std::string name = i == 1 ? plain.string() : fmt::format("{}-{}{}", plain.stem().string(), i, end);
    if (has_same_bytes(name, drop.path) || copy_as_new(drop.path, name)) drop.kept = name;
  }
}

WebAnswer Studio::drop_camera(const std::string& name, const std::string& path) {
  std::vector<std::string> warnings;
  const ods::Sidecar sidecar = ods::read_sidecar(ods::read_text(path, kMaxCameraBytes), name, warnings);
  const std::string fault = camera_fault(sidecar.camera);
  if (!fault.empty()) throw UsageError("the camera's " + fault);
  for (const auto& map : {sidecar.camera.merge_map, sidecar.camera.head_tilt_map}) {
    if (map && maps_.size() < kMaxMaps) maps_.push_back(map);
  }
  settings_.sidecar = sidecar;
  settings_.live.camera = sidecar.camera;
  settings_.live.merge_limit.reset();
  live_->set(settings_.live, settings_.look);
  return json_answer({{"what", "camera"}, {"settings", settings_json(settings_)}});
}

// A file that was dropped onto the page: another scene, another light, or a camera. Files that it names, such as a
// scene's textures, are read from our own folder only.
WebAnswer Studio::drop(const WebRequest& request) {
  const std::string name = plain_name(value_of(request, "name"));
  const std::string kind = ods::small_letters(std::filesystem::path(name).extension().string());
  if (kind == ".json") return drop_camera(name, request.file);
  if (is_foreign_scene(name)) {
    throw UsageError(fmt::format("{} must be converted first: end ods view and start it as ods view {}", name,
                                 ods::shell_word(name)));
  }
  const bool is_scene = kind == ".glb" || kind == ".zip", is_light = kind == ".hdr" || kind == ".exr";
  if (!is_scene && !is_light) throw UsageError("drop a .glb or .zip, an .hdr or .exr, or a .camera.json");
  const Drop drop{name, fmt::format("{}/{}{}", drops_.path(), ++drop_count_, kind)};
  std::filesystem::rename(request.file, drop.path);
  Drop& place = is_scene ? dropped_scene_ : dropped_light_;
  const Drop before = std::exchange(place, drop);
  SceneSource source = is_scene ? SceneSource() : source_;
  if (is_scene) {
    source.name = drop.path;
    source.confine = drops_.path();
  } else {
    source.light.environment = drop.path;
  }
  try {
    open(source, is_scene);
  } catch (const std::exception& error) {
    const std::string why = without_paths(error.what());
    place = before;
    discard(drop);
    throw ods::Error(ods::ErrorKind::kInput, why);
  }
  discard(before);
  if (is_scene) discard(std::exchange(dropped_light_, {}));
  if (is_scene) return json_answer({{"what", "scene"}, {"settings", settings_json(settings_)}});
  settings_.environment = usual_.environment = name;
  live_->set(settings_.live, settings_.look);
  return json_answer({{"what", "environment"}, {"settings", settings_json(settings_)}});
}

// The names of the scene's files without their endings.
std::string Studio::stem() const {
  return std::filesystem::path(title()).stem().string();
}

WebAnswer Studio::save() {
  ods::Sidecar sidecar = settings_.sidecar;
  sidecar.camera = live_->camera();
  sidecar.eye = {settings_.width, natural_height(sidecar.camera.projection, settings_.width)};
  const ods::PrivateFolder folder(".ods-view-");  // whatever has the name, nothing is written through it
  const std::string made = folder.path() + "/camera";
  std::vector<std::string> ends = save_maps(command_camera(), made);
  save_sidecar(sidecar, made + ends.emplace_back(".camera.json"));
  const auto is_taken = [&](const std::string& name) {  // a file of another program stays
    return std::ranges::any_of(ends, [&](const std::string& end) {
      return std::filesystem::exists(std::filesystem::symlink_status(name + end));
    });
  };
  std::string name = saved_.empty() ? stem() : saved_;
  for (int i = 2; saved_.empty() && is_taken(name); i++) name = fmt::format("{}-{}", stem(), i);
  for (const std::string& end : ends) {
    if (!saved_.empty())
      std::filesystem::rename(made + end, name + end);
    else if (!ods::rename_as_new(made + end, name + end))
      throw UsageError(fmt::format("'{}' exists by now: try again", name + end));
  }
  saved_ = name;
  for (Drop* const drop : {&dropped_scene_, &dropped_light_}) keep(*drop);
  return json_answer({{"file", saved_ + ".camera.json"}});
}
