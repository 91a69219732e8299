// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Likeness of layered scenes to their scenes for eyes in the head box: layers_bench [WIDTH [SCENE...]]. A scene is a
// built-in one or a glTF file.
//
// Colours are unlit, so that neither noise nor gloss matters: 12 poses in a box of 0.3 m, views of 90 degrees with
// 512 x 512 pixels of 4 x 4 samples, because fewer would measure the aliasing of the scene's own textures. dB: PSNR of
// displayed values. off: pixels that differ by more than a tenth of white. holes: samples for which the scene has a
// surface and the layers have none. mono: the panorama from the middle of the box, which ignores the head.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

#include "bench/measure.h"
#include "bench/subjects.h"
#include "ods/layers/build_layers.h"
#include "ods/layers/probe.h"
#include "ods/scene/builtin/builder.h"

namespace {

using namespace ods;

constexpr int kView = 512, kGrid = 4, kPoses = 12;
constexpr vec3 kSky(0.5f, 0.6f, 0.7f);

// The unlit colours that rays meet.
class Colours {
 public:
  explicit Colours(const Scene& scene) : embree_(scene), lights_(without_lights(scene)) {
    set_scene(tracer_, scene, lights_);
    tracer_.ray_time = 0.5f;
  }

  // one_sided: surfaces are invisible from behind. Sets whether the ray meets anything.
  vec3 at(Ray ray, bool one_sided, bool& met) const {
    PathTracer tracer = tracer_;
    for (int passed = 0; passed < 64; passed++) {
      tracer.start_path(ray, no_media(), 0u, 0u);
      const Hit hit = embree_.closest_hit(tracer, ray, kHalfAlphaRay);
      met = hit.t >= 0.0f;
      if (!met) return kSky;
      const Surface surface = tracer.surface_at(hit, ray.direction, false);
      if (surface.front || !one_sided) return surface.base_color;
      ray.origin = offset_point(surface.position, -surface.geometric);
    }
    return kSky;
  }

 private:
  EmbreeScene embree_;
  LightTable lights_;
  PathTracer tracer_;
};

uint packed(vec3 color, float alpha) {
  const auto byte = [](float value) { return static_cast<uint>(std::lrint(std::clamp(value, 0.0f, 1.0f) * 255.0f)); };
  return byte(srgb_encode(color.x)) | byte(srgb_encode(color.y)) << 8 | byte(srgb_encode(color.z)) << 16 |
         byte(alpha) << 24;
}

// The texels of one texture: light found along the rays, pushed to where filters read it.
std::vector<uint> texels_of(const Colours& truth, const LayerGeometry& geometry, size_t mesh,
                            std::vector<vec3>& light) {
  const size_t size = static_cast<size_t>(geometry.texture_size);
  const size_t first = mesh * size * size;
  tbb::parallel_for(first, first + size * size, [&](size_t i) {
    const TexelRay& ray = geometry.rays.rays[i];
    bool met = false;
    if (ray.direction == vec3(0.0f)) return;
    vec3 sum(0.0f);
    for (int k = 0; k < 4; k++) {
      const vec3 origin = ray.origin + (static_cast<float>(k % 2) * 0.5f - 0.25f) * ray.across +
                          (static_cast<float>(k / 2) * 0.5f - 0.25f) * ray.down;
      sum += truth.at({origin, ray.direction}, false, met);
    }
    light[i] = sum / 4.0f;
  });
  for (const PushedTexel& push : geometry.pushed) {
    if (push.to >= first && push.to < first + size * size) light[push.to] = light[push.from];
  }
  // Empty texels that filters read: the mean of lit neighbours.
  std::vector<char> lit(size * size);
  for (size_t i = 0; i < size * size; i++) lit[i] = light[first + i].x >= 0.0f;
  std::vector<uint> texels(size * size);
  for (size_t i = 0; i < size * size; i++) {
    const int x = static_cast<int>(i % size), y = static_cast<int>(i / size);
    vec3 colour = light[first + i];
    if (!lit[i]) {
      vec3 sum(0.0f);
      int count = 0;
      for (int dy = -1; dy <= 1; dy++) {
        for (int dx = -1; dx <= 1; dx++) {
          const int nx = x + dx, ny = y + dy;
          if (nx < 0 || ny < 0 || nx >= static_cast<int>(size) || ny >= static_cast<int>(size)) continue;
          const size_t n = static_cast<size_t>(ny) * size + static_cast<size_t>(nx);
          if (lit[n]) sum += light[first + n], count++;
        }
      }
      colour = count > 0 ? sum / static_cast<float>(count) : vec3(0.0f);
    }
    texels[i] = packed(colour, geometry.coverage.empty() ? 1.0f : geometry.coverage[first + i]);
  }
  return texels;
}

Scene to_scene(const Colours& truth, const LayerGeometry& geometry) {
  Scene scene;
  std::vector<vec3> light(geometry.rays.rays.size(), vec3(-1.0f));
  for (size_t i = 0; i < geometry.scene.meshes.size(); i++) {
    const LayerMesh& mesh = geometry.scene.meshes[i];
    const std::vector<uint> texels = texels_of(truth, geometry, i, light);
    Texture texture{};
    texture.first_texel = static_cast<uint>(scene.texels.size());
    texture.width = texture.height = geometry.texture_size;
    texture.wrap_u = texture.wrap_v = kWrapClamp;
    texture.srgb = 1;
    scene.textures.push_back(texture);
    scene.texels.insert(scene.texels.end(), texels.begin(), texels.end());
    Material material = default_material();
    material.base_color_slot = no_texture();
    material.base_color_slot.texture = static_cast<int>(i);
    if (mesh.kind == LayerKind::kMasked) material.alpha_mode = kAlphaMask, material.alpha_cutoff = 0.5f;
    scene.materials.push_back(material);
    std::vector<Vertex> vertices;
    for (size_t v = 0; v < mesh.positions.size(); v++) {
      vertices.push_back({mesh.positions[v], vec3(0, 1, 0), vec4(0.0f), mesh.uvs[v], vec2(0.0f), vec4(1.0f)});
    }
    add_instance(scene, add_mesh(scene, vertices, mesh.triangles, static_cast<int>(i)), glm::mat4(1.0f));
  }
  return scene;
}

struct Likeness {
  double squares = 0.0;
  size_t off = 0, holes = 0, pixels = 0, samples = 0;
  double decibels() const { return -10.0 * std::log10(squares / (3.0 * static_cast<double>(pixels))); }
  std::string text() const {
    return fmt::format("{:5.2f} dB, off {:.2f} %, holes {:.3f} %", decibels(),
                       100.0 * static_cast<double>(off) / static_cast<double>(pixels),
                       100.0 * static_cast<double>(holes) / static_cast<double>(samples));
  }
};

void save_ppm(const std::string& name, const std::vector<vec3>& pixels) {
  std::ofstream file(name, std::ios::binary);
  file << "P6 " << kView << " " << kView << " 255\n";
  for (const vec3& p : pixels) {
    for (int c = 0; c < 3; c++) file.put(static_cast<char>(std::lrint(255.0f * shown(p[c]))));
  }
}

// One pose: its pixels by a function from a ray to a colour.
template <typename Look>
std::vector<vec3> view_from(vec3 eye, const glm::mat3& turn, const Look& look) {
  std::vector<vec3> pixels(kView * kView);
  tbb::parallel_for(0, kView, [&](int y) {
    for (int x = 0; x < kView; x++) {
      vec3 sum(0.0f);
      for (int k = 0; k < kGrid * kGrid; k++) {
        const float u = (static_cast<float>(x) + (static_cast<float>(k % kGrid) + 0.5f) / kGrid) / kView * 2 - 1;
        const float v = (static_cast<float>(y) + (static_cast<float>(k / kGrid) + 0.5f) / kGrid) / kView * 2 - 1;
        sum += look(Ray{eye, turn * normalize(vec3(u, -v, -1.0f))});
      }
      pixels[static_cast<size_t>(y * kView + x)] = sum / static_cast<float>(kGrid * kGrid);
    }
  });
  return pixels;
}

void compare(const std::vector<vec3>& truth, const std::vector<vec3>& pixels, Likeness& likeness) {
  for (size_t i = 0; i < truth.size(); i++) {
    float most = 0.0f;
    for (int c = 0; c < 3; c++) {
      const float error = shown(truth[i][c]) - shown(pixels[i][c]);
      likeness.squares += double{error} * double{error};
      most = std::max(most, std::abs(error));
    }
    likeness.pixels++;
    if (most > 0.1f) likeness.off++;
  }
}

void judge(const std::string& name, int width) {
  const Scene scene = name == "atrium" ? load(kAtrium) : name == "helmet" ? load(kHelmet) : load_scene(name, {});
  HeadBox box;
  box.center = name == "atrium" ? kAtrium.position : name == "helmet" ? kHelmet.position : default_view(scene).position;
  LayerCounts counts;
  const double start = cpu_seconds();
  const auto begin = std::chrono::steady_clock::now();
  const LayerGeometry geometry = build_layers(scene, box, width, &counts);
  fmt::print(
      "{}: {:.1f} CPU s, {:.1f} s; {} triangles seen, {} simplified, {} in {} textures of {}; {} charts; texels {:.2f} M "
      "of pages, {:.2f} M of charts\n",
      name, cpu_seconds() - start, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
      counts.seen_triangles, counts.simplified_triangles, counts.triangles, geometry.scene.meshes.size(),
      geometry.texture_size, counts.charts, static_cast<double>(counts.page_texels) * 1e-6,
      static_cast<double>(counts.chart_texels) * 1e-6);
  const Colours truth(scene);
  const Scene layers = to_scene(truth, geometry);
  const Colours shown_layers(layers);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(-0.5f, 0.5f);
  Likeness all, mono;
  for (int pose = 0; pose < kPoses; pose++) {
    const vec3 eye = box.center + vec3(any(random), any(random), any(random)) * box.size;
    const glm::mat3 turn =
        glm::mat3(glm::rotate(glm::rotate(glm::mat4(1.0f), 2.399963f * static_cast<float>(pose), vec3(0, 1, 0)),
                              0.8f * any(random), vec3(1, 0, 0)));
    std::atomic<size_t> holes = 0;
    const std::vector<vec3> wanted = view_from(eye, turn, [&](const Ray& ray) {
      bool m;
      return truth.at(ray, false, m);
    });
    const std::vector<vec3> got = view_from(eye, turn, [&](const Ray& ray) {
      bool ours = false, theirs = false;
      const vec3 colour = shown_layers.at(ray, true, ours);
      if (!ours) {
        truth.at(ray, false, theirs);
        if (theirs) holes++;
      }
      return colour;
    });
    const std::vector<vec3> flat = view_from(eye, turn, [&](const Ray& ray) {
      bool m;
      return truth.at({box.center, ray.direction}, false, m);
    });
    all.holes += holes;
    all.samples += wanted.size() * kGrid * kGrid;
    mono.samples = all.samples;
    compare(wanted, got, all);
    compare(wanted, flat, mono);
    if (const char* folder = std::getenv("LAYERS_BENCH_PICTURES")) {
      save_ppm(fmt::format("{}/{}_{}_truth.ppm", folder, name, pose), wanted);
      save_ppm(fmt::format("{}/{}_{}_layers.ppm", folder, name, pose), got);
    }
  }
  fmt::print("  layers {}\n  mono   {}\n", all.text(), mono.text());
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc > 1 ? std::atoi(argv[1]) : 8192;
  std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
  if (names.empty()) names = {"room", "atrium", "wineglass", "toys"};
  for (const std::string& name : names) judge(name, width);
}
