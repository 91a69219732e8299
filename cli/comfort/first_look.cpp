// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/first_look.h"

#include <fmt/format.h>

#include <utility>

#include "ods/picture/picture.h"
#include "ods/render/render_target.h"

constexpr int kFirstLookWidth = 512;

Things things_of(const ods::Scene& scene) {
  Things things{{}, std::vector<int>(scene.instances.size(), -1)};
  for (const ods::NamedObject& object : scene.objects) {
    for (size_t i = 0; i < object.count; i++) {
      things.of_instance[object.first_instance + i] = static_cast<int>(things.names.size());
    }
    things.names.push_back(object.name);
  }
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (things.of_instance[i] >= 0) continue;
    const auto material = static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material);
    things.of_instance[i] = static_cast<int>(things.names.size());
    things.names.push_back(material < scene.material_names.size() ? scene.material_names[material] : "");
  }
  return things;
}

std::vector<ods::SeenDepth> look_from(const ods::CpuRenderer& renderer, const Things& things,
                                      const ods::StereoCamera& camera, const ods::RenderOptions& options) {
  const std::vector<int> eyes = ods::eye_list(options.eyes);
  const std::vector<std::vector<ods::Hit>> hits = renderer.center_hits(camera, options);
  std::vector<ods::SeenDepth> all;
  for (size_t i = 0; i < eyes.size(); i++) {
    ods::SeenDepth& seen = all.emplace_back(
        ods::SeenDepth{camera, eyes[i], ods::Image(options.width, options.height, 1), {}, things.names});
    for (size_t k = 0; k < hits[i].size(); k++) {
      const ods::Hit& hit = hits[i][k];
      seen.depth.pixels[k] = hit.t < 0.0f ? ods::kFarDepth : hit.t;
      seen.things.push_back(hit.t < 0.0f ? -1 : things.of_instance[static_cast<size_t>(hit.instance)]);
    }
  }
  return all;
}

std::string strain_line(const ods::CpuRenderer& renderer, const ods::Scene& scene, const ods::StereoCamera& camera,
                        ods::ComfortLevel level) {
  ods::RenderOptions options;
  options.width = kFirstLookWidth, options.height = 0;
  options.eyes = ods::Eyes::kLeftEye;
  const ods::SeenDepth seen = look_from(renderer, things_of(scene), camera, ods::with_height(options, camera))[0];
  const ods::ComfortReport report = ods::judge_comfort(seen);
  if (report.places.empty() || report.places[0].level < level) return "";
  const ods::StrainedPlace& worst = report.places[0];
  return fmt::format("{}, {:.2f} m away, {}, strains the viewer's eyes: {}, {:.3g} {}; {:.2f} m would do",
                     worst.name.empty() ? "a thing" : "'" + worst.name + "'", worst.distance,
                     ods::direction_text(worst.azimuth, worst.elevation), ods::strain_row(worst.strain).title,
                     worst.value, ods::strain_row(worst.strain).unit, worst.enough);
}
