// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// CPU seconds to equal noise over those of Blender's Cycles in the same run, where Blender and the shared scenes are
// there: both eyes, white sky of 1, box filter, 8 bounces, no denoising.
//
// Two pictures of other seeds differ by twice the noise of either, so each renderer is measured against itself.
// Variance falls as one over the time: their product is the price.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench/measure.h"
#include "ods/export/camera_export.h"
#include "ods/image/image_file.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"

namespace {

using namespace ods;

struct Subject {
  const char* name;
  const char* file;  // below SHARED_SCENES
  vec3 position;
};

constexpr Subject kSubjects[] = {{"atrium", "atrium.glb", {0.0f, 1.6f, 0.0f}},
                                 {"helmet", "DamagedHelmet.glb", {0.0f, 0.0f, 1.5f}}};
constexpr int kWidth = 256;
constexpr int kSamples = 64;

// numpy.bool: the importer of Blender 3.4 asks for it, and numpy 1.24 has none.
constexpr const char* kScript = R"(import bpy, numpy, resource
if not hasattr(numpy, 'bool'): numpy.bool = bool
bpy.ops.object.select_all(action='SELECT')
bpy.ops.object.delete()
bpy.ops.import_scene.gltf(filepath='{}')
for each in [o for o in bpy.data.objects if o.type in ('CAMERA', 'LIGHT')]: bpy.data.objects.remove(each)
world = bpy.data.worlds.new('white')
world.use_nodes = True
world.node_tree.nodes['Background'].inputs['Color'].default_value = (1, 1, 1, 1)
bpy.context.scene.world = world
{}
cycles = bpy.context.scene.cycles
cycles.samples = {}
cycles.use_denoising = cycles.use_adaptive_sampling = False
cycles.pixel_filter_type = 'BOX'
for kind in ('', 'diffuse_', 'glossy_', 'transmission_', 'transparent_max_'):
    setattr(cycles, (kind or 'max_') + 'bounces', {})
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
cycles.light_sampling_threshold = 0
bpy.context.scene.render.image_settings.file_format = 'OPEN_EXR'
bpy.context.scene.render.image_settings.color_depth = '32'
seconds = lambda: sum(resource.getrusage(resource.RUSAGE_SELF)[:2])
for seed in (1, 2):
    cycles.seed = seed
    bpy.context.scene.render.filepath = '{}/' + str(seed)
    before = seconds()
    bpy.ops.render.render(write_still=True)
    open('{}/seconds', 'a').write(str(seconds() - before) + '\n')
)";

double square_difference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (int y = 0; y < a.height; y++) {
    for (int x = 0; x < a.width; x++) {
      for (int c = 0; c < 3; c++) sum += std::pow(double{a.at(x, y)[c]} - double{b.at(x, y)[c]}, 2.0);
    }
  }
  return sum / (3.0 * a.width * a.height);
}

struct Price {
  double seconds = 0.0;   // of a picture
  double variance = 0.0;  // of its pixels
  double product() const { return seconds * variance; }
};

Price price_of_cycles(const Subject& subject, const Folder& folder) {
  Sidecar file;
  file.eye = {kWidth, kWidth / 2};
  file.layout = Layout::kSeparate;
  file.camera.position = subject.position;
  const std::string here = std::filesystem::absolute(folder.path());
  std::ofstream(folder.path("render.py"))
      << fmt::format(kScript, std::string(SHARED_SCENES "/") + subject.file,
                     export_camera(file, CameraTarget::kBlender).text, kSamples, 8, here, here);
  const std::string command = fmt::format("blender -b --factory-startup --python-exit-code 1 -P {} > {} 2>&1",
                                          folder.path("render.py"), folder.path("log"));
  if (std::system(command.c_str()) != 0) return {};
  std::ifstream seconds(folder.path("seconds"));
  Price price;
  for (double each = 0.0; seconds >> each;) price.seconds += 0.5 * each;
  for (const char* eye : {"L", "R"}) {
    const Image a = read_image(fmt::format("{}/1_{}.exr", folder.path(), eye));
    const Image b = read_image(fmt::format("{}/2_{}.exr", folder.path(), eye));
    price.variance += 0.25 * square_difference(a, b);
  }
  return price;
}

Price price_of_ours(const Subject& subject) {
  Scene scene = load_scene(std::string(SHARED_SCENES "/") + subject.file, {});
  scene.environment = Environment();
  scene.environment.radiance = vec3(1.0f);
  StereoCamera camera;
  camera.position = subject.position;
  RenderOptions options;
  options.width = kWidth;
  options.samples = kSamples;
  options.filter = PixelFilter::kBox;
  options.even_noise = options.layers = false;
  Price price;
  std::vector<Picture> pictures;
  for (const uint32_t seed : {1u, 2u}) {
    options.seed = seed;
    price.seconds += 0.5 * seconds_of([&] { pictures.push_back(render_cpu(scene, camera, options)); }).cpu;
  }
  for (size_t eye = 0; eye < 2; eye++) {
    price.variance += 0.25 * square_difference(pictures[0].eyes[eye].radiance, pictures[1].eyes[eye].radiance);
  }
  return price;
}

void equal_noise_over_cycles(benchmark::State& state, const Subject& subject) {
  const bool can_run = std::filesystem::exists(std::string(SHARED_SCENES "/") + subject.file) &&
                       std::system("blender --version > /dev/null 2>&1") == 0;
  if (!can_run) return state.SkipWithError("needs Blender and the shared scenes");
  const Folder folder;
  for (auto _ : state) {
    const Price theirs = price_of_cycles(subject, folder), ours = price_of_ours(subject);
    if (theirs.seconds == 0.0) return state.SkipWithError("Blender failed");
    state.counters["ours_s"] = ours.seconds;
    state.counters["theirs_s"] = theirs.seconds;
    state.counters["ours_rmse"] = std::sqrt(ours.variance);
    state.counters["theirs_rmse"] = std::sqrt(theirs.variance);
    state.counters["cpu_s_to_equal_noise_ratio"] = ours.product() / theirs.product();
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (const Subject& subject : kSubjects) {
    const auto run = [&](benchmark::State& state) { equal_noise_over_cycles(state, subject); };
    benchmark::RegisterBenchmark(fmt::format("equal_noise_over_cycles/{}", subject.name).c_str(), run)
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
