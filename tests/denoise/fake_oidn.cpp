// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stands in for Open Image Denoise 2: halves every colour, and remembers what it was given.
#include <cstring>
#include <string>
#include <vector>

#define FAKE extern "C" __attribute__((visibility("default")))

namespace {

struct Call {
  size_t width = 0, height = 0;
  float* color = nullptr;
  float* albedo = nullptr;
  float* normal = nullptr;
  float* output = nullptr;
  bool hdr = false;
  float scale = 0.0f;
};

int device;
bool fails = false;
std::vector<float> scales;
std::vector<std::vector<float>> colors;
std::vector<size_t> widths;
size_t with_features = 0;

}  // namespace

FAKE void* oidnNewDevice(int) {
  return &device;
}
FAKE void oidnSetDeviceInt(void*, const char*, int) {}
FAKE void oidnCommitDevice(void*) {}
FAKE int oidnGetDeviceError(void*, const char** message) {
  *message = "no more of this";
  return fails ? 1 : 0;
}
FAKE void oidnReleaseDevice(void*) {}
FAKE void* oidnNewFilter(void*, const char* type) {
  return std::strcmp(type, "RT") == 0 ? new Call : nullptr;
}
FAKE void oidnSetSharedFilterImage(void* filter, const char* name, void* pixels, int format, size_t width,
                                   size_t height, size_t, size_t, size_t) {
  Call& call = *static_cast<Call*>(filter);
  if (format != 3) fails = true;
  call.width = width, call.height = height;
  float*& to = std::strcmp(name, "color") == 0    ? call.color
               : std::strcmp(name, "albedo") == 0 ? call.albedo
               : std::strcmp(name, "normal") == 0 ? call.normal
                                                  : call.output;
  to = static_cast<float*>(pixels);
}
FAKE void oidnSetFilterBool(void* filter, const char*, bool value) {
  static_cast<Call*>(filter)->hdr = value;
}
FAKE void oidnSetFilterFloat(void* filter, const char*, float value) {
  static_cast<Call*>(filter)->scale = value;
}
FAKE void oidnCommitFilter(void*) {}
FAKE void oidnExecuteFilter(void* filter) {
  const Call& call = *static_cast<Call*>(filter);
  if (!call.hdr) fails = true;
  const size_t count = 3 * call.width * call.height;
  for (size_t i = 0; i < count; i++) call.output[i] = 0.5f * call.color[i];
  scales.push_back(call.scale);
  colors.emplace_back(call.color, call.color + count);
  widths.push_back(call.width);
  if (call.albedo && call.normal) with_features++;
}
FAKE void oidnReleaseFilter(void* filter) {
  delete static_cast<Call*>(filter);
}

FAKE void fake_reset(bool failing) {
  fails = failing;
  scales.clear(), colors.clear(), widths.clear();
  with_features = 0;
}
FAKE const std::vector<float>& fake_scales() {
  return scales;
}
FAKE const std::vector<std::vector<float>>& fake_colors() {
  return colors;
}
FAKE const std::vector<size_t>& fake_widths() {
  return widths;
}
FAKE size_t fake_with_features() {
  return with_features;
}
