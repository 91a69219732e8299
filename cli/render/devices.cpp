// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods devices: lists the devices that can render.
#include "ods/render/devices/devices.h"

#include <fmt/format.h>

#include "cli/console/command.h"
#include "cli/console/print.h"
#include "ods/base/memory.h"
#include "ods/render/gpu/gpu_device.h"

namespace {

struct DevicesJob {};

DevicesJob parse_devices(Options& options) {
  options.describe(
      "Lists the devices that --device of ods render and ods video knows: the processor, and what Vulkan's drivers\n"
      "offer. docs/devices.md lists what a graphics card cannot render yet.",
      "  ods devices\n"
      "  ods render room -o room.png --device auto");
  options.group("Console");
  add_console_options(options);
  options.parse();
  return {};
}

const char* text_of(ods::GpuKind kind) {
  switch (kind) {
    case ods::GpuKind::kDiscrete:
      return "a card of its own";
    case ods::GpuKind::kIntegrated:
      return "part of the processor";
    case ods::GpuKind::kVirtual:
      return "virtual";
    case ods::GpuKind::kSoftware:
      return "software, for tests";
    case ods::GpuKind::kOther:
      return "of unknown kind";
  }
  return "of unknown kind";
}

void list_devices(const DevicesJob&) {
  const ods::GpuList list = ods::list_gpus();
  put_out(fmt::format("{:<7} {}\n", "cpu", "this processor: renders everything"));
  for (size_t i = 0; i < list.gpus.size(); i++) {
    const ods::GpuInfo& gpu = list.gpus[i];
    const std::string can = gpu.lacks.empty() ? "can render" : fmt::format("cannot render: it lacks {}", gpu.lacks);
    put_out(fmt::format("{:<7} {}: {}, {}, {}; {}\n", i, gpu.name, text_of(gpu.kind), ods::bytes_text(gpu.memory),
                        gpu.driver, can));
  }
  if (!list.fault.empty()) put_out(fmt::format("no graphics card: {}\n", list.fault));
  const ods::DeviceChoice choice = ods::choose_among(list, "auto");
  put_out(fmt::format("auto takes {}: {}\n", choice.name, choice.why));
}

}  // namespace

extern const Command kDevices =
    make_command<parse_devices, list_devices>("devices", "list the devices that can render");
