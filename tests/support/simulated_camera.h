// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Raw files of cameras with two fisheyes, in a world by formula: circles anywhere on the sensor, with what real
// sensors add.
#pragma once
#include <array>
#include <functional>
#include <string>

#include "ods/camera/direction_map.h"
#include "ods/camera/layout.h"
#include "ods/image/image.h"

namespace ods {

// Values as displayed, 0..1.
struct SensorFlaws {
  float black = 0.0f;     // of the sensor around the circles
  float glow = 0.0f;      // at the rim, outside, fading within a few percent of the radius
  float vignette = 0.0f;  // fraction of the light that is lost at the rim
  float soft = 0.004f;    // width of the rim, relative to the radius
  float noise = 0.0f;     // standard deviation
};

struct SimulatedCamera {
  Layout layout = Layout::kSideBySide;
  Extent half{480, 480};
  std::array<FisheyeLens, 2> lenses;  // in pixels of the halves; the second one's yaw includes 180 degrees
  SensorFlaws flaws;
};

// The light that comes from a direction to the lens in the first (0) or second (1) half, as displayed, 0..1.
using LensWorld = std::function<float(int lens, vec3 direction)>;

// Writes a grey picture, as JPEG of this quality.
void write_raw_file(const std::string& path, const SimulatedCamera& camera, const LensWorld& world, int quality);

}  // namespace ods
