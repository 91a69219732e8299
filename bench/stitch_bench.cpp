// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Time to stitch a picture from the views of a rig, relative to merely reading the same files on as many threads:
// alternating, five times, of which the median counts.
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "bench/bare_file.h"
#include "bench/measure.h"
#include "ods/stitch/view_files.h"

namespace {

using namespace ods;

// A pattern on a sphere of radius 3 m, with or without depth.
void make_view(const SlitRig& rig, const StereoCamera& pose, const std::string& path) {
  PictureRows rows;
  rows.eye = rig.view;
  rows.eyes = {kMono};
  rows.layers = {{{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf}};
  const bool deep = rig.options.depth != ViewDepth::kNone;
  if (deep) rows.layers.push_back({{"Z"}, LayerRule::kNearest, SampleType::kFloat});
  rows.fill = [&, camera = make_camera(pose)](int, int y, std::span<float> row) {
    for (int x = 0; x < rig.view.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(rig.view.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(rig.view.height));
      const Ray ray = camera_ray(camera, kMono, uv);
      const float along = dot(ray.origin, ray.direction);
      const float t = -along + std::sqrt(along * along - dot(ray.origin, ray.origin) + 9.0f);
      const vec3 p = ray.origin + t * ray.direction;
      float* pixel = &row[static_cast<size_t>(x) * (deep ? 4 : 3)];
      for (int c = 0; c < 3; c++) pixel[c] = 0.5f + 0.4f * std::sin(20.0f * p[c] + 7.0f * p[(c + 1) % 3]);
      if (deep) pixel[3] = t;
    }
  };
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  save_picture(rows, nullptr, save, path);
}

void stitch_views(benchmark::State& state, int slits, ViewDepth depth, const std::string& extension) {
  const Folder folder;
  SlitOptions options;
  options.slits = slits;
  options.depth = depth;
  const SlitRig rig = make_slit_rig(StereoCamera(), {4096, 2048}, {kLeft, kRight}, options);
  ViewFiles files;
  files.names = folder.path("####." + extension);
  tbb::parallel_for(size_t{0}, rig.views.size(),
                    [&](size_t i) { make_view(rig, rig.views[i], view_path(rig, files, i)); });
  sync();  // otherwise the disk would still be busy with them
  Stitched stitched;
  const auto ours = [&] {
    StitchOptions stitching;
    stitching.journal = folder.path("journal");
    stitched = stitch(rig, open_view_files(rig, files), stitching);
  };
  const auto bare = [&] {
    tbb::parallel_for(size_t{0}, rig.views.size(),
                      [&](size_t i) { benchmark::DoNotOptimize(read_bare(view_path(rig, files, i))); });
  };
  std::vector<std::pair<Seconds, Seconds>> rounds;
  for (auto _ : state) {
    stitched = {};  // the next run starts again
    std::filesystem::remove(folder.path("journal"));
    forget_peak();
    const Seconds stitching = seconds_of(ours);
    state.counters["peak_MB"] = peak_megabytes();
    rounds.emplace_back(stitching, seconds_of(bare));
  }
  const auto middle = rounds.begin() + static_cast<ptrdiff_t>(rounds.size() / 2);
  std::nth_element(rounds.begin(), middle, rounds.end(), [](const auto& a, const auto& b) {
    return a.first.wall * b.second.wall < b.first.wall * a.second.wall;
  });
  say(state, middle->first, middle->second);
  const Seconds saving = seconds_of([&] {
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(stitched.rows, &rig.camera, save, folder.path("stitched." + extension));
  });
  state.counters["saving_s"] = saving.wall;
  state.counters["Mpixels_per_cpu_s"] = 2.0 * 4096 * 2048 * 1e-6 / middle->first.cpu;
  state.counters["views"] = static_cast<double>(rig.views.size());
}

}  // namespace

int main(int argc, char** argv) {
  // 720 views either way. Target of the first: at most 1.3.
  for (const char* extension : {"exr", "png"}) {
    const auto plain = [=](benchmark::State& state) { stitch_views(state, 180, ViewDepth::kNone, extension); };
    benchmark::RegisterBenchmark((std::string("stitch/") + extension).c_str(), plain)
        ->Iterations(5)
        ->Unit(benchmark::kSecond);
  }
  const auto deep = [](benchmark::State& state) { stitch_views(state, 36, ViewDepth::kRay, "exr"); };
  benchmark::RegisterBenchmark("by_depth/exr", deep)->Iterations(1)->Unit(benchmark::kSecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
