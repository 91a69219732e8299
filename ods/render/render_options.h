// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Options for rendering a scene on any device.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"

namespace ods {

enum class Eyes { kBothEyes, kLeftEye, kRightEye, kMonoEye };

inline constexpr NameRow<Eyes> kEyesTable[] = {
    {Eyes::kBothEyes, "both"},
    {Eyes::kLeftEye, "left"},
    {Eyes::kRightEye, "right"},
    {Eyes::kMonoEye, "mono"},
};
static_assert(has_every_member(kEyesTable));
inline constexpr auto kAllEyes = members_of(kEyesTable);
constexpr std::string_view eyes_name(Eyes eyes) {
  return name_in(kEyesTable, eyes);
}
std::vector<int> eye_list(Eyes eyes);  // as in EyeImage: kLeft, kRight, kMono

enum class PixelFilter { kBlackmanHarris, kBox };
inline constexpr NameRow<PixelFilter> kPixelFilterTable[] = {
    {PixelFilter::kBlackmanHarris, "blackman-harris"},
    {PixelFilter::kBox, "box"},
};
static_assert(has_every_member(kPixelFilterTable));
inline constexpr auto kPixelFilters = members_of(kPixelFilterTable);
constexpr std::string_view pixel_filter_name(PixelFilter filter) {
  return name_in(kPixelFilterTable, filter);
}

// The path of light through smooth solids of glass and liquid: refracted, which paths find by chance only, or straight,
// as through a window (ods/kernel/path_light.h). The camera sees them refract in both modes.
enum class Caustics { kPath, kStraight };
inline constexpr NameRow<Caustics> kCausticsTable[] = {
    {Caustics::kPath, "path"},
    {Caustics::kStraight, "straight"},
};
static_assert(has_every_member(kCausticsTable));
constexpr std::string_view caustics_name(Caustics caustics) {
  return name_in(kCausticsTable, caustics);
}

// The method of finding indirect light: by whole paths, or by paths that end in a cache, which is filled first
// (ods/kernel/light_cache.h). The cache is much faster in rooms, with an error of a few per mille.
enum class Indirect { kPath, kCache };
inline constexpr NameRow<Indirect> kIndirectTable[] = {
    {Indirect::kPath, "path"},
    {Indirect::kCache, "cache"},
};
static_assert(has_every_member(kIndirectTable));
constexpr std::string_view indirect_name(Indirect indirect) {
  return name_in(kIndirectTable, indirect);
}

// The method by which paths find light. Use kBoth; the others exist for tests.
enum class LightSampling { kBoth, kLightsOnly, kBsdfOnly };

// Maximum number of samples of a pixel.
inline constexpr int kMaxSamples = 1 << 20;

// One of several parts of a picture that are rendered separately, each with different samples: {2, 6} is the second
// sixth.
struct Part {
  int number = 1;  // 1 .. count
  int count = 1;
};

// Parses a part as users write it: 3/8. Returns nullopt for other texts, or for more parts than a picture can have
// samples.
std::optional<Part> parse_part(const std::string& text);
std::string part_text(const Part& part);

struct RenderOptions {
  int width = 2048;             // size of one eye
  int height = 0;               // natural_height() of the camera's projection if 0
  int samples = 64;             // maximum per pixel, 1 .. kMaxSamples
  float noise = 0.0f;           // blocks of pixels stop at this noise, in Cycles' measure; 0 to disable
  float noise_exposure = 0.0f;  // stops: noise is judged in the picture as displayed with this exposure
  double time_limit = 0.0;      // seconds after which no further samples begin; 0 for no limit
  Part part;                    // part of the samples; needs noise 0 and no time limit
  bool even_noise = true;  // fewer samples for pixels that cover little of the sphere, as near the poles of lat-long
  int bounces = 8;         // a path has up to bounces + 1 segments
  float clamp = 0.0f;      // maximum light of paths that have met two surfaces or more; 0 for no limit
  Caustics caustics = Caustics::kPath;
  Indirect indirect = Indirect::kPath;
  int cache_paths = 0;  // paths that fill the cache; 0 for a fraction of the picture's, and no cache for small pictures
  Eyes eyes = Eyes::kBothEyes;
  bool share_paths = true;  // paths of one eye contribute light to both, if both see the first surface
  PixelFilter filter = PixelFilter::kBlackmanHarris;  // radius 1.5 pixels; the box is 1 pixel wide
  bool layers = true;        // depth, normal and albedo beside radiance; otherwise their images are empty
  bool transparent = false;  // the sky lights the scene but is invisible: alpha is 0 where a ray hits nothing;
                             // required if the scene has catchers (ods/scene/catchers.h)
  bool statistics = false;   // variance and samples beside radiance
  uint32_t seed = 0;
  int threads = 0;           // 0 for all processors
  int gpu = -1;              // number of the graphics card that renders (ods/render/gpu/gpu_device.h); -1 for the CPU
  std::string shader_cache;  // folder for shaders compiled for that card; none if empty
  LightSampling light_sampling = LightSampling::kBoth;
  bool last_tile_first = false;  // renders the tiles in reverse, for tests that the order changes nothing
};

// The samples of options.part: numbers begin .. end - 1.
struct SampleRange {
  int begin;
  int end;
};
SampleRange samples_of_part(const RenderOptions& options);

}  // namespace ods
