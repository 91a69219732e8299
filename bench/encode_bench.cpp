// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Speed of encoding frames to a video, relative to the ffmpeg program on the same frames with the same encoder and
// settings, alternating in the same run. The frames have gradients, edges and moving grain, so that they compress about
// as slowly as photographs. above_ffmpeg: 1 is as fast, more is faster; by wall clock and, for machines with other
// work, by CPU seconds. Also the speed of compositing a title over a video, relative to the ffmpeg program decoding and
// encoding it alone.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <sstream>

#include "bench/measure.h"
#include "ods/compose/over_video.h"
#include "ods/picture/save.h"
#include "ods/video/make_video.h"

namespace {

using namespace ods;

constexpr int kFrames = 48;

PictureRows frame(int width, int number) {
  PictureRows rows;
  rows.eye = {width, width / 2};
  rows.eyes = {kLeft, kRight};
  rows.layers = {{{"R", "G", "B"}}};
  rows.fill = [=](int eye, int y, std::span<float> row) {
    std::minstd_rand random(static_cast<unsigned>(1 + y + 65536 * eye));
    for (int x = 0; x < width; x++) {
      const float u = static_cast<float>(x + 4 * number) / static_cast<float>(width),
                  v = static_cast<float>(2 * y) / static_cast<float>(width);
      const float edge = std::fmod(8.0f * u + 3.0f * v, 1.0f) < 0.5f ? 0.25f : 0.0f;
      const float grain = static_cast<float>(random() % 64) / 1600.0f;
      for (int c = 0; c < 3; c++) {
        row[static_cast<size_t>(3 * x + c)] =
            0.3f + 0.25f * std::sin(6.28f * u + static_cast<float>(c)) * v + edge + grain;
      }
    }
  };
  return rows;
}

// Alternates ours and theirs, and takes the minimum of each, because the machine has other work.
struct Race {
  Seconds ours{1e9, 1e9}, theirs{1e9, 1e9};

  void round(benchmark::State& state, const std::string& command, const std::function<void()>& work) {
    keep_least(theirs, seconds_of([&] {
                 if (std::system(command.c_str()) != 0) state.SkipWithError("ffmpeg failed");
               }));
    keep_least(ours, seconds_of(work));
  }
  static void keep_least(Seconds& minimum, const Seconds& now) {
    minimum = {std::min(minimum.wall, now.wall), std::min(minimum.cpu, now.cpu)};
  }
};

struct Settings {
  const char* encoder;
  VideoCodec codec;
  const char* preset_option;
  const char* preset;
};
constexpr Settings kSettings[] = {{"libx264", VideoCodec::kH264, "-preset", "medium"},
                                  {"libx264", VideoCodec::kH264, "-preset", "ultrafast"},
                                  {"libx265", VideoCodec::kHevc, "-preset", "ultrafast"},
                                  {"libsvtav1", VideoCodec::kAv1, "-preset", "12"}};

// The options with which ffmpeg makes the same pictures: the matrix and the rounding are not its defaults.
std::string ffmpeg_words(const Settings& settings, const std::string& frames, const std::string& video) {
  std::ostringstream words;
  words << "ffmpeg -v error -y -framerate 30 -i " << frames
        << " -vf scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p"
        << " -c:v " << settings.encoder << " " << settings.preset_option << " " << settings.preset
        << " -crf 24 -g 30 -flags +cgop -colorspace bt709 -color_primaries bt709 -color_trc bt709 -color_range tv"
        << " -movflags +faststart " << video;
  if (std::string(settings.encoder) == "libx265") return words.str() + " -x265-params log-level=none:open-gop=0";
  return words.str();
}

void encode(benchmark::State& state) {
  const Settings& settings = kSettings[state.range(0)];
  const int width = static_cast<int>(state.range(1));
  if (std::system("command -v ffmpeg > /dev/null") != 0) return state.SkipWithError("skipped: ffmpeg is not installed");
  if (!has_encoder(settings.encoder)) return state.SkipWithError("skipped: this machine has no such encoder");
  setenv("SVT_LOG", "0", 0);
  const Folder folder;
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  for (int i = 1; i <= kFrames; i++) {
    const FrameNames names = *frame_names(folder.path("frame.####.png"));
    save_picture(frame(width, i), nullptr, save, names.path(i));
  }
  EncodeOptions options;
  options.packing = {settings.codec, 8, Chroma::k420, 24};
  options.encoder = settings.encoder;
  options.preset = settings.preset;
  const std::string command = ffmpeg_words(settings, folder.path("frame.%04d.png"), folder.path("theirs.mp4"));
  Race race;
  for (auto round : state) {
    static_cast<void>(round);
    race.round(state, command, [&] {
      const FrameFiles files = find_frames(folder.path("frame.####.png"));
      make_video(files, plan_video(files, {}, {}), {}, options, folder.path("ours.mp4"));
    });
  }
  state.SetLabel(std::string(settings.encoder) + " " + settings.preset);
  state.counters["frames/s"] = kFrames / race.ours.wall;
  state.counters["above_ffmpeg"] = race.theirs.wall / race.ours.wall;
  state.counters["above_ffmpeg_cpu"] = race.theirs.cpu / race.ours.cpu;
  state.counters["bytes_over_ffmpeg"] = static_cast<double>(std::filesystem::file_size(folder.path("ours.mp4"))) /
                                        static_cast<double>(std::filesystem::file_size(folder.path("theirs.mp4")));
}
BENCHMARK(encode)->ArgsProduct({{0, 1, 2, 3}, {1024}})->Iterations(3)->Unit(benchmark::kSecond)->UseRealTime();

// A title: white, 40 degrees wide and 8 high, its edges soft.
PictureRows title(int width) {
  PictureRows rows;
  rows.eye = {width, width / 2};
  rows.eyes = {kLeft, kRight};
  rows.layers = {{{"R", "G", "B", "A"}}};
  rows.fill = [=](int, int y, std::span<float> row) {
    for (int x = 0; x < width; x++) {
      const float theta = 360.0f * (static_cast<float>(x) / static_cast<float>(width) - 0.5f),
                  phi = 180.0f * (2.0f * static_cast<float>(y) / static_cast<float>(width) - 0.5f);
      const float alpha = std::clamp(5.0f * std::min(20.0f - std::abs(theta), 4.0f - std::abs(phi)), 0.0f, 1.0f);
      for (size_t c = 0; c < 4; c++) row[4 * static_cast<size_t>(x) + c] = alpha;
    }
  };
  return rows;
}

void over(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0)), frames = 12;
  if (std::system("command -v ffmpeg > /dev/null") != 0) return state.SkipWithError("skipped: ffmpeg is not installed");
  if (!has_encoder("libx264")) return state.SkipWithError("skipped: this machine has no libx264");
  const Folder folder;
  EncodeOptions options;
  options.packing = {VideoCodec::kH264, 8, Chroma::k420, 24};
  options.encoder = "libx264";
  options.preset = "ultrafast";
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  for (int i = 1; i <= frames; i++) {
    save_picture(frame(width, i), nullptr, save, frame_names(folder.path("frame.####.png"))->path(i));
  }
  const FrameFiles files = find_frames(folder.path("frame.####.png"));
  make_video(files, plan_video(files, {}, {}), {}, options, folder.path("video.mp4"));
  const StereoCamera camera;
  save_picture(title(width), &camera, save, folder.path("title.exr"));
  const std::string command = "ffmpeg -v error -y -i " + folder.path("video.mp4") +
                              " -c:v libx264 -preset ultrafast -crf 24 -g 30 -flags +cgop -movflags +faststart " +
                              folder.path("theirs.mp4");
  Race race;
  for (auto round : state) {
    static_cast<void>(round);
    race.round(state, command, [&] {
      Footage back(folder.path("video.mp4"), {}), front(folder.path("title.exr"), {});
      over_video(back, front, 0, frames, {}, options, folder.path("ours.mp4"));
    });
  }
  const double pixels = 1.0 * width * width * frames;
  state.counters["Mpixel/s"] = pixels / race.ours.wall * 1e-6;
  state.counters["above_decode_encode"] = race.theirs.wall / race.ours.wall;
  state.counters["above_decode_encode_cpu"] = race.theirs.cpu / race.ours.cpu;
}
BENCHMARK(over)->Arg(4096)->Iterations(3)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
