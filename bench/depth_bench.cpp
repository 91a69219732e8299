// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stereo from a mono picture and its depth: speed, and accuracy relative to rendered stereo. Prints the tables of
// docs/depth.md.
//
// Speed: every eighth row of both eyes of 8192x4096, without reading and writing files; for comparison, a turn of the
// same picture by a third of a pixel, which only resamples. CPU seconds, so that other work on the machine does not
// count.
//
// Quality: the albedo of the first hit, which has no noise, for scenes rendered from the middle and from both eyes.
// Depth is exact, 8-bit 1 / metres, or 8-bit and blurred over 9 pixels, with sharpened or unchanged edges. PSNR of
// display-encoded colours, separately for the surfaces that the middle sees, and for the others.
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "bench/measure.h"
#include "ods/convert/convert.h"
#include "ods/depth/picture_depth.h"
#include "ods/kernel/camera/project.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "tests/support/places.h"
#include "tests/support/stored_pictures.h"

namespace {

using namespace ods;

// --- speed -----------------------------------------------------------------------------------------------------------

// A room with objects in it, metres.
float room_depth(vec3 d) {
  float depth = 1e9f;
  const vec3 half(3.0f, 1.5f, 4.0f);
  for (int i = 0; i < 3; i++) depth = std::min(depth, half[i] / std::max(std::abs(d[i]), 1e-6f));
  const float theta = std::atan2(d.x, -d.z), phi = std::asin(d.y);
  const float u = theta * 4.0f, v = phi * 4.0f;
  const vec2 off(u - std::round(u), v - std::round(v));
  if (length(off) < 0.3f) depth = std::min(depth, 0.7f + 0.2f * std::abs(std::round(u)));
  return depth;
}

MadePicture large_picture() {
  MadePicture made = make_picture(StereoCamera(), {8192, 4096}, {kMono});
  add_layer<uint8_t>(made, {"R", "G", "B"}, LayerRule::kLight, SampleType::kUint8, [](int, vec2 uv, float* out) {
    const int x = static_cast<int>(uv.x * 8192.0f), y = static_cast<int>(uv.y * 4096.0f);
    for (int c = 0; c < 3; c++) out[c] = static_cast<float>((x * 7 + y * 13 + (x / 97 + y / 61) * 50 + c * 31) % 256);
  });
  const Camera camera = make_camera(StereoCamera());
  add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat,
                   [&](int, vec2 uv, float* out) { *out = room_depth(camera_ray(camera, kMono, uv).direction); });
  return made;
}

// CPU seconds for every eighth row of all eyes.
double seconds_of_rows(const MadePicture& made, const ConvertTarget& target, int64_t& pixels) {
  const Conversion conversion = convert(made.picture, target);
  std::vector<float> row(static_cast<size_t>(target.eye.width) * count_channels(conversion.rows.layers));
  pixels = 0;
  tbb::task_arena one(1);
  Seconds seconds;
  one.execute([&] {
    seconds = seconds_of([&] {
      for (size_t eye = 0; eye < target.eyes.size(); eye++) {
        for (int y = 0; y < target.eye.height; y += 8) {
          conversion.rows.fill(static_cast<int>(eye), y, row);
          pixels += target.eye.width;
        }
      }
    });
  });
  return seconds.cpu;
}

void speed(benchmark::State& state) {
  const MadePicture made = large_picture();
  for (auto _ : state) {
    ConvertTarget moved = target_of(made, StereoCamera().projection, made.picture.size);
    moved.eyes = {kLeft, kRight}, moved.holes = Holes::kFilled;
    moved.camera.top = moved.camera.bottom = kUsualMerge;
    ConvertTarget turned = target_of(made, StereoCamera().projection, made.picture.size);
    turned.camera.yaw = 0.015f;
    int64_t pixels = 0, others = 0;
    const double ours = seconds_of_rows(made, moved, pixels), bare = seconds_of_rows(made, turned, others);
    state.counters["Mpixel_s"] = 1e-6 * static_cast<double>(pixels) / ours;
    state.counters["resampling_Mpixel_s"] = 1e-6 * static_cast<double>(others) / bare;
  }
}

// --- quality ---------------------------------------------------------------------------------------------------------

enum class DepthCase { kExact, kCodes, kBlurred, kBlurredAsIs };

struct Views {
  MadePicture middle;  // with exact depth
  Picture truth;
};

std::vector<EyeImage> rendered(const Scene& scene, const StereoCamera& camera, Eyes eyes) {
  RenderOptions options;
  options.width = 1024, options.height = 512;
  options.eyes = eyes, options.samples = 16, options.bounces = 0;
  options.even_noise = false;
  return render_cpu(scene, camera, options, {}).eyes;
}

Views views_of(const std::string& name) {
  const Scene scene = load_scene(name);
  StereoCamera camera;
  camera.position = default_view(scene).position;
  std::vector<EyeImage> middle = rendered(scene, camera, Eyes::kMonoEye);
  Views views{make_picture(camera, {1024, 512}, {kMono}), {rendered(scene, camera, Eyes::kBothEyes), 0.0}};
  const auto at = [](vec2 uv) { return std::pair(static_cast<int>(uv.x * 1024.0f), static_cast<int>(uv.y * 512.0f)); };
  add_colour(views.middle,
             [&](int, vec2 uv, float* out) { std::copy_n(middle[0].albedo.at(at(uv).first, at(uv).second), 3, out); });
  add_layer<float>(views.middle, {"Z"}, LayerRule::kNearest, SampleType::kFloat,
                   [&](int, vec2 uv, float* out) { *out = *middle[0].depth.at(at(uv).first, at(uv).second); });
  return views;
}

float depth_of(const StoredPicture& picture, int x, int y) {
  const LayerPixels& layer = picture.eyes[0].layers.back();
  float depth;
  std::memcpy(&depth, layer.first + y * layer.row_stride + x * layer.pixel_stride, sizeof depth);
  return depth;
}

// Degrades the depth as if delivered by another program; exact depth is not changed.
void spoil(MadePicture& made, DepthCase how) {
  if (how == DepthCase::kExact) return;
  DepthNumbers depth{Image(1024, 512, 1), 255, "depth.png"};
  float nearest = 1e9f;
  for (int i = 0; i < 1024 * 512; i++) nearest = std::min(nearest, depth_of(made.picture, i % 1024, i / 1024));
  for (int i = 0; i < 1024 * 512; i++) {
    depth.numbers.pixels[static_cast<size_t>(i)] = nearest / depth_of(made.picture, i % 1024, i / 1024);
  }
  const int reach = how == DepthCase::kCodes ? 0 : 4;
  for (const int down : {0, 1}) {
    const Image from = depth.numbers;
    for (int i = 0; i < 1024 * 512; i++) {
      float sum = 0.0f;
      for (int k = -reach; k <= reach; k++) {
        const int x = (i % 1024 + (down ? 0 : k) + 1024) % 1024, y = std::clamp(i / 1024 + (down ? k : 0), 0, 511);
        sum += *from.at(x, y);
      }
      depth.numbers.pixels[static_cast<size_t>(i)] = sum / static_cast<float>(2 * reach + 1);
    }
  }
  for (float& value : depth.numbers.pixels) value = std::round(255.0f * value) / 255.0f;
  DepthOptions options;
  options.format.kind = DepthKind::kDisparity, options.format.nearest = nearest;
  if (how == DepthCase::kBlurredAsIs) options.edges = DepthEdges::kSoft;
  add_depth(made.picture, {depth}, options);
}

bool middle_sees(const StoredPicture& middle, const Ray& ray, float depth) {
  if (!is_surface(depth)) return true;
  const Camera camera = make_camera(middle.camera);
  const ImagePosition at = project_point(camera, kMono, ray.origin + ray.direction * depth);
  const int x = std::clamp(static_cast<int>(at.uv.x * 1024.0f), 0, 1023);
  const int y = std::clamp(static_cast<int>(at.uv.y * 512.0f), 0, 511);
  return depth_of(middle, x, y) > 0.97f * at.depth;
}

struct Score {
  double squares = 0.0;
  int64_t count = 0;
  double psnr() const { return -10.0 * std::log10(squares / static_cast<double>(3 * std::max<int64_t>(count, 1))); }
};

void quality(benchmark::State& state, const std::string& scene, DepthCase how) {
  if (scene.ends_with(".glb") && !std::filesystem::exists(scene)) return state.SkipWithError("the scene is not there");
  for (auto _ : state) {
    const Views exact = views_of(scene);
    Views views = exact;
    spoil(views.middle, how);
    ConvertTarget target = target_of(views.middle, StereoCamera().projection, {1024, 512});
    target.eyes = {kLeft, kRight}, target.holes = Holes::kFilled;
    const std::vector<Image> made = images_of(convert(views.middle.picture, target).rows);
    Score outside, inside;
    const Camera camera = make_camera(target.camera);
    for (size_t eye = 0; eye < 2; eye++) {
      const EyeImage& truth = views.truth.eyes[eye];
      for (int i = 0; i < 1024 * 512; i++) {
        const int x = i % 1024, y = i / 1024;
        const vec2 uv((static_cast<float>(x) + 0.5f) / 1024.0f, (static_cast<float>(y) + 0.5f) / 512.0f);
        const bool is_seen =
            middle_sees(exact.middle.picture, camera_ray(camera, truth.eye, uv), *truth.depth.at(x, y));
        Score& score = is_seen ? outside : inside;
        score.count++;
        for (int c = 0; c < 3; c++) {
          const float off = srgb_encode(std::clamp(made[eye].at(x, y)[c], 0.0f, 1.0f)) -
                            srgb_encode(std::clamp(truth.albedo.at(x, y)[c], 0.0f, 1.0f));
          score.squares += double{off} * double{off};
        }
      }
    }
    state.counters["outside_dB"] = outside.psnr();
    state.counters["inside_dB"] = inside.psnr();
    state.counters["inside_percent"] = 100.0 * static_cast<double>(inside.count) / (2.0 * 1024 * 512);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("speed", speed)->Iterations(1)->Unit(benchmark::kSecond);
  const std::pair<const char*, DepthCase> kCases[] = {{"exact", DepthCase::kExact},
                                                      {"8_bits", DepthCase::kCodes},
                                                      {"8_bits_blurred", DepthCase::kBlurred},
                                                      {"8_bits_blurred_as_is", DepthCase::kBlurredAsIs}};
  for (const std::string& scene : {std::string("room"), std::string("toys"), shared_scenes() + "/atrium.glb"}) {
    for (const auto& [name, how] : kCases) {
      const std::string shown = std::filesystem::path(scene).stem().native();
      benchmark::RegisterBenchmark((shown + "/" + name).c_str(), [=, how = how](benchmark::State& state) {
        quality(state, scene, how);
      })->Iterations(1);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
