// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Speed of the path tracer, in the measures of similar renderers: samples per CPU second, Embree's share of the time,
// CPU seconds to a given noise, loading, threads. Seconds are CPU seconds of the whole process.
//
// The scenes are the shared atrium and helmet, and the built-in room; box filter, 8 bounces.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

#include "bench/measure.h"
#include "bench/subjects.h"
#include "ods/render/cpu/embree_scene.h"
#include "ods/render/cpu/render.h"
#include "ods/render/lights.h"
#include "ods/scene/shutter.h"

namespace {

using namespace ods;

constexpr Subject kRoom{"room", "", {}, 0.02};

Price price_with(const CpuRenderer& renderer, const StereoCamera& camera, const RenderOptions& options) {
  return price_of(options, [&](const RenderOptions& seeded) { return renderer.render(camera, seeded); });
}

double million_samples(const RenderOptions& options) {
  return 1e-6 * options.width * options.width * options.samples;  // two eyes of half the height
}

// Cycles 5.2 reaches 0.37 and 2.4, OSPRay 0.3 and 9.5 (2 cores of an EPYC).
void samples_per_second(benchmark::State& state, const Subject& subject) {
  const Scene scene = load(subject);
  RenderOptions options = options_of(1024, 16);
  for (auto _ : state) {
    for (const bool share : {false, true}) {
      options.share_paths = share;
      const double start = cpu_seconds();
      benchmark::DoNotOptimize(render_cpu(scene, camera_of(subject, scene), options));
      state.counters[share ? "Msamples_per_cpu_s" : "Msamples_unshared_per_cpu_s"] =
          million_samples(options) / (cpu_seconds() - start);
    }
  }
}

struct TracedRay {
  Ray ray;
  float length;
  bool shadow;
};

// The rays of a render of both eyes, one sample per pixel, in rendering order.
std::vector<TracedRay> record_rays(const EmbreeScene& embree, PathTracer tracer, const Camera& camera, int width) {
  std::vector<TracedRay> rays;
  const PathSettings settings{8, kLightSamplingBoth, false, 0.0f};
  for (int i = 0; i < width * width; i++) {
    const int x = i % width, y = i / width % (width / 2), eye = i / (width * width / 2);
    const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                  (static_cast<float>(y) + 0.5f) / static_cast<float>(width / 2));
    tracer.start_path(camera_ray(camera, eye, uv), no_media(), hash(static_cast<uint>(i)), 0u);
    while (tracer.path.alive) {
      rays.push_back({tracer.path.ray, 0.0f, false});
      tracer.shade(embree.closest_hit(tracer, tracer.path.ray, kPathRay), settings);
      if (!tracer.path.shadow_pending) continue;
      rays.push_back({tracer.path.shadow_ray, tracer.path.shadow_length, true});
      if (!embree.occluded(tracer, tracer.path.shadow_ray, tracer.path.shadow_length)) {
        tracer.add_shadow_light();
      }
    }
  }
  return rays;
}

// The baseline: tracing only the same rays, relative to tracing and shading them.
void share_of_embree(benchmark::State& state, const Subject& subject) {
  const Scene scene = load(subject);
  const LightTable lights = make_lights(scene);
  const EmbreeScene embree(scene);
  PathTracer tracer;
  set_scene(tracer, scene, lights);
  const Camera camera = make_camera(camera_of(subject, scene));
  const std::vector<TracedRay> rays = record_rays(embree, tracer, camera, 512);
  for (auto _ : state) {
    const double start = cpu_seconds();
    for (const TracedRay& traced : rays) {
      if (traced.shadow) {
        benchmark::DoNotOptimize(embree.occluded(tracer, traced.ray, traced.length));
      } else {
        benchmark::DoNotOptimize(embree.closest_hit(tracer, traced.ray, kPathRay));
      }
    }
    const double bare = cpu_seconds() - start;
    RenderOptions options = options_of(512, 16);
    options.threads = 1;
    const double before = cpu_seconds();
    double first_tile = 0.0;
    Progress progress;
    progress.report = [&](double) {
      if (first_tile == 0.0) first_tile = cpu_seconds();
    };
    benchmark::DoNotOptimize(render_cpu(scene, camera_of(subject, scene), options, progress));
    const double whole = (cpu_seconds() - std::max(before, first_tile)) / options.samples;
    state.counters["share_percent"] = 100.0 * bare / whole;
    state.counters["Mrays_per_s"] = 1e-6 * static_cast<double>(rays.size()) / bare;
    state.counters["rays_per_sample"] = static_cast<double>(rays.size()) / (512.0 * 512.0);
  }
}

// The benefit of sharing paths between the eyes: variance times CPU time without, over that with sharing.
void gain_of_shared_paths(benchmark::State& state, const Subject& subject) {
  const Scene scene = load(subject);
  const CpuRenderer renderer(scene);
  for (auto _ : state) {
    double cost[2];
    for (const bool share : {false, true}) {
      RenderOptions options = options_of(256, 16);
      options.share_paths = share;
      cost[share] = price_with(renderer, camera_of(subject, scene), options).product();
    }
    state.counters["gain"] = cost[0] / cost[1];
  }
}

// The benefit of stopping clean pixels: variance times CPU time over that of as many samples everywhere.
void adaptive_over_uniform(benchmark::State& state, const Subject& subject) {
  const Scene scene = load(subject);
  const StereoCamera camera = camera_of(subject, scene);
  const CpuRenderer renderer(scene);
  for (auto _ : state) {
    RenderOptions options = options_of(256, 1024);
    options.noise = 0.02f;
    const Price adaptive = price_with(renderer, camera, options);
    const Price uniform = price_with(renderer, camera, options_of(256, static_cast<int>(adaptive.samples)));
    state.counters["mean_samples"] = adaptive.samples;
    state.counters["rmse"] = std::sqrt(adaptive.variance);
    state.counters["shown_ratio"] =
        adaptive.seconds * adaptive.shown_variance / (uniform.seconds * uniform.shown_variance);
    state.counters["ratio"] = adaptive.product() / uniform.product();
  }
}

// 256x128 for each eye. Variance is inversely proportional to the number of samples.
void seconds_to_equal_noise(benchmark::State& state, const Subject& subject) {
  const Scene scene = load(subject);
  const CpuRenderer renderer(scene);
  for (auto _ : state) {
    const Price price = price_with(renderer, camera_of(subject, scene), options_of(256, 64));
    state.counters["rmse_at_64"] = std::sqrt(price.variance);
    state.counters["cpu_s_to_target"] = price.product() / std::pow(subject.noise, 2.0);
  }
}

void load_to_first_ray(benchmark::State& state, const Subject& subject) {
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const Scene scene = load(subject);
    const LightTable lights = make_lights(scene);
    const EmbreeScene embree(scene);
    PathTracer tracer;
    set_scene(tracer, scene, lights);
    const Ray ray = camera_ray(make_camera(camera_of(subject, scene)), kLeft, vec2(0.5f));
    benchmark::DoNotOptimize(embree.closest_hit(tracer, ray, kPathRay));
    state.counters["wall_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    state.counters["peak_MB"] = peak_megabytes();
  }
}

void two_threads_against_one(benchmark::State& state, const Subject& subject) {
  const Scene scene = load(subject);
  for (auto _ : state) {
    double wall[2];
    for (int threads = 1; threads <= 2; threads++) {
      RenderOptions options = options_of(512, 16);
      options.threads = threads;
      const auto start = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(render_cpu(scene, camera_of(subject, scene), options));
      wall[threads - 1] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    state.counters["speedup"] = wall[0] / wall[1];
  }
}

// Cost of a video's frame besides tracing: the scene at another time, its trees and lights, relative to building all of
// them as for a first frame. The built-in toys, or a static scene.
void frame_overhead(benchmark::State& state, const Subject& subject) {
  Scene scene = load(subject);
  play(scene.animation, "");
  const auto start = std::chrono::steady_clock::now();
  const auto milliseconds = [](auto since) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count();
  };
  CpuRenderer renderer(scene);
  const double first = milliseconds(start);
  constexpr int kFrames = 48;
  for (auto _ : state) {
    auto since = std::chrono::steady_clock::now();
    for (int frame = 0; frame < kFrames; frame++) renderer.update(set_time(scene, frame / 24.0));
    state.counters["ms_per_frame"] = milliseconds(since) / kFrames;
    since = std::chrono::steady_clock::now();
    for (int frame = 0; frame < kFrames; frame++) set_time(scene, frame / 24.0);
    state.counters["ms_of_it_posing"] = milliseconds(since) / kFrames;
    state.counters["ms_first_frame"] = first;
  }
  open_shutter(scene, 0.0, 0.02);
  CpuRenderer blurred(scene);
  const auto since = std::chrono::steady_clock::now();
  for (int frame = 0; frame < kFrames; frame++) blurred.update(open_shutter(scene, frame / 24.0, frame / 24.0 + 0.02));
  state.counters["ms_per_blurred_frame"] = milliseconds(since) / kFrames;
  state.counters["triangles"] = static_cast<double>(scene.triangles.size());
}

}  // namespace

int main(int argc, char** argv) {
  using Figure = void (*)(benchmark::State&, const Subject&);
  const std::pair<const char*, Figure> figures[] = {{"load_to_first_ray", load_to_first_ray},
                                                    {"samples_per_second", samples_per_second},
                                                    {"share_of_embree", share_of_embree},
                                                    {"two_threads_against_one", two_threads_against_one},
                                                    {"gain_of_shared_paths", gain_of_shared_paths},
                                                    {"adaptive_over_uniform", adaptive_over_uniform},
                                                    {"seconds_to_equal_noise", seconds_to_equal_noise}};
  for (const auto& [name, figure] : figures) {
    for (const Subject& subject : {kAtrium, kHelmet, kRoom}) {
      const auto run = [figure = figure, subject](benchmark::State& state) { figure(state, subject); };
      benchmark::RegisterBenchmark((std::string(name) + "/" + subject.name).c_str(), run)
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
    }
  }
  for (const Subject& subject : {Subject{"toys"}, kAtrium}) {
    const auto run = [subject](benchmark::State& state) { frame_overhead(state, subject); };
    benchmark::RegisterBenchmark((std::string("frame_overhead/") + subject.name).c_str(), run)
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
