// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Benefit and cost of denoising: the error of N samples denoised over the error of 8 N samples; the difference between
// the eyes where they see the same; CPU seconds and memory for a large picture.
//
// The truth is not needed. Two pictures A and B of 8 N samples with other seeds have independent noise, so the mean of
// (d - A)(d - B) is the squared error of d, and half of the mean of (A - B)^2 the squared error of 8 N samples. Errors
// are those of linear light, which the edge of one bright lamp may dominate, and of the displayed picture (clipped to
// 0..1, sRGB).
#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>

#include "bench/measure.h"
#include "bench/subjects.h"
#include "ods/denoise/denoise.h"
#include "ods/kernel/camera/project.h"
#include "ods/kernel/random.h"
#include "ods/render/cpu/render.h"

namespace {

using namespace ods;

struct Stage {
  Scene scene;
  StereoCamera camera;
};

Stage load_stage(const std::string& name) {
  const Subject subject = name == kAtrium.name ? kAtrium : Subject{name.c_str()};
  Stage stage{load(subject), {}};
  stage.camera = camera_of(subject, stage.scene);
  return stage;
}

Picture render(const Stage& stage, int width, int samples, uint32_t seed) {
  RenderOptions options;
  options.width = width;
  options.samples = samples;
  options.seed = seed;
  options.statistics = true;
  return render_cpu(stage.scene, stage.camera, options, {});
}

// The mean over all values of all eyes, without those that are not finite.
double mean_of(std::initializer_list<const Picture*> pictures, LightView view,
               const std::function<double(const std::vector<double>&)>& of) {
  double sum = 0.0;
  size_t count = 0;
  const Picture& first = **pictures.begin();
  for (size_t eye = 0; eye < first.eyes.size(); eye++) {
    for (size_t i = 0; i < first.eyes[eye].radiance.pixels.size(); i++) {
      std::vector<double> values;
      bool finite = true;
      for (const Picture* picture : pictures) {
        const float value = picture->eyes[eye].radiance.pixels[i];
        finite = finite && std::isfinite(value);
        values.push_back(double{view(value)});
      }
      if (finite) sum += of(values), count++;
    }
  }
  return sum / static_cast<double>(count);
}

double error(const Picture& d, const Picture& a, const Picture& b, LightView view) {
  const double square = mean_of({&d, &a, &b}, view, [](const auto& v) { return (v[0] - v[1]) * (v[0] - v[2]); });
  return std::sqrt(std::max(square, 0.0));
}

struct Seen {
  const EyeImage& image;
  Camera camera;
};

// RMS of the difference between a pixel of one picture and the pixel of another picture that shows the same point. Only
// the camera moves.
double difference_of(const Seen& one, const Seen& other, LightView view) {
  const EyeImage &left = one.image, &right = other.image;
  const int width = left.depth.width, height = left.depth.height;
  const vec2 size(static_cast<float>(width), static_cast<float>(height));
  double sum = 0.0;
  size_t count = 0;
  for (int i = 0; i < width * height; i++) {
    const int x = i % width, y = i / width;
    const float depth = *left.depth.at(x, y);
    if (depth >= kFarDepth) continue;
    const vec2 uv = (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / size;
    const Ray ray = camera_ray(one.camera, left.eye, uv);
    const ImagePosition place = project_point(other.camera, right.eye, ray.origin + ray.direction * depth);
    const vec2 at = place.uv * size - 0.5f, corner = floor(at), share = at - corner;
    if (!place.seen || corner.y < 0.0f || corner.y + 1.0f >= size.y) continue;
    vec3 there(0.0f);
    bool same = true;
    for (int k = 0; k < 4; k++) {
      const int column = (static_cast<int>(corner.x) + k % 2 + width) % width, row = static_cast<int>(corner.y) + k / 2;
      same = same && std::abs(*right.depth.at(column, row) / place.depth - 1.0f) < 0.05f;
      const float weight = (k % 2 == 1 ? share.x : 1.0f - share.x) * (k / 2 == 1 ? share.y : 1.0f - share.y);
      for (int c = 0; c < 3; c++) there[c] += weight * view(right.radiance.at(column, row)[c]);
    }
    for (int c = 0; same && c < 3; c++) {
      const double off = double{view(left.radiance.at(x, y)[c])} - double{there[c]};
      if (std::isfinite(off)) sum += off * off, count++;
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

double difference_of_eyes(const Picture& picture, const StereoCamera& stereo, LightView view) {
  const Camera camera = make_camera(stereo);
  return difference_of({picture.eyes[0], camera}, {picture.eyes[1], camera}, view);
}

// Ratios to the error of the raw picture with the same number of samples.
void error_against_eight_times_the_samples(benchmark::State& state, const std::string& name, int width, int samples) {
  const Stage stage = load_stage(name);
  const Picture raw = render(stage, width, samples, 1);
  const Picture a = render(stage, width, 8 * samples, 2), b = render(stage, width, 8 * samples, 3);
  for (auto _ : state) {
    Picture both = raw, alone = raw;
    denoise(both, stage.camera);
    DenoiseOptions options;
    options.both_eyes = false;
    denoise(alone, stage.camera, options);
    for (const LightView view : {&linear, &shown}) {
      const std::string of = view == &linear ? "_linear" : "";
      const double before = error(raw, a, b, view);
      const double eight = mean_of({&a, &b}, view, [](const auto& v) { return 0.5 * (v[0] - v[1]) * (v[0] - v[1]); });
      state.counters["raw" + of] = before;
      state.counters["denoised_over_raw" + of] = error(both, a, b, view) / before;
      state.counters["raw_of_8N_over_raw" + of] = std::sqrt(eight) / before;
      state.counters["eyes_difference_over_alone" + of] =
          difference_of_eyes(both, stage.camera, view) / difference_of_eyes(alone, stage.camera, view);
    }
    const double energy = mean_of({&both}, linear, [](const auto& v) { return v[0]; });
    state.counters["energy"] = energy / mean_of({&raw}, linear, [](const auto& v) { return v[0]; });
  }
}

// The difference between successive frames of a turntable after exact motion, as displayed, over that of raw frames
// with eight times the samples. The room turns in 20 seconds.
void flicker(benchmark::State& state, const std::string& name, int width, int samples) {
  Stage stage = load_stage(name);
  std::vector<StereoCamera> cameras;
  std::vector<Picture> changing, fixed, many;
  for (int frame = 0; frame < 4; frame++) {
    stage.camera.yaw = 0.6f * static_cast<float>(frame);
    cameras.push_back(stage.camera);
    changing.push_back(render(stage, width, samples, 10 + static_cast<uint32_t>(frame)));
    fixed.push_back(render(stage, width, samples, 10));
    if (frame == 1 || frame == 2) many.push_back(render(stage, width, 8 * samples, 20 + static_cast<uint32_t>(frame)));
  }
  const auto between = [&](const Picture& a, const Picture& b) {
    return difference_of({a.eyes[0], make_camera(cameras[1])}, {b.eyes[0], make_camera(cameras[2])}, shown);
  };
  const auto denoised = [&](const std::vector<Picture>& frames, size_t i, bool beside) {
    Picture picture = frames[i];
    const std::vector<FrameBeside> both{{frames[i - 1], cameras[i - 1], {}}, {frames[i + 1], cameras[i + 1], {}}};
    DenoiseOptions options;
    if (beside) options.beside = both;
    denoise(picture, cameras[i], options);
    return picture;
  };
  for (auto _ : state) {
    const double yardstick = between(many[0], many[1]);
    state.counters["raw_of_8N"] = yardstick;
    for (const bool beside : {false, true}) {
      const std::string how = beside ? "_with_neighbours" : "_alone";
      state.counters["changing" + how] =
          between(denoised(changing, 1, beside), denoised(changing, 2, beside)) / yardstick;
      state.counters["fixed" + how] = between(denoised(fixed, 1, beside), denoised(fixed, 2, beside)) / yardstick;
    }
  }
}

// The difference between frames whose indirect light comes from a cache that each frame fills again, over that of
// frames with whole paths. The camera turns, or moves by 2 cm between frames.
void flicker_of_cache(benchmark::State& state, const std::string& name, bool moves) {
  Stage stage = load_stage(name);
  std::vector<StereoCamera> cameras;
  std::vector<Picture> frames[2];
  RenderOptions options;
  options.width = 256, options.samples = 16, options.statistics = true, options.cache_paths = 1 << 19;
  for (uint32_t frame = 0; frame < 4; frame++) {
    if (moves) stage.camera.position.z -= 0.02f;
    if (!moves) stage.camera.yaw += 0.6f;
    cameras.push_back(stage.camera);
    for (const Indirect indirect : {Indirect::kPath, Indirect::kCache}) {
      options.indirect = indirect;
      options.seed = hash_pair(1, frame);
      frames[indirect == Indirect::kCache].push_back(render_cpu(stage.scene, stage.camera, options, {}));
    }
  }
  for (auto _ : state) {
    double apart[2];
    for (const bool cached : {false, true}) {
      std::vector<Picture> denoised;
      for (const size_t i : {size_t{1}, size_t{2}}) {
        const std::vector<Picture>& raw = frames[cached];
        const std::vector<FrameBeside> both{{raw[i - 1], cameras[i - 1], {}}, {raw[i + 1], cameras[i + 1], {}}};
        DenoiseOptions denoising;
        denoising.beside = both;
        denoise(denoised.emplace_back(raw[i]), cameras[i], denoising);
      }
      apart[cached] = difference_of({denoised[0].eyes[0], make_camera(cameras[1])},
                                    {denoised[1].eyes[0], make_camera(cameras[2])}, shown);
    }
    state.counters["path"] = apart[0];
    state.counters["cache_over_path"] = apart[1] / apart[0];
  }
}

// Both eyes 4096x2048. Peak memory is the process's: the picture with its statistics needs 940 MB.
void large_picture(benchmark::State& state) {
  const Stage stage = load_stage("toys");
  Picture picture = render(stage, 4096, 2, 1);
  const double pixels = 2.0 * 4096 * 2048;
  for (auto _ : state) {
    const double start = cpu_seconds();
    denoise(picture, stage.camera);
    state.counters["cpu_s"] = cpu_seconds() - start;
    state.counters["us_per_pixel"] = 1e6 * (cpu_seconds() - start) / pixels;
    state.counters["peak_MB"] = peak_megabytes();
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("large_picture", large_picture)->Iterations(1)->Unit(benchmark::kSecond);
  for (const auto& [width, samples] : {std::pair{512, 16}, std::pair{384, 64}}) {
    for (const char* name : {"atrium", "room", "toys", "wineglass"}) {
      const auto run = [=, w = width, n = samples](benchmark::State& state) {
        error_against_eight_times_the_samples(state, name, w, n);
      };
      benchmark::RegisterBenchmark(("error/" + std::string(name) + "/" + std::to_string(samples)).c_str(), run)
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
    }
  }
  for (const char* name : {"atrium", "room"}) {
    const auto run = [=](benchmark::State& state) { flicker(state, name, 512, 16); };
    benchmark::RegisterBenchmark(("flicker/" + std::string(name)).c_str(), run)
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
  }
  for (const char* name : {"atrium", "room"}) {
    for (const bool moves : {false, true}) {
      const auto run = [=](benchmark::State& state) { flicker_of_cache(state, name, moves); };
      benchmark::RegisterBenchmark(
          ("flicker_of_cache/" + std::string(name) + (moves ? "/dolly" : "/turntable")).c_str(), run)
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
