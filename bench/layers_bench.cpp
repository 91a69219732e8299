// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Likeness of layered scenes to their scenes for eyes in the head box: layers_bench [WIDTH [SCENE...]]. A scene is a
// built-in one or a glTF file.
//
// Colours are unlit, so that neither noise nor gloss matters: 12 poses in a box of 0.3 m, views of 90 degrees with
// 512 x 512 pixels of 4 x 4 samples, because fewer would measure the aliasing of the scene's own textures. dB: PSNR of
// displayed values. off: pixels that differ by more than a tenth of white. holes: samples for which the scene has a
// surface and the layers have none. stereo, depth: layers of a picture with depth of two eyes, or of one. mono: the
// panorama from the middle of the box, which ignores the head. Mirrors and panes are painted surfaces here, as unlit
// colours know no reflection.
//
// layers_bench lit [WIDTH [SCENE...]] compares with light: 6 poses of 256 x 256 pixels, path traced and denoised,
// against layers that are baked as ods layers does. "+pane" after a scene's name adds a sheet of thin glass.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "bench/layers_depth.h"
#include "bench/layers_lit.h"
#include "bench/layers_views.h"
#include "bench/measure.h"
#include "ods/layers/as_scene.h"
#include "ods/layers/build_layers.h"

namespace {

using namespace ods;

constexpr int kView = 512, kPoses = 12;

// One texture: light found along the rays, pushed to where filters read it.
Image texture_of(const Colours& truth, const LayerGeometry& geometry, size_t mesh, std::vector<vec3>& light) {
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
  Image texture(geometry.texture_size, geometry.texture_size, 4);
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
    float* const texel = texture.at(x, y);
    for (int c = 0; c < 3; c++) texel[c] = srgb_encode(colour[c]);
    texel[3] = geometry.coverage.empty() ? 1.0f : geometry.coverage[first + i];
  }
  return texture;
}

// The layers with the colours that the scene has.
Scene to_scene(const Colours& truth, const LayerGeometry& geometry) {
  LayeredScene layers = geometry.scene;
  std::vector<vec3> light(geometry.rays.rays.size(), vec3(-1.0f));
  for (size_t i = 0; i < layers.meshes.size(); i++) layers.meshes[i].texture = texture_of(truth, geometry, i, light);
  return as_scene(layers);
}

// Saves a view if LAYERS_BENCH_PICTURES names a folder.
void save_view(const std::string& name, const std::vector<vec3>& pixels) {
  if (const char* folder = std::getenv("LAYERS_BENCH_PICTURES")) {
    save_ppm(fmt::format("{}/{}.ppm", folder, name), kView, pixels);
  }
}

// The views of the poses, as a function shows them, against those of the scene. shows: sets whether a ray meets
// anything.
template <typename Shows>
Likeness likeness_of(const Colours& truth, const std::vector<Pose>& poses, const std::vector<std::vector<vec3>>& wanted,
                     const std::string& title, const Shows& shows) {
  Likeness likeness;
  for (size_t pose = 0; pose < poses.size(); pose++) {
    std::atomic<size_t> holes = 0;
    const std::vector<vec3> got = view_from(poses[pose], kView, [&](const Ray& ray) {
      bool ours = false, theirs = false;
      const vec3 colour = shows(ray, ours);
      if (ours) return colour;
      truth.at(ray, false, theirs);
      if (theirs) holes++;
      return colour;
    });
    likeness.holes += holes;
    likeness.samples += got.size() * kGrid * kGrid;
    compare(wanted[pose], got, likeness);
    save_view(fmt::format("{}_{}", title, pose), got);
  }
  return likeness;
}

void judge(const std::string& name, int width) {
  const Scene scene = with_painted_glass(scene_named(name));
  const HeadBox box = box_in(name, scene);
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
  const std::vector<Pose> poses = poses_in(box, kPoses);
  std::vector<std::vector<vec3>> wanted;
  for (const Pose& pose : poses) {
    wanted.push_back(view_from(pose, kView, [&](const Ray& ray) {
      bool met;
      return truth.at(ray, false, met);
    }));
    save_view(fmt::format("{}_truth_{}", name, wanted.size() - 1), wanted.back());
  }
  const auto print = [&](const std::string& row, const std::string& about, const auto& shows) {
    fmt::print("  {:7} {}{}{}\n", row, likeness_of(truth, poses, wanted, name + "_" + row, shows).text(),
               about.empty() ? "" : "; ", about);
  };
  const auto print_layers = [&](const std::string& row, const std::string& about, const Scene& layers) {
    const Colours shown(layers);
    print(row, about, [&](const Ray& ray, bool& met) { return shown.at(ray, true, met); });
  };
  print_layers("layers", "", to_scene(truth, geometry));
  for (const float ipd : {0.065f, 0.0f}) {
    std::string about;
    const Scene layers = scene_of_depth(truth, box, width, ipd, about);
    print_layers(ipd > 0.0f ? "stereo" : "depth", about, layers);
  }
  print("mono", "", [&](const Ray& ray, bool& met) { return truth.at({box.center, ray.direction}, false, met); });
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const bool is_lit = !words.empty() && words[0] == "lit";
  if (is_lit) words.erase(words.begin());
  const int width = words.empty() ? (is_lit ? 2048 : 8192) : std::atoi(words[0].c_str());
  std::vector<std::string> names(words.begin() + std::min<std::ptrdiff_t>(1, std::ssize(words)), words.end());
  if (names.empty())
    names = is_lit ? std::vector<std::string>{"room", "room+pane"}
                   : std::vector<std::string>{"room", "atrium", "wineglass", "toys"};
  for (const std::string& name : names) (is_lit ? judge_lit : judge)(name, width);
}
