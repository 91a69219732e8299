// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A room made in Blender, rendered through the bridge and by Cycles' own stereo camera, if Blender and the shared tools
// are installed: mean radiance by region, the distance of edges, and the time of the conversion. Without the room's
// glass, whose caustics are noise in both renderers for hours, and without its hair. docs/blender.md has the figures.
//   blender_bench, in a build that has the command
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "ods/image/image_file.h"
#include "ods/kernel/surface.h"
#include "tests/support/places.h"

namespace {

using namespace ods;
namespace fs = std::filesystem;

const std::string kInterior = shared_scenes() + "/../tools/interior.py";
constexpr int kWidth = 384, kSamples = 192;         // the picture's
constexpr int kFilmWidth = 192, kFilmSamples = 16;  // a frame's
constexpr int kFilmFrames = 24;                     // out of 60
constexpr int kSeeds[] = {0, 7};
constexpr std::array<const char*, 2> kEyes = {"left", "right"};

// Pixels of the left eye at the width kWidth.
struct Region {
  const char* name;
  int x0, x1, y0, y1;
};
constexpr Region kRegions[] = {
    {"wall_west", 70, 108, 72, 84},  {"wall_north", 110, 140, 74, 84},
    {"wall_south", 10, 26, 78, 120}, {"ceiling", 60, 150, 20, 60},
    {"floor", 300, 370, 130, 160},   {"floor_west", 10, 90, 130, 165},
    {"window", 262, 296, 86, 108},   {"door", 348, 364, 90, 120},
    {"lamp", 233, 239, 95, 100},     {"whole_picture", 0, kWidth, 0, kWidth / 2},
};

// Saves judged.blend, and lets Cycles render its first frames as FOLDER/cycles.FRAME.exr.
constexpr const char* kScript = R"(import bpy
scene = bpy.context.scene
for name in ('window pane', 'table top', 'glass ball'):
    if name in bpy.data.objects: bpy.data.objects.remove(bpy.data.objects[name])
rug = bpy.data.objects['rug']
for modifier in [m for m in rug.modifiers if m.type == 'PARTICLE_SYSTEM']: rug.modifiers.remove(modifier)
bpy.ops.wm.save_as_mainfile(filepath='{folder}/judged.blend', copy=True)
cycles, render = scene.cycles, scene.render
cycles.device = 'CPU'
cycles.samples, cycles.seed = {samples}, {seed}
cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_fast_gi = False
cycles.pixel_filter_type = 'BOX'
for kind in ('', 'diffuse_', 'glossy_', 'transmission_', 'transparent_max_'):
    setattr(cycles, (kind or 'max_') + 'bounces', 8)
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
cycles.caustics_reflective = cycles.caustics_refractive = True
render.resolution_x, render.resolution_y, render.resolution_percentage = {width}, {width} // 2, 100
image = render.image_settings
image.file_format, image.color_mode, image.color_depth, image.views_format = 'OPEN_EXR', 'RGB', '32', 'STEREO_3D'
image.stereo_3d_format.display_mode, image.stereo_3d_format.use_squeezed_frame = 'TOPBOTTOM', False
render.use_file_extension = render.use_compositing = False
for frame in range({frames}):
    scene.frame_set(1 + frame)
    render.filepath = '{folder}/cycles.%04d.exr' % frame
    bpy.ops.render.render(write_still=True)
)";

bool runs(const std::string& line) {
  return std::system((line + " > /dev/null 2>&1").c_str()) == 0;
}

std::string own_program() {
  return fs::canonical("/proc/self/exe").replace_filename("ods").native();
}

// The reason why it cannot run. Empty if it can; then interior.blend and own.glb, Blender's own export, are in the
// folder.
std::string missing(const Folder& folder) {
  if (!fs::exists(kInterior) || !runs("blender --version")) return "needs Blender and the shared tools";
  if (!fs::exists(own_program())) return "needs the command: build it first";
  const bool made = runs(fmt::format("cd '{}' && blender -b --factory-startup -P '{}'", folder.path(), kInterior));
  setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1);
  return made ? "" : "Blender could not make the room";
}

struct Rendered {
  Image cycles, ours;  // left eye above right eye
};

// Empty on failure.
std::vector<Rendered> render_both(const Folder& folder, int width, int samples, int frames, int seed = 0) {
  std::ofstream(folder.path("render.py"))
      << fmt::format(kScript, fmt::arg("folder", folder.path()), fmt::arg("samples", samples), fmt::arg("width", width),
                     fmt::arg("frames", frames), fmt::arg("seed", seed));
  const bool done =
      runs(fmt::format("blender -b --factory-startup '{}' --python-exit-code 1 -P '{}'", folder.path("interior.blend"),
                       folder.path("render.py"))) &&
      runs(fmt::format(
          "'{}' render '{}' -o '{}' --frames 0-{} --width {} --samples {} --seed {} --noise none --filter box "
          "--bake 512 --indirect path",
          own_program(), folder.path("judged.blend"), folder.path("ours.####.exr"), frames - 1, width, samples, seed));
  std::vector<Rendered> all;
  for (int frame = 0; done && frame < frames; frame++) {
    all.push_back({read_image(folder.path(fmt::format("cycles.{:04}.exr", frame))),
                   read_image(folder.path(fmt::format("ours.{:04}.exr", frame)))});
  }
  return all;
}

// A picture of one number per pixel.
Image luminance(const Image& pair, int eye) {
  Image grey(pair.width, pair.height / 2, 1);
  for (int y = 0; y < grey.height; y++) {
    for (int x = 0; x < grey.width; x++) {
      const float* const p = pair.at(x, y + eye * grey.height);
      *grey.at(x, y) = ods::luminance(vec3(p[0], p[1], p[2]));
    }
  }
  return grey;
}

double mean(const Image& grey, const Region& region) {
  double sum = 0.0;
  for (int y = region.y0; y < region.y1; y++) {
    for (int x = region.x0; x < region.x1; x++) sum += double{*grey.at(x, y)};
  }
  return sum / ((region.x1 - region.x0) * (region.y1 - region.y0));
}

// The logarithm of medians of 3 x 3 pixels, which has edges but no bright specks.
Image edges(const Image& grey) {
  Image result(grey.width, grey.height, 1);
  for (int y = 1; y + 1 < grey.height; y++) {
    for (int x = 1; x + 1 < grey.width; x++) {
      std::array<float, 9> near{};
      for (int i = 0; i < 9; i++) near[size_t(i)] = *grey.at(x + i % 3 - 1, y + i / 3 - 1);
      std::nth_element(near.begin(), near.begin() + 4, near.end());
      *result.at(x, y) = std::log(near[4] + 0.02f);
    }
  }
  return result;
}

constexpr int kBlock = 32, kReach = 3;

std::vector<double> block_of(const Image& picture, int x, int y) {
  std::vector<double> block;
  for (int i = 0; i < kBlock * kBlock; i++) block.push_back(double{*picture.at(x + i % kBlock, y + i / kBlock)});
  const double middle = std::accumulate(block.begin(), block.end(), 0.0) / double(block.size());
  for (double& each : block) each -= middle;
  return block;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double likeness(const std::vector<double>& a, const std::vector<double>& b) {
  return dot(a, b) / std::sqrt(dot(a, a) * dot(b, b) + 1e-9);
}

// The horizontal shift in pixels between two pictures, for each block with strong edges, by correlation. Blocks that
// are equally similar at all shifts have only horizontal edges, and are not used.
std::vector<double> shifts(const Image& theirs, const Image& ours) {
  constexpr double kStrong = 0.25, kLevel = 0.05;
  std::vector<double> found;
  for (int y = kBlock; y + 2 * kBlock <= theirs.height; y += kBlock) {
    for (int x = 8; x + kBlock + kReach < theirs.width; x += kBlock) {
      const std::vector<double> block = block_of(theirs, x, y);
      if (dot(block, block) < kStrong * kStrong * double(block.size())) continue;
      std::array<double, 2 * kReach + 1> alike{};
      for (int shift = -kReach; shift <= kReach; shift++) {
        alike[size_t(shift + kReach)] = likeness(block, block_of(ours, x + shift, y));
      }
      const auto [minimum, maximum] = std::minmax_element(alike.begin(), alike.end());
      if (*maximum - *minimum < kLevel) continue;
      const auto best = std::clamp<size_t>(size_t(maximum - alike.begin()), 1, 2 * kReach - 1);
      const double left = alike[best - 1], middle = alike[best], right = alike[best + 1];
      const double part = 0.5 * (left - right) / (left - 2 * middle + right);
      found.push_back(double(best) - kReach + std::clamp(part, -1.0, 1.0));
    }
  }
  return found;
}

void say_shifts(benchmark::State& state, const std::string& what, std::vector<double> all) {
  if (all.empty()) return;
  for (double& each : all) each = std::abs(each);
  std::sort(all.begin(), all.end());
  state.counters[what + "_px_median"] = all[all.size() / 2];
  state.counters[what + "_px_90"] = all[all.size() * 9 / 10];
  state.counters[what + "_px_most"] = all.back();
  state.counters[what + "_blocks"] = double(all.size());
}

void against_cycles(benchmark::State& state) {
  const Folder folder;
  if (const std::string why = missing(folder); !why.empty()) return state.SkipWithError(why.c_str());
  for (auto _ : state) {
    std::array<std::vector<double>, 2> apart;
    std::map<std::string, std::array<double, 2>> sums;  // theirs, ours
    for (const int seed : kSeeds) {
      const std::vector<Rendered> both = render_both(folder, kWidth, kSamples, 1, seed);
      if (both.empty()) return state.SkipWithError("rendering failed");
      for (size_t eye : {0, 1}) {
        const Image theirs = luminance(both[0].cycles, int(eye)), ours = luminance(both[0].ours, int(eye));
        const std::vector<double> here = shifts(edges(theirs), edges(ours));
        apart[eye].insert(apart[eye].end(), here.begin(), here.end());
        for (const Region& region : kRegions) {
          sums[region.name][0] += mean(theirs, region);
          sums[region.name][1] += mean(ours, region);
        }
      }
    }
    for (size_t eye : {0, 1}) say_shifts(state, kEyes[eye], apart[eye]);
    for (const auto& [name, sum] : sums) state.counters[name] = sum[1] / sum[0];
  }
}

// The camera moves, and the door opens.
void film_against_cycles(benchmark::State& state) {
  const Folder folder;
  if (const std::string why = missing(folder); !why.empty()) return state.SkipWithError(why.c_str());
  for (auto _ : state) {
    const std::vector<Rendered> frames = render_both(folder, kFilmWidth, kFilmSamples, kFilmFrames);
    if (frames.empty()) return state.SkipWithError("rendering failed");
    for (int eye : {0, 1}) {
      std::vector<double> all, moved;
      const Image first = edges(luminance(frames.front().cycles, eye));
      for (const Rendered& frame : frames) {
        const Image theirs = edges(luminance(frame.cycles, eye));
        const std::vector<double> here = shifts(theirs, edges(luminance(frame.ours, eye)));
        all.insert(all.end(), here.begin(), here.end());
        moved = shifts(first, theirs);  // movement of the last frame relative to the first
      }
      say_shifts(state, kEyes[size_t(eye)], all);
      say_shifts(state, fmt::format("{}_moved", kEyes[size_t(eye)]), moved);
    }
  }
}

// The first `ods info` of a scene, and the second one, relative to Blender's own export including its start. Only the
// very first run also compiles the exporter, for all scenes: the first iteration, which is one of three.
void conversion_over_export(benchmark::State& state) {
  const Folder folder;
  if (const std::string why = missing(folder); !why.empty()) return state.SkipWithError(why.c_str());
  std::ofstream(folder.path("export.py"))
      << "import bpy, numpy\nif not hasattr(numpy, 'bool'): numpy.bool = bool\n"  // as in cycles_bench.cpp
      << fmt::format("bpy.ops.export_scene.gltf(filepath='{}', export_apply=True)\n", folder.path("own.glb"));
  const auto seconds = [&](const std::string& line) { return seconds_of([&] { runs(line); }); };
  const std::string scene = folder.path("interior.blend");
  for (auto _ : state) {
    fs::remove_all(folder.path("cache/ods/scenes"));
    const Seconds theirs = seconds(
        fmt::format("blender -b --factory-startup '{}' --python-exit-code 1 -P '{}'", scene, folder.path("export.py")));
    const Seconds first = seconds(fmt::format("'{}' info '{}'", own_program(), scene));
    const Seconds second = seconds(fmt::format("'{}' info '{}'", own_program(), scene));
    const Seconds plain = seconds(fmt::format("'{}' info '{}'", own_program(), folder.path("own.glb")));
    say(state, first, theirs);
    state.counters["second_s"] = second.wall;
    state.counters["glb_s"] = plain.wall;
    state.counters["second_over_glb_cpu"] = second.cpu / plain.cpu;
  }
}

}  // namespace

BENCHMARK(conversion_over_export)->Iterations(3)->Unit(benchmark::kSecond);
BENCHMARK(against_cycles)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK(film_against_cycles)->Iterations(1)->Unit(benchmark::kSecond);

BENCHMARK_MAIN();
