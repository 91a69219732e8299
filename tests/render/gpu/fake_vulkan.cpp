// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/render/gpu/fake_vulkan.h"

#define VK_NO_PROTOTYPES
#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <array>
#include <string_view>

namespace {

struct Planned {
  VulkanCall call = VulkanCall::kCreateInstance;
  int left = 0;  // calls until it fails; 0: none fails
  int result = 0;
};
Planned planned;
std::array<int, kVulkanCalls> counts{};

bool fails_now(VulkanCall call) {
  counts[static_cast<size_t>(call)]++;
  return planned.left > 0 && planned.call == call && --planned.left == 0;
}

// A function of Vulkan that can fail: the system's, and ours, which calls it.
template <VulkanCall kCall, typename Function>
struct Wrapped;
template <VulkanCall kCall, typename... Arguments>
struct Wrapped<kCall, VkResult(VKAPI_PTR*)(Arguments...)> {
  static inline VkResult(VKAPI_PTR* real)(Arguments...) = nullptr;
  static VkResult VKAPI_PTR call(Arguments... arguments) {
    return fails_now(kCall) ? static_cast<VkResult>(planned.result) : real(arguments...);
  }
};

// Returns ours, and keeps the system's, if the name is this function's.
template <VulkanCall kCall, typename Function>
bool wrap(std::string_view own, std::string_view name, PFN_vkVoidFunction& function) {
  if (own != name || !function) return false;
  Wrapped<kCall, Function>::real = reinterpret_cast<Function>(function);
  function = reinterpret_cast<PFN_vkVoidFunction>(&Wrapped<kCall, Function>::call);
  return true;
}

PFN_vkVoidFunction wrapped(std::string_view name, PFN_vkVoidFunction function) {
#define ODS_WRAP(name_of) wrap<VulkanCall::k##name_of, PFN_vk##name_of>("vk" #name_of, name, function)
  ODS_WRAP(CreateInstance) || ODS_WRAP(EnumeratePhysicalDevices) || ODS_WRAP(CreateDevice) || ODS_WRAP(CreateBuffer) ||
      ODS_WRAP(AllocateMemory) || ODS_WRAP(BindBufferMemory) || ODS_WRAP(MapMemory) || ODS_WRAP(CreateShaderModule) ||
      ODS_WRAP(CreateComputePipelines) || ODS_WRAP(CreatePipelineCache) || ODS_WRAP(CreateCommandPool) ||
      ODS_WRAP(BeginCommandBuffer) || ODS_WRAP(EndCommandBuffer) || ODS_WRAP(QueueSubmit) || ODS_WRAP(WaitForFences);
#undef ODS_WRAP
  return function;
}

PFN_vkGetDeviceProcAddr real_device_functions = nullptr;

PFN_vkVoidFunction VKAPI_PTR device_function(VkDevice device, const char* name) {
  return wrapped(name, real_device_functions(device, name));
}

}  // namespace

void fail_vulkan(VulkanCall call, int n, int result) {
  planned = {call, n, result};
}

int count_vulkan_calls(VulkanCall call) {
  return counts[static_cast<size_t>(call)];
}

bool has_vulkan_failed() {
  const bool has_failed = planned.left == 0;
  planned.left = 0;
  return has_failed;
}

extern "C" PFN_vkVoidFunction vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  static void* const library = dlopen(VULKAN_LOADER, RTLD_NOW | RTLD_LOCAL);
  if (!library) return nullptr;
  static const auto real = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  const PFN_vkVoidFunction function = real(instance, name);
  if (std::string_view(name) != "vkGetDeviceProcAddr") return wrapped(name, function);
  real_device_functions = reinterpret_cast<PFN_vkGetDeviceProcAddr>(function);
  return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
}
