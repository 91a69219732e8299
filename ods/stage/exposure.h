// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The exposure that suits a picture's light, as a camera or an eye would choose it.
#pragma once
#include <optional>
#include <span>

#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"
#include "ods/render/render_options.h"

namespace ods {

// How the light of a picture is measured: by a small picture of one eye between the two, with a few samples, of
// everything around the camera. It has the same bits in every run and for every size of the picture itself.
RenderOptions first_look(const RenderOptions& options);
StereoCamera first_look_camera(const StereoCamera& camera);

// The exposure in stops, rounded to tenths, for one or several such looks (frames of a video) together. The mean of the
// logarithm of luminance, by solid angle, the sky at most with half the weight of surfaces,
// and without what is black, becomes kExposedMean; but less than that where
// kHighlightShare of the sphere would be brighter than kHighlight: the sky through windows, where it is less than
// kWindowShare of the sphere, may be. None if all is black. Light is averaged over 4 x 4
// pixels first, as single pixels of so few samples are noise.
std::optional<float> suitable_exposure(std::span<const Picture> looks);

// That exposure and some stops more, within kMostStops; rounded, so that it is the same number where it is printed.
float brightened(float exposure, float brighter);

inline constexpr float kExposedMean = 0.18f;  // middle grey
inline constexpr float kHighlight = 1.5f;     // PBR Neutral shows it at 0.93
inline constexpr float kHighlightShare = 0.05f;
inline constexpr float kWindowShare = 0.15f;
inline constexpr float kMostStops = 30.0f;

}  // namespace ods
