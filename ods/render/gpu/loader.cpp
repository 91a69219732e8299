// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/loader.h"

#include <dlfcn.h>

namespace ods {
namespace {

// The names under which systems have the loader.
constexpr const char* kLibraries[] = {"libvulkan.so.1", "libvulkan.so"};

// The library stays open: some drivers crash when it is closed and opened again.
PFN_vkGetInstanceProcAddr open_loader() {
  for (const char* name : kLibraries) {
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
      return reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    }
  }
  return nullptr;
}

}  // namespace

VulkanInstance::VulkanInstance() {
  const PFN_vkGetInstanceProcAddr find = open_loader();
  if (!find) {
    fault = "Vulkan's loader libvulkan.so.1 is not installed; Debian and Ubuntu have it as libvulkan1";
    return;
  }
#define ODS_LOAD(name) functions.name = reinterpret_cast<PFN_##name>(find(VK_NULL_HANDLE, #name));
  ODS_VULKAN_GLOBAL(ODS_LOAD)
#undef ODS_LOAD
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "ods";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (!functions.vkCreateInstance || functions.vkCreateInstance(&info, nullptr, &instance) != VK_SUCCESS) {
    instance = VK_NULL_HANDLE;
    fault = "no driver for Vulkan 1.2 is installed; mesa-vulkan-drivers has those for AMD and Intel";
    return;
  }
  bool complete = true;
#define ODS_LOAD(name)                                                  \
  functions.name = reinterpret_cast<PFN_##name>(find(instance, #name)); \
  complete = complete && functions.name != nullptr;
  ODS_VULKAN_INSTANCE(ODS_LOAD)
#undef ODS_LOAD
  if (!complete) fault = "Vulkan's loader is older than 1.2";
}

// The first instance stays, and with it the drivers: NVIDIA's cannot be opened again after a dozen times.
VulkanInstance::~VulkanInstance() {
  if (instance == VK_NULL_HANDLE) return;
  static const VkInstance kept = instance;
  if (instance != kept) functions.vkDestroyInstance(instance, nullptr);
}

bool add_device_functions(VulkanFunctions& functions, VkDevice device) {
  bool complete = true;
#define ODS_LOAD(name)                                                                         \
  functions.name = reinterpret_cast<PFN_##name>(functions.vkGetDeviceProcAddr(device, #name)); \
  complete = complete && functions.name != nullptr;
  ODS_VULKAN_DEVICE(ODS_LOAD)
#undef ODS_LOAD
  return complete;
}

}  // namespace ods
