// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/oidn.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/denoise/noisy_picture.h"
#include "ods/kernel/surface.h"

namespace ods {
namespace {

constexpr int kCpuDevice = 1, kFloat3 = 3;  // OIDN_DEVICE_TYPE_CPU, OIDN_FORMAT_FLOAT3
constexpr int kMargin = 64;                 // pixels; about the reach of the network

// The used part of the C interface. Version 2 has longer names for three of the functions.
struct Library {
  void* (*new_device)(int type) = nullptr;
  void (*set_device_int)(void* device, const char* name, int value) = nullptr;
  void (*commit_device)(void* device) = nullptr;
  int (*get_error)(void* device, const char** message) = nullptr;
  void (*release_device)(void* device) = nullptr;
  void* (*new_filter)(void* device, const char* type) = nullptr;
  void (*set_image)(void* filter, const char* name, void* pixels, int format, size_t width, size_t height,
                    size_t offset, size_t pixel_stride, size_t row_stride) = nullptr;
  void (*set_bool)(void* filter, const char* name, bool value) = nullptr;
  void (*set_float)(void* filter, const char* name, float value) = nullptr;
  void (*commit_filter)(void* filter) = nullptr;
  void (*execute_filter)(void* filter) = nullptr;
  void (*release_filter)(void* filter) = nullptr;
};

template <typename Function>
void find(void* library, Function*& function, const char* name, const char* name_in_version_1 = nullptr) {
  void* symbol = dlsym(library, name);
  if (!symbol && name_in_version_1) symbol = dlsym(library, name_in_version_1);
  if (!symbol) throw Error(ErrorKind::kInput, fmt::format("Open Image Denoise lacks the function {}", name));
  function = reinterpret_cast<Function*>(symbol);
}

Library open_library() {
  void* library = nullptr;
  for (const char* name :
       {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1", "libOpenImageDenoise.so.0", "libOpenImageDenoise.so"}) {
    if (!library) library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  }
  if (!library) {
    throw Error(ErrorKind::kInput,
                "Open Image Denoise is not installed (libOpenImageDenoise.so.2 or .1; LD_LIBRARY_PATH can name its "
                "folder): use `denoise` own");
  }
  Library l;
  find(library, l.new_device, "oidnNewDevice");
  find(library, l.set_device_int, "oidnSetDeviceInt", "oidnSetDevice1i");
  find(library, l.commit_device, "oidnCommitDevice");
  find(library, l.get_error, "oidnGetDeviceError");
  find(library, l.release_device, "oidnReleaseDevice");
  find(library, l.new_filter, "oidnNewFilter");
  find(library, l.set_image, "oidnSetSharedFilterImage");
  find(library, l.set_bool, "oidnSetFilterBool", "oidnSetFilter1b");
  find(library, l.set_float, "oidnSetFilterFloat", "oidnSetFilter1f");
  find(library, l.commit_filter, "oidnCommitFilter");
  find(library, l.execute_filter, "oidnExecuteFilter");
  find(library, l.release_filter, "oidnReleaseFilter");
  return l;
}

using Handle = std::unique_ptr<void, void (*)(void*)>;

void check(const Library& library, void* device) {
  const char* message = nullptr;
  if (library.get_error(device, &message) != 0) {
    throw Error(ErrorKind::kInput, fmt::format("Open Image Denoise: {}", message ? message : "unknown error"));
  }
}

// Like the library's own estimate, but from all eyes: the mean of the logarithm of luminance becomes 0.18.
float input_scale(const Picture& picture) {
  double sum = 0.0;
  size_t count = 0;
  for (const EyeImage& eye : picture.eyes) {
    for (size_t i = 0; i < eye.radiance.pixels.size(); i += 3) {
      const float* at = &eye.radiance.pixels[i];
      const float light = luminance(vec3(at[0], at[1], at[2]));
      if (!(light > 1e-8f) || !std::isfinite(light)) continue;
      sum += std::log2(double{light});
      count++;
    }
  }
  return count == 0 ? 1.0f : static_cast<float>(0.18 / std::exp2(sum / static_cast<double>(count)));
}

// A cell of an eye with its margin.
struct Padded {
  Cell cell;
  int across = 0;
  int down = 0;
  size_t width = 0;
  size_t height = 0;
};

Padded padded(const Cell& cell) {
  Padded p{cell, 0, 0, 0, 0};
  const int width = cell.right - cell.left, height = cell.bottom - cell.top;
  p.across = std::min(kMargin, width), p.down = std::min(kMargin, height);
  p.width = static_cast<size_t>(width + 2 * p.across), p.height = static_cast<size_t>(height + 2 * p.down);
  return p;
}

// A layer of the cell with the adjacent parts of the world; beyond the picture, its last pixel.
std::vector<float> pad(const NoisyPicture& noisy, int eye, Image EyeImage::*layer, const Padded& p) {
  std::vector<float> pixels(3 * p.width * p.height);
  tbb::parallel_for(0, static_cast<int>(p.height), [&](int row) {
    float* to = &pixels[3 * p.width * static_cast<size_t>(row)];
    const int y = p.cell.top - p.down + row;
    for (int x = p.cell.left - p.across; x < p.cell.right + p.across; x++, to += 3) {
      const Texel nearest{eye, std::clamp(x, p.cell.left, p.cell.right - 1),
                          std::clamp(y, p.cell.top, p.cell.bottom - 1)};
      const Texel from = texel_at(noisy, eye, p.cell, x, y).value_or(nearest);
      const float* value = (noisy.eye(from.source_eye).*layer).at(from.x, from.y);
      for (int c = 0; c < 3; c++) to[c] = std::isfinite(value[c]) ? value[c] : 0.0f;
    }
  });
  return pixels;
}

void denoise_cell(const Library& library, void* device, const NoisyPicture& noisy, int eye, const Padded& p,
                  float scale, Image& result) {
  const EyeImage& image = noisy.eye(eye);
  std::vector<float> color = pad(noisy, eye, &EyeImage::radiance, p), output(color.size()), albedo, normal;
  const Handle filter(library.new_filter(device, "RT"), library.release_filter);
  const auto set = [&](const char* name, std::vector<float>& pixels) {
    library.set_image(filter.get(), name, pixels.data(), kFloat3, p.width, p.height, 0, 0, 0);
  };
  set("color", color);
  if (!image.albedo.pixels.empty()) set("albedo", albedo = pad(noisy, eye, &EyeImage::albedo, p));
  if (!image.albedo.pixels.empty() && !image.normal.pixels.empty()) {
    set("normal", normal = pad(noisy, eye, &EyeImage::normal, p));
  }
  set("output", output);
  library.set_bool(filter.get(), "hdr", true);
  library.set_float(filter.get(), "inputScale", scale);
  library.commit_filter(filter.get());
  check(library, device);
  library.execute_filter(filter.get());
  check(library, device);
  for (int y = p.cell.top; y < p.cell.bottom; y++) {
    const size_t from = static_cast<size_t>(y - p.cell.top + p.down) * p.width + static_cast<size_t>(p.across);
    const size_t row = 3 * static_cast<size_t>(p.cell.right - p.cell.left);
    std::copy_n(&output[3 * from], row, result.at(p.cell.left, y));
  }
}

}  // namespace

void check_oidn() {
  open_library();
}

void denoise_with_oidn(Picture& picture, const StereoCamera& camera, int threads, const Progress& progress) {
  const Library library = open_library();
  NoisyPicture noisy;
  open_noisy(noisy, picture, camera);
  const size_t pixels = static_cast<size_t>(noisy.width()) * static_cast<size_t>(noisy.height());
  check_memory(2 * 15 * sizeof(float) * pixels, "Open Image Denoise", "a smaller picture needs less");
  const Handle device(library.new_device(kCpuDevice), library.release_device);
  if (!device) throw Error(ErrorKind::kInput, "Open Image Denoise does not run on this processor");
  if (threads > 0) library.set_device_int(device.get(), "numThreads", threads);
  library.commit_device(device.get());
  check(library, device.get());
  const float scale = input_scale(picture);
  std::vector<Image> results;
  const double total = static_cast<double>(picture.eyes.size() * noisy.cells.size());
  double done = 0.0;
  for (int eye = 0; eye < static_cast<int>(picture.eyes.size()); eye++) {
    Image& result = results.emplace_back(noisy.eye(eye).radiance);
    for (const Cell& cell : noisy.cells) {
      if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "denoising was stopped");
      denoise_cell(library, device.get(), noisy, eye, padded(cell), scale, result);
      if (progress.report) progress.report(++done / total);
    }
  }
  for (size_t eye = 0; eye < results.size(); eye++) picture.eyes[eye].radiance = std::move(results[eye]);
}

}  // namespace ods
