// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/light_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/files/confined_file.h"
#include "ods/scene/load/environment.h"
#include "ods/stage/light/studio.h"

using ods::Surround, ods::vec3;

namespace {

constexpr const char* kForms =
    "studio, sky, sky:elevation=35,azimuth=120, white, a lat-long picture, R,G,B or one brightness";

// An environment that an option names.
struct Named {
  Surround surround = Surround::kGiven;
  ods::SkyOptions sky;
  std::string file;
  vec3 color{0.0f};
};

// "sky" or "sky:elevation=35,azimuth=120".
ods::SkyOptions parse_sky(const std::string& option, const std::string& word) {
  ods::SkyOptions sky;
  std::string rest = word.substr(std::min(word.size(), std::string("sky:").size()));
  while (!rest.empty()) {
    const size_t comma = std::min(rest.find(','), rest.size()), equals = std::min(rest.find('='), comma);
    const std::string name = rest.substr(0, equals);
    const std::vector<float> value = parse_numbers(rest.substr(equals, comma - equals).substr(equals < comma ? 1 : 0));
    const bool known = name == "elevation" || name == "azimuth";
    const float low = name == "elevation" ? 0.0f : -360.0f, high = name == "elevation" ? 90.0f : 360.0f;
    if (!known || value.size() != 1 || !(value[0] >= low && value[0] <= high)) {
      throw UsageError(
          fmt::format("{}: a sky has an elevation of the sun from 0 to 90 degrees and an azimuth from -360 "
                      "to 360, as in sky:elevation=35,azimuth=120, not '{}'",
                      option, word));
    }
    (name == "elevation" ? sky.elevation : sky.azimuth) = value[0];
    rest.erase(0, comma + 1);
  }
  return sky;
}

Named parse_environment(const std::string& option, const std::string& word) {
  Named named;
  if (word == "studio") return {Surround::kStudio, {}, "", {}};
  if (word == "white") return {Surround::kGiven, {}, "", vec3(1.0f)};
  if (word == "sky" || word.starts_with("sky:")) return {Surround::kSky, parse_sky(option, word), "", {}};
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.empty()) return {Surround::kGiven, {}, word, {}};
  const bool legal = (numbers.size() == 1 || numbers.size() == 3) &&
                     std::ranges::all_of(numbers, [](float number) { return number >= 0.0f && number <= 1e6f; });
  if (!legal) throw UsageError(fmt::format("{} is {}, from 0 to 1e6, not '{}'", option, kForms, word));
  named.color = numbers.size() == 1 ? vec3(numbers[0]) : vec3(numbers[0], numbers[1], numbers[2]);
  return named;
}

ods::Environment read_picture(const std::string& option, const std::string& path, const std::string& confined_to) {
  // Confined, the message is the same whether or not a file outside exists.
  if (confined_to.empty() && !std::filesystem::exists(path)) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("{}: no such file as '{}'; other than a file it can be {}", option, path, kForms));
  }
  std::string color_fault;
  const ods::ConfinedFile file(path, confined_to);
  ods::Environment environment =
      file.read([&](const std::string& opened) { return ods::load_environment(opened, &color_fault); });
  if (!color_fault.empty()) warn(fmt::format("'{}': {}", path, color_fault));
  if (environment.width != 2 * environment.height) {
    note(fmt::format("{}: a sky is a lat-long picture, twice as wide as high; this one is stretched to that", option));
  }
  return environment;
}

// The environment of a file or a colour.
ods::Environment given_environment(const std::string& option, const Named& named, const std::string& confined_to) {
  if (!named.file.empty()) return read_picture(option, named.file, confined_to);
  ods::Environment environment;
  environment.radiance = named.color;
  return environment;
}

void read_lamp(const std::string& word, ods::LightChoices& choices) {
  if (word.empty() || word == "auto") return;
  if (word == "none") {
    choices.lamp = ods::LampChoice::kNone;
    return;
  }
  const std::vector<float> numbers = parse_numbers(word);
  const bool legal =
      numbers.size() == 3 && std::ranges::all_of(numbers, [](float number) { return std::abs(number) <= 1e6f; });
  if (!legal) throw UsageError(fmt::format("--lamp is auto, none or a place X,Y,Z, not '{}'", word));
  choices.lamp = ods::LampChoice::kPlaced;
  choices.lamp_position = vec3(numbers[0], numbers[1], numbers[2]);
}

}  // namespace

void add_light_options(Options& options, LightOptions& light) {
  const auto kind = [](const std::string& option, const char* unit) {
    return ValueKind::input_file(unit,
                                 [=](const std::string& word) { return !environment_file(option, word).empty(); });
  };
  options.text("--env", kind("--env", "LIGHT"), light.environment,
               "light from all around, instead of the scene's own: studio, sky, sky:elevation=35,azimuth=120 (of the "
               "sun), white, a lat-long picture (.hdr, .exr, ...), R,G,B or one brightness; 0 is none. A scene without "
               "light gets suitable light");
  options.number("--env-turn", light.turn, -360.0f, 360.0f,
                 "turn the light from all around, clockwise seen from above, degrees");
  options.number("--env-strength", light.strength, 0.0f, 1e6f, "multiply the light from all around by this");
  options.text("--lamp", "auto|none|X,Y,Z", light.lamp,
               "a soft lamp that shines down from there; by default (auto) only closed rooms without light get one");
  options.choice("--light-unit", light.lamp_unit, ods::kLampUnitTable,
                 "the unit of the file's lamps. watt: divide them by 683, by which Blender multiplies lamps but not "
                 "emission. auto: candela, as in glTF, unless Blender wrote both lamps and emission");
  options.flag("--unlit", light.unlit, "show the colours of all materials, without light and shadow");
  options.text("--background", kind("--background", "env|PICTURE"), light.background,
               "what the camera sees behind the scene; it lights nothing, and takes the values of --env. By default "
               "env, the light from all around; in a studio the walls, or black behind floating things");
}

std::string environment_file(const std::string& option, const std::string& word) {
  return word.empty() || word == "env" ? "" : parse_environment(option, word).file;
}

std::optional<ods::SkyOptions> described_sky(const std::string& option, const std::string& word) {
  const Named named = parse_environment(option, word);
  return named.surround == Surround::kSky ? std::optional(named.sky) : std::nullopt;
}

std::string sky_word(const ods::SkyOptions& sky) {
  return sky == ods::SkyOptions() ? "sky" : fmt::format("sky:elevation={},azimuth={}", sky.elevation, sky.azimuth);
}

ods::LightChoices read_choices(const LightOptions& light, bool transparent, const std::string& confined_to) {
  ods::LightChoices choices;
  read_lamp(light.lamp, choices);
  choices.unlit = light.unlit;
  choices.turn = light.turn;
  choices.strength = light.strength;
  choices.ground = !transparent;
  if (light.environment.empty()) return choices;
  const Named named = parse_environment("--env", light.environment);
  choices.surround = named.surround;
  choices.sky = named.sky;
  if (named.surround == Surround::kGiven) choices.given = given_environment("--env", named, confined_to);
  return choices;
}

std::optional<ods::Environment> read_background(const std::string& word, const std::string& confined_to) {
  if (word.empty() || word == "env") return std::nullopt;
  const Named named = parse_environment("--background", word);
  if (named.surround == Surround::kStudio) return ods::make_studio_walls();
  if (named.surround == Surround::kSky) return ods::make_sky(named.sky);
  return given_environment("--background", named, confined_to);
}

void light_scene(ods::Scene& scene, const LightOptions& light, ods::LightChoices choices, bool is_ours,
                 const std::string& confined_to, PlannedLight planned) {
  choices.yaw = ods::default_view(scene).yaw;
  const std::optional<ods::Environment> background = read_background(light.background, confined_to);
  auto& [survey, plan] = planned;
  if (is_ours && choices.lamp == ods::LampChoice::kPlaced) {
    const ods::SceneRays rays(scene);
    survey = ods::survey(rays);
    plan = ods::plan_light(rays, survey, choices);
  } else if (is_ours) {
    plan.as_painted = choices.unlit;
    plan.sky = choices.sky;
    if (choices.surround != Surround::kAuto) plan.surround = choices.surround;
  }
  if (!plan.note.empty()) note(plan.note);
  if (!plan.advice.empty()) note(plan.advice);
  ods::apply_light(scene, survey, plan, choices);
  if (!light.background.empty()) scene.background = background;
}
