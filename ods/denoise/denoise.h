// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Removes the noise of a path traced picture, both eyes as one, from what the renderer knows about each pixel.
//
// Its steps, in order:
//
// - Fireflies are replaced by what is around them. Their light is spread widely at the end (ods/denoise/outliers.h).
// - Where depth is known, a pixel takes light from the same surface in the other eye's picture, and in the frames
//   of a video before and after, followed by the exact motion of camera and scene. It does if the two means do not
//   differ significantly, given the variance of both (Sakai et al., "A Statistical Approach to Monte Carlo Denoising",
//   2024).
// - Five passes, each in a window twice as wide, average pixels of similar normals and albedos (ods/denoise/filter.h).
//   What a pass takes away comes back as far as it is more than noise (ods/denoise/detail.h).
// - Pixels on edges become what the surfaces beside them make of their normals and albedos (ods/denoise/edges.h).
//
// Light is averaged without the albedo, so textures stay. Windows continue over the seam, the poles and the edges of
// cube faces.
//
// The picture converges to the truth: with more samples the variance falls and more detail comes back. A pixel whose
// variance is 0, as its neighbours', keeps its bits, and so does the bare sky (no hit, no normal).
#pragma once
#include <span>
#include <vector>

#include "ods/base/names.h"
#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"

namespace ods {

// How a rendered picture is denoised.
enum class Denoiser {
  kNone,
  kOwn,   // denoise()
  kOidn,  // denoise_with_oidn() (ods/denoise/oidn.h)
};
inline constexpr NameRow<Denoiser> kDenoiserTable[] = {
    {Denoiser::kNone, "none"},
    {Denoiser::kOwn, "own"},
    {Denoiser::kOidn, "oidn"},
};
static_assert(has_every_member(kDenoiserTable));

// A frame of the same video, before or after the one that is denoised, as rendered: with the same eyes, size and
// layers. Without depth it is of no use.
struct FrameBeside {
  const Picture& picture;
  StereoCamera camera;
  // For each eye and pixel of the frame that is denoised, in its rows: where the surface in the pixel's middle is at
  // the time of this frame, in world coordinates. Empty: where it is now, as in scenes where only the camera moves.
  std::span<const std::vector<vec3>> places;
  // Whether both frames have the same random numbers in a pixel. What stays where it is has the same noise, then, and
  // is left out.
  bool same_noise = false;
};

struct DenoiseOptions {
  bool both_eyes = true;                  // false: each eye alone
  int threads = 0;                        // 0: all processors
  std::span<const FrameBeside> beside{};  // of a video's frame
  bool keep_statistics = true;            // false: variance and samples are gone afterwards, and need no memory
};

// Replaces the radiance by the denoised one; the same bits for any number of threads. Needs the layer `variance`; uses
// `samples`, `normal`, `albedo` and `depth` if they are present. Variance that is NaN, infinite, negative, or of fewer
// than 2 samples counts as unknown and is taken from the neighbours. Radiance that is not finite becomes the mean of
// the neighbours, if there are any. Needs 45 bytes for each pixel beside the picture, and 15 for each of a frame beside
// it. Throws Error(kInput) if no pixel has a usable variance, Error(kMemory), Error(kCancelled). Precondition: one or
// two eyes of equal size with radiance and variance.
void denoise(Picture& picture, const StereoCamera& camera, const DenoiseOptions& options = {},
             const Progress& progress = {});

}  // namespace ods
