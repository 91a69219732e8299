// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/supply.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/image/tone.h"
#include "ods/kernel/surface.h"
#include "ods/stage/light/areas.h"
#include "ods/stage/light/studio.h"

namespace ods {
namespace {

// Dimmer emission is an indicator lamp of a device, which does not light a place. A lamp of a tenth of a square metre
// and a radiance of 5 in a room with 250 square metres of surface has this level.
constexpr float kLitPlace = 0.002f;
// Objects with less emission are seen by the light around them.
constexpr float kLitObject = 0.5f;

// The mean luminance of a texture, from at most a few thousand texels.
float mean_luminance(const Scene& scene, int index) {
  const Texture& texture = scene.textures[static_cast<size_t>(index)];
  const std::vector<float> decoded = linear_from_encoded(255);
  const size_t count = static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height);
  const size_t stride = count / 4096 + 1;
  double sum = 0.0;
  size_t texels = 0;
  for (size_t i = 0; i < count; i += stride) {
    const uint texel = scene.texels[texture.first_texel + i];
    const auto channel = [&](uint shift) {
      const uint value = texel >> shift & 255u;
      return texture.srgb == 1 ? decoded[value] : static_cast<float>(value) / 255.0f;
    };
    sum += static_cast<double>(luminance(vec3(channel(0), channel(8), channel(16))));
    texels++;
  }
  return texels > 0 ? static_cast<float>(sum / static_cast<double>(texels)) : 0.0f;
}

float luminance_of(const Scene& scene, const Material& material) {
  if (!is_emissive(material)) return 0.0f;
  const float factor = luminance(material.emission);
  const int texture = material.emission_slot.texture;
  return texture < 0 ? factor : factor * mean_luminance(scene, texture);
}

float window_share(const SceneRays& rays, vec3 eye) {
  const std::vector<vec3> directions = sphere_directions(4096);
  const auto open = [&](const vec3& direction) { return rays.is_open(eye, direction); };
  return static_cast<float>(std::ranges::count_if(directions, open)) / static_cast<float>(directions.size());
}

bool is_within(const Bounds& bounds, vec3 point) {
  return all(greaterThanEqual(point, bounds.low)) && all(lessThanEqual(point, bounds.high));
}

// Returns whether the scene's lamps or its environment light the viewer. Distant light does not pass walls without
// windows.
bool lamps_reach(const SceneRays& rays, const Survey& survey, float windows) {
  const Scene& scene = rays.scene();
  const bool shut = survey.kind == SceneKind::kClosedRoom && windows < kWindows;
  if (scene.environment.radiance != vec3(0.0f) && !shut) return true;
  const auto reaches = [&](const PunctualLight& light) {
    if (!(luminance(light.intensity) > 0.0f)) return false;
    return !shut || (light.kind != kLightDirectional && is_within(survey.bounds, light.position));
  };
  return std::ranges::any_of(scene.lights, reaches);
}

bool glows_enough(const Scene& scene, const Survey& survey) {
  return emission_level(scene) >= (survey.kind == SceneKind::kObject ? kLitObject : kLitPlace);
}

// Sets has_light and paint. may_be_painted: the user did not ask for light.
void judge_light(const SceneRays& rays, const Survey& survey, bool may_be_painted, LightPlan& plan) {
  const bool is_place = survey.kind == SceneKind::kClosedRoom || survey.kind == SceneKind::kOpenPlace;
  plan.has_light = lamps_reach(rays, survey, plan.windows);
  if (plan.has_light) return;
  const bool glows = glows_enough(rays.scene(), survey);
  // Scans have no lamps.
  if (may_be_painted) plan.paint = paint_of(rays.scene(), is_place && !glows);
  plan.has_light = glows && plan.paint == Paint::kLit;
}

// The environment to add if the user did not choose one and the scene has no light.
std::optional<Surround> missing_surround(const Survey& survey, const LightPlan& plan) {
  switch (survey.kind) {
    case SceneKind::kNothing:  // objects that appear later
    case SceneKind::kObject:
      return Surround::kStudio;
    case SceneKind::kOpenPlace:
      if (!survey.stand->floor) return Surround::kStudio;  // the sky has a ground, and no object here stands on one
      return Surround::kSky;
    case SceneKind::kClosedRoom:
      break;
  }
  if (plan.windows >= kWindows) return Surround::kSky;
  return std::nullopt;
}

std::string place_text(vec3 p) {
  const auto rounded = [](float x) { return std::round(100.0f * x) / 100.0f + 0.0f; };  // avoids -0
  return fmt::format("{:g},{:g},{:g}", rounded(p.x), rounded(p.y), rounded(p.z));
}

std::string note_for(const Survey& survey, const LightPlan& plan, const LightChoices& choices) {
  if (choices.unlit) return "";
  if (plan.paint == Paint::kUnlit) return "the scene is shown as it is painted: " + paint_reason(plan.paint);
  if (plan.as_painted) {
    return fmt::format(
        "the scene seems to hold its light in its colours ({}): it is shown as it is painted (`env` sky or `lamp` "
        "X,Y,Z "
        "lights it instead)",
        paint_reason(plan.paint));
  }
  if (plan.lamp && choices.lamp == LampChoice::kAuto) {
    return fmt::format(
        "a closed room without light: a lamp hangs at {} (`lamp` X,Y,Z moves it, `lamp` none removes it)",
        place_text(plan.lamp->position));
  }
  if (!plan.surround || choices.surround != Surround::kAuto) return "";
  if (plan.surround == Surround::kStudio) {
    const bool floats = survey.kind == SceneKind::kOpenPlace;
    return fmt::format(
        "{} own: a studio lights {} (`env` sky, white, R,G,B or a lat-long picture replaces the studio, `env` "
        "0 removes it)",
        floats ? "floating things without light of their" : "an object without light of its", floats ? "them" : "it");
  }
  const std::string sky = fmt::format(
      "`env` sky:elevation={:g},azimuth={:g} is this sun, `env` white, R,G,B or a lat-long picture replaces the sky)",
      plan.sky.elevation, plan.sky.azimuth);
  if (survey.kind == SceneKind::kClosedRoom && plan.windows >= kWindows) {
    return "a room with windows and no lamp: sun and sky light it from outside (`lamp` X,Y,Z adds a lamp, " + sky;
  }
  return "an open place without light of its own: sun and sky light it (" + sky;
}

// The name of the material with the most emission; empty if it has none.
std::string brightest_material(const Scene& scene) {
  const std::vector<double> areas = instance_areas(scene);
  std::vector<double> power(scene.materials.size(), 0.0);
  for (size_t i = 0; i < areas.size(); i++) {
    const auto material = static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material);
    power[material] += areas[i] * static_cast<double>(luminance_of(scene, scene.materials[material]));
  }
  const auto maximum = static_cast<size_t>(std::ranges::max_element(power) - power.begin());
  return maximum < scene.material_names.size() ? scene.material_names[maximum] : "";
}

// The fraction of the emissive surfaces around the viewer that have only open air behind them: panes that represent the
// sky.
float glowing_panes(const SceneRays& rays, vec3 eye) {
  constexpr int kDirections = 2048;
  int glowing = 0, panes = 0;
  const Scene& scene = rays.scene();
  for (const vec3& direction : sphere_directions(kDirections)) {
    const Sight sight = rays.look(eye, direction);
    if (sight.leaves()) continue;
    const auto mesh = static_cast<size_t>(scene.instances[static_cast<size_t>(sight.instance)].mesh);
    if (!is_emissive(scene.materials[static_cast<size_t>(scene.meshes[mesh].material)])) continue;
    constexpr float kThickest = 0.05f;  // thickness of a pane, metres
    glowing++;
    if (rays.is_open(eye + direction * (sight.distance + kThickest), direction)) panes++;
  }
  return glowing == 0 ? 0.0f : static_cast<float>(panes) / static_cast<float>(glowing);
}

std::string advice_for(const SceneRays& rays, const Survey& survey, const LightPlan& plan) {
  constexpr float kMaxPanes = 0.5f;
  const Scene& scene = rays.scene();
  const bool dark_outside = scene.environment.radiance == vec3(0.0f) && !plan.surround;
  if (survey.kind != SceneKind::kClosedRoom || !plan.has_light || !dark_outside || plan.as_painted) return "";
  const std::string material = brightest_material(scene);
  const std::string glowing = material.empty() ? "what glows" : fmt::format("'{}', which glows", material);
  if (glowing_panes(rays, survey.stand->eye) > kMaxPanes) {
    return fmt::format("the room's light is {}, in a window: without it, sun and sky would light the room", glowing);
  }
  if (plan.windows < kWindows) return "";
  return fmt::format("the room's only light is {}, and nothing is behind its windows: `env` sky puts sun and sky there",
                     scene.lights.empty() ? glowing : "that of its lamps");
}

// Turns it clockwise, seen from above: a sun at the azimuth a appears at a + degrees.
void turn(Environment& environment, float degrees) {
  if (environment.width == 0 || degrees == 0.0f) return;
  const auto width = static_cast<ptrdiff_t>(environment.width);
  const double shift = static_cast<double>(degrees) / 360.0 * static_cast<double>(width);
  const auto whole = static_cast<ptrdiff_t>(std::floor(shift));
  const auto part = static_cast<float>(shift - std::floor(shift));
  const std::vector<vec3> before = environment.texels;
  for (ptrdiff_t y = 0; y < environment.height; y++) {
    for (ptrdiff_t x = 0; x < width; x++) {
      const auto at = [&](ptrdiff_t column) {
        return before[static_cast<size_t>(y * width + ((column % width) + width) % width)];
      };
      environment.texels[static_cast<size_t>(y * width + x)] = mix(at(x - whole), at(x - whole - 1), part);
    }
  }
}

void adjust(Environment& environment, const LightChoices& choices) {
  turn(environment, choices.turn);
  environment.radiance *= choices.strength;
}

}  // namespace

float emission_level(const Scene& scene) {
  const std::vector<double> areas = instance_areas(scene);
  std::vector<float> luminances;
  for (const Material& material : scene.materials) luminances.push_back(luminance_of(scene, material));
  double total = 0.0, emitted = 0.0;
  for (size_t i = 0; i < areas.size(); i++) {
    const auto material = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material;
    total += areas[i];
    emitted += areas[i] * static_cast<double>(luminances[static_cast<size_t>(material)]);
  }
  return total > 0.0 ? static_cast<float>(emitted / total) : 0.0f;
}

SkyOptions best_sun(const SceneRays& rays, vec3 eye) {
  constexpr float kStep = 15.0f;  // degrees
  const SkyOptions usual;
  std::vector<std::pair<vec3, vec3>> seen;  // points just in front of surfaces, and their normals
  for (const vec3& direction : sphere_directions(512)) {
    const Sight sight = rays.look(eye, direction);
    if (!sight.leaves()) seen.emplace_back(eye + direction * (sight.distance * 0.999f), sight.normal);
  }
  SkyOptions best = usual;
  int maximum = 0;
  for (const float elevation : {usual.elevation, usual.elevation + kStep, usual.elevation + 2.0f * kStep}) {
    for (float turned = 0.0f; turned < 360.0f; turned += kStep) {
      const float azimuth = std::fmod(usual.azimuth + turned, 360.0f);
      const vec3 sun = direction_at(azimuth, elevation);
      const auto is_lit = [&](const auto& place) {
        return dot(place.second, sun) > 0.0f && rays.is_open(place.first, sun);
      };
      const int lit = static_cast<int>(std::ranges::count_if(seen, is_lit));
      // Another sun must be clearly better.
      if (lit * 4 <= maximum * 5) continue;
      maximum = lit;
      best = {elevation, azimuth};
    }
  }
  return best;
}

LightPlan plan_light(const SceneRays& rays, const Survey& survey, const LightChoices& choices) {
  const bool closed = survey.kind == SceneKind::kClosedRoom;
  const bool chosen = choices.surround != Surround::kAuto;
  LightPlan plan;
  if (closed) plan.windows = window_share(rays, survey.stand->eye);
  judge_light(rays, survey, !chosen && choices.lamp != LampChoice::kPlaced, plan);
  plan.as_painted = choices.unlit || plan.paint != Paint::kLit;
  if (chosen) plan.surround = choices.surround;
  if (!chosen && !plan.has_light) plan.surround = missing_surround(survey, plan);
  const auto clearance = [&](vec3 from, vec3 direction) { return rays.distance(from, direction); };
  const bool dark = closed && !plan.has_light && !plan.as_painted && plan.windows < kWindows;
  if (choices.lamp == LampChoice::kPlaced) {
    plan.lamp = lamp_at(choices.lamp_position, clearance);
  } else if (choices.lamp == LampChoice::kAuto && dark) {
    plan.lamp = place_lamp(survey.stand->eye, clearance);
    if (!plan.lamp && !chosen) plan.surround = Surround::kSky;
  }
  plan.sky = choices.sky;
  const bool sun_is_free = plan.surround == Surround::kSky && !chosen && survey.stand;
  if (sun_is_free) plan.sky = best_sun(rays, survey.stand->eye);
  const bool made = plan.surround == Surround::kStudio || plan.surround == Surround::kSky;
  plan.ground = choices.ground && made && survey.kind == SceneKind::kObject && !plan.as_painted;
  plan.note = note_for(survey, plan, choices);
  if (!chosen) plan.advice = advice_for(rays, survey, plan);
  return plan;
}

void apply_light(Scene& scene, const Survey& survey, const LightPlan& plan, const LightChoices& choices) {
  if (plan.as_painted) show_paint(scene);
  scene.as_painted = plan.as_painted;
  const size_t before = scene.instances.size();
  if (plan.surround == Surround::kStudio) {
    scene.environment = make_studio(choices.yaw);
    const bool floats = survey.stand && !survey.stand->floor;  // without a floor below or a wall behind
    scene.background = floats ? Environment{} : make_studio_walls();
  }
  if (plan.surround == Surround::kSky) scene.environment = make_sky(plan.sky);
  if (plan.surround == Surround::kGiven) scene.environment = choices.given;
  adjust(scene.environment, choices);
  if (scene.background) adjust(*scene.background, choices);
  if (plan.ground) {
    const vec3 size = survey.core.high - survey.core.low, middle = 0.5f * (survey.core.low + survey.core.high);
    const float largest = std::max({size.x, size.y, size.z});
    // Slightly below the object, whose own underside may be flat.
    const vec3 center(middle.x, survey.bounds.low.y - 0.001f * largest, middle.z);
    add_ground(scene, center, 7.0f * largest, plan.surround == Surround::kStudio ? studio_floor() : sky_ground());
  }
  if (plan.lamp) add_lamp(scene, *plan.lamp);
  scene.supplied = scene.instances.size() - before;
}

}  // namespace ods
