// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts scene-linear light for a display: exposure, tone curve, sRGB.
#pragma once
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/kernel/math.h"

namespace ods {

enum class ToneCurve {
  kNeutral,  // Khronos PBR Neutral: colours below 0.76 nearly unchanged, highlights rolled off towards white
  kLinear,   // unchanged, clipped at 1
};

// `neutral`, `linear`: the names on the command line.
inline constexpr NameRow<ToneCurve> kToneCurveTable[] = {
    {ToneCurve::kNeutral, "neutral"},
    {ToneCurve::kLinear, "linear"},
};
static_assert(has_every_member(kToneCurveTable));
inline constexpr auto kToneCurves = members_of(kToneCurveTable);
constexpr std::string_view tone_curve_name(ToneCurve curve) {
  return name_in(kToneCurveTable, curve);
}

// Multiplies the light by 2^exposure, then applies the curve. Input and output are linear Rec. 709; the output is 0..1.
// NaN and negative light become 0; infinite light counts as the largest float. Source of neutral: Khronos, "PBR Neutral
// Tone Mapper Specification" (github.com/KhronosGroup/ToneMapping).
vec3 tone_map(vec3 light, float exposure, ToneCurve curve);

// IEC 61966-2-1: linear 0..1 <-> encoded 0..1.
float srgb_encode(float linear);
float srgb_decode(float encoded);

// Returns a table of linear light, indexed by code value 0..largest.
std::vector<float> linear_from_encoded(int largest);

}  // namespace ods
