// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Likeness of layered scenes with their light to path traced views: as baked, and with mirrors and panes painted.
#pragma once
#include <array>
#include <cstdlib>
#include <memory>

#include "bench/layers_views.h"
#include "ods/layers/light/light_layers.h"
#include "ods/render/cpu/render.h"
#include "ods/stage/exposure.h"

namespace ods {

inline constexpr int kLitView = 256, kLitPoses = 6, kLitSamples = 16, kTruthSamples = 4;
inline constexpr float kFarSky = 1000.0f;

enum { kWhole, kAwayFromEdges, kInMirrors, kBehindGlass, kParts };
inline constexpr const char* kPartNames[kParts] = {"whole", "away from edges", "in mirrors", "behind glass"};

inline LayerLight light_for(const Scene& scene, const HeadBox& box, int width) {
  StereoCamera camera;
  camera.position = box.center;
  RenderOptions look = options_of(128, 16);
  look.eyes = Eyes::kMonoEye;
  look.layers = true;
  const Picture small = render_cpu(scene, camera, look);
  LayerLight light;
  light.exposure = suitable_exposure({&small, 1}).value_or(0.0f);
  light.bake.render = options_of(width, kLitSamples);
  light.bake.render.indirect = Indirect::kCache;
  return light;
}

// The meshes of one kind, with their colours or their alpha.
inline Scene lit_scene(const LayeredScene& layers, bool is_blended, bool shows_alpha) {
  Scene scene;
  for (const LayerMesh& mesh : layers.meshes) {
    if ((mesh.kind == LayerKind::kBlended) != is_blended) continue;
    const int number = static_cast<int>(scene.textures.size());
    Texture texture{};
    texture.first_texel = static_cast<uint>(scene.texels.size());
    texture.width = mesh.texture.width, texture.height = mesh.texture.height;
    texture.wrap_u = texture.wrap_v = kWrapClamp;
    texture.srgb = shows_alpha ? 0 : 1;
    scene.textures.push_back(texture);
    const size_t channels = static_cast<size_t>(mesh.texture.channels);
    for (size_t i = 0; i < mesh.texture.pixels.size(); i += channels) {
      const float* const p = &mesh.texture.pixels[i];
      const auto byte = [](float value) {
        return static_cast<uint>(std::lrint(255.0f * std::clamp(value, 0.0f, 1.0f)));
      };
      const uint alpha = byte(channels == 4 ? p[3] : 1.0f);
      scene.texels.push_back(shows_alpha ? alpha * 0x01010101u
                                         : byte(p[0]) | byte(p[1]) << 8 | byte(p[2]) << 16 | alpha << 24);
    }
    Material material = default_material();
    material.base_color_slot = no_texture();
    material.base_color_slot.texture = number;
    if (mesh.kind == LayerKind::kMasked) material.alpha_mode = kAlphaMask, material.alpha_cutoff = 0.5f;
    scene.materials.push_back(material);
    std::vector<Vertex> vertices;
    for (size_t v = 0; v < mesh.positions.size(); v++) {
      const vec3 at =
          mesh.kind == LayerKind::kSky ? layers.box.center + kFarSky * mesh.positions[v] : mesh.positions[v];
      vertices.push_back({at, vec3(0, 1, 0), vec4(0.0f), mesh.uvs[v], vec2(0.0f), vec4(1.0f)});
    }
    add_instance(scene, add_mesh(scene, vertices, mesh.triangles, number), glm::mat4(1.0f));
  }
  return scene;
}

// A layered scene as a viewer shows it.
class LitViewer {
 public:
  explicit LitViewer(const LayeredScene& layers)
      : solid_(lit_scene(layers, false, false)),
        panes_(lit_scene(layers, true, false)),
        alphas_(lit_scene(layers, true, true)),
        solid_colours_(solid_),
        pane_colours_(panes_),
        pane_alphas_(alphas_) {}

  vec3 at(const Ray& ray) const {
    bool met = false;
    float end = 0.0f;
    vec3 behind = solid_colours_.at(ray, true, met, &end);
    if (!met) behind = vec3(0.0f), end = kFarAway;
    return panes_.instances.empty() ? behind : through(ray, ray.origin, end, behind);
  }

 private:
  vec3 through(Ray ray, vec3 eye, float end, vec3 behind) const {
    bool met = false;
    float distance = 0.0f;
    const vec3 colour = pane_colours_.at(ray, true, met, &distance);
    if (!met || length(ray.origin + distance * ray.direction - eye) >= end) return behind;
    const float alpha = pane_alphas_.at(ray, true, met).x;
    ray.origin += (distance + 1e-4f) * ray.direction;
    return alpha * colour + (1.0f - alpha) * through(ray, eye, end, behind);
  }

  Scene solid_, panes_, alphas_;
  Colours solid_colours_, pane_colours_, pane_alphas_;
};

// The path traced, denoised view of a pose, linear as displayed.
inline std::vector<vec3> lit_truth(const CpuRenderer& renderer, const LayerLight& light, const Pose& pose) {
  constexpr int kSize = kLitView * kGrid;
  TexelRays table;
  table.width = table.height = kSize;
  table.owners.assign(size_t{kSize} * kSize, 0);
  for (int i = 0; i < kSize * kSize; i++) {
    const int x = i % kSize, y = i / kSize;
    const Ray ray = sample_ray(pose, kLitView, x / kGrid, y / kGrid, y % kGrid * kGrid + x % kGrid);
    TexelRay texel{};
    texel.origin = ray.origin;
    texel.direction = ray.direction;
    table.rays.push_back(texel);
  }
  BakeOptions options = light.bake;
  options.viewer = pose.eye;
  options.render = options_of(kSize, kTruthSamples);
  options.render.indirect = Indirect::kCache;
  const Image image = bake(renderer, std::make_shared<const TexelRays>(std::move(table)), options);
  std::vector<vec3> pixels(size_t{kLitView} * kLitView);
  for (int y = 0; y < kSize; y++) {
    for (int x = 0; x < kSize; x++) {
      const float* const p = image.at(x, y);
      pixels[static_cast<size_t>(y / kGrid * kLitView + x / kGrid)] += vec3(p[0], p[1], p[2]) / float{kGrid * kGrid};
    }
  }
  for (vec3& pixel : pixels) pixel = tone_map(pixel, light.exposure, light.tone);
  return pixels;
}

struct Seen {
  int instance = -1;
  float distance = 0.0f;
  vec3 normal{0.0f};
};

// The parts of a view that each pixel belongs to, as bits.
inline std::vector<int> parts_of(const EmbreeScene& embree, PathTracer tracer, const Pose& pose) {
  std::vector<int> parts(size_t{kLitView} * kLitView, 1 << kWhole);
  std::vector<Seen> seen(parts.size());
  for (size_t i = 0; i < parts.size(); i++) {
    const Ray ray = sample_ray(pose, kLitView, static_cast<int>(i % kLitView), static_cast<int>(i / kLitView), 0);
    tracer.start_path(ray, no_media(), 0u, 0u);
    const Hit hit = embree.closest_hit(tracer, ray, kHalfAlphaRay);
    if (hit.t < 0.0f) continue;
    const Surface surface = tracer.surface_at(hit, ray.direction, false);
    seen[i] = {hit.instance, hit.t, surface.geometric};
    const bool is_flat = dot(surface.geometric, surface.normal) > 0.99999f;
    if (surface.metallic > 0.5f && surface.roughness < 0.15f && is_flat) parts[i] |= 1 << kInMirrors;
    if (surface.transmission > 0.5f && !surface.volume && surface.roughness < 0.05f) parts[i] |= 1 << kBehindGlass;
  }
  for (int y = 1; y + 1 < kLitView; y++) {
    for (int x = 1; x + 1 < kLitView; x++) {
      const Seen& here = seen[static_cast<size_t>(y * kLitView + x)];
      bool is_edge = false;
      for (int k = 0; k < 9; k++) {
        const Seen& beside = seen[static_cast<size_t>((y + k / 3 - 1) * kLitView + x + k % 3 - 1)];
        is_edge = is_edge || beside.instance != here.instance || dot(beside.normal, here.normal) < 0.9f ||
                  std::abs(beside.distance - here.distance) > 0.1f * here.distance;
      }
      if (!is_edge) parts[static_cast<size_t>(y * kLitView + x)] |= 1 << kAwayFromEdges;
    }
  }
  return parts;
}

// The scene with the same light, but with layers that keep mirrors and panes as they are: painted.
inline Scene with_painted_glass(const Scene& scene) {
  Scene painted = scene;
  for (Material& material : painted.materials) {
    const bool is_special = material.metallic > 0.5f || material.transmission > 0.0f;
    if (!is_special || material.layers >= 0) continue;
    material.layers = static_cast<int>(painted.material_layers.size());
    painted.material_layers.push_back(default_layers());
  }
  return painted;
}

using LikenessOfParts = std::array<Likeness, kParts>;

inline void print_parts(const std::string& title, const LikenessOfParts& all) {
  fmt::print("{}\n", title);
  for (size_t part = 0; part < kParts; part++) {
    if (all[part].pixels == 0) continue;
    fmt::print("  {:15} {:5.2f} dB, {:.2f} % of the pixels\n", kPartNames[part], all[part].decibels(),
               100.0 * static_cast<double>(all[part].pixels) / static_cast<double>(all[kWhole].pixels));
  }
  std::fflush(stdout);
}

// Layers of a scene, as a viewer shows them, or with its mirrors and panes painted.
inline LitViewer lit_viewer(const Scene& scene, const HeadBox& box, int width, const LayerLight& light, bool is_painted,
                            std::string& about) {
  const Scene own = is_painted ? with_painted_glass(scene) : scene;
  LayerCounts counts;
  const CpuRenderer renderer(own);
  const LayeredScene layers = light_layers(build_layers(own, box, width, &counts), own, renderer, light);
  about = fmt::format("{} mirrors, {} panes, {} triangles, {} textures", counts.mirrors, counts.panes, counts.triangles,
                      layers.meshes.size());
  return LitViewer(layers);
}

inline void judge_lit(const std::string& name, int width) {
  const Scene scene = scene_named(name);
  const HeadBox box = box_in(name, scene);
  const LayerLight light = light_for(scene, box, width);
  std::string about[2];
  const LitViewer viewers[2] = {lit_viewer(scene, box, width, light, true, about[0]),
                                lit_viewer(scene, box, width, light, false, about[1])};
  const CpuRenderer renderer(scene);
  const LightTable lights = without_lights(scene);
  const EmbreeScene embree(scene);
  PathTracer tracer;
  set_scene(tracer, scene, lights);
  tracer.ray_time = 0.5f;
  LikenessOfParts all[2];
  const std::vector<Pose> poses = poses_in(box, kLitPoses);
  for (size_t pose = 0; pose < poses.size(); pose++) {
    const std::vector<vec3> truth = lit_truth(renderer, light, poses[pose]);
    const std::vector<int> parts = parts_of(embree, tracer, poses[pose]);
    const char* const folder = std::getenv("LAYERS_BENCH_PICTURES");
    if (folder) save_ppm(fmt::format("{}/{}_{}_lit_truth.ppm", folder, name, pose), kLitView, truth);
    for (size_t i = 0; i < 2; i++) {
      const std::vector<vec3> got =
          view_from(poses[pose], kLitView, [&](const Ray& ray) { return viewers[i].at(ray); });
      for (size_t pixel = 0; pixel < truth.size(); pixel++) {
        for (size_t part = 0; part < kParts; part++) {
          if (parts[pixel] >> part & 1) compare({truth[pixel]}, {got[pixel]}, all[i][part]);
        }
      }
      if (folder)
        save_ppm(fmt::format("{}/{}_{}_lit_{}.ppm", folder, name, pose, i ? "layers" : "painted"), kLitView, got);
    }
  }
  print_parts(fmt::format("{}, lit, mirrors and panes painted: {}", name, about[0]), all[0]);
  print_parts(fmt::format("{}, lit: {}", name, about[1]), all[1]);
}

}  // namespace ods
