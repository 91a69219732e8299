// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/judge_scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "ods/camera/pixel.h"
#include "ods/picture/picture.h"
#include "ods/render/render_target.h"
#include "ods/scene/things.h"

namespace ods {

namespace {

// The middle of the circle is looked at in this width: a thing of a millimetre within the circle is three pixels.
constexpr int kMiddleWidth = 512;

SeenDepth seen_by(const std::vector<Hit>& hits, const StereoCamera& camera, int eye, const RenderOptions& options) {
  SeenDepth seen{camera, eye, Image(options.width, options.height, 1), {}, {}};
  for (size_t i = 0; i < hits.size(); i++) seen.depth.pixels[i] = hits[i].t < 0.0f ? kFarDepth : hits[i].t;
  return seen;
}

std::vector<SeenDepth> eyes_in_scene(const Renderer& renderer, const Things& things, const StereoCamera& camera,
                                     const RenderOptions& options) {
  const std::vector<int> eyes = eye_list(options.eyes);
  const std::vector<std::vector<Hit>> hits = renderer.center_hits(camera, options);
  std::vector<SeenDepth> all;
  for (size_t i = 0; i < eyes.size(); i++) {
    SeenDepth& seen = all.emplace_back(seen_by(hits[i], camera, eyes[i], options));
    seen.names = things.names;
    for (const Hit& hit : hits[i]) {
      seen.things.push_back(hit.t < 0.0f ? -1 : things.of_instance[static_cast<size_t>(hit.instance)]);
    }
  }
  return all;
}

// The things that rays from the circle's middle meet before they leave it.
std::vector<std::string> hidden_in_circle(const Renderer& renderer, const Things& things, const StereoCamera& camera,
                                          int width) {
  RenderOptions options;
  options.width = std::min(width, kMiddleWidth);
  options.eyes = Eyes::kMonoEye;
  options = with_height(options, camera);
  const Camera kernel = make_camera(camera);
  const std::vector<Hit> hits = std::move(renderer.center_hits(camera, options)[0]);
  std::set<std::string> names;
  for (size_t i = 0; i < hits.size(); i++) {
    if (hits[i].t < 0.0f || hits[i].t > 0.5f * camera.ipd) continue;
    const int pixel = static_cast<int>(i);
    const vec2 uv = pixel_middle(pixel % options.width, pixel / options.width, Extent{options.width, options.height});
    const ViewDirection look = look_of(kernel.projection, uv, uv);
    const float radius = 0.5f * camera.ipd * merge_at(kernel, look.direction, look.elevation);
    if (hits[i].t * std::cos(look.elevation) >= radius) continue;
    names.insert(things.names[static_cast<size_t>(things.of_instance[static_cast<size_t>(hits[i].instance)])]);
  }
  return {names.begin(), names.end()};
}

}  // namespace

JudgedPicture judge_scene(const Renderer& renderer, const Scene& scene, const StereoCamera& camera, int width,
                          const ComfortOptions& comfort) {
  RenderOptions options;
  options.width = width;
  options = with_height(options, camera);
  const Things things = things_of(scene);
  const std::vector<SeenDepth> eyes = eyes_in_scene(renderer, things, camera, options);
  JudgedPicture judged;
  judged.verdict = judge_comfort(eyes, comfort);
  judged.camera = camera;
  judged.hidden = hidden_in_circle(renderer, things, camera, width);
  for (const SeenDepth& seen : eyes) {
    Image& light = judged.light.emplace_back(options.width, options.height, 3);
    for (size_t i = 0; i < seen.depth.pixels.size(); i++) {
      const float depth = seen.depth.pixels[i];
      std::fill_n(&light.pixels[3 * i], 3, is_surface(depth) ? 0.5f / (1.0f + depth) : 0.8f);
    }
  }
  return judged;
}

std::vector<float> shares_seen(const Renderer& renderer, const StereoCamera& camera, float limit) {
  StereoCamera middle;
  middle.position = camera.position;
  middle.yaw = camera.yaw;
  middle.ipd = camera.ipd;
  RenderOptions options;
  options.width = kMiddleWidth;
  options.eyes = Eyes::kMonoEye;
  options = with_height(options, middle);
  return comfortable_shares(seen_by(renderer.center_hits(middle, options)[0], middle, kMono, options), {}, limit);
}

}  // namespace ods
