// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/gpu_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/render/gpu/loader.h"
#include "ods/render/gpu/pipeline_cache.h"

namespace ods {
namespace {

constexpr size_t kStagingBytes = size_t{16} << 20;
constexpr uint32_t kMaxConstants = 128;          // bytes of push constants that every device has
constexpr uint64_t kWaitAtOnce = 1'000'000'000;  // nanoseconds
constexpr const char* kRemedy = "`device` cpu renders without it";

GpuKind kind_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return GpuKind::kDiscrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return GpuKind::kIntegrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return GpuKind::kVirtual;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return GpuKind::kSoftware;
    default:
      return GpuKind::kOther;
  }
}

std::vector<VkPhysicalDevice> physical_devices(const VulkanInstance& vulkan) {
  uint32_t count = 0;
  if (vulkan.functions.vkEnumeratePhysicalDevices(vulkan.instance, &count, nullptr) != VK_SUCCESS) return {};
  std::vector<VkPhysicalDevice> devices(count);
  if (vulkan.functions.vkEnumeratePhysicalDevices(vulkan.instance, &count, devices.data()) != VK_SUCCESS) return {};
  devices.resize(count);
  return devices;
}

std::vector<VkQueueFamilyProperties> queue_families(const VulkanFunctions& vk, VkPhysicalDevice device) {
  uint32_t count = 0;
  vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

VkPhysicalDeviceProperties properties_of(const VulkanFunctions& vk, VkPhysicalDevice device) {
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  vk.vkGetPhysicalDeviceProperties2(device, &properties);
  return properties.properties;
}

// Returns the index of the first queue family that supports compute; nullopt if none does.
std::optional<uint32_t> compute_family(const VulkanFunctions& vk, VkPhysicalDevice device) {
  const std::vector<VkQueueFamilyProperties> families = queue_families(vk, device);
  for (uint32_t i = 0; i < families.size(); i++) {
    if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
  }
  return {};
}

// The features that the shaders need, each with its name.
struct Need {
  VkBool32 VkPhysicalDeviceVulkan12Features::*feature;
  const char* name;
};
constexpr Need kNeeds[] = {{&VkPhysicalDeviceVulkan12Features::bufferDeviceAddress, "bufferDeviceAddress"},
                           {&VkPhysicalDeviceVulkan12Features::scalarBlockLayout, "scalarBlockLayout"}};

std::string lacks_of(const VulkanFunctions& vk, VkPhysicalDevice device, uint32_t version) {
  if (version < VK_API_VERSION_1_2) return "Vulkan 1.2";
  VkPhysicalDeviceVulkan12Features has{};
  has.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &has;
  vk.vkGetPhysicalDeviceFeatures2(device, &features);
  for (const Need& need : kNeeds) {
    if (!(has.*need.feature)) return need.name;
  }
  return compute_family(vk, device) ? "" : "a queue that computes";
}

GpuInfo describe(const VulkanFunctions& vk, VkPhysicalDevice device) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vk.vkGetPhysicalDeviceProperties2(device, &properties);
  VkPhysicalDeviceMemoryProperties memory{};
  vk.vkGetPhysicalDeviceMemoryProperties(device, &memory);
  GpuInfo info;
  info.name = properties.properties.deviceName;
  info.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
  info.kind = kind_of(properties.properties.deviceType);
  for (uint32_t i = 0; i < memory.memoryHeapCount; i++) {
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
      info.memory = std::max(info.memory, memory.memoryHeaps[i].size);
    }
  }
  info.lacks = lacks_of(vk, device, properties.properties.apiVersion);
  return info;
}

struct Memory {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
};

}  // namespace

GpuList list_gpus() {
  const VulkanInstance vulkan;
  if (!vulkan.fault.empty()) return {{}, vulkan.fault};
  GpuList list;
  for (VkPhysicalDevice device : physical_devices(vulkan)) list.gpus.push_back(describe(vulkan.functions, device));
  if (list.gpus.empty()) list.fault = "no driver for Vulkan offers a device";
  return list;
}

struct GpuDevice::Vulkan {
  Vulkan() = default;
  ~Vulkan();
  Vulkan(const Vulkan&) = delete;
  Vulkan& operator=(const Vulkan&) = delete;

  void open(int number, std::string cache_folder);
  void check(VkResult result, const char* what) const;
  void make_device(VkPhysicalDevice physical);
  void make_commands(uint32_t family);
  void make_clock(VkPhysicalDevice physical, uint32_t family);
  std::vector<double> read_clock(size_t intervals) const;
  uint32_t memory_type(uint32_t allowed, VkMemoryPropertyFlags wanted) const;
  Memory allocate(size_t bytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags wanted);
  void release(Memory& memory);
  void begin();
  void submit();

  VulkanInstance instance;
  VulkanFunctions vk;
  GpuInfo info;
  PipelineCacheFile cache_file;
  VkPhysicalDeviceMemoryProperties memory_properties{};
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkQueryPool clock = VK_NULL_HANDLE;  // null if the queue has none
  double tick = 0.0;                   // seconds
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipelineCache cache = VK_NULL_HANDLE;
  std::vector<VkPipeline> pipelines;
  std::vector<const uint32_t*> shaders;  // of the pipelines
  std::vector<Memory> buffers;
  Memory staging;
  std::byte* staged = nullptr;
};

void GpuDevice::Vulkan::open(int number, std::string cache_folder) {
  if (!instance.fault.empty()) throw Error(ErrorKind::kDevice, instance.fault);
  vk = instance.functions;
  const std::vector<VkPhysicalDevice> all = physical_devices(instance);
  if (number < 0 || number >= static_cast<int>(all.size())) {
    throw Error(ErrorKind::kDevice, fmt::format("there is no graphics card {}; ods devices lists them", number));
  }
  VkPhysicalDevice physical = all[static_cast<size_t>(number)];
  info = describe(vk, physical);
  if (!info.lacks.empty()) {
    throw Error(ErrorKind::kDevice, fmt::format("'{}' lacks {}; {}", info.name, info.lacks, kRemedy));
  }
  vk.vkGetPhysicalDeviceMemoryProperties(physical, &memory_properties);
  make_device(physical);
  cache_file = PipelineCacheFile(std::move(cache_folder), properties_of(vk, physical).pipelineCacheUUID);
  const std::vector<std::byte> known = cache_file.read();
  VkPipelineCacheCreateInfo cache_info{};
  cache_info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  cache_info.initialDataSize = known.size();
  cache_info.pInitialData = known.data();
  check(vk.vkCreatePipelineCache(device, &cache_info, nullptr, &cache), "keep compiled shaders");
}

GpuDevice::Vulkan::~Vulkan() {
  if (device == VK_NULL_HANDLE) return;
  vk.vkDeviceWaitIdle(device);
  for (Memory& each : buffers) release(each);
  release(staging);
  for (VkPipeline pipeline : pipelines) vk.vkDestroyPipeline(device, pipeline, nullptr);
  if (cache != VK_NULL_HANDLE) vk.vkDestroyPipelineCache(device, cache, nullptr);
  if (clock != VK_NULL_HANDLE) vk.vkDestroyQueryPool(device, clock, nullptr);
  if (layout != VK_NULL_HANDLE) vk.vkDestroyPipelineLayout(device, layout, nullptr);
  if (fence != VK_NULL_HANDLE) vk.vkDestroyFence(device, fence, nullptr);
  if (pool != VK_NULL_HANDLE) vk.vkDestroyCommandPool(device, pool, nullptr);
  vk.vkDestroyDevice(device, nullptr);
}

void GpuDevice::Vulkan::check(VkResult result, const char* what) const {
  if (result == VK_SUCCESS) return;
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
    throw Error(ErrorKind::kDevice, fmt::format("'{}' has too little memory to {}; {}", info.name, what, kRemedy));
  }
  if (result == VK_ERROR_DEVICE_LOST) {
    throw Error(ErrorKind::kDevice, fmt::format("'{}' stopped working; {}", info.name, kRemedy));
  }
  throw Error(ErrorKind::kDevice, fmt::format("'{}' cannot {} (Vulkan's error {}); {}", info.name, what,
                                              static_cast<int>(result), kRemedy));
}

void GpuDevice::Vulkan::make_device(VkPhysicalDevice physical) {
  const uint32_t family = *compute_family(vk, physical);
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue_info{};
  queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue_info.queueFamilyIndex = family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  VkPhysicalDeviceVulkan12Features features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  for (const Need& need : kNeeds) features.*need.feature = VK_TRUE;
  VkDeviceCreateInfo device_info{};
  device_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  device_info.pNext = &features;
  device_info.queueCreateInfoCount = 1;
  device_info.pQueueCreateInfos = &queue_info;
  check(vk.vkCreateDevice(physical, &device_info, nullptr, &device), "be opened");
  if (!add_device_functions(vk, device))
    throw Error(ErrorKind::kDevice, fmt::format("'{}' has an incomplete driver; {}", info.name, kRemedy));
  vk.vkGetDeviceQueue(device, family, 0, &queue);
  make_commands(family);
  make_clock(physical, family);
  staging = allocate(kStagingBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  void* mapped = nullptr;
  check(vk.vkMapMemory(device, staging.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "map its memory");
  staged = static_cast<std::byte*>(mapped);
}

void GpuDevice::Vulkan::make_commands(uint32_t family) {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool_info.queueFamilyIndex = family;
  check(vk.vkCreateCommandPool(device, &pool_info, nullptr, &pool), "take commands");
  VkCommandBufferAllocateInfo commands_info{};
  commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  commands_info.commandPool = pool;
  commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands_info.commandBufferCount = 1;
  check(vk.vkAllocateCommandBuffers(device, &commands_info, &commands), "take commands");
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  check(vk.vkCreateFence(device, &fence_info, nullptr, &fence), "take commands");
  VkPushConstantRange constants{VK_SHADER_STAGE_COMPUTE_BIT, 0, kMaxConstants};
  VkPipelineLayoutCreateInfo layout_info{};
  layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout_info.pushConstantRangeCount = 1;
  layout_info.pPushConstantRanges = &constants;
  check(vk.vkCreatePipelineLayout(device, &layout_info, nullptr, &layout), "take commands");
}

void GpuDevice::Vulkan::make_clock(VkPhysicalDevice physical, uint32_t family) {
  if (queue_families(vk, physical)[family].timestampValidBits < 64) return;
  tick = 1e-9 * double{properties_of(vk, physical).limits.timestampPeriod};
  VkQueryPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  pool_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  pool_info.queryCount = kMaxDispatches + 1;
  check(vk.vkCreateQueryPool(device, &pool_info, nullptr, &clock), "measure its time");
}

// The first type of memory with the wanted properties, cached if the processor reads it; or with none of them if a
// device has no memory of its own.
uint32_t GpuDevice::Vulkan::memory_type(uint32_t allowed, VkMemoryPropertyFlags wanted) const {
  const bool is_mapped = wanted & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
  const VkMemoryPropertyFlags cached = is_mapped ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT : 0;
  for (const VkMemoryPropertyFlags each : {wanted | cached, wanted, VkMemoryPropertyFlags{0}}) {
    for (uint32_t i = 0; i < memory_properties.memoryTypeCount; i++) {
      const bool fits = (memory_properties.memoryTypes[i].propertyFlags & each) == each;
      if ((allowed >> i & 1u) && fits) return i;
    }
  }
  return 0;
}

Memory GpuDevice::Vulkan::allocate(size_t bytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags wanted) {
  Memory made;
  VkBufferCreateInfo buffer_info{};
  buffer_info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  buffer_info.size = bytes;
  buffer_info.usage = usage;
  check(vk.vkCreateBuffer(device, &buffer_info, nullptr, &made.buffer), "hold the scene");
  VkMemoryRequirements needs{};
  vk.vkGetBufferMemoryRequirements(device, made.buffer, &needs);
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo memory_info{};
  memory_info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  memory_info.pNext = usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT ? &flags : nullptr;
  memory_info.allocationSize = needs.size;
  memory_info.memoryTypeIndex = memory_type(needs.memoryTypeBits, wanted);
  VkResult result = vk.vkAllocateMemory(device, &memory_info, nullptr, &made.memory);
  if (result == VK_SUCCESS) result = vk.vkBindBufferMemory(device, made.buffer, made.memory, 0);
  if (result == VK_SUCCESS) return made;
  release(made);
  check(result, fmt::format("hold another {}", bytes_text(bytes)).c_str());
  return made;
}

void GpuDevice::Vulkan::release(Memory& memory) {
  if (memory.buffer != VK_NULL_HANDLE) vk.vkDestroyBuffer(device, memory.buffer, nullptr);
  if (memory.memory != VK_NULL_HANDLE) vk.vkFreeMemory(device, memory.memory, nullptr);
  memory = {};
}

void GpuDevice::Vulkan::begin() {
  VkCommandBufferBeginInfo info_of_begin{};
  info_of_begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info_of_begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vk.vkBeginCommandBuffer(commands, &info_of_begin), "take commands");
}

// Returns when the commands are done.
void GpuDevice::Vulkan::submit() {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
  vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                          VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr,
                          0, nullptr);
  check(vk.vkEndCommandBuffer(commands), "take commands");
  VkSubmitInfo submit_info{};
  submit_info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit_info.commandBufferCount = 1;
  submit_info.pCommandBuffers = &commands;
  check(vk.vkQueueSubmit(queue, 1, &submit_info, fence), "take commands");
  VkResult result = VK_TIMEOUT;
  while (result == VK_TIMEOUT) result = vk.vkWaitForFences(device, 1, &fence, VK_TRUE, kWaitAtOnce);
  if (result != VK_SUCCESS) vk.vkDeviceWaitIdle(device);  // it may still use memory that is freed after this failure
  check(result, "compute");
  check(vk.vkResetFences(device, 1, &fence), "take commands");
}

std::vector<double> GpuDevice::Vulkan::read_clock(size_t intervals) const {
  std::vector<double> seconds(intervals, 0.0);
  if (clock == VK_NULL_HANDLE) return seconds;
  std::vector<uint64_t> at(intervals + 1);
  check(vk.vkGetQueryPoolResults(device, clock, 0, static_cast<uint32_t>(at.size()), at.size() * sizeof(uint64_t),
                                 at.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "measure its time");
  for (size_t i = 0; i < intervals; i++) seconds[i] = tick * static_cast<double>(at[i + 1] - at[i]);
  return seconds;
}

GpuDevice::GpuDevice(int number, std::string cache) : vulkan_(std::make_unique<Vulkan>()) {
  vulkan_->open(number, std::move(cache));
}

GpuDevice::~GpuDevice() = default;

const GpuInfo& GpuDevice::info() const {
  return vulkan_->info;
}

GpuBuffer GpuDevice::make_buffer(size_t bytes) {
  const size_t whole = std::max((bytes + 15) / 16 * 16, size_t{16});
  const Memory made = vulkan_->allocate(whole,
                                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                            VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                                            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  vulkan_->buffers.push_back(made);
  VkBufferDeviceAddressInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  info.buffer = made.buffer;
  GpuBuffer buffer{vulkan_->buffers.size() - 1, vulkan_->vk.vkGetBufferDeviceAddress(vulkan_->device, &info), bytes};
  clear(buffer, whole);
  return buffer;
}

void GpuDevice::free(const GpuBuffer& buffer) {
  vulkan_->release(vulkan_->buffers[buffer.index]);
}

void GpuDevice::upload(const GpuBuffer& buffer, size_t to, std::span<const std::byte> bytes) {
  assert(to + bytes.size() <= buffer.bytes);
  for (size_t at = 0; at < bytes.size(); at += kStagingBytes) {
    const size_t piece = std::min(kStagingBytes, bytes.size() - at);
    std::memcpy(vulkan_->staged, bytes.data() + at, piece);
    vulkan_->begin();
    const VkBufferCopy copy{0, to + at, piece};
    vulkan_->vk.vkCmdCopyBuffer(vulkan_->commands, vulkan_->staging.buffer, vulkan_->buffers[buffer.index].buffer, 1,
                                &copy);
    vulkan_->submit();
  }
}

void GpuDevice::download(const GpuBuffer& buffer, size_t from, std::span<std::byte> bytes) {
  assert(from + bytes.size() <= buffer.bytes);
  for (size_t at = 0; at < bytes.size(); at += kStagingBytes) {
    const size_t piece = std::min(kStagingBytes, bytes.size() - at);
    vulkan_->begin();
    const VkBufferCopy copy{from + at, 0, piece};
    vulkan_->vk.vkCmdCopyBuffer(vulkan_->commands, vulkan_->buffers[buffer.index].buffer, vulkan_->staging.buffer, 1,
                                &copy);
    vulkan_->submit();
    std::memcpy(bytes.data() + at, vulkan_->staged, piece);
  }
}

void GpuDevice::clear(const GpuBuffer& buffer, size_t bytes) {
  vulkan_->begin();
  vulkan_->vk.vkCmdFillBuffer(vulkan_->commands, vulkan_->buffers[buffer.index].buffer, 0, (bytes + 3) / 4 * 4, 0);
  vulkan_->submit();
}

size_t GpuDevice::make_pipeline(std::span<const uint32_t> spirv) {
  Vulkan& v = *vulkan_;
  const auto known = std::find(v.shaders.begin(), v.shaders.end(), spirv.data());
  if (known != v.shaders.end()) return static_cast<size_t>(known - v.shaders.begin());
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  v.check(v.vk.vkCreateShaderModule(v.device, &module_info, nullptr, &module), "compile the shaders");
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.layout = v.layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result = v.vk.vkCreateComputePipelines(v.device, v.cache, 1, &info, nullptr, &pipeline);
  v.vk.vkDestroyShaderModule(v.device, module, nullptr);
  v.check(result, "compile the shaders");
  v.pipelines.push_back(pipeline);
  v.shaders.push_back(spirv.data());
  return v.pipelines.size() - 1;
}

void GpuDevice::store_pipelines() {
  Vulkan& v = *vulkan_;
  size_t size = 0;
  if (v.vk.vkGetPipelineCacheData(v.device, v.cache, &size, nullptr) != VK_SUCCESS) return;
  std::vector<std::byte> data(size);
  if (v.vk.vkGetPipelineCacheData(v.device, v.cache, &size, data.data()) != VK_SUCCESS) return;
  data.resize(size);
  v.cache_file.write(data);
}

std::vector<double> GpuDevice::run(std::span<const GpuDispatch> dispatches) {
  assert(dispatches.size() <= kMaxDispatches);
  Vulkan& v = *vulkan_;
  v.begin();
  uint32_t times = 0;
  const auto take_time = [&] {
    if (v.clock != VK_NULL_HANDLE)
      v.vk.vkCmdWriteTimestamp(v.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, v.clock, times++);
  };
  if (v.clock != VK_NULL_HANDLE) v.vk.vkCmdResetQueryPool(v.commands, v.clock, 0, kMaxDispatches + 1);
  take_time();
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
  for (const GpuDispatch& dispatch : dispatches) {
    assert(dispatch.constants.size() <= kMaxConstants);
    v.vk.vkCmdBindPipeline(v.commands, VK_PIPELINE_BIND_POINT_COMPUTE, v.pipelines[dispatch.pipeline]);
    v.vk.vkCmdPushConstants(v.commands, v.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                            static_cast<uint32_t>(dispatch.constants.size()), dispatch.constants.data());
    if (dispatch.groups > 0) {
      v.vk.vkCmdDispatch(v.commands, dispatch.groups, 1, 1);
    } else {
      v.vk.vkCmdDispatchIndirect(v.commands, v.buffers[dispatch.groups_from.index].buffer, dispatch.groups_at);
    }
    v.vk.vkCmdPipelineBarrier(v.commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                              VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1,
                              &barrier, 0, nullptr, 0, nullptr);
    take_time();
  }
  v.submit();
  return v.read_clock(dispatches.size());
}

}  // namespace ods
