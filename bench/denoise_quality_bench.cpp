// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Quality of denoised pictures: denoise_quality_bench [FOLDER [SCENE|all [WIDTH SAMPLES]]]. It renders the pictures
// that are missing in the folder, so a second run, with another denoiser, takes seconds. WIDTH and SAMPLES (of A and B)
// replace a scene's own. small-window and neon-street are files of build/release/kinds_of_scene FOLDER. Results of
// other denoisers, or of an older one, beside a picture (room_16.exr: room_16.LABEL.exr) are judged in the same run.
//
// shown: RMSE of the displayed picture, sRGB, at the exposure that ods render chooses. FLIP: tests/support/flip.h.
// room_16c: with a light cache, as in drafts. plain and edge: shown, for pixels without and with a step in normal or
// albedo beside them. blotch: RMSE of the means of 8x8 pixels, for plain ones only. energy: the sum of light over the
// raw picture's.
//
// The truth is not needed for the errors, see denoise_bench.cpp. The reference of FLIP is the mean of A and B.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "bench/lit_scene.h"
#include "bench/subjects.h"
#include "ods/denoise/denoise.h"
#include "ods/denoise/stored_noise.h"
#include "ods/image/tone.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/render/cpu/render.h"
#include "ods/stage/exposure.h"
#include "tests/support/flip.h"
#include "tests/support/places.h"

namespace {

using namespace ods;
namespace fs = std::filesystem;

struct Row {
  const char* name;
  const char* file = "";  // in the folder or below shared_scenes(); empty for the built-in scene
  int width;
  int samples;  // for A and B
};

constexpr Row kRows[] = {{"room", "", 256, 512},
                         {"interior", "interior.glb", 384, 1024},
                         {"atrium", "atrium.glb", 384, 256},
                         {"toys", "", 384, 256},
                         {"wineglass", "", 384, 256},
                         {"mirrors", "", 384, 256},
                         {"small-window", "small-window.glb", 256, 512},
                         {"neon-street", "neon-street.glb", 256, 512},
                         {"leafy", "leafy.glb", 256, 512}};

constexpr int kCachePaths = 1 << 20;  // the number for a draft of a useful size

struct Opened {
  Picture picture;
  StereoCamera camera;
};

std::string path_of(const Row& row, const fs::path& folder) {
  if (!*row.file) return row.name;
  const fs::path here = folder / row.file;
  return fs::exists(here) ? here : fs::path(shared_scenes()) / row.file;
}

std::optional<Opened> opened(const Row& row, const fs::path& folder, const std::string& file, int samples,
                             uint32_t seed, bool cached = false) {
  const fs::path path = folder / file;
  if (!fs::exists(path)) {
    const std::string from = path_of(row, folder);
    if (*row.file && !fs::exists(from)) return {};
    const Scene scene = *row.file ? lit_scene(from) : load_scene(from, {});
    StereoCamera camera;
    camera.position = default_view(scene).position;
    RenderOptions options;
    options.width = row.width, options.samples = samples, options.seed = seed, options.statistics = true;
    if (cached) options.indirect = Indirect::kCache, options.cache_paths = kCachePaths;
    save_picture(render_cpu(scene, camera, options, {}), camera, {}, path);
  }
  const StoredPicture stored = open_picture(path);
  return Opened{read_noise(stored, {}, path).picture, stored.camera};
}

Picture radiance_of(const fs::path& path) {
  Picture picture;
  for (Image& eye : load_eyes(path).eyes) picture.eyes.emplace_back().radiance = std::move(eye);
  return picture;
}

// The displayed picture, linear or encoded.
Image on_screen(const Image& light, float exposure, bool encode) {
  Image result = light;
  for (size_t i = 0; i < light.pixels.size(); i += 3) {
    const vec3 c =
        tone_map(vec3(light.pixels[i], light.pixels[i + 1], light.pixels[i + 2]), exposure, ToneCurve::kNeutral);
    for (size_t k = 0; k < 3; k++) {
      const float value = c[static_cast<int>(k)];
      result.pixels[i + k] = encode ? srgb_encode(value) : value;
    }
  }
  return result;
}

// 1 for pixels beside a step in normal or albedo.
std::vector<char> edges_of(const EyeImage& eye) {
  const int width = eye.normal.width, height = eye.normal.height;
  std::vector<char> edges(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      float maximum = 0.0f;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
        const int nx = (x + dx + width) % width, ny = std::clamp(y + dy, 0, height - 1);
        for (int c = 0; c < 3; c++) {
          maximum = std::max({maximum, 0.5f * std::abs(eye.normal.at(x, y)[c] - eye.normal.at(nx, ny)[c]),
                              std::abs(eye.albedo.at(x, y)[c] - eye.albedo.at(nx, ny)[c])});
        }
      }
      edges[static_cast<size_t>(y * width + x)] = maximum > 0.05f;
    }
  }
  return edges;
}

struct Judged {
  double shown = 0.0, plain = 0.0, edge = 0.0, blotch = 0.0, flip = 0.0, energy = 0.0;
};

// Sums of products of two errors.
struct Sum {
  double sum = 0.0, count = 0.0;
  void add(double product) { sum += product, count += 1.0; }
  double root() const { return std::sqrt(std::max(sum / std::max(count, 1.0), 0.0)); }
};

class Judge {
 public:
  Judge(const Opened& a, const Opened& b) {
    exposure_ = suitable_exposure(std::vector<Picture>{a.picture}).value_or(0.0f);
    for (size_t e = 0; e < a.picture.eyes.size(); e++) {
      const EyeImage &one = a.picture.eyes[e], &two = b.picture.eyes[e];
      a_.push_back(one.radiance), b_.push_back(two.radiance);
      edges_.push_back(edges_of(one));
      Image mean = one.radiance;
      for (size_t i = 0; i < mean.pixels.size(); i++) mean.pixels[i] = 0.5f * (mean.pixels[i] + two.radiance.pixels[i]);
      mean_.push_back(on_screen(mean, exposure_, false));
    }
  }

  Judged of(const Picture& picture, const Picture& raw) const {
    Sum shown, plain, edge, blotch;
    Judged result;
    double light = 0.0, before = 0.0;
    for (size_t e = 0; e < picture.eyes.size(); e++) {
      const Image& radiance = picture.eyes[e].radiance;
      for (size_t i = 0; i < radiance.pixels.size(); i += 3) {
        const vec3 d = light_at(radiance, i);
        const double product = seen(d, light_at(a_[e], i), light_at(b_[e], i));
        shown.add(product), (edges_[e][i / 3] ? edge : plain).add(product);
        for (size_t c = i; c < i + 3; c++) {
          light += double{radiance.pixels[c]}, before += double{raw.eyes[e].radiance.pixels[c]};
        }
      }
      add_blotches(radiance, e, blotch);
      result.flip +=
          flip_error(mean_[e], on_screen(radiance, exposure_, false)) / static_cast<double>(picture.eyes.size());
    }
    result.shown = shown.root(), result.plain = plain.root(), result.edge = edge.root();
    result.blotch = blotch.root(), result.energy = light / before;
    return result;
  }
  float exposure() const { return exposure_; }

 private:
  static vec3 light_at(const Image& image, size_t i) {
    return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
  }

  // The product of two errors as displayed, mean of the channels: in light, times the tone curve's slope. A noisy truth
  // has the right mean in light, but not after a curve.
  double seen(vec3 d, vec3 a, vec3 b) const {
    const auto shown = [&](vec3 light) {
      const vec3 c = tone_map(light, exposure_, ToneCurve::kNeutral);
      return vec3(srgb_encode(c.x), srgb_encode(c.y), srgb_encode(c.z));
    };
    const vec3 truth = 0.5f * (a + b), apart = abs(d - truth) + 1e-3f * (d + truth) + 1e-6f;
    const vec3 slope = (shown(truth + apart) - shown(max(truth - apart, vec3(0.0f)))) /
                       (truth + apart - max(truth - apart, vec3(0.0f)));
    const vec3 product = (d - a) * (d - b) * slope * slope;
    return double{product.x + product.y + product.z} / 3.0;
  }

  void add_blotches(const Image& d, size_t e, Sum& blotch) const {
    constexpr int kSize = 8;
    for (int y = 0; y + kSize <= d.height; y += kSize) {
      for (int x = 0; x + kSize <= d.width; x += kSize) {
        vec3 mean(0.0f), one(0.0f), two(0.0f);
        float count = 0.0f;
        for (int i = 0; i < kSize * kSize; i++) {
          const int px = x + i % kSize, py = y + i / kSize;
          if (edges_[e][static_cast<size_t>(py * d.width + px)]) continue;
          const size_t at = 3 * static_cast<size_t>(py * d.width + px);
          count += 1.0f, mean += light_at(d, at), one += light_at(a_[e], at), two += light_at(b_[e], at);
        }
        if (count >= kSize * kSize / 2) blotch.add(seen(mean / count, one / count, two / count));
      }
    }
  }

  float exposure_;
  std::vector<Image> a_, b_, mean_;
  std::vector<std::vector<char>> edges_;
};

void print(const std::string& name, const std::string& label, const Judged& judged, double seconds) {
  fmt::print("{:14} {:8} {:7.4f} {:7.4f} {:7.4f} {:7.4f} {:7.4f} {:8.4f} {:7.3f}\n", name, label, judged.shown,
             judged.plain, judged.edge, judged.blotch, judged.flip, judged.energy, seconds);
}

// Other results for the picture in this file.
std::vector<std::pair<std::string, fs::path>> others_of(const fs::path& folder, const std::string& stem) {
  std::vector<std::pair<std::string, fs::path>> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(stem + ".") || !name.ends_with(".exr") || name == stem + ".exr") continue;
    others.push_back({name.substr(stem.size() + 1, name.size() - stem.size() - 5), entry.path()});
  }
  std::sort(others.begin(), others.end());
  return others;
}

void judge_row(const Row& row, const fs::path& folder) {
  const std::string name = row.name;
  const auto a = opened(row, folder, name + "_a.exr", row.samples, 101);
  const auto b = opened(row, folder, name + "_b.exr", row.samples, 102);
  if (!a || !b) return fmt::print("{:14} skipped: no {}\n", name, row.file);
  const Judge judge(*a, *b);
  for (const auto& [samples, cached] : {std::pair{4, false}, {16, false}, {16, true}, {64, false}}) {
    const std::string stem = fmt::format("{}_{}{}", name, samples, cached ? "c" : "");
    Opened one = *opened(row, folder, stem + ".exr", samples, 1, cached);
    const Picture raw = one.picture;
    print(stem, "raw", judge.of(raw, raw), 0.0);
    for (const auto& [label, path] : others_of(folder, stem)) print(stem, label, judge.of(radiance_of(path), raw), 0.0);
    const double seconds = seconds_of([&] { denoise(one.picture, one.camera); }).cpu;
    print(stem, "own", judge.of(one.picture, raw), seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path folder = argc > 1 ? argv[1] : "build/denoise_quality";
  fs::create_directories(folder);
  fmt::print("{:14} {:8} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8} {:>7}\n", "", "", "shown", "plain", "edge", "blotch",
             "FLIP", "energy", "CPU s");
  for (Row row : kRows) {
    if (argc > 2 && std::string(argv[2]) != "all" && std::string(argv[2]) != row.name) continue;
    if (argc > 4) row.width = std::stoi(argv[3]), row.samples = std::stoi(argv[4]);
    judge_row(row, folder);
  }
}
