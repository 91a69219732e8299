// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A loader of Vulkan that passes every call on to the system's, until a test has one fail. A program that links it has
// opened it before ods looks for libvulkan.so.1.
#pragma once

// The calls that can fail; all of them return a VkResult.
enum class VulkanCall {
  kCreateInstance,
  kEnumeratePhysicalDevices,
  kCreateDevice,
  kCreateBuffer,
  kAllocateMemory,
  kBindBufferMemory,
  kMapMemory,
  kCreateShaderModule,
  kCreateComputePipelines,
  kCreatePipelineCache,
  kCreateCommandPool,
  kBeginCommandBuffer,
  kEndCommandBuffer,
  kQueueSubmit,
  kWaitForFences,
};
inline constexpr int kVulkanCalls = static_cast<int>(VulkanCall::kWaitForFences) + 1;

// Makes the n-th such call from now, 1 for the next, return this VkResult, once.
void fail_vulkan(VulkanCall call, int n, int result);

// Returns the number of such calls so far.
int count_vulkan_calls(VulkanCall call);

// Returns whether the call that should fail has done so, and cancels it otherwise.
bool has_vulkan_failed();
