// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/outliers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ods/denoise/membership.h"
#include "ods/denoise/other_view.h"

namespace ods {
namespace {

constexpr int kOutlierReach = 2;            // radius of the window for detecting outliers
constexpr float kMaxNeighbourShare = 2.0f;  // an outlier is brighter than its neighbours' total light over this
constexpr float kSigmas = 3.0f;   // a pixel that is brighter by this many of its own deviations is not an outlier
constexpr float kSeen = 0.03f;    // target fraction of the light that spread light adds
constexpr float kMaxSeen = 0.1f;  // maximum fraction; the rest brightens the whole picture
constexpr float kNarrowest = 8.0f, kWidest = 64.0f;  // radius in pixels over which light is spread
constexpr double kVisits = 8.0;                      // visits of a pixel by outliers, on average; limits the time

float mean_of(vec3 v) {
  return (v.x + v.y + v.z) * (1.0f / 3.0f);
}

vec3 light_at(const Level& level, size_t pixel) {
  return {level.light[3 * pixel], level.light[3 * pixel + 1], level.light[3 * pixel + 2]};
}

bool is_known(const Level& level, size_t pixel) {
  return unpack_variance(level.variance[pixel]) >= 0.0f && std::isfinite(mean_of(light_at(level, pixel)));
}

// A pixel without its outlier.
struct Taken {
  Outlier outlier;
  vec3 light{0.0f};
  float variance = 0.0f;
  bool exists = false;
};

// Calls `see` for the neighbours within kOutlierReach until it returns false.
template <typename See>
void each_neighbour(const NoisyPicture& noisy, const std::vector<Level>& levels, const Outlier& at, const Cell& cell,
                    const See& see) {
  for (int dy = -kOutlierReach; dy <= kOutlierReach; dy++) {
    for (int dx = -kOutlierReach; dx <= kOutlierReach; dx++) {
      if (dx == 0 && dy == 0) continue;
      const auto texel = texel_at(noisy, at.eye, cell, at.x + dx, at.y + dy);
      if (!texel) continue;
      const size_t pixel = noisy.index(texel->x, texel->y);
      const Level& level = levels[static_cast<size_t>(texel->source_eye)];
      if (!noisy.have_one_owner(noisy.index(at.x, at.y), pixel)) continue;
      if (is_known(level, pixel) && !see(noisy.eye(texel->source_eye), level, pixel)) return;
    }
  }
}

// The brightest neighbour may be an outlier too, and is left out.
Taken take(const NoisyPicture& noisy, const std::vector<Level>& levels, const Outlier& at, const Cell& cell) {
  const EyeImage& eye = noisy.eye(at.eye);
  const Level& level = levels[static_cast<size_t>(at.eye)];
  const size_t pixel = noisy.index(at.x, at.y);
  const float own = unpack_variance(level.variance[pixel]);
  const vec3 light = light_at(level, pixel), by = divisor(eye, pixel);
  Taken taken{at};
  // Most pixels return here.
  if (!(own > 0.0f) || mean_of(light) * 0.9f > kSigmas * std::sqrt(own) || is_bare_sky(eye, pixel)) return taken;
  const float bright = mean_of(light * by);
  float sum = 0.0f, maximum = 0.0f;
  int count = 0;
  each_neighbour(noisy, levels, at, cell, [&](const EyeImage& from, const Level& theirs, size_t i) {
    const float radiance = std::max(mean_of(light_at(theirs, i) * divisor(from, i)), 0.0f);
    sum += radiance, maximum = std::max(maximum, radiance), count++;
    return sum - maximum < kMaxNeighbourShare * bright;
  });
  if (count < 12 || !(sum - maximum < kMaxNeighbourShare * bright)) return taken;
  const vec3 normal = normal_at(eye, pixel), albedo = albedo_at(eye, pixel);
  float weights = 0.0f;
  bool left_out = false;
  each_neighbour(noisy, levels, at, cell, [&](const EyeImage& from, const Level& theirs, size_t i) {
    const vec3 there = light_at(theirs, i), dn = normal_at(from, i) - normal, da = albedo_at(from, i) - albedo;
    if (!left_out && std::max(mean_of(there * divisor(from, i)), 0.0f) == maximum) return left_out = true;
    const float weight = 1e-3f + feature_weight(dot(dn, dn), dot(da, da));
    taken.light += weight * there, taken.variance += weight * unpack_variance(theirs.variance[i]), weights += weight;
    return true;
  });
  taken.light = min(taken.light / weights, light), taken.variance /= weights;
  taken.outlier.excess = (light - taken.light) * by;
  taken.exists = mean_of(light - taken.light) > 2.5f * std::sqrt(taken.variance) && taken.variance > 0.0f;
  return taken;
}

// The target of an outlier's light.
struct Splash {
  int eye;
  int x, y;
  Cell cell;
  vec3 light;  // radiance: the total of the outlier
  vec3 normal;
  float radius;
};

// The radius over which the light becomes nearly invisible.
float radius_of(const NoisyPicture& noisy, const std::vector<Level>& levels, const Splash& splash) {
  const size_t pixel = noisy.index(splash.x, splash.y);
  const vec3 here = light_at(levels[static_cast<size_t>(splash.eye)], pixel) * divisor(noisy.eye(splash.eye), pixel);
  const float area = mean_of(splash.light) / (kSeen * std::max(mean_of(here), 1e-6f));  // a third of the circle's area
  return std::clamp(std::sqrt(3.0f / kPi * area), kNarrowest, kWidest);
}

// Returns nullopt if the other eye does not see the surface, or has no noise there.
std::optional<Outlier> in_other_eye(const NoisyPicture& noisy, const std::vector<Level>& levels, const Outlier& at) {
  const auto surface = surface_at(noisy, at.eye, at.x, at.y);
  if (!surface) return {};
  const int eye = 1 - at.eye;
  const auto place = place_in_view({noisy, levels, eye}, *surface);
  if (!place) return {};
  const int x = std::clamp(static_cast<int>(place->at.x), 0, noisy.width() - 1);
  const int y = std::clamp(static_cast<int>(place->at.y), 0, noisy.height() - 1);
  const size_t pixel = noisy.index(x, y);
  const vec3 dn = normal_at(noisy.eye(eye), pixel) - normal_at(noisy.eye(at.eye), noisy.index(at.x, at.y));
  const bool takes = unpack_variance(levels[static_cast<size_t>(eye)].variance[pixel]) > 0.0f;
  return takes && feature_weight(dot(dn, dn), 0.0f) > 0.5f ? std::optional(Outlier{eye, x, y, {}}) : std::nullopt;
}

std::vector<Splash> splashes_of(const NoisyPicture& noisy, const std::vector<Outlier>& outliers, bool both,
                                const std::vector<Level>& levels) {
  std::vector<Splash> splashes;
  const auto add = [&](int eye, int x, int y, vec3 light, vec3 normal) {
    const vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    const Cell cell = cell_of(noisy.camera.projection, noisy.shape.size, middle);
    Splash splash{eye, x, y, cell, light, normal, 0.0f};
    splash.radius = radius_of(noisy, levels, splash);
    splashes.push_back(splash);
  };
  for (const Outlier& each : outliers) {
    const vec3 normal = normal_at(noisy.eye(each.eye), noisy.index(each.x, each.y));
    const std::optional<Outlier> there = both ? in_other_eye(noisy, levels, each) : std::nullopt;
    add(each.eye, each.x, each.y, there ? 0.5f * each.excess : each.excess, normal);
    if (there) add(there->eye, there->x, there->y, 0.5f * each.excess, normal);
  }
  double visits = 0.0;
  for (const Splash& each : splashes) visits += double{kPi} * double{each.radius * each.radius};
  const double maximum = kVisits * static_cast<double>(levels.size()) * static_cast<double>(levels[0].variance.size());
  const float scale = static_cast<float>(std::sqrt(std::min(maximum / visits, 1.0)));
  for (Splash& each : splashes) each.radius = std::max(each.radius * scale, 3.0f);
  return splashes;
}

// Light on a surface has the surface's colours, so textures are preserved. Returns the light that would be visible
// there.
vec3 add_splash(const NoisyPicture& noisy, const Splash& splash, Level& level) {
  struct Share {
    size_t pixel;
    vec3 radiance;  // radiance of the light that it receives
  };
  const EyeImage& eye = noisy.eye(splash.eye);
  std::vector<Share> shares;
  vec3 sum(0.0f);
  float here = 0.0f;  // light already in these pixels, with the same weights
  const int reach = static_cast<int>(splash.radius);
  for (int dy = -reach; dy <= reach; dy++) {
    for (int dx = -reach; dx <= reach; dx++) {
      const float away = static_cast<float>(dx * dx + dy * dy) / (splash.radius * splash.radius);
      if (away >= 1.0f) continue;
      const auto texel = texel_at(noisy, splash.eye, splash.cell, splash.x + dx, splash.y + dy);
      if (!texel || texel->source_eye != splash.eye) continue;
      const size_t pixel = noisy.index(texel->x, texel->y);
      if (!(unpack_variance(level.variance[pixel]) > 0.0f)) continue;
      if (!noisy.have_one_owner(noisy.index(splash.x, splash.y), pixel)) continue;
      const vec3 dn = normal_at(eye, pixel) - splash.normal;
      const float weight = taper(away) * feature_weight(dot(dn, dn), 0.0f);
      if (weight == 0.0f) continue;
      shares.push_back({pixel, weight * divisor(eye, pixel)});
      sum += shares.back().radiance;
      here += weight * std::max(mean_of(light_at(level, pixel) * divisor(eye, pixel)), 0.0f);
    }
  }
  if (shares.empty()) return splash.light;
  const float part = std::min(kMaxSeen * here / std::max(mean_of(splash.light), 1e-20f), 1.0f);
  for (const Share& share : shares) {
    const vec3 light = part * splash.light * share.radiance / (sum * divisor(eye, share.pixel));
    for (int c = 0; c < 3; c++) level.light[3 * share.pixel + static_cast<size_t>(c)] += light[c];
  }
  return (1.0f - part) * splash.light;
}

// Adds this much light to all noisy pixels of these eyes, multiplying them by a common factor.
void brighten(const NoisyPicture& noisy, float light, size_t first_eye, size_t end, std::vector<Level>& levels) {
  double all = 0.0;
  const auto each = [&](const auto& visit) {
    for (size_t eye = first_eye; eye < end; eye++) {
      for (size_t pixel = 0; pixel < levels[eye].variance.size(); pixel++) {
        if (unpack_variance(levels[eye].variance[pixel]) > 0.0f && is_known(levels[eye], pixel)) visit(eye, pixel);
      }
    }
  };
  each([&](size_t eye, size_t pixel) {
    const vec3 radiance = light_at(levels[eye], pixel) * divisor(noisy.eye(static_cast<int>(eye)), pixel);
    all += std::max(static_cast<double>(mean_of(radiance)), 0.0);
  });
  if (!(all > 0.0)) return;
  const auto factor = static_cast<float>(1.0 + static_cast<double>(light) / all);
  each([&](size_t eye, size_t pixel) {
    for (size_t c = 0; c < 3; c++) levels[eye].light[3 * pixel + c] *= factor;
  });
}

}  // namespace

std::vector<Outlier> take_outliers(const NoisyPicture& noisy, std::vector<Level>& levels) {
  std::vector<std::vector<Taken>> rows(levels.size() * static_cast<size_t>(noisy.height()));
  tbb::parallel_for(size_t{0}, rows.size(), [&](size_t row) {
    const int eye = static_cast<int>(row / static_cast<size_t>(noisy.height()));
    const int y = static_cast<int>(row % static_cast<size_t>(noisy.height()));
    for (const Cell& cell : noisy.cells) {
      if (y < cell.top || y >= cell.bottom) continue;
      for (int x = cell.left; x < cell.right; x++) {
        const Taken taken = take(noisy, levels, {eye, x, y}, cell);
        if (taken.exists) rows[row].push_back(taken);
      }
    }
  });
  std::vector<Outlier> outliers;
  for (const std::vector<Taken>& row : rows) {
    for (const Taken& taken : row) {
      Level& level = levels[static_cast<size_t>(taken.outlier.eye)];
      const size_t pixel = noisy.index(taken.outlier.x, taken.outlier.y);
      for (int c = 0; c < 3; c++) level.light[3 * pixel + static_cast<size_t>(c)] = taken.light[c];
      level.variance[pixel] = pack_variance(taken.variance);
      outliers.push_back(taken.outlier);
    }
  }
  return outliers;
}

void spread_outliers(const NoisyPicture& noisy, const std::vector<Outlier>& outliers, bool both,
                     std::vector<Level>& levels) {
  if (outliers.empty()) return;
  const std::vector<Splash> splashes = splashes_of(noisy, outliers, both, levels);
  // In the order of the eyes, so that sums have the same bits for any number of threads.
  std::vector<vec3> left(levels.size(), vec3(0.0f));
  tbb::parallel_for(size_t{0}, levels.size(), [&](size_t eye) {
    for (const Splash& splash : splashes) {
      if (splash.eye == static_cast<int>(eye)) left[eye] += add_splash(noisy, splash, levels[eye]);
    }
  });
  if (both) {
    brighten(noisy, mean_of(std::accumulate(left.begin(), left.end(), vec3(0.0f))), 0, levels.size(), levels);
    return;
  }
  for (size_t eye = 0; eye < levels.size(); eye++) brighten(noisy, mean_of(left[eye]), eye, eye + 1, levels);
}

}  // namespace ods
