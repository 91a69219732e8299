// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/devices/devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "ods/base/error.h"
#include "ods/render/cpu/render.h"
#include "ods/render/gpu/gpu_device.h"
#include "ods/render/gpu/gpu_renderer.h"

namespace ods {
namespace {

constexpr const char* kAdvice = "ods devices lists what there is";

bool is_number(const std::string& word) {
  return !word.empty() && word.size() < 5 &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// The rank of a card for "gpu" and "auto", the best first.
int rank_of(const GpuInfo& gpu) {
  switch (gpu.kind) {
    case GpuKind::kDiscrete:
      return 0;
    case GpuKind::kIntegrated:
      return 1;
    case GpuKind::kVirtual:
      return 2;
    case GpuKind::kOther:
      return 3;
    case GpuKind::kSoftware:
      return 4;
  }
  return 4;
}

// Returns the index of the best card that can render, or -1.
int best_gpu(const std::vector<GpuInfo>& gpus) {
  int best = -1;
  for (size_t i = 0; i < gpus.size(); i++) {
    if (!gpus[i].lacks.empty()) continue;
    if (best < 0 || rank_of(gpus[i]) < rank_of(gpus[static_cast<size_t>(best)])) best = static_cast<int>(i);
  }
  return best;
}

DeviceChoice choose_gpu(const GpuList& list, size_t index, const std::string& why) {
  const GpuInfo& gpu = list.gpus[index];
  if (!gpu.lacks.empty()) {
    throw Error(ErrorKind::kDevice, fmt::format("'{}' cannot render: it lacks {}; {}", gpu.name, gpu.lacks, kAdvice));
  }
  return {static_cast<int>(index), gpu.name, why};
}

DeviceChoice choose_named(const GpuList& list, const std::string& word) {
  std::vector<size_t> found;
  for (size_t i = 0; i < list.gpus.size(); i++) {
    if (lower(list.gpus[i].name).find(lower(word)) != std::string::npos) found.push_back(i);
  }
  if (found.empty()) throw Error(ErrorKind::kDevice, fmt::format("no device is called '{}'; {}", word, kAdvice));
  if (found.size() > 1) {
    throw Error(ErrorKind::kDevice, fmt::format("{} devices are called '{}'; their numbers tell them apart: {}",
                                                found.size(), word, kAdvice));
  }
  return choose_gpu(list, found.front(), "it was named");
}

DeviceChoice choose_automatically(const GpuList& list) {
  const int best = best_gpu(list.gpus);
  if (best < 0) return {-1, "CPU", list.gpus.empty() ? list.fault : "no graphics card can render"};
  if (list.gpus[static_cast<size_t>(best)].kind == GpuKind::kSoftware) {
    return {-1, "CPU", "the only Vulkan device is software, which is slower"};
  }
  return choose_gpu(list, static_cast<size_t>(best), "the first graphics card");
}

}  // namespace

DeviceChoice choose_among(const GpuList& list, const std::string& word) {
  if (word == "cpu") return {-1, "CPU", "it was named"};
  if (word == "auto") return choose_automatically(list);
  if (list.gpus.empty()) {
    throw Error(ErrorKind::kDevice, fmt::format("`device` {}: there is no graphics card; {}", word, list.fault));
  }
  if (word == "gpu") {
    const int best = best_gpu(list.gpus);
    if (best < 0)
      throw Error(ErrorKind::kDevice, fmt::format("`device` {}: no graphics card can render; {}", word, kAdvice));
    return choose_gpu(list, static_cast<size_t>(best), "the first that can render");
  }
  if (!is_number(word)) return choose_named(list, word);
  const auto index = static_cast<size_t>(std::stoi(word));
  if (index >= list.gpus.size()) {
    throw Error(ErrorKind::kDevice, fmt::format("there is no device {}; {}", word, kAdvice));
  }
  return choose_gpu(list, index, "it was named");
}

DeviceChoice choose_device(const std::string& word) {
  return choose_among(word == "cpu" ? GpuList{} : list_gpus(), word);
}

std::unique_ptr<Renderer> make_renderer(const Scene& scene, const RenderOptions& options) {
  if (options.gpu < 0) return std::make_unique<CpuRenderer>(scene, options.threads);
  return std::make_unique<GpuRenderer>(scene, std::make_shared<GpuDevice>(options.gpu, options.shader_cache));
}

}  // namespace ods
