// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/info_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/console/console.h"
#include "cli/console/print.h"

using ods::SceneInfo, ods::vec3, ods::ViewPoint;

namespace {

std::string xyz(vec3 p) {
  return fmt::format("{:.4g},{:.4g},{:.4g}", p.x, p.y, p.z);
}

nlohmann::ordered_json to_json(vec3 p) {
  return {p.x, p.y, p.z};
}

}  // namespace

void print_text(const SceneInfo& info, const SceneFindings& found, vec3 position) {
  auto row = [](const char* name, const std::string& value) { put_out(fmt::format("{:<14} {}\n", name, value)); };
  const vec3 size = info.bounds.high - info.bounds.low;
  row("scene", info.name);
  row("triangles", fmt::format("{} stored in {} meshes, {} in {} instances", info.triangles, info.meshes,
                               info.instanced_triangles, info.instances));
  row("materials", fmt::format("{}, {} textures ({:.1f} MB)", info.materials, info.textures,
                               static_cast<double>(info.texel_bytes) * 1e-6));
  row("lights",
      fmt::format("{} glowing triangles, {} point, {} spot, {} directional, {} environment", info.emissive_triangles,
                  info.point_lights, info.spot_lights, info.directional_lights, info.has_environment ? "an" : "no"));
  row("size", fmt::format("{:.4g} x {:.4g} x {:.4g} m, from {} to {}", size.x, size.y, size.z, xyz(info.bounds.low),
                          xyz(info.bounds.high)));
  if (found.settled.kind != ods::SceneKind::kNothing) {
    row("taken for", std::string(scene_kind_name(found.settled.kind)));
    if (!found.settled.unit_reason.empty()) row("unit", found.settled.unit_reason + "; --unit m keeps its size");
    if (found.settled.doubted) row("doubt", with_options(settle_doubt(found.settled.kind)));
    if (!found.settled.camera_reason.empty()) row("doubt", found.settled.camera_reason + ": it is not used by default");
  }
  if (found.viewing && (info.view_points.empty() || found.viewing->replaces_cameras)) {
    const ViewPoint& view = found.viewing->view;
    row("viewer", fmt::format("at {}, yaw {:.4g}: {}", xyz(view.position), view.yaw, view.name));
  }
  for (const ViewPoint& view : info.view_points) {
    row("camera", fmt::format("'{}' at {}, yaw {:.4g} pitch {:.4g} roll {:.4g}", view.name, xyz(view.position),
                              view.yaw, view.pitch, view.roll));
  }
  for (const auto& [name, seconds] : info.animations) row("animation", fmt::format("'{}', {:.4g} s", name, seconds));
  if (info.nearest_surface >= 0.0f) {
    row("nearest", fmt::format("{:.3g} m from {}", info.nearest_surface, xyz(position)));
  }
  if (!found.strain.empty()) row("comfort", found.strain + "; ods comfort has more");
  for (const ods::SheetGlass& glass : info.sheet_glass) {
    row("glass", fmt::format("'{}' has no volume and is rendered as thin sheets (closed meshes: {}, open: {}){}",
                             glass.name, glass.closed_meshes, glass.open_meshes,
                             glass.closed_meshes > 0 ? "; --solid-glass makes closed ones refract" : ""));
  }
  for (const std::string& variant : info.variants) row("variant", fmt::format("'{}'", variant));
  for (const ods::UsedExtension& extension : info.extensions) {
    row("extension", fmt::format("{}: {} ({})", extension.name, extension.state, extension.how));
  }
  if (!found.advice.empty()) row("light", found.advice);
  for (const std::string& loss : info.losses) row("lost", loss);
  for (const std::string& warning : info.warnings) row("warning", warning);
}

void print_json(const SceneInfo& info, const SceneFindings& found, vec3 position) {
  nlohmann::ordered_json json = {
      {"name", info.name},
      {"meshes", info.meshes},
      {"instances", info.instances},
      {"triangles", info.triangles},
      {"instanced_triangles", info.instanced_triangles},
      {"emissive_triangles", info.emissive_triangles},
      {"materials", info.materials},
      {"textures", info.textures},
      {"texel_bytes", info.texel_bytes},
      {"point_lights", info.point_lights},
      {"spot_lights", info.spot_lights},
      {"directional_lights", info.directional_lights},
      {"has_environment", info.has_environment},
      {"bounds", {{"low", to_json(info.bounds.low)}, {"high", to_json(info.bounds.high)}}},
      {"kind", nullptr},
      {"metres_per_unit", found.settled.metres_per_unit},
      {"unit_reason", found.settled.unit_reason},
      {"doubt", found.settled.doubted ? with_options(settle_doubt(found.settled.kind)) : ""},
      {"camera_reason", found.settled.camera_reason},
      {"viewer", nullptr},
      {"position", to_json(position)},
      {"nearest_surface", nullptr},
      {"cameras", nlohmann::ordered_json::array()},
      {"animations", nlohmann::ordered_json::array()},
      {"variants", info.variants},
      {"sheet_glass", nlohmann::ordered_json::array()},
      {"extensions", nlohmann::ordered_json::array()},
      {"light_advice", found.advice},
      {"comfort", found.strain},
      {"losses", info.losses},
      {"warnings", info.warnings},
  };
  if (info.nearest_surface >= 0.0f) json["nearest_surface"] = info.nearest_surface;
  if (found.settled.kind != ods::SceneKind::kNothing) json["kind"] = scene_kind_name(found.settled.kind);
  if (found.viewing) {
    const ViewPoint& view = found.viewing->view;
    json["viewer"] = {{"position", to_json(view.position)}, {"yaw", view.yaw}, {"reason", view.name}};
  }
  for (const ViewPoint& view : info.view_points) {
    json["cameras"].push_back({{"name", view.name},
                               {"position", to_json(view.position)},
                               {"yaw", view.yaw},
                               {"pitch", view.pitch},
                               {"roll", view.roll}});
  }
  for (const auto& [name, seconds] : info.animations) {
    json["animations"].push_back({{"name", name}, {"seconds", seconds}});
  }
  for (const ods::SheetGlass& glass : info.sheet_glass) {
    json["sheet_glass"].push_back(
        {{"material", glass.name}, {"closed_meshes", glass.closed_meshes}, {"open_meshes", glass.open_meshes}});
  }
  for (const ods::UsedExtension& each : info.extensions) {
    json["extensions"].push_back(
        {{"name", each.name}, {"state", each.state}, {"how", each.how}, {"required", each.required}});
  }
  // Names in files need not be valid UTF-8.
  put_json(json);
}
