// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Speed of a graphics card next to that of the processor, in the same run: gpu_bench [DEVICE [SCENE...]], DEVICE as for
// ods render --device. Without a card it measures software Vulkan, which shows only that everything runs.
//
// The first table: prepare: seconds until the scene is on the device; the first time on a machine includes the
// compilation of the shaders. M/s: millions of samples per second, of both eyes, whole paths. trace: the share of the
// card's time in which it follows rays; busy: the share of the time in which the card works.
// The second: milliseconds by the card's clock for a frame of 4096x4096 pixels, two eyes of 4096x2048, one sample per
// pixel; the fastest of several, since cards raise their clock rate under load. The transfer is in the last column only.
// The third: seconds until a picture of the room is denoised, 1536 pixels wide, from the prepared scene.
#include <fmt/format.h>

#include <algorithm>

#include "bench/measure.h"
#include "bench/subjects.h"
#include "ods/base/error.h"
#include "ods/denoise/denoise.h"
#include "ods/render/cpu/render.h"
#include "ods/render/devices/devices.h"
#include "ods/render/gpu/gpu_lacks.h"
#include "ods/render/gpu/gpu_renderer.h"
#include "ods/render/render_target.h"

namespace {

using namespace ods;

constexpr double kSecondsToMeasure = 2.0;
constexpr int kFrames = 10;
constexpr Subject kRoom{"room"};
constexpr Subject kSubjects[] = {kRoom, kAtrium, kHelmet, {"wineglass"}, {"mirrors"}, {"furnace"}};

struct Speed {
  double prepare = 0.0;  // seconds
  double samples = 0.0;  // per second
  double cpu = 0.0;      // samples per CPU second
  double wall = 0.0;     // of the measured picture
  int per_pixel = 0;     // samples of the measured picture
};

// Software only shows that everything runs.
int frame_width(const GpuDevice& card) {
  return card.info().kind == GpuKind::kSoftware ? 64 : 4096;
}

int clean_width(const GpuDevice& card) {
  return card.info().kind == GpuKind::kSoftware ? 64 : 1536;
}

RenderOptions options_for(const Subject& subject, const Scene& scene, int width) {
  RenderOptions options;
  options.width = width;
  options.samples = 1;
  options.caustics = Caustics::kStraight;
  return with_height(options, camera_of(subject, scene));
}

// Renders with ever more samples until it takes long enough.
Speed speed_of(const Renderer& renderer, const StereoCamera& camera, RenderOptions options) {
  Speed speed;
  speed.prepare = seconds_of([&] { renderer.render(camera, options); }).wall;  // drivers compile as late as this
  for (; speed.wall < kSecondsToMeasure; options.samples *= 4) {
    double samples = 0.0;
    const Seconds took = seconds_of([&] { samples = renderer.render(camera, options).samples_taken; });
    speed = {speed.prepare, samples / took.wall, samples / took.cpu, took.wall, options.samples};
  }
  return speed;
}

// The processor's and the card's renderer of a scene, and the seconds that it took to make them.
struct Renderers {
  Renderers(const Scene& scene, const std::shared_ptr<GpuDevice>& card) {
    cpu_seconds = seconds_of([&] { cpu = std::make_unique<CpuRenderer>(scene); }).wall;
    gpu_seconds = seconds_of([&] { gpu = std::make_unique<GpuRenderer>(scene, card); }).wall;
  }

  std::unique_ptr<CpuRenderer> cpu;
  std::unique_ptr<GpuRenderer> gpu;
  double cpu_seconds = 0.0, gpu_seconds = 0.0;
};

// The times between two readings.
GpuTimes difference_of(const GpuTimes& a, const GpuTimes& b) {
  return {b.trace - a.trace, b.begin - a.begin, b.shade - a.shade};
}

void measure_speed(const Subject& subject, const std::shared_ptr<GpuDevice>& card) {
  const Scene scene = load(subject);
  const StereoCamera camera = camera_of(subject, scene);
  const RenderOptions options = options_for(subject, scene, 512);
  const std::string lacks = gpu_lacks(scene, options, false);
  if (!lacks.empty()) return fmt::print("{:12} {}\n", subject.name, lacks);
  const Renderers renderers(scene, card);
  const Speed cpu = speed_of(*renderers.cpu, camera, options);
  const Speed gpu = speed_of(*renderers.gpu, camera, options);
  const GpuTimes before = renderers.gpu->times();
  RenderOptions many = options;
  many.samples = gpu.per_pixel;
  const double wall = seconds_of([&] { renderers.gpu->render(camera, many); }).wall;
  const GpuTimes times = difference_of(before, renderers.gpu->times());
  fmt::print("{:12} {:9.2f} {:9.4f} {:9.4f} {:9.2f} {:9.4f} {:8.2f} {:8.2f} {:8.2f}\n", subject.name,
             renderers.cpu_seconds + cpu.prepare, 1e-6 * cpu.samples, 1e-6 * cpu.cpu,
             renderers.gpu_seconds + gpu.prepare, 1e-6 * gpu.samples, gpu.samples / cpu.samples,
             times.trace / std::max(times.all(), 1e-9), times.all() / wall);
}

void measure_frames(const Subject& subject, const std::shared_ptr<GpuDevice>& card) {
  const Scene scene = load(subject);
  const StereoCamera camera = camera_of(subject, scene);
  RenderOptions options = options_for(subject, scene, frame_width(*card));
  options.even_noise = false, options.layers = false;
  const GpuRenderer renderer(scene, card);
  for (const int bounces : {0, 1, 8}) {
    options.bounces = bounces;
    GpuTimes best;
    double wall = 0.0;
    for (int i = 0; i < kFrames; i++) {
      PictureSamples samples = no_samples(options);
      const GpuTimes before = renderer.times();
      const double took = seconds_of([&] { renderer.sample({&camera, 1}, options, samples); }).wall;
      const GpuTimes times = difference_of(before, renderer.times());
      if (i == 0 || times.all() < best.all()) best = times, wall = took;
    }
    fmt::print("{:12} {:9} {:9.1f} {:9.2f} {:9.2f} {:9.2f} {:9.1f}\n", subject.name, bounces,
               1.0 / std::max(best.all(), 1e-9), 1e3 * best.trace, 1e3 * best.begin, 1e3 * best.shade, 1e3 * wall);
  }
}

void measure_clean_room(const std::shared_ptr<GpuDevice>& card) {
  const Scene scene = load(kRoom);
  const StereoCamera camera = camera_of(kRoom, scene);
  RenderOptions options = options_for(kRoom, scene, clean_width(*card));
  options.samples = 256, options.statistics = true;
  for (const float noise : {0.1f, 0.05f}) {
    options.noise = noise;
    const GpuRenderer renderer(scene, card);
    renderer.render(camera, options_for(kRoom, scene, 64));
    Picture picture;
    const double rendering = seconds_of([&] { picture = renderer.render(camera, options); }).wall;
    const double denoising = seconds_of([&] { denoise(picture, camera); }).wall;
    fmt::print("{:12} {:9} {:9.2f} {:9.2f} {:9.2f}\n", kRoom.name, noise, rendering, renderer.times().all(), denoising);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    const DeviceChoice device = choose_device(argc > 1 ? argv[1] : "gpu");
    fmt::print("{}: {}\n", device.name, device.why);
    const auto card = std::make_shared<GpuDevice>(device.gpu);
    fmt::print("{:12} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "", "CPU: s", "M/s", "M/CPU s", "card: s",
               "M/s", "faster", "trace", "busy");
    const auto is_wanted = [&](const Subject& subject) {
      return argc <= 2 || std::find(argv + 2, argv + argc, std::string(subject.name)) != argv + argc;
    };
    for (const Subject& subject : kSubjects) {
      if (is_wanted(subject)) measure_speed(subject, card);
    }
    fmt::print("\n{:12} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "4096x4096", "bounces", "frames/s", "trace ms",
               "begin ms", "shade ms", "wall ms");
    for (const Subject& subject : {kRoom, kAtrium, kHelmet}) {
      if (is_wanted(subject)) measure_frames(subject, card);
    }
    fmt::print("\n{:12} {:>9} {:>9} {:>9} {:>9}\n", "1536 clean", "noise", "render s", "card s", "denoise s");
    if (is_wanted(kRoom)) measure_clean_room(card);
  } catch (const Error& error) {
    fmt::print("skipped: {}\n", error.what());
  }
}
