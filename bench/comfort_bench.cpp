// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Accuracy of verdicts on pictures without depth: built-in scenes, without noise of light, as JPEGs whose eyes are
// matched, compared with the exact depth of the rendering; and the pictures named as arguments, .exr with depth. Prints
// the table of docs/comfort.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "ods/base/angles.h"
#include "ods/comfort/areas.h"
#include "ods/comfort/matched.h"
#include "ods/convert/reproject.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace ods;

constexpr int kWidth = 2048;

// The angle in degrees by which eyes converge, for each pixel, in arc minutes; NaN if unknown.
std::vector<double> vergences(const SeenDepth& seen) {
  std::vector<double> all;
  for (int y = 0; y < seen.depth.height; y++) {
    const double phi = 3.14159265358979 * (0.5 - (y + 0.5) / seen.depth.height);
    for (int x = 0; x < seen.depth.width; x++) {
      const double depth = double{*seen.depth.at(x, y)}, radius = 0.5 * double{seen.camera.ipd};
      all.push_back(depth > 0.0 ? vergence(std::atan(radius / (depth * std::cos(phi))), phi) / kArcMinute : NAN);
    }
  }
  return all;
}

void compare(const std::string& name, const Picture& picture, const StereoCamera& camera) {
  const TemporaryFolder folder;
  const std::string path = folder.path("x_360_TB.jpg");
  SaveOptions save;
  save.jpeg_quality = 90;
  save_picture(picture, camera, save, path);
  const std::clock_t start = std::clock();
  const StoredPicture stored = open_picture(path);
  const MatchedEyes matched = match_eyes_for_depth(grey_eyes(stored), camera, false);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  SeenDepth truth{camera, kLeft, nearest_of_blocks(picture.eyes[0].depth, kMatchedWidth), {}, {}};
  const std::vector<double> exact = vergences(truth), found = vergences(matched.seen[0]);
  std::vector<double> off;
  for (size_t i = 0; i < exact.size(); i++) {
    if (!std::isnan(found[i]) && !std::isnan(exact[i])) off.push_back(std::abs(found[i] - exact[i]));
  }
  std::ranges::sort(off);
  const auto at = [&](double share) { return off[static_cast<size_t>(share * static_cast<double>(off.size() - 1))]; };
  const auto wrong =
      static_cast<double>(off.end() - std::ranges::lower_bound(off, 60.0)) / static_cast<double>(off.size());
  const ComfortVerdict a = judge_comfort(truth), b = judge_comfort(matched.seen[0]);
  fmt::print(
      "| {} | {:.0f} % | {:.1f} | {:.1f} | {:.1f} | {:.0f} | {:.1f} % | {:.2f}, {:.2f} | {}, {} | {:.1f}, {:.1f} % | "
      "{:.2f} |\n",
      name, 100.0 * matched.share, matched.precision, at(0.5), at(0.9), at(0.99), 100.0 * wrong, a.nearest, b.nearest,
      comfort_level_name(a.level), comfort_level_name(b.level), 100.0 * a.share[ComfortLevel::kError],
      100.0 * b.share[ComfortLevel::kError], seconds);
  std::fflush(stdout);
}

void compare_scene(const std::string& name) {
  Scene scene = find_builtin(name)->make();
  for (Material& material : scene.materials) material.unlit = 1;
  StereoCamera camera;
  camera.position = default_view(scene).position;
  RenderOptions options;
  options.width = kWidth, options.height = kWidth / 2;
  options.samples = 4, options.bounces = 2, options.even_noise = false;
  compare(name, render_cpu(scene, camera, options), camera);
}

void compare_file(const std::string& path) {
  const StoredPicture stored = open_picture(path);
  Picture picture;
  for (size_t i = 0; i < stored.eyes.size(); i++) {
    EyeImage& eye = picture.eyes.emplace_back();
    eye.eye = stored.eyes[i].eye;
    eye.radiance = Image(stored.size.width, stored.size.height, 3);
    read_colors(stored, i,
                [&](int y, const std::vector<float>& row) { std::ranges::copy(row, eye.radiance.at(0, y)); });
    eye.depth = depth_of_eye(stored, i);
  }
  compare(path.substr(path.rfind('/') + 1), picture, stored.camera);
}

}  // namespace

int main(int argc, char** argv) {
  std::puts(
      "| picture | matched | stated +-' | off by, median ' | 90 % | 99 % | by more than a degree | nearest m, exact "
      "and "
      "matched | verdicts | error | CPU s |\n|---|---|---|---|---|---|---|---|---|---|---|");
  for (const char* name : {"room", "toys", "fractal", "mirrors"}) compare_scene(name);
  for (int i = 1; i < argc; i++) compare_file(argv[i]);
}
