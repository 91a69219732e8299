// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/gpu_samples.h"

#include <algorithm>
#include <span>

#include "ods/picture/picture.h"

namespace ods {

namespace {

// Returns whether the planes are more than zeros.
bool has_samples(const PictureSamples& samples) {
  return samples.done > 0 || samples.blocks_done > 0;
}

// Both eyes' numbers of a plane, as the device has them. Where it is empty in one eye, it is in the other, too.
template <typename Number>
GpuBuffer put(GpuDevice& device, const PictureSamples& samples, std::vector<Number> EyeSamples::*plane) {
  const size_t bytes = (samples.eyes.front().*plane).size() * sizeof(Number);
  const GpuBuffer buffer = device.make_buffer(samples.eyes.size() * bytes);
  if (!has_samples(samples)) return buffer;
  for (size_t eye = 0; eye < samples.eyes.size(); eye++) {
    device.upload(buffer, eye * bytes, std::as_bytes(std::span(samples.eyes[eye].*plane)));
  }
  return buffer;
}

template <typename Number>
void get(GpuDevice& device, const GpuBuffer& buffer, PictureSamples& samples, std::vector<Number> EyeSamples::*plane) {
  size_t from = 0;
  for (EyeSamples& eye : samples.eyes) {
    const std::span bytes = std::as_writable_bytes(std::span(eye.*plane));
    device.download(buffer, from, bytes);
    from += bytes.size();
  }
}

GpuBuffer put_squares(GpuDevice& device, const PictureSamples& samples) {
  std::vector<float> pairs;
  for (const EyeSamples& eye : samples.eyes) {
    for (const double square : eye.squares) {
      const auto high = static_cast<float>(square);
      pairs.push_back(high);
      pairs.push_back(static_cast<float>(square - double{high}));
    }
  }
  const GpuBuffer buffer = device.make_buffer(pairs.size() * sizeof(float));
  if (has_samples(samples)) device.upload(buffer, 0, std::as_bytes(std::span(pairs)));
  return buffer;
}

void get_squares(GpuDevice& device, const GpuBuffer& buffer, PictureSamples& samples) {
  std::vector<float> pairs(buffer.bytes / sizeof(float));
  device.download(buffer, 0, std::as_writable_bytes(std::span(pairs)));
  size_t at = 0;
  for (EyeSamples& eye : samples.eyes) {
    for (double& square : eye.squares) {
      square = double{pairs[at]} + double{pairs[at + 1]};
      at += 2;
    }
  }
}

}  // namespace

GpuSamples::GpuSamples(GpuDevice& device, const PictureSamples& samples, GpuView& view) : device_(device) {
  view.light = (light_ = put(device, samples, &EyeSamples::light)).address;
  view.squares = (squares_ = put_squares(device, samples)).address;
  view.alone = (alone_ = put(device, samples, &EyeSamples::alone)).address;
  view.weights = (weights_ = put(device, samples, &EyeSamples::weights)).address;
  view.normal = (normal_ = put(device, samples, &EyeSamples::normal)).address;
  view.albedo = (albedo_ = put(device, samples, &EyeSamples::albedo)).address;
  view.depth = (depth_ = put(device, samples, &EyeSamples::depth)).address;
  view.hits = (hits_ = put(device, samples, &EyeSamples::hits)).address;
  view.caught = (caught_ = put(device, samples, &EyeSamples::caught)).address;
  view.light_with = (light_with_ = put(device, samples, &EyeSamples::light_with)).address;
  view.light_without = (light_without_ = put(device, samples, &EyeSamples::light_without)).address;
  view.far_depth = kFarDepth;
  const EyeSamples& eye = samples.eyes.front();
  view.has_squares = eye.squares.empty() ? 0 : 1;
  view.has_alone = eye.alone.empty() ? 0 : 1;
  view.has_layers = eye.normal.empty() ? 0 : 1;
  view.has_hits = eye.hits.empty() ? 0 : 1;
}

GpuSamples::~GpuSamples() {
  for (const GpuBuffer& buffer :
       {light_, squares_, alone_, weights_, normal_, albedo_, depth_, hits_, caught_, light_with_, light_without_}) {
    device_.free(buffer);
  }
}

void GpuSamples::fetch(PictureSamples& samples) const {
  get(device_, light_, samples, &EyeSamples::light);
  get_squares(device_, squares_, samples);
  get(device_, alone_, samples, &EyeSamples::alone);
  get(device_, weights_, samples, &EyeSamples::weights);
  get(device_, normal_, samples, &EyeSamples::normal);
  get(device_, albedo_, samples, &EyeSamples::albedo);
  get(device_, depth_, samples, &EyeSamples::depth);
  get(device_, hits_, samples, &EyeSamples::hits);
  get(device_, caught_, samples, &EyeSamples::caught);
  get(device_, light_with_, samples, &EyeSamples::light_with);
  get(device_, light_without_, samples, &EyeSamples::light_without);
}

}  // namespace ods
