// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Duration of conversions, relative to baselines measured in the same run: only reading and writing the same files, and
// resizing by the program oiiotool and the ffmpeg program's v360 if they are installed. Wall clock, and CPU seconds for
// machines with other work. The pictures have gradients, edges and grain, so that they compress about as slowly as
// photographs.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "bench/bare_file.h"
#include "bench/measure.h"
#include "ods/base/error.h"
#include "ods/convert/convert.h"
#include "ods/files/scratch.h"

namespace {

using namespace ods;
namespace fs = std::filesystem;

float grain(int x, int y) {
  uint32_t n = static_cast<uint32_t>(x) * 374761393u + static_cast<uint32_t>(y) * 668265263u;
  n = (n ^ n >> 13) * 1274126177u;
  return static_cast<float>(n >> 16 & 255u) / 255.0f - 0.5f;
}

void make_picture(const std::string& path, const std::vector<int>& eyes, Extent eye) {
  PictureRows rows;
  rows.eye = eye;
  rows.eyes = eyes;
  rows.layers = {{{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf}};
  rows.fill = [eye](int index, int y, std::span<float> row) {
    const float v = static_cast<float>(y) / static_cast<float>(eye.height);
    for (int x = 0; x < eye.width; x++) {
      const float u = static_cast<float>(x) / static_cast<float>(eye.width);
      const bool tile = (x / 97 + y / 61 + index) % 5 == 0;
      for (int c = 0; c < 3; c++) {
        const float wave = 0.5f + 0.4f * std::sin(20.0f * u + 9.0f * v * static_cast<float>(c + 1));
        const float value = (tile ? 0.3f : 1.0f) * wave + 0.01f * grain(x, y);
        row[static_cast<size_t>(3 * x + c)] = std::max(value, 0.0f);
      }
    }
  };
  SaveOptions options;
  options.tone = ToneCurve::kLinear;
  const StereoCamera camera;
  save_picture(rows, &camera, options, path);
}

// The job of `ods convert`, from file to file.
void convert_file(const std::string& from, const std::string& to, const ProjectionSetting& projection,
                  std::optional<Extent> eye, const std::string& scratch_folder) {
  OpenOptions open;
  open.scratch_folder = scratch_folder;
  const StoredPicture picture = open_picture(from, open);
  ConvertTarget target = same_format(picture);
  target.camera.projection = projection;
  target.eye = eye.value_or(fitting_extent(picture, projection));
  const std::string fault = conversion_fault(picture, target);
  if (!fault.empty()) throw Error(ErrorKind::kInput, fault);
  Conversion conversion = convert(picture, target);
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  save_picture(conversion.rows, &target.camera, save, to);
}

// 8192x8192 top-bottom lat-long to 3x2 cubes of the same sharpness. Target: a ratio of 2 or less.
void cubes(benchmark::State& state, const std::string& extension) {
  const Folder folder;
  const std::string from = folder.path("from." + extension), to = folder.path("to." + extension);
  make_picture(from, {kLeft, kRight}, {8192, 4096});
  const ProjectionSetting projection = find_projection("cube-3x2")->setting;
  for (auto _ : state) {
    forget_peak();
    const Seconds ours = seconds_of([&] { convert_file(from, to, projection, {}, folder.path()); });
    state.counters["peak_MB"] = peak_megabytes();
    const BareFile written = read_bare(to);
    const Seconds bare = seconds_of([&] {
      benchmark::DoNotOptimize(read_bare(from));
      write_bare(folder.path("bare." + extension), written);
    });
    say(state, ours, bare);
    state.counters["width"] = written.info.width;
  }
}

// Mono 8192x4096 to cubes against the ffmpeg program's v360, from file to file too, by its widest filter. It only
// interpolates: if a face is coarser than the picture, it skips texels.
void v360(benchmark::State& state, const std::string& extension) {
  const Folder folder;
  const std::string from = folder.path("from." + extension), to = folder.path("to." + extension);
  make_picture(from, {kMono}, {8192, 4096});
  for (auto _ : state) {
    const Seconds ours =
        seconds_of([&] { convert_file(from, to, find_projection("cube-3x2")->setting, {}, folder.path()); });
    const FileInfo size = read_info(to);
    const std::string command = fmt::format("ffmpeg -v error -i {} -vf v360=e:c3x2:interp=lanczos:w={}:h={} {}", from,
                                            size.width, size.height, folder.path("theirs." + extension));
    int failed = 0;
    const Seconds theirs = seconds_of([&] { failed = std::system(command.c_str()); });
    if (failed) return state.SkipWithError("ffmpeg failed");
    say(state, ours, theirs);
  }
}

bool has_ffmpeg() {
  return std::system("ffmpeg -version > /dev/null 2>&1") == 0;
}

// Mono 8192x4096 to 4096x2048, against a lanczos resize of the whole picture. Target: below 1.
void halved(benchmark::State& state, const std::string& extension) {
  const Folder folder;
  const std::string from = folder.path("from." + extension);
  make_picture(from, {kMono}, {8192, 4096});
  const ProjectionSetting projection = find_projection("lat-long")->setting;
  for (auto _ : state) {
    const std::string to = folder.path("to." + extension);
    const Seconds ours = seconds_of([&] { convert_file(from, to, projection, Extent{4096, 2048}, folder.path()); });
    const std::string command =
        fmt::format("oiiotool {} --resize:filter=lanczos3 4096x2048 -o {}", from, folder.path("theirs." + extension));
    int failed = 0;
    const Seconds theirs = seconds_of([&] { failed = std::system(command.c_str()); });
    if (failed) return state.SkipWithError("oiiotool failed, or there is none");
    say(state, ours, theirs);
  }
}

// The largest readable picture: 16384x16384, both eyes, to cubes. Target: below 2000 MB.
void largest(benchmark::State& state, const std::string& extension) {
  const Folder folder;
  const std::string from = folder.path("from." + extension);
  make_picture(from, {kLeft, kRight}, {16384, 8192});
  for (auto _ : state) {
    forget_peak();
    const double before = peak_megabytes();
    const Seconds ours = seconds_of([&] {
      convert_file(from, folder.path("to." + extension), find_projection("cube-3x2")->setting, {}, folder.path());
    });
    state.counters["ours_s"] = ours.wall;
    state.counters["before_MB"] = before;
    state.counters["peak_MB"] = peak_megabytes();
  }
}

}  // namespace

int main(int argc, char** argv) {
  using Figure = void (*)(benchmark::State&, const std::string&);
  const std::pair<const char*, Figure> figures[] = {{"cubes", cubes}, {"halved", halved}, {"largest", largest}};
  for (const auto& [name, figure] : figures) {
    for (const char* extension : {"png", "exr"}) {
      const auto run = [figure = figure, extension](benchmark::State& state) { figure(state, extension); };
      benchmark::RegisterBenchmark((std::string(name) + "/" + extension).c_str(), run)
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
    }
  }
  if (has_ffmpeg()) {
    const auto run = [](benchmark::State& state) { v360(state, "png"); };
    benchmark::RegisterBenchmark("v360/png", run)->Iterations(1)->Unit(benchmark::kSecond);
  } else {
    std::puts("v360/png: skipped, as there is no ffmpeg program");
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
