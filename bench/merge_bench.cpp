// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Cost of merging parts of a picture, until its .exr is written: time relative to merely reading all their pixels, and
// memory. Targets: 1.5 times, and below 1000 MB for 64 parts of 4096x4096 pixels with both eyes in them.
//
//   merge_bench                          64 parts of 1024x1024: 0.1 GB of disk
//   merge_bench --width 4096             64 of 4096x4096: 1.1 GB of disk, 2 GB of memory to make them
//   merge_bench --width 4096 --parts 8   an eighth of the time; work done once for all parts weighs eight times
//
// The sums are noise, which compresses as badly as a rendering's. All parts are the same file under different names, so
// that the disk is not measured.
#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "bench/measure.h"
#include "ods/base/large_blocks.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/render/part_file.h"

namespace {

using namespace ods;

std::map<std::string, int> wishes = {{"--width", 1024}, {"--parts", 64}};

RenderOptions whole_picture() {
  RenderOptions options;
  options.width = wishes["--width"], options.height = options.width / 2;
  options.samples = 16 * wishes["--parts"];
  options.statistics = true;
  return options;
}

uint64_t noise(uint64_t n) {
  n = (n ^ n >> 31) * 0x9e3779b97f4a7c15u;
  return n ^ n >> 29;
}

// Sums of 16 samples: light near 1, its squares, layers.
void fill(PictureSamples& samples, uint64_t seed) {
  for (EyeSamples& eye : samples.eyes) {
    each_plane(eye, [&]<typename Number>(const char*, std::vector<Number>& plane) {
      for (Number& number : plane) {
        const uint64_t bits = noise(++seed);
        number = sizeof(Number) == 8 ? static_cast<Number>(bits >> 36) : static_cast<Number>(bits >> 40);
        if (std::is_floating_point_v<Number>) number /= Number{1 << 20};
      }
    });
    std::ranges::fill(eye.count, 16u);
  }
}

std::vector<std::string> make_parts(const Folder& folder) {
  SampledPicture about;
  about.options = whole_picture();
  about.camera = write_sidecar({StereoCamera(), {about.options.width, about.options.height}});
  about.options.part = {1, wishes["--parts"]};
  PictureSamples samples = no_samples(about.options);
  fill(samples, 0);
  std::vector<std::string> parts = {save_part(folder.path("part_1.exr"), about, samples)};
  for (int number = 2; number <= wishes["--parts"]; number++) {
    parts.push_back(folder.path(fmt::format("part_{}.exr", number)));
    std::filesystem::create_hard_link(parts.front(), parts.back());
  }
  return parts;
}

void read_all(const std::vector<std::string>& parts) {
  std::vector<std::byte> bytes;
  for (const std::string& part : parts) {
    const auto rows = open_rows(part);
    const FileInfo& info = rows->info();
    size_t pixel = 0;
    for (const SampleType sample : info.samples) pixel += bytes_of(sample);
    bytes.resize(pixel * static_cast<size_t>(info.width) * static_cast<size_t>(rows->band_rows()));
    for (int begin = 0; begin < info.height; begin += rows->band_rows()) {
      rows->read(begin, std::min(begin + rows->band_rows(), info.height), info.channels.size(), bytes.data());
      benchmark::DoNotOptimize(bytes.data());
    }
  }
}

void merge(benchmark::State& state) {
  const Folder folder;
  const std::vector<std::string> parts = make_parts(folder);
  for (auto _ : state) {
    RenderOptions options = whole_picture();
    options.statistics = false;  // no denoising
    forget_peak();
    const Seconds ours =
        seconds_of([&] { save_picture(merge_parts(parts, options), StereoCamera(), {}, folder.path("whole.exr")); });
    state.counters["peak_MB"] = peak_megabytes();
    say(state, ours, seconds_of([&] { read_all(parts); }));
    state.counters["part_MB"] = static_cast<double>(std::filesystem::file_size(parts[0])) / (1 << 20);
  }
}

}  // namespace

int main(int argc, char** argv) {
  ods::return_large_blocks();  // like in the command
  benchmark::Initialize(&argc, argv);
  for (int i = 1; i + 1 < argc; i += 2) wishes.at(argv[i]) = std::max(std::atoi(argv[i + 1]), 2);
  const std::string name = fmt::format("merge/{}/{}", wishes["--width"], wishes["--parts"]);
  benchmark::RegisterBenchmark(name.c_str(), merge)->Iterations(1)->Unit(benchmark::kSecond);
  benchmark::RunSpecifiedBenchmarks();
}
