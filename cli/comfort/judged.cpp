// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/judged.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/console/console.h"
#include "ods/convert/reproject.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "ods/stage/comfortable_merge.h"

namespace {

constexpr int kMostWidth = 2048;  // of what is judged

// What each instance of a scene is called: a name for each, and each instance's index in the names. Instances that have
// none go by their material.
struct Things {
  std::vector<std::string> names;
  std::vector<int> of_instance;
};

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

}  // namespace

std::vector<Judged> look_at_scene(const ComfortJob& job, ods::StereoCamera& camera) {
  const ods::Scene scene = open_scene(job.scene);
  camera = place_camera(job.camera, scene);
  ods::RenderOptions options;
  options.width = job.width;
  options = ods::with_height(options, camera);
  const ods::CpuRenderer renderer(scene);
  if (job.camera.merge_limit) {
    ods::use_merge_map(camera, ods::merge_map_of(ods::shares_seen(renderer, camera, *job.camera.merge_limit)));
  }
  const Things things = things_of(scene);
  const std::vector<int> eyes = ods::eye_list(options.eyes);
  std::vector<std::vector<ods::Hit>> hits = renderer.center_hits(camera, options);
  std::vector<Judged> all;
  for (size_t i = 0; i < eyes.size(); i++) {
    Judged& judged = all.emplace_back();
    judged.seen = {camera, eyes[i], ods::Image(options.width, options.height, 1), {}, things.names};
    judged.grey = judged.seen.depth;
    for (size_t k = 0; k < hits[i].size(); k++) {
      const ods::Hit& hit = hits[i][k];
      judged.seen.depth.pixels[k] = hit.t < 0.0f ? ods::kFarDepth : hit.t;
      judged.grey.pixels[k] = hit.t < 0.0f ? 0.8f : 0.5f / (1.0f + hit.t);
      judged.seen.things.push_back(hit.t < 0.0f ? -1 : things.of_instance[static_cast<size_t>(hit.instance)]);
    }
  }
  return all;
}

std::vector<Judged> look_at_picture(const ComfortJob& job, ods::StereoCamera& camera) {
  const ods::StoredPicture picture = ods::open_picture(job.scene.name);
  if (!ods::depth_layer(picture)) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("'{}' has no depth (a layer Z, metres along the ray): ods render writes one into .exr",
                                 job.scene.name));
  }
  for (const std::string& guess : picture.guesses) note(guess);
  camera = picture.camera;
  const std::vector<ods::Image> greys = job.heat.empty() ? std::vector<ods::Image>() : ods::grey_eyes(picture);
  std::vector<Judged> all;
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    Judged& judged = all.emplace_back();
    judged.seen = {
        camera, picture.eyes[i].eye, ods::nearest_of_blocks(ods::depth_of_eye(picture, i), kMostWidth), {}, {}};
    if (greys.empty()) continue;
    const ods::Image& depth = judged.seen.depth;
    judged.grey = ods::Image(depth.width, depth.height, 1);
    for (int y = 0; y < depth.height; y++) {
      for (int x = 0; x < depth.width; x++) {
        judged.grey.at(x, y)[0] = greys[i].at(x * greys[i].width / depth.width, y * greys[i].height / depth.height)[0];
      }
    }
  }
  return all;
}

void save_heat(const std::string& path, const ods::StereoCamera& camera, const std::vector<Judged>& judged,
               const std::vector<ods::ComfortReport>& reports) {
  constexpr ods::vec3 kColors[] = {{0, 0, 0}, {1.0f, 0.75f, 0.05f}, {1.0f, 0.22f, 0.0f}, {0.75f, 0.0f, 0.03f}};
  ods::Picture picture;
  for (size_t i = 0; i < judged.size(); i++) {
    ods::EyeImage& eye = picture.eyes.emplace_back();
    const ods::Image &grey = judged[i].grey, &level = reports[i].level;
    eye.eye = judged[i].seen.eye;
    eye.radiance = ods::Image(grey.width, grey.height, 3);
    for (size_t k = 0; k < grey.pixels.size(); k++) {
      const float light = 0.6f * std::clamp(grey.pixels[k], 0.0f, 1.0f);
      const auto color = static_cast<size_t>(level.pixels[k]);
      for (int c = 0; c < 3; c++) {
        const float hot = 0.3f * light + 0.7f * kColors[color][c];
        eye.radiance.pixels[3 * k + static_cast<size_t>(c)] = color == 0 ? light : hot;
      }
    }
  }
  for (const std::string& file : ods::save_picture(picture, camera, {}, path)) announce_file(file);
}
