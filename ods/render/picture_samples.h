// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the samples of a picture have added up to so far: the state of a picture that is being rendered.
//
// The sums are whole numbers. Adding them in another order gives the same bits, so threads may finish in any order and
// several machines can render samples of the same picture.
#pragma once
#include <cstdint>
#include <vector>

#include "ods/kernel/math.h"
#include "ods/picture/picture.h"
#include "ods/render/render_options.h"

namespace ods {

struct EyeSamples {
  int eye = 0;                  // as in EyeImage
  std::vector<uint32_t> count;  // samples of each pixel
  std::vector<int64_t> light;   // 3 per pixel, in units of 1 / kLightUnit

  // RenderOptions::statistics or noise: how much a sample varies. Doubles are added in the order of the samples.
  std::vector<double> squares;    // 3 per pixel: of the samples' radiance
  std::vector<int64_t> alone;     // if the eyes share paths: like light, as if nothing were shared; so are squares
  std::vector<uint32_t> weights;  // likewise: squares of the weights that samples have in light, over kWeightUnit

  // RenderOptions::layers.
  std::vector<int32_t> normal;  // 3 per pixel, in units of 1 / layer_unit()
  std::vector<int32_t> albedo;  // likewise
  std::vector<float> depth;     // as in EyeImage; negative: of a catcher

  // RenderOptions::transparent.
  std::vector<uint32_t> hits;          // samples that hit something that is no catcher
  std::vector<uint32_t> caught;        // samples that hit a catcher, and the light that they found (ods/kernel/path.h)
  std::vector<int64_t> light_with;     // luminance, in units of 1 / kLightUnit
  std::vector<int64_t> light_without;  // likewise
};

// Calls function(name, plane) for each vector of an EyeSamples.
template <typename Eye, typename Function>
void each_plane(Eye& eye, const Function& function) {
  function("count", eye.count), function("light", eye.light);
  function("squares", eye.squares), function("alone", eye.alone), function("weights", eye.weights);
  function("normal", eye.normal), function("albedo", eye.albedo), function("depth", eye.depth);
  function("hits", eye.hits), function("caught", eye.caught);
  function("light_with", eye.light_with), function("light_without", eye.light_without);
}

inline constexpr uint8_t kBothClasses = 3;  // in PictureSamples::noisy

struct PictureSamples {
  int width = 0;
  int height = 0;
  int done = 0;                // pixels that have always been noisy have all samples before this one, or their share
  int pass_to = 0;             // where the pass ends that has begun; `done` if none has
  int blocks_done = 0;         // in that pass
  std::vector<uint8_t> noisy;  // of each block (ods/render/sampling_plan.h): bits 0 and 1 for the classes of its pixels
                               // that are still sampled
  float judged_at = 0.0f;      // RenderOptions::noise_exposure by which judge_noise() has found that out
  std::vector<EyeSamples> eyes;
};

// A sum of 2^20 samples as bright as a half float can be does not overflow, and the unit is the smallest half float.
inline constexpr double kLightUnit = 1 << 24;

inline constexpr float kWeightUnit = 1 << 10;

// A brighter sample counts as this.
inline constexpr float kBrightestSample = 1 << 19;

// Components of normals and albedo are at most 1 in size; as many samples as wanted fit into 31 bits.
double layer_unit(const RenderOptions& options);

// Whether paths of one eye bring light to the other (ods/kernel/path.h).
bool shares_paths(const RenderOptions& options);

// No samples yet. Precondition: options.height > 0.
PictureSamples no_samples(const RenderOptions& options);

// Whether these can be the samples of a picture with these options: for what comes from a file.
bool fit(const PictureSamples& samples, const RenderOptions& options);

// Those of all pixels of all eyes.
uint64_t count_samples(const PictureSamples& samples);

// The memory that no_samples() takes.
size_t samples_bytes(const RenderOptions& options);

// The picture that the samples amount to. A pixel without samples is black. In the middle of a pass, eyes that share
// paths need `alone`.
Picture develop(PictureSamples samples, const RenderOptions& options);

// The variance of a pixel's mean, per channel, with the light that the other eye's paths brought. 0 if the pixel has
// less than two samples. Not in the middle of a pass: one eye then lacks what it has given to the other.
vec3 variance_of_mean(const EyeSamples& eye, size_t pixel);

}  // namespace ods
