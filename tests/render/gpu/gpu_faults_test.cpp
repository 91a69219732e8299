// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Drivers that fail in every way, at every call.
#include <array>
#include <functional>
#include <set>

#include "ods/base/error.h"
#include "ods/render/gpu/gpu_renderer.h"
#include "ods/scene/builtin/builtin.h"
#include "tests/render/gpu/agreement.h"
#include "tests/render/gpu/fake_vulkan.h"

namespace ods::gpu_faults_test {

// Values of VkResult.
constexpr int kNoMemory = -2, kLost = -4, kNoDriver = -9, kUnknown = -13;

RenderOptions tiny_options() {
  RenderOptions options;
  options.width = 16;
  options.samples = 2;
  return with_height(options, StereoCamera{});
}

// Returns the error of some work; empty if there was none.
std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kDevice) << error.what();
    return error.what();
  }
  return "";
}

std::string error_of_rendering(const Scene& scene, int number) {
  return error_of([&] { sampled(GpuRenderer(scene, std::make_shared<GpuDevice>(number)), {}, tiny_options()); });
}

std::array<int, kVulkanCalls> calls_of(const std::function<void()>& work) {
  std::array<int, kVulkanCalls> counts{};
  for (int call = 0; call < kVulkanCalls; call++) counts[call] = -count_vulkan_calls(static_cast<VulkanCall>(call));
  work();
  for (int call = 0; call < kVulkanCalls; call++) counts[call] += count_vulkan_calls(static_cast<VulkanCall>(call));
  return counts;
}

// The first call of each kind in some work fails, and a later one. How many calls there are depends on the time, more so
// while shaders are compiled.
void expect_one_line(const std::function<void()>& work) {
  work();
  const std::array<int, kVulkanCalls> counts = calls_of(work);
  for (int call = 0; call < kVulkanCalls; call++) {
    for (const int n : std::set{1, (counts[call] + 2) / 3}) {
      if (n < 1 || n > counts[call]) continue;
      fail_vulkan(static_cast<VulkanCall>(call), n, kNoMemory);
      const std::string error = error_of(work);
      EXPECT_TRUE(has_vulkan_failed()) << call << ", " << n;
      EXPECT_NE(error, "") << call << ", " << n;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
  EXPECT_EQ(error_of(work), "");
}

class GpuFaults : public OnCard {};

TEST_F(GpuFaults, EveryFailureIsOneLine) {
  const Scene scene = find_builtin("furnace")->make();
  expect_one_line([&] { GpuRenderer(scene, std::make_shared<GpuDevice>(number)); });
  const GpuRenderer renderer(scene, std::make_shared<GpuDevice>(number));
  expect_one_line([&] { sampled(renderer, {}, tiny_options()); });
}

TEST_F(GpuFaults, SayWhatHappenedAndWhatToTry) {
  const Scene scene = find_builtin("furnace")->make();
  const auto expect_words = [&](VulkanCall call, int result, const std::string& words) {
    fail_vulkan(call, 1, result);
    const std::string error = error_of_rendering(scene, number);
    EXPECT_TRUE(has_vulkan_failed()) << words;
    EXPECT_NE(error.find(words), std::string::npos) << error;
    EXPECT_NE(error.find("`device` cpu"), std::string::npos) << error;
  };
  expect_words(VulkanCall::kAllocateMemory, kNoMemory, "too little memory");
  expect_words(VulkanCall::kQueueSubmit, kLost, "stopped working");
  expect_words(VulkanCall::kWaitForFences, kLost, "stopped working");
  expect_words(VulkanCall::kCreateComputePipelines, kUnknown, "cannot compile the shaders");
}

TEST_F(GpuFaults, WithoutADriverThereAreNoDevices) {
  fail_vulkan(VulkanCall::kCreateInstance, 1, kNoDriver);
  const GpuList list = list_gpus();
  EXPECT_TRUE(has_vulkan_failed());
  EXPECT_TRUE(list.gpus.empty());
  EXPECT_NE(list.fault.find("mesa-vulkan-drivers"), std::string::npos) << list.fault;
  fail_vulkan(VulkanCall::kEnumeratePhysicalDevices, 1, kNoMemory);
  EXPECT_NE(list_gpus().fault, "");
  EXPECT_TRUE(has_vulkan_failed());
}

// A card that is lost in the middle of a picture: what was kept is resumed with the bits of a picture at once.
TEST_F(GpuFaults, NothingThatWasKeptIsLost) {
  const Scene scene = find_builtin("furnace")->make();
  const StereoCamera camera;
  RenderOptions options = tiny_options();
  options.noise = 1e-4f;  // several passes
  options.samples = 64;
  PictureSamples kept = no_samples(options);
  int polls = 0;
  Progress stops;
  stops.cancelled = [&] { return ++polls == 1; };
  PictureSamples samples = kept;
  const auto keep = [&](const PictureSamples& now) { kept = now; };
  EXPECT_THROW(GpuRenderer(scene, card).sample({&camera, 1}, options, samples, stops, keep), Error);
  EXPECT_GT(count_samples(kept), 0u);
  samples = kept;
  {
    const GpuRenderer renderer(scene, std::make_shared<GpuDevice>(number));
    fail_vulkan(VulkanCall::kQueueSubmit, 40, kLost);
    EXPECT_THROW(renderer.sample({&camera, 1}, options, samples, {}, keep), Error);
    EXPECT_TRUE(has_vulkan_failed());
  }
  samples = kept;
  const GpuRenderer renderer(scene, card);
  renderer.sample({&camera, 1}, options, samples);
  EXPECT_EQ(samples.eyes[0].light, sampled(renderer, camera, options).eyes[0].light);
}

}  // namespace ods::gpu_faults_test
