// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/device.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/user_folder.h"
#include "ods/render/devices/devices.h"
#include "ods/render/gpu/gpu_lacks.h"

namespace {

constexpr const char* kAuto = "auto";

RenderJob on_card(RenderJob job, int gpu) {
  job.render.gpu = gpu;
  const std::string cache = user_folder("XDG_CACHE_HOME", ".cache");
  if (!cache.empty()) job.render.shader_cache = cache + "/shaders";
  if (!job.quality.indirect) job.render.indirect = ods::Indirect::kPath;
  return job;
}

}  // namespace

void add_device_option(Options& options, RenderJob& job) {
  options.group("Device");
  add_renderer_option(options, job.renderer);
  options.text("--device", "cpu|gpu|auto|NAME|NUMBER", job.device,
               "what renders: the processor, or a graphics card through Vulkan. gpu: the best card; auto: the best "
               "card that is not software, else the processor; ods devices lists names and numbers");
}

RenderJob on_device(const RenderJob& job, const ods::Scene& scene) {
  if (job.device == kCpu) return job;
  const ods::DeviceChoice choice = ods::choose_device(job.device);
  if (choice.gpu < 0) {
    note(fmt::format("renders on the {}: {}", choice.name, choice.why));
    return job;
  }
  RenderJob with_card = on_card(job, choice.gpu);
  const std::string lacks = ods::gpu_lacks(scene, with_card.render, job.time.shutter > 0.0f);
  if (lacks.empty()) {
    note(fmt::format("renders on '{}': {}", choice.name, choice.why));
    return with_card;
  }
  if (job.device != kAuto) throw ods::Error(ods::ErrorKind::kUsage, lacks);
  note(fmt::format("renders on the CPU: {}", with_options(lacks)));
  return job;
}

bool continues_on_cpu(const RenderJob& job, const ods::Error& failure) {
  return failure.kind() == ods::ErrorKind::kDevice && job.device == kAuto;
}

RenderJob on_cpu(RenderJob job, const ods::Error& failure) {
  note(fmt::format("continues on the CPU: {}", with_options(failure.what())));
  job.render.gpu = -1;
  job.restart = false;
  return job;
}
