// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Removes the noise of a path traced picture, both eyes as one, from what the renderer knows about each pixel.
//
// A pixel becomes a weighted mean of pixels around it, in growing windows. A pixel takes part if, given the variance of
// both, the two means do not differ significantly (Sakai et al., "A Statistical Approach to Monte Carlo Denoising",
// 2024), and if its normal and albedo are similar. Light is averaged without the albedo, so textures stay. Windows
// continue over the seam, the poles and the edges of cube faces. Where depth is known, the second set of candidates is
// the same surface in the other eye's picture: both eyes get the same light, and less noise.
//
// Fireflies are replaced by what is around them first, and their light is spread widely at the end
// (ods/denoise/outliers.h).
//
// Frames of a video find a third set of candidates in the frames before and after them: the same surface, followed
// by the exact motion of camera and scene. So the noise that is left flickers less.
//
// The picture converges to the truth: with more samples the variance falls and fewer pixels agree. A pixel whose
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
// the neighbours, if there are any. Needs 28 bytes for each pixel beside the picture, and 14 for each of a frame beside
// it. Throws Error(kInput) if no pixel has a usable variance, Error(kMemory), Error(kCancelled). Precondition: one or
// two eyes of equal size with radiance and variance.
void denoise(Picture& picture, const StereoCamera& camera, const DenoiseOptions& options = {},
             const Progress& progress = {});

}  // namespace ods
