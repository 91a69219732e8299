// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes the exposure for a picture's light, as a camera or an eye would choose it.
#pragma once
#include <optional>
#include <span>

#include "ods/camera/stereo_camera.h"
#include "ods/image/tone.h"
#include "ods/picture/picture.h"
#include "ods/render/render_options.h"
#include "ods/scene/scene.h"

namespace ods {

// The options and the camera of the picture that measures the light: small, one eye between the two, a few samples, all
// directions around the camera. It has the same bits in every run on one device, independent of the size of the final
// picture.
RenderOptions metering_options(const RenderOptions& options);
StereoCamera metering_camera(const StereoCamera& camera);

// The exposure in stops, rounded to tenths, for one or several such pictures (frames of a video) together. The mean of
// the logarithm of luminance becomes kExposedMean. The mean is weighted by solid angle, excludes black, and weights the
// sky at most half as much as surfaces. The exposure is lower if more than kHighlightShare of the sphere would be
// brighter than kHighlight; the sky through windows is exempt if it is less than kWindowShare of the sphere. Returns
// nullopt if everything is black. Light is first averaged over 4 x 4 pixels, because single pixels of so few samples
// are noisy.
std::optional<float> suitable_exposure(std::span<const Picture> looks);

// Adds stops to an exposure, within kMaxStops. Rounds the result, so that it equals the printed number.
float brightened(float exposure, float brighter);

// The tone curve of a scene's display-referred pictures, if none is given: linear if its colours are shown as painted
// (Scene::as_painted).
ToneCurve usual_tone(const Scene& scene);

inline constexpr float kExposedMean = 0.18f;  // middle grey
inline constexpr float kHighlight = 1.5f;     // PBR Neutral shows it at 0.93
inline constexpr float kHighlightShare = 0.05f;
inline constexpr float kWindowShare = 0.15f;
inline constexpr float kMaxStops = 30.0f;

}  // namespace ods
