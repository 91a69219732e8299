// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The planes of PictureSamples in the memory of a graphics card, one eye after the other.
#pragma once
#include <vector>

#include "ods/render/gpu/gpu_device.h"
#include "ods/render/gpu/shaders/shared.h"
#include "ods/render/picture_samples.h"

namespace ods {

class GpuSamples {
 public:
  // Copies the samples to the device, which must outlive this object, and fills in the addresses in the view. Sums of
  // squares become pairs of floats, 48 of their 53 bits.
  GpuSamples(GpuDevice& device, const PictureSamples& samples, GpuView& view);
  ~GpuSamples();
  GpuSamples(const GpuSamples&) = delete;
  GpuSamples& operator=(const GpuSamples&) = delete;

  // Copies the planes back, except the counts, which the host keeps. samples: those of the constructor.
  void fetch(PictureSamples& samples) const;

 private:
  GpuDevice& device_;
  GpuBuffer light_, squares_, alone_, weights_, normal_, albedo_, depth_, hits_, caught_, light_with_, light_without_;
};

}  // namespace ods
