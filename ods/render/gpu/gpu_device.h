// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Graphics cards through Vulkan, as far as rendering needs them: buffers that shaders reach by their addresses, compute
// pipelines, and dispatches. Vulkan's loader is opened at run time, so programs start without it.
//
// Functions throw Error(kDevice) if the device fails, is lost or has too little memory.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ods {

enum class GpuKind { kDiscrete, kIntegrated, kVirtual, kSoftware, kOther };

struct GpuInfo {
  std::string name;
  std::string driver;  // its name and version
  GpuKind kind = GpuKind::kOther;
  uint64_t memory = 0;  // bytes of its largest heap
  std::string lacks;    // a feature that rendering needs and the device has not; empty if it can render
};

struct GpuList {
  std::vector<GpuInfo> gpus;  // in Vulkan's order
  std::string fault;          // the reason why there are none, with the remedy
};

// Lists the devices of all drivers. Takes a few hundredths of a second.
GpuList list_gpus();

// A part of the device's memory. Freed with its GpuDevice at the latest.
struct GpuBuffer {
  size_t index = 0;
  uint64_t address = 0;  // for shaders
  size_t bytes = 0;
};

// One dispatch of a pipeline.
struct GpuDispatch {
  size_t pipeline = 0;
  std::span<const std::byte> constants;  // at most 128 bytes
  uint32_t groups = 0;                   // work groups; if 0, the three numbers in a buffer
  GpuBuffer groups_from{};
  size_t groups_at = 0;  // bytes
};

class GpuDevice {
 public:
  static constexpr size_t kMaxDispatches = 255;

  // number: in list_gpus(). cache: a folder for compiled pipelines, one file per driver; none if empty.
  explicit GpuDevice(int number, std::string cache = {});
  ~GpuDevice();
  GpuDevice(const GpuDevice&) = delete;
  GpuDevice& operator=(const GpuDevice&) = delete;

  const GpuInfo& info() const;

  // A buffer of zeros. 0 bytes give one of a few bytes, whose address is valid.
  GpuBuffer make_buffer(size_t bytes);
  void free(const GpuBuffer& buffer);
  void upload(const GpuBuffer& buffer, size_t to, std::span<const std::byte> bytes);  // to: the first byte
  void download(const GpuBuffer& buffer, size_t from, std::span<std::byte> bytes);
  void clear(const GpuBuffer& buffer, size_t bytes);  // the first bytes become 0

  // Compiles a shader with the entry point main, when it is first asked for. Shaders are told apart by their address.
  size_t make_pipeline(std::span<const uint32_t> spirv);

  // Stores what the driver has compiled in the cache, if there is one.
  void store_pipelines();

  // Runs dispatches one after the other, each after the memory of the one before is visible. Returns when all are done:
  // the seconds that each took by the device's clock, 0 if it has none. At most kMaxDispatches.
  std::vector<double> run(std::span<const GpuDispatch> dispatches);

 private:
  struct Vulkan;
  std::unique_ptr<Vulkan> vulkan_;
};

}  // namespace ods
