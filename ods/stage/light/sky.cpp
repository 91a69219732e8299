// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/sky.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace ods {
namespace {

using glm::dvec2, glm::dvec3;
using std::numbers::pi;

// Kilometres.
constexpr double kGround = 6360.0;
constexpr double kTop = 6460.0;
constexpr double kViewer = kGround + 0.01;
constexpr double kSunRadius = 0.004654;  // radians
// A clear day: aerosol has a vertical optical depth of 0.06, of which it absorbs a tenth.
constexpr double kAerosol = 0.9 * 0.06 / 1.2;  // scattering per kilometre at sea level
constexpr double kAerosolHeight = 1.2;         // scale height of its density
constexpr double kAirHeight = 8.0;
constexpr double kForward = 0.76;  // mean cosine of aerosol's scattering
constexpr double kGroundAlbedo = 1.0 / 3.0;

// Rayleigh scattering of air per kilometre at sea level: refractive index 1.0003, 2.545e25 molecules per cubic metre,
// depolarization 0.035.
dvec3 air_scattering() {
  const double n = 1.0003, molecules = 2.545e25, depolarized = 0.035;
  const double squared = n * n - 1.0;
  const double king = (6.0 + 3.0 * depolarized) / (6.0 - 7.0 * depolarized);
  const auto at = [&](double wavelength) {
    return 1e3 * 8.0 * std::pow(pi, 3.0) * squared * squared / (3.0 * molecules * std::pow(wavelength, 4.0)) * king;
  };
  return {at(680e-9), at(550e-9), at(440e-9)};
}

const dvec3 kAir = air_scattering();
const dvec3 kOzone(0.650e-3, 1.881e-3, 0.085e-3);  // absorption per kilometre, 25 km up

struct Density {
  dvec3 air;  // scattering per kilometre
  double aerosol;
  dvec3 extinction;
};

// radius: distance from the planet's centre.
Density density_at(double radius) {
  const double height = std::max(radius - kGround, 0.0);
  Density density;
  density.air = kAir * std::exp(-height / kAirHeight);
  density.aerosol = kAerosol * std::exp(-height / kAerosolHeight);
  density.extinction =
      density.air + 10.0 / 9.0 * density.aerosol + kOzone * std::max(0.0, 1.0 - std::abs(height - 25.0) / 15.0);
  return density;
}

// The distance along a ray that starts at this radius, at this cosine from straight up, to a sphere outside.
double distance_to(double sphere, double radius, double up) {
  return -radius * up + std::sqrt(std::max(0.0, radius * radius * (up * up - 1.0) + sphere * sphere));
}

// The cosine from straight up of the direction to the horizon.
double horizon_at(double radius) {
  const double share = kGround / radius;
  return -std::sqrt(std::max(0.0, 1.0 - share * share));
}

dvec3 transmittance_to_top(double radius, double up, int steps) {
  const double length = distance_to(kTop, radius, up);
  dvec3 depth(0.0);
  double before = 0.0;
  for (int i = 0; i < steps; i++) {
    const double share = (i + 1.0) / steps, after = length * share * share;  // the air is densest near the viewer
    const double at = 0.5 * (before + after);
    depth += density_at(std::sqrt(radius * radius + at * at + 2.0 * radius * at * up)).extinction * (after - before);
    before = after;
  }
  return glm::exp(-depth);
}

// A table of numbers with interpolation; x and y are 0..1.
struct Table {
  Table(int width, int height) : columns(width), rows(height), texels(static_cast<size_t>(width * height)) {}
  dvec3& at(int x, int y) { return texels[static_cast<size_t>(y * columns + x)]; }
  const dvec3& at(int x, int y) const { return texels[static_cast<size_t>(y * columns + x)]; }
  dvec3 read(double x, double y) const {
    x = std::clamp(x, 0.0, 1.0) * (columns - 1), y = std::clamp(y, 0.0, 1.0) * (rows - 1);
    const int left = std::min(static_cast<int>(x), columns - 2), above = std::min(static_cast<int>(y), rows - 2);
    return glm::mix(glm::mix(at(left, above), at(left + 1, above), x - left),
                    glm::mix(at(left, above + 1), at(left + 1, above + 1), x - left), y - above);
  }
  int columns;
  int rows;
  std::vector<dvec3> texels;
};

// Transmittance to the top of the atmosphere, in Bruneton and Neyret's parameters: by the distance to the top and to
// the horizon.
class Transmittance {
 public:
  Transmittance() : table_(128, 48) {
    for (int y = 0; y < table_.rows; y++) {
      const double to_horizon = kSpan * y / (table_.rows - 1);
      const double radius = std::sqrt(to_horizon * to_horizon + kGround * kGround);
      for (int x = 0; x < table_.columns; x++) {
        const double share = static_cast<double>(x) / (table_.columns - 1);
        const double length = glm::mix(kTop - radius, to_horizon + kSpan, share);
        const double up =
            length > 0.0 ? (kSpan * kSpan - to_horizon * to_horizon - length * length) / (2.0 * radius * length) : 1.0;
        table_.at(x, y) = transmittance_to_top(radius, std::clamp(up, -1.0, 1.0), 80);
      }
    }
  }

  // Transmittance of the sun's light, at this cosine from straight up; the planet hides the sun as it sets.
  dvec3 to_sun(double radius, double up) const {
    const double horizon = horizon_at(radius);
    const double risen = glm::smoothstep(-kSunRadius, kSunRadius, up - horizon);
    if (risen == 0.0) return dvec3(0.0);
    const double to_horizon = std::sqrt(std::max(0.0, radius * radius - kGround * kGround));
    const double nearest = kTop - radius, farthest = to_horizon + kSpan;
    const double length = distance_to(kTop, radius, std::max(up, horizon));
    return risen * table_.read((length - nearest) / (farthest - nearest), to_horizon / kSpan);
  }

 private:
  static inline const double kSpan = std::sqrt(kTop * kTop - kGround * kGround);
  Table table_;
};

// Light that a ray collects from a sun of irradiance 1, still without the phase functions.
struct Gathered {
  dvec3 by_air{0.0};
  dvec3 by_aerosol{0.0};
  dvec3 by_any{0.0};  // from light that was scattered before
  dvec3 evenly{0.0};  // from light of radiance 1 in all directions
  dvec3 transmittance{1.0};
};

// Integrates along a ray from this radius, of this length. direction: Y is up. sun: unit vector. again: radiance of
// light that was scattered before, by height and by the sun's cosine from straight up; null if not yet known.
Gathered gather(const Transmittance& transmittance, const Table* again, double radius, dvec3 direction, dvec3 sun,
                double length, int steps) {
  Gathered sum;
  double before = 0.0;
  for (int i = 0; i < steps; i++) {
    const double share = (i + 1.0) / steps, after = length * share * share, step = after - before;
    const dvec3 place = dvec3(0.0, radius, 0.0) + direction * (0.5 * (before + after));
    const double here = glm::length(place), sun_up = glm::dot(place, sun) / here;
    const Density density = density_at(here);
    const dvec3 passing = glm::exp(-density.extinction * step);
    const dvec3 weight = sum.transmittance * (1.0 - passing) / density.extinction;
    const dvec3 lit = weight * transmittance.to_sun(here, sun_up);
    sum.by_air += lit * density.air;
    sum.by_aerosol += lit * density.aerosol;
    sum.evenly += weight * (density.air + density.aerosol);
    if (again) {
      sum.by_any += weight * (density.air + density.aerosol) *
                    again->read(0.5 + 0.5 * sun_up, (here - kGround) / (kTop - kGround));
    }
    sum.transmittance *= passing;
    before = after;
  }
  return sum;
}

// Radiance after two or more scatterings, equal from all sides: the second order from a sphere of directions, and the
// sum of a geometric series for all higher orders.
dvec3 scattered_again(const Transmittance& transmittance, double radius, double sun_up) {
  constexpr int kRings = 8;
  const dvec3 sun(std::sqrt(std::max(0.0, 1.0 - sun_up * sun_up)), sun_up, 0.0);
  dvec3 second(0.0), kept(0.0);
  for (int ring = 0; ring < kRings; ring++) {
    const double up = 1.0 - (2.0 * ring + 1.0) / kRings, across = std::sqrt(1.0 - up * up);
    const bool down = up < horizon_at(radius);
    const double length =
        down ? -radius * up - std::sqrt(std::max(0.0, radius * radius * (up * up - 1.0) + kGround * kGround))
             : distance_to(kTop, radius, up);
    for (int i = 0; i < kRings; i++) {
      const double azimuth = 2.0 * pi * (i + 0.5) / kRings;
      const dvec3 direction(across * std::cos(azimuth), up, across * std::sin(azimuth));
      const Gathered found = gather(transmittance, nullptr, radius, direction, sun, length, 20);
      second += (found.by_air + found.by_aerosol) / (4.0 * pi);
      kept += found.evenly;
      if (!down) continue;
      const dvec3 hit = dvec3(0.0, radius, 0.0) + direction * length;
      const double falls = std::max(0.0, glm::dot(hit, sun) / glm::length(hit));
      second += found.transmittance * transmittance.to_sun(kGround, falls) * (falls * kGroundAlbedo / pi);
    }
  }
  constexpr double kShare = 1.0 / (kRings * kRings);
  return second * kShare / (1.0 - kept * kShare);
}

Table scattered_again_table(const Transmittance& transmittance) {
  Table table(32, 24);
  for (int y = 0; y < table.rows; y++) {
    // The very top has no air, and upward rays from there have no length.
    const double radius = glm::mix(kGround, kTop, std::min(y / (table.rows - 1.0), 0.999));
    for (int x = 0; x < table.columns; x++) {
      table.at(x, y) = scattered_again(transmittance, radius, 2.0 * x / (table.columns - 1.0) - 1.0);
    }
  }
  return table;
}

// Normalized so that 4 pi times the value is 1 on average.
double air_phase(double cosine) {
  return 3.0 / (16.0 * pi) * (1.0 + cosine * cosine);
}

// Source: Cornette and Shanks, "Physically reasonable analytic expression for the single-scattering phase function",
// 1992.
double aerosol_phase(double cosine) {
  constexpr double g = kForward;
  return 3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + cosine * cosine) /
         ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}

// The sky above the horizon for a sun of irradiance 1, without its disc.
class Dome {
 public:
  explicit Dome(double sun_elevation)
      : sun_(std::cos(sun_elevation), std::sin(sun_elevation), 0.0),
        by_air_(33, 97),
        by_aerosol_(33, 97),
        by_any_(33, 97) {
    const Transmittance transmittance;
    const Table again = scattered_again_table(transmittance);
    for (int y = 0; y < by_air_.rows; y++) {
      const double share = y / (by_air_.rows - 1.0), elevation = 0.5 * pi * share * share;
      const double length = distance_to(kTop, kViewer, std::sin(elevation));
      for (int x = 0; x < by_air_.columns; x++) {
        const dvec3 direction = direction_of(pi * x / (by_air_.columns - 1.0), elevation);
        const Gathered found = gather(transmittance, &again, kViewer, direction, sun_, length, 48);
        by_air_.at(x, y) = found.by_air;
        by_aerosol_.at(x, y) = found.by_aerosol;
        by_any_.at(x, y) = found.by_any;
      }
    }
  }

  // azimuth: from the sun's, radians, 0..pi. Precondition: elevation >= 0.
  dvec3 radiance(double azimuth, double elevation) const {
    const double x = azimuth / pi, y = std::sqrt(elevation / (0.5 * pi));
    const double cosine = glm::dot(direction_of(azimuth, elevation), sun_);
    return by_air_.read(x, y) * air_phase(cosine) + by_aerosol_.read(x, y) * aerosol_phase(cosine) + by_any_.read(x, y);
  }

 private:
  static dvec3 direction_of(double azimuth, double elevation) {
    return {std::cos(azimuth) * std::cos(elevation), std::sin(elevation), std::sin(azimuth) * std::cos(elevation)};
  }

  dvec3 sun_;
  Table by_air_;
  Table by_aerosol_;
  Table by_any_;
};

constexpr int kWidth = 1024;
constexpr int kHeight = 512;

// The solid angle over which interpolation spreads a texel of this row, with each direction's weight. Beyond the
// centres of the first and the last row, the row is constant.
double spread_of_row(int row) {
  constexpr int kSteps = 64;
  double sum = 0.0;
  for (int i = 0; i < 2 * kSteps; i++) {
    const double place = row - 0.5 + (i + 0.5) / kSteps;  // in rows from the top
    if (place < 0.0 || place > kHeight) continue;
    const double distance = std::abs(place - (row + 0.5));
    const bool at_pole = place < 0.5 || place > kHeight - 0.5;
    sum += (at_pole ? 1.0 : 1.0 - distance) * std::sin(pi * place / kHeight);
  }
  return sum * (pi / kHeight / kSteps) * (2.0 * pi / kWidth);
}

dvec3 irradiance_at_sea_level(double elevation) {
  return transmittance_to_top(kGround, std::sin(elevation), 1000) * double{kSunAboveAir};
}

// Adds the part of the disc that is above the horizon. Returns the irradiance on the ground.
dvec3 add_sun(double azimuth, double elevation, std::vector<dvec3>& texels) {
  constexpr int kRings = 64, kSpokes = 256;
  const dvec3 irradiance = irradiance_at_sea_level(elevation);
  double on_ground = 0.0;
  for (int ring = 0; ring < kRings; ring++) {
    const double away = kSunRadius * std::sqrt((ring + 0.5) / kRings);
    for (int spoke = 0; spoke < kSpokes; spoke++) {
      const double around = 2.0 * pi * (spoke + 0.5) / kSpokes;
      // A point of the disc, relative to the sun's centre: up and to the right.
      const double higher = away * std::cos(around), right = away * std::sin(around);
      const dvec3 place(std::cos(elevation) - higher * std::sin(elevation),
                        std::sin(elevation) + higher * std::cos(elevation), right);
      const double up = place.y / glm::length(place);
      if (up <= 0.0) continue;
      on_ground += up / (kRings * kSpokes);
      const double turned = (azimuth + std::atan2(place.z, place.x)) / (2.0 * pi) + 0.5;
      const int column = std::min(static_cast<int>((turned - std::floor(turned)) * kWidth), kWidth - 1);
      const int row = std::min(static_cast<int>(std::acos(std::min(up, 1.0)) / pi * kHeight), kHeight / 2 - 1);
      texels[static_cast<size_t>(row * kWidth + column)] += irradiance / (kRings * kSpokes * spread_of_row(row));
    }
  }
  return irradiance * on_ground;
}

// Returns the irradiance on the ground.
dvec3 add_dome(const Dome& dome, double sun_azimuth, std::vector<dvec3>& texels) {
  dvec3 on_ground(0.0);
  for (int y = 0; y < kHeight / 2; y++) {
    const double elevation = pi * (0.5 - (y + 0.5) / kHeight);
    dvec3 row(0.0);
    for (int x = 0; x < kWidth; x++) {
      const double away = std::abs(std::remainder(2.0 * pi * ((x + 0.5) / kWidth - 0.5) - sun_azimuth, 2.0 * pi));
      const dvec3 radiance = dome.radiance(away, elevation) * double{kSunAboveAir};
      texels[static_cast<size_t>(y * kWidth + x)] += radiance;
      row += radiance;
    }
    on_ground += row * (std::sin(elevation) * std::cos(elevation) * (pi / kHeight) * (2.0 * pi / kWidth));
  }
  return on_ground;
}

// Radiance of the ground far below, which fades into the sky at the horizon. horizon: a row of the sky.
void add_ground(dvec3 radiance, const std::vector<dvec3>& horizon, std::vector<dvec3>& texels) {
  for (int y = kHeight / 2; y < kHeight; y++) {
    const double below = 180.0 * ((y + 0.5) / kHeight - 0.5);
    const double haze = std::exp(-below / 2.5);
    for (int x = 0; x < kWidth; x++) {
      texels[static_cast<size_t>(y * kWidth + x)] = glm::mix(radiance, horizon[static_cast<size_t>(x)], haze);
    }
  }
}

}  // namespace

Environment make_sky(const SkyOptions& options) {
  assert(options.elevation >= 0.0f && options.elevation <= 90.0f && std::isfinite(options.azimuth));
  const double elevation = glm::radians(static_cast<double>(options.elevation));
  const double azimuth = glm::radians(static_cast<double>(options.azimuth));
  std::vector<dvec3> texels(static_cast<size_t>(kWidth * kHeight));
  dvec3 on_ground = add_dome(Dome(elevation), azimuth, texels);
  const auto horizon = texels.begin() + (kHeight / 2 - 1) * kWidth;
  const std::vector<dvec3> haze(horizon, horizon + kWidth);
  on_ground += add_sun(azimuth, elevation, texels);
  add_ground(on_ground * (kGroundAlbedo / pi), haze, texels);
  Environment sky;
  sky.radiance = vec3(1.0f);
  sky.width = kWidth;
  sky.height = kHeight;
  sky.texels.assign(texels.begin(), texels.end());
  return sky;
}

vec3 sky_ground() {
  return vec3(dvec3(kGroundAlbedo));
}

vec3 sun_irradiance(float elevation) {
  return vec3(irradiance_at_sea_level(glm::radians(static_cast<double>(elevation))));
}

}  // namespace ods
