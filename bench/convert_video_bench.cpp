// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Speed of video conversions, relative to the ffmpeg program's v360 (lanczos) with the same encoder and settings,
// alternating in the same run; and the accuracy of both relative to the world in the video, which is a formula.
// over_v360: our CPU seconds over its; below 1 is faster. bare: decoded and converted, but not encoded.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "bench/measure.h"
#include "ods/convert/video/convert_video.h"

namespace {

using namespace ods;

// --- the world -------------------------------------------------------------------------------------------------------

// Display-encoded, grey: waves down to a few pixels at 3840 pixels around, and edges.
float world(vec3 d, int eye) {
  const float wave = 0.12f * std::sin(40.0f * d.x + 9.0f * d.y) + 0.12f * std::sin(90.0f * d.y - 30.0f * d.z) +
                     0.08f * std::sin(700.0f * d.x + 300.0f * d.z) + 0.06f * std::sin(900.0f * d.y);
  const bool edge = std::sin(12.0f * d.x + 1.5f * static_cast<float>(eye)) * std::sin(11.0f * d.y) > 0.3f;
  return 0.45f + wave + (edge ? 0.12f : 0.0f);
}

// An eye's picture of the world, each pixel the mean light over its area. Moved to the right by `turn` degrees.
std::vector<float> picture_of_world(Extent eye, vec2 longitude, int which, float turn) {
  constexpr int kSamples = 3;  // per side of a pixel
  std::vector<float> codes(static_cast<size_t>(eye.width) * static_cast<size_t>(eye.height));
  const auto radians = [](float degrees) { return degrees * (std::acos(-1.0f) / 180.0f); };
  for (int y = 0; y < eye.height; y++) {
    for (int x = 0; x < eye.width; x++) {
      float light = 0.0f;
      for (int i = 0; i < kSamples * kSamples; i++) {
        const float u = (static_cast<float>(x) + (static_cast<float>(i % kSamples) + 0.5f) / kSamples) /
                        static_cast<float>(eye.width);
        const float v = (static_cast<float>(y) + (static_cast<float>(i / kSamples) + 0.5f) / kSamples) /
                        static_cast<float>(eye.height);
        const float theta = radians(longitude.x + (longitude.y - longitude.x) * u + turn),
                    phi = radians(90.0f - 180.0f * v);
        light += srgb_decode(
            world({std::cos(phi) * std::sin(theta), std::sin(phi), -std::cos(phi) * std::cos(theta)}, which));
      }
      codes[static_cast<size_t>(y) * static_cast<size_t>(eye.width) + static_cast<size_t>(x)] =
          srgb_encode(light / (kSamples * kSamples));
    }
  }
  return codes;
}

// Frame `number` of the video: the world turns by four pixels a frame, and has grain.
std::shared_ptr<VideoFrame> frame_of_world(const std::vector<std::vector<float>>& eyes, Extent eye, int number,
                                           float grain) {
  auto frame = std::make_shared<VideoFrame>(packed_size(Layout::kTopBottom, eye, 2), Packing{});
  for (int i = 0; i < 2; i++) {
    const EyeCorner corner = eye_corner(Layout::kTopBottom, eye, i);
    const auto rows = [&](int y, std::span<float> row) {
      uint32_t random = static_cast<uint32_t>(1 + y + 8192 * i + 16384 * number);
      const size_t width = static_cast<size_t>(eye.width);
      for (size_t x = 0; x < width; x++) {
        random = random * 1664525u + 1013904223u;
        const float code = eyes[static_cast<size_t>(i)]
                               [static_cast<size_t>(y) * width + (x + 4 * static_cast<size_t>(number)) % width] +
                           grain * (static_cast<float>(random >> 24) / 255.0f - 0.5f);
        for (size_t c = 0; c < 3; c++) row[x + c * width] = code;
      }
    };
    put_ycbcr(rows, eye, frame->planes().at(corner.x, corner.y));
  }
  return frame;
}

std::string make_video(const Folder& folder, Extent eye, int frames, int quality, float grain) {
  const std::string path = folder.path("from_360_TB.mp4");
  std::vector<std::vector<float>> eyes;
  for (int i = 0; i < 2; i++) eyes.push_back(picture_of_world(eye, {-180.0f, 180.0f}, i, 0.0f));
  NewVideo video;
  video.size = packed_size(Layout::kTopBottom, eye, 2);
  video.options.packing.quality = quality;
  video.options.preset = "ultrafast";
  video.metadata.stereo = VideoStereo::kTopBottom;
  video.metadata.projection = VideoProjection::kEquirect;
  int next = 0;
  write_video(
      video,
      [&]() -> std::optional<PendingFrame> {
        if (next == frames) return std::nullopt;
        const int number = next++;
        return PendingFrame{{number, 1}, [&, number] { return frame_of_world(eyes, eye, number, grain); }};
      },
      path);
  return path;
}

// --- speed --------------------------------------------------------------------------------------------------------

struct Case {
  const char* name;
  float yaw;
  int width;  // per eye; 1920 is the video's own resolution
};
// A vr180 picture cut out of a whole sphere is a part of its pixels, unless it is turned or of another size.
constexpr Case kCases[] = {{"vr180", 0.0f, 1920}, {"vr180 turned", 7.3f, 1920}, {"vr180 of 2/3", 7.3f, 1280}};

ConvertTarget target_of(const Case& wish, const StoredPicture& prototype) {
  ConvertTarget target = same_format(prototype);
  target.camera.projection = find_projection("vr180")->setting;
  turn(target.camera, wish.yaw, 0.0f, 0.0f);
  target.eye = {wish.width * prototype.size.width / 3840, wish.width * prototype.size.width / 3840};
  return target;
}

std::string v360(const Case& wish, Extent eye, const char* interpolation) {
  return fmt::format("v360=e:he:in_stereo=tb:out_stereo=sbs:w={}:h={}:yaw={}:interp={}", eye.width, eye.height,
                     wish.yaw, interpolation);
}

bool has_programs(benchmark::State& state) {
  if (std::system("command -v ffmpeg > /dev/null") != 0)
    state.SkipWithError("skipped: ffmpeg is not installed");
  else if (!has_encoder("libx264"))
    state.SkipWithError("skipped: this machine has no libx264");
  else
    return true;
  return false;
}

void convert(benchmark::State& state) {
  const Case& wish = kCases[state.range(0)];
  const Extent eye{static_cast<int>(state.range(1)), static_cast<int>(state.range(1)) / 2};
  const int frames = static_cast<int>(state.range(2));
  if (!has_programs(state)) return;
  const Folder folder;
  const std::string from = make_video(folder, eye, frames, 20, 0.02f);
  EncodeOptions options;
  options.packing.quality = 20;
  const ConvertTarget target = target_of(wish, open_video(from).prototype);
  const std::string command = fmt::format(
      "ffmpeg -v error -y -i {} -vf {} -c:v libx264 -preset medium -crf 20 -g 30 -flags +cgop -movflags +faststart {}",
      from, v360(wish, target.eye, "lanczos"), folder.path("theirs.mp4"));
  const std::string pictures =
      fmt::format("ffmpeg -v error -y -i {} -vf {} -f null -", from, v360(wish, target.eye, "lanczos"));
  Seconds ours{1e9, 1e9}, theirs{1e9, 1e9}, ours_bare{1e9, 1e9}, theirs_bare{1e9, 1e9};
  const auto keep_least = [](Seconds& minimum, const Seconds& now) {
    minimum = {std::min(minimum.wall, now.wall), std::min(minimum.cpu, now.cpu)};
  };
  const auto run = [&](const std::string& line) {
    if (std::system(line.c_str()) != 0) state.SkipWithError("ffmpeg failed");
  };
  for (auto round : state) {
    static_cast<void>(round);
    keep_least(theirs, seconds_of([&] { run(command); }));
    forget_peak();
    keep_least(ours, seconds_of([&] {
                 Footage video(from, {});
                 convert_video(video, {target, Layout::kSideBySide, {}, {}}, options, folder.path("ours.mp4"));
               }));
    state.counters["peak_MB"] = peak_megabytes();
    keep_least(theirs_bare, seconds_of([&] { run(pictures); }));
    forget_peak();
    keep_least(
        ours_bare, seconds_of([&] {
          Footage video(from, {});
          const FrameConverter converter(video.video(), video.stream(), target, {Layout::kSideBySide, {}, {}}, false);
          while (const auto frame = video.next()) converter.convert(*frame, {0.0f, 0.0f, 0.0f});
        }));
    state.counters["bare_peak_MB"] = peak_megabytes();
  }
  state.SetLabel(wish.name);
  state.counters["frames/s"] = frames / ours.wall;
  state.counters["over_v360"] = ours.cpu / theirs.cpu;
  state.counters["over_v360_wall"] = ours.wall / theirs.wall;
  state.counters["bare_over_v360"] = ours_bare.cpu / theirs_bare.cpu;
  state.counters["bare_ms"] = 1000.0 * ours_bare.cpu / frames;
  state.counters["theirs_bare_ms"] = 1000.0 * theirs_bare.cpu / frames;
  state.counters["bytes_over_ffmpeg"] = static_cast<double>(std::filesystem::file_size(folder.path("ours.mp4"))) /
                                        static_cast<double>(std::filesystem::file_size(folder.path("theirs.mp4")));
}
BENCHMARK(convert)
    ->ArgsProduct({{0, 1, 2}, {3840}, {24}})
    ->Args({0, 7680, 8})
    ->Iterations(2)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

// --- accuracy --------------------------------------------------------------------------------------------------------

double psnr(const std::vector<float>& codes, const std::function<double(size_t x, size_t y)>& luma, Extent eye) {
  double sum = 0.0;
  for (size_t y = 0; y < static_cast<size_t>(eye.height); y++) {
    for (size_t x = 0; x < static_cast<size_t>(eye.width); x++) {
      const double code = (luma(x, y) - 16.0) / 219.0,
                   right = static_cast<double>(codes[y * static_cast<size_t>(eye.width) + x]);
      sum += (code - right) * (code - right);
    }
  }
  return -10.0 * std::log10(sum / static_cast<double>(codes.size()));
}

// The left eye's luma, with the widest filters of both.
void nearness(benchmark::State& state) {
  const Case& wish = kCases[state.range(0)];
  if (!has_programs(state)) return;
  const Folder folder;
  const std::string from = make_video(folder, {3840, 1920}, 1, 0, 0.0f);
  const ConvertTarget target = target_of(wish, open_video(from).prototype);
  const Extent eye = target.eye;
  const std::vector<float> right = picture_of_world(eye, {-90.0f, 90.0f}, 0, wish.yaw);
  for (auto round : state) {
    static_cast<void>(round);
    Footage video(from, {});
    const FrameConverter converter(video.video(), video.stream(), target, {Layout::kSideBySide, {}, {}}, false);
    const auto frame = converter.convert(*video.next(), {0.0f, 0.0f, 0.0f});
    const Planes planes = frame->planes();
    state.counters["ours_dB"] = psnr(
        right, [&](size_t x, size_t y) { return static_cast<double>(planes.first[0][y * planes.stride[0] + x]); }, eye);
    for (const char* interpolation : {"linear", "cubic", "lanczos"}) {
      const std::string raw = folder.path("theirs.raw");
      const std::string command = fmt::format("ffmpeg -v error -y -i {} -vf {} -pix_fmt yuv420p -f rawvideo {}", from,
                                              v360(wish, eye, interpolation), raw);
      if (std::system(command.c_str()) != 0) return state.SkipWithError("ffmpeg failed");
      std::ifstream file(raw, std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(file), {}};
      const auto luma = [&](size_t x, size_t y) {
        return static_cast<double>(static_cast<unsigned char>(bytes[y * 2 * static_cast<size_t>(eye.width) + x]));
      };
      state.counters[fmt::format("v360_{}_dB", interpolation)] = psnr(right, luma, eye);
    }
  }
  state.SetLabel(wish.name);
}
BENCHMARK(nearness)->DenseRange(0, 2)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
