// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command that renders what the studio shows.
#include <fmt/format.h>

#include "cli/options/camera_options.h"
#include "cli/view/render_arguments.h"
#include "cli/view/studio.h"
#include "ods/comfort/strain.h"
#include "ods/stage/exposure.h"

// The camera as options say it: a merge by depth is one of them, and has no map there.
ods::StereoCamera Studio::command_camera() const {
  ods::StereoCamera camera = settings_.live.camera;
  if (settings_.live.merge_limit) camera.top = camera.bottom = ods::kUsualMerge;
  return camera;
}

// The command that renders the page's view: with the names of files that the user knows, or with their paths here, and
// without the quality and the output. maps: as camera_arguments().
std::vector<std::string> Studio::words(const std::string& maps, bool is_shown) const {
  std::vector<std::string> words = {"render", source_.name};
  if (is_shown && !dropped_scene_.path.empty()) words[1] = dropped_scene_.shown();
  const auto add = [&](const char* option, const std::string& value) { words.insert(words.end(), {option, value}); };
  if (!source_.scene.empty()) add("--scene", source_.scene);
  if (!settings_.variant.empty()) add("--variant", settings_.variant);
  if (source_.solid_glass) words.emplace_back("--solid-glass");
  if (source_.portable) words.emplace_back("--portable");
  if (source_.unit != "auto") add("--unit", source_.unit);
  const auto add_member = [&](const char* option, const auto& table, auto member) {
    if (static_cast<int>(member) != 0) add(option, std::string(name_in(table, member)));
  };
  add_member("--as", ods::kTakenForTable, source_.taken_for);
  add_member("--up", ods::kUpAxisTable, source_.up);
  add_member("--light-unit", ods::kLampUnitTable, source_.light.lamp_unit);
  if (!source_.confine.empty() && !is_shown) add("--confine", source_.confine);
  if (settings_.environment != "auto") {
    add("--env", environment_of(settings_, is_shown));
  }
  if (settings_.turn != 0.0f) add("--env-turn", fmt::format("{}", settings_.turn));
  if (settings_.strength != 1.0f) add("--env-strength", fmt::format("{}", settings_.strength));
  if (!source_.light.lamp.empty()) add("--lamp", source_.light.lamp);
  if (!source_.light.background.empty()) add("--background", source_.light.background);
  if (source_.light.unlit) words.emplace_back("--unlit");
  for (const std::string& word : camera_arguments(command_camera(), settings_.width, maps)) words.push_back(word);
  if (const std::optional<float> limit = settings_.live.merge_limit) {
    add("--merge", *limit == static_cast<float>(ods::kFusionLimit) ? "auto" : fmt::format("auto,{}", *limit));
  }
  const ods::Layout layout = settings_.sidecar.layout;
  if (layout != default_layout(settings_.live.camera.projection)) add("--layout", std::string(layout_name(layout)));
  if (duration_ > 0.0) add("--time", fmt::format("{}", settings_.live.time));
  add("--exposure", fmt::format("{}", settings_.live.exposure));
  if (settings_.live.tone != ods::usual_tone(*scene_)) add("--tone", std::string(tone_curve_name(settings_.live.tone)));
  add("--width", fmt::format("{}", settings_.width));
  return words;
}
