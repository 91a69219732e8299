// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Removes the noise of a path traced picture, both eyes together, using the renderer's data about each pixel.
//
// Its steps, in order:
//
// - Fireflies are replaced by the light around them. Their light is spread widely at the end (ods/denoise/outliers.h).
// - If depth is known, a pixel takes light from the same surface in the other eye's picture, and in the previous and
//   next frames of a video, tracked by the exact motion of camera and scene. It does if the two means do not differ
//   significantly, given the variance of both (Sakai et al., "A Statistical Approach to Monte Carlo Denoising", 2024).
// - Five passes, each in a window twice as wide, average pixels of similar normals and albedos (ods/denoise/filter.h).
//   The light that a pass removes is restored where it is more than noise (ods/denoise/detail.h).
// - Pixels on edges are computed from the light of the adjacent surfaces by their normals and albedos
//   (ods/denoise/edges.h).
//
// Light is averaged without the albedo, so textures are preserved. Windows continue over the seam, the poles and the
// edges of cube faces.
//
// The picture converges to the truth: with more samples the variance decreases and more detail is restored. A pixel
// whose variance is 0, like its neighbours', keeps its bits, and so does the bare sky (no hit, no normal).
//
// In a texture (texel_camera() in ods/camera/stereo_camera.h), light is only mixed among texels with one owner.
#pragma once
#include <span>
#include <vector>

#include "ods/base/names.h"
#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"

namespace ods {

// The denoiser for a rendered picture.
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

// A previous or next frame of the same video, as rendered, with the same eyes, size and layers. It is only used if it
// has depth.
struct FrameBeside {
  const Picture& picture;
  StereoCamera camera;
  // For each eye and pixel of the denoised frame, row by row: the position of the surface in the pixel's centre at the
  // time of this frame, in world coordinates. If empty, the present position is used, as in scenes where only the
  // camera moves.
  std::span<const std::vector<vec3>> places;
  // Set if both frames have the same random numbers in a pixel. Static pixels then have the same noise and are left
  // out.
  bool same_noise = false;
};

// Returns whether some pixel has the samples that its variance needs: a picture that was interrupted may have too few.
// Precondition: the picture has the layers `variance` and `samples`.
bool has_variance(const Picture& picture);

struct DenoiseOptions {
  bool both_eyes = true;                  // if false, each eye is denoised separately
  int threads = 0;                        // 0 for all processors
  std::span<const FrameBeside> beside{};  // frames of a video
  bool keep_statistics = true;            // if false, variance and samples are freed, which needs less memory
};

// Replaces the radiance by the denoised one, with the same bits for any number of threads. Needs the layer `variance`;
// uses `samples`, `normal`, `albedo` and `depth` if they are present. Variance that is NaN, infinite, negative, or from
// fewer than 2 samples counts as unknown and is taken from the neighbours. Radiance that is not finite is replaced by
// the mean of the neighbours, if there are any. Needs 45 bytes per pixel in addition to the picture, and 15 per pixel
// of each other frame. Throws Error(kInput) if no pixel has a usable variance, Error(kMemory), Error(kCancelled).
// Precondition: one or two eyes of equal size with radiance and variance.
void denoise(Picture& picture, const StereoCamera& camera, const DenoiseOptions& options = {},
             const Progress& progress = {});

}  // namespace ods
