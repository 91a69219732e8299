// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Vulkan's functions, from the loader of the system. Only .cpp files of this folder include this file.
#pragma once
#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

#include <string>

// The functions that rendering calls: of the loader, of an instance, of a device.
// clang-format off
#define ODS_VULKAN_GLOBAL(F) F(vkCreateInstance)
#define ODS_VULKAN_INSTANCE(F) \
  F(vkDestroyInstance) F(vkEnumeratePhysicalDevices) F(vkGetPhysicalDeviceProperties2) \
  F(vkGetPhysicalDeviceFeatures2) F(vkGetPhysicalDeviceMemoryProperties) \
  F(vkGetPhysicalDeviceQueueFamilyProperties) F(vkCreateDevice) F(vkGetDeviceProcAddr)
#define ODS_VULKAN_DEVICE(F) \
  F(vkDestroyDevice) F(vkGetDeviceQueue) F(vkDeviceWaitIdle) F(vkCreateBuffer) F(vkDestroyBuffer) \
  F(vkGetBufferMemoryRequirements) F(vkGetBufferDeviceAddress) F(vkAllocateMemory) F(vkFreeMemory) \
  F(vkBindBufferMemory) F(vkMapMemory) F(vkCreateShaderModule) F(vkDestroyShaderModule) \
  F(vkCreatePipelineLayout) F(vkDestroyPipelineLayout) F(vkCreateComputePipelines) F(vkDestroyPipeline) \
  F(vkCreatePipelineCache) F(vkDestroyPipelineCache) F(vkGetPipelineCacheData) F(vkCreateCommandPool) \
  F(vkDestroyCommandPool) F(vkAllocateCommandBuffers) F(vkBeginCommandBuffer) F(vkEndCommandBuffer) \
  F(vkCmdBindPipeline) F(vkCmdPushConstants) F(vkCmdDispatch) F(vkCmdDispatchIndirect) F(vkCmdPipelineBarrier) F(vkCmdCopyBuffer) \
  F(vkCmdFillBuffer) F(vkCreateQueryPool) F(vkDestroyQueryPool) F(vkCmdResetQueryPool) \
  F(vkCmdWriteTimestamp) F(vkGetQueryPoolResults) F(vkQueueSubmit) F(vkCreateFence) F(vkDestroyFence) F(vkWaitForFences) F(vkResetFences)
// clang-format on

namespace ods {

struct VulkanFunctions {
#define ODS_DECLARE(name) PFN_##name name = nullptr;
  ODS_VULKAN_GLOBAL(ODS_DECLARE)
  ODS_VULKAN_INSTANCE(ODS_DECLARE)
  ODS_VULKAN_DEVICE(ODS_DECLARE)
#undef ODS_DECLARE
};

// The opened loader, an instance, and the functions of both. Without a loader `fault` has the reason, and the remedy.
class VulkanInstance {
 public:
  VulkanInstance();
  ~VulkanInstance();
  VulkanInstance(const VulkanInstance&) = delete;
  VulkanInstance& operator=(const VulkanInstance&) = delete;

  VulkanFunctions functions;
  VkInstance instance = VK_NULL_HANDLE;  // null if there is a fault
  std::string fault;
};

// Adds a device's functions. Returns false if one is missing.
bool add_device_functions(VulkanFunctions& functions, VkDevice device);

}  // namespace ods
