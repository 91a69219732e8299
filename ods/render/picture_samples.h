// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sums of a picture's samples: the state of a picture that is being rendered.
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
  std::vector<uint32_t> count;  // number of samples per pixel
  std::vector<int64_t> light;   // 3 per pixel, in units of 1 / kLightUnit

  // For RenderOptions::statistics or noise: the variation of samples. Doubles are added in the order of the samples.
  std::vector<double> squares;    // 3 per pixel: squares of the samples' radiance
  std::vector<int64_t> alone;     // if the eyes share paths: light without sharing; `squares` are also without sharing
  std::vector<uint32_t> weights;  // if the eyes share paths: squares of the samples' weights in light, over kWeightUnit

  // For RenderOptions::layers.
  std::vector<int32_t> normal;  // 3 per pixel, in units of 1 / layer_unit()
  std::vector<int32_t> albedo;  // 3 per pixel, in units of 1 / layer_unit()
  std::vector<float> depth;     // as in EyeImage; negative for a catcher

  // For RenderOptions::transparent.
  std::vector<uint32_t> hits;          // samples that hit something other than a catcher
  std::vector<uint32_t> caught;        // samples that hit a catcher, and the light that they found (ods/kernel/path.h)
  std::vector<int64_t> light_with;     // luminance, in units of 1 / kLightUnit
  std::vector<int64_t> light_without;  // luminance, in units of 1 / kLightUnit
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
  int pass_to = 0;             // end of the current pass; `done` if there is none
  int blocks_done = 0;         // in the current pass
  std::vector<uint8_t> noisy;  // per block (ods/render/sampling_plan.h): bits 0 and 1 for the classes of its pixels
                               // that are still sampled
  float judged_at = 0.0f;      // RenderOptions::noise_exposure at the last call of judge_noise()
  std::vector<EyeSamples> eyes;
};

// A sum of 2^20 samples of the maximum half float does not overflow, and the unit is the smallest half float.
inline constexpr double kLightUnit = 1 << 24;

inline constexpr float kWeightUnit = 1 << 10;

// Maximum radiance of a sample; brighter ones are clamped.
inline constexpr float kBrightestSample = 1 << 19;

// The unit of normals and albedo: their components are at most 1, and the sum of all samples fits into 31 bits.
double layer_unit(const RenderOptions& options);

// Returns whether paths of one eye contribute light to the other (ods/kernel/path.h).
bool shares_paths(const RenderOptions& options);

// Samples of a picture that is not started yet. Precondition: options.height > 0.
PictureSamples no_samples(const RenderOptions& options);

// Returns whether these can be the samples of a picture with these options; for samples from a file.
bool fit(const PictureSamples& samples, const RenderOptions& options);

// The total number of samples of all pixels of all eyes.
uint64_t count_samples(const PictureSamples& samples);

// The memory for no_samples(), bytes.
size_t samples_bytes(const RenderOptions& options);

// Computes the picture from the samples. A pixel without samples is black. In the middle of a pass, eyes that share
// paths need `alone`.
Picture develop(PictureSamples samples, const RenderOptions& options);

// The variance of a pixel's mean, per channel, with the light that the other eye's paths brought. 0 if the pixel has
// less than two samples. Not in the middle of a pass, when light that the eyes share is incomplete.
vec3 variance_of_mean(const EyeSamples& eye, size_t pixel);

}  // namespace ods
