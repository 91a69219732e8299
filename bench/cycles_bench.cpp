// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// CPU seconds to equal noise relative to Blender's Cycles in the same run, if Blender and the shared scenes are
// installed: both eyes, white sky of 1, box filter, 8 bounces, no denoising. Each renderer is measured against itself.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench/measure.h"
#include "bench/subjects.h"
#include "ods/export/camera_export.h"
#include "ods/image/image_file.h"
#include "ods/render/cpu/render.h"

namespace {

using namespace ods;

constexpr int kWidth = 256;
constexpr int kSamples = 64;

// The importer of Blender 3.4 uses numpy.bool, which numpy 1.24 does not have.
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

Price price_of_cycles(const Subject& subject, const Folder& folder) {
  Sidecar file;
  file.eye = {kWidth, kWidth / 2};
  file.layout = Layout::kSeparate;
  file.camera.position = subject.position;
  const std::string here = std::filesystem::absolute(folder.path());
  std::ofstream(folder.path("render.py")) << fmt::format(
      kScript, subject.path(), export_camera(file, CameraTarget::kBlender).text, kSamples, 8, here, here);
  const std::string command = fmt::format("blender -b --factory-startup --python-exit-code 1 -P {} > {} 2>&1",
                                          folder.path("render.py"), folder.path("log"));
  if (std::system(command.c_str()) != 0) return {};
  std::ifstream times(folder.path("seconds"));
  double seconds = 0.0;
  for (double each = 0.0; times >> each;) seconds += each;
  const auto rendered = [&](int seed) {
    Picture picture;
    for (const char* eye : {"L", "R"}) {
      picture.eyes.emplace_back().radiance = read_image(fmt::format("{}/{}_{}.exr", folder.path(), seed, eye));
    }
    return picture;
  };
  return price_of(rendered(1), rendered(2), seconds);
}

Price price_of_ours(const Subject& subject) {
  const Scene scene = load(subject);
  return price_of(options_of(kWidth, kSamples),
                  [&](const RenderOptions& options) { return render_cpu(scene, camera_of(subject, scene), options); });
}

void equal_noise_over_cycles(benchmark::State& state, const Subject& subject) {
  const bool can_run =
      std::filesystem::exists(subject.path()) && std::system("blender --version > /dev/null 2>&1") == 0;
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
  for (const Subject& subject : {kAtrium, kHelmet}) {
    const auto run = [subject](benchmark::State& state) { equal_noise_over_cycles(state, subject); };
    benchmark::RegisterBenchmark(fmt::format("equal_noise_over_cycles/{}", subject.name).c_str(), run)
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
