// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/front_and_back.h"

#include <algorithm>
#include <cmath>

#include "ods/identify/correlation.h"
#include "ods/identify/lens_detail.h"

namespace ods {

namespace {

constexpr float kUsualFov = 195.0f;  // degrees: of cameras that look ahead and back
constexpr float kMinFov = 183.0f, kMaxFov = 252.0f;

// The samples of a zone beside the camera, where both lenses look.
struct Zone {
  static constexpr int kAround = 720, kAcross = 9;
  float half_width = 0.0f;  // radians

  // The direction of sample i; its elevation above the plane between the lenses grows with i.
  vec3 direction(int i) const {
    const float around = 2.0f * kPi * static_cast<float>(i % kAround) / kAround;
    const float behind = half_width * (2.0f * static_cast<float>(i / kAround) / (kAcross - 1) - 1.0f);
    return vec3(std::cos(behind) * std::cos(around), std::cos(behind) * std::sin(around), std::sin(behind));
  }
};

// The zone that both lenses see, without the outermost rim, which is dark.
Zone zone_of(const std::vector<FisheyeLens>& lenses) {
  return {0.9f * glm::radians(0.5f * lenses[0].fov - 90.0f)};
}

std::vector<std::shared_ptr<const DirectionMap>> maps_of(const LensImages& images, std::vector<FisheyeLens> lenses) {
  lenses[1].yaw += 180.0f;
  const Extent size{images.first.width, images.first.height};
  return {make_map(lenses[0], size), make_map(lenses[1], size)};
}

// The correlation of the images in the zone that both lenses see; -1 if they see none.
float alikeness(const LensImages& images, const std::vector<FisheyeLens>& lenses) {
  const Zone zone = zone_of(lenses);
  const auto maps = maps_of(images, lenses);
  Correlation both;
  for (int i = 0; i < Zone::kAround * Zone::kAcross; i++) {
    const vec3 d = zone.direction(i);
    const ImagePoint p = maps[0]->place(d), q = maps[1]->place(d);
    if (p.seen && q.seen) both.add(sample_at(images.first, p.uv), sample_at(images.second, q.uv));
  }
  return both.count() < Zone::kAround ? -1.0f : both.value();
}

// The correlation of both images just inside their rims, as if nothing was between them.
float rims_alike(const LensImages& images, const std::vector<FisheyeLens>& lenses) {
  constexpr float kInside = 0.97f;
  const vec2 size(static_cast<float>(images.first.width), static_cast<float>(images.first.height));
  const float roll = glm::radians(lenses[1].roll);
  Correlation both;
  for (int i = 0; i < Zone::kAround; i++) {
    const float around = 2.0f * kPi * static_cast<float>(i) / Zone::kAround;
    const vec2 way(std::cos(around), -std::sin(around)), back(-std::cos(around + roll), -std::sin(around + roll));
    const vec2 p = (lenses[0].center + kInside * lenses[0].radius * way) / size;
    const vec2 q = (lenses[1].center + kInside * lenses[1].radius * back) / size;
    if (inside_picture(p) && inside_picture(q)) both.add(sample_at(images.first, p), sample_at(images.second, q));
  }
  return both.count() < Zone::kAround / 4 ? -1.0f : both.value();
}

void set_fov(std::vector<FisheyeLens>& lenses, float fov) {
  for (FisheyeLens& lens : lenses) lens.fov = fov;
}

constexpr float kRolls[] = {0.0f, 90.0f, 180.0f, 270.0f};  // as sensors are mounted

// --- the overlap -----------------------------------------------------------------------------------------------------

// Optimizes one parameter after another, in decreasing steps.
float refine(const LensImages& detail, std::vector<FisheyeLens>& lenses, float first_step, bool is_fov_open) {
  float best = alikeness(detail, lenses);
  using Change = void (*)(std::vector<FisheyeLens>&, float);
  const Change kChanges[] = {[](std::vector<FisheyeLens>& l, float by) { set_fov(l, l[0].fov + by); },
                             [](std::vector<FisheyeLens>& l, float by) { l[1].roll += by; },
                             [](std::vector<FisheyeLens>& l, float by) { l[1].yaw += by; },
                             [](std::vector<FisheyeLens>& l, float by) { l[1].pitch += by; }};
  for (float step = first_step; step > 0.04f; step *= 0.5f) {
    for (int round = 0; round < 3; round++) {
      for (const Change change : kChanges) {
        if (change == kChanges[0] && !is_fov_open) continue;
        for (const float by : {step, -step}) {
          std::vector<FisheyeLens> tried = lenses;
          change(tried, by);
          if (!(tried[0].fov > kMinFov - 2.0f && tried[0].fov < 280.0f)) continue;
          const float alike = alikeness(detail, tried);
          if (alike > best) best = alike, lenses = tried;
        }
      }
    }
  }
  return best;
}

// The best field of view and roll.
struct RoughFit {
  std::vector<FisheyeLens> lenses;
  float alike = -2.0f;
  float other = -2.0f;  // the largest correlation at a field of view that is clearly another
};

RoughFit roughly_aligned(const LensImages& detail, const std::vector<FisheyeLens>& lenses, std::optional<float> fov) {
  constexpr float kStep = 1.5f, kApart = 8.0f;  // degrees
  std::vector<RoughFit> all;
  for (const float roll : kRolls) {
    for (float angle = fov.value_or(kMinFov); angle <= fov.value_or(kMaxFov); angle += kStep) {
      RoughFit& tried = all.emplace_back(RoughFit{lenses});
      set_fov(tried.lenses, angle);
      tried.lenses[1].roll = roll;
      tried.alike = alikeness(detail, tried.lenses);
    }
  }
  RoughFit best =
      *std::max_element(all.begin(), all.end(), [](const RoughFit& a, const RoughFit& b) { return a.alike < b.alike; });
  for (const RoughFit& each : all) {
    if (std::abs(each.lenses[0].fov - best.lenses[0].fov) > kApart) best.other = std::max(best.other, each.alike);
  }
  return best;
}

// The fraction of the outer part of both circles that has detail. Closer to the rim a gradient looks like detail,
// because the squares of lens_detail() are cut.
float detail_beside(const LensImages& detail, const std::vector<FisheyeLens>& lenses) {
  int visible = 0, count = 0;
  const vec2 size(static_cast<float>(detail.first.width), static_cast<float>(detail.first.height));
  for (const size_t which : {0u, 1u}) {
    const Image& image = which == 0 ? detail.first : detail.second;
    for (int i = 0; i < Zone::kAround * Zone::kAcross; i++) {
      const float around = 2.0f * kPi * static_cast<float>(i % Zone::kAround) / Zone::kAround;
      const float r =
          lenses[which].radius * std::lerp(0.74f, 0.86f, static_cast<float>(i / Zone::kAround) / (Zone::kAcross - 1));
      const vec2 at = (lenses[which].center + r * vec2(std::cos(around), std::sin(around))) / size;
      if (!inside_picture(at)) continue;
      count++;
      if (std::abs(sample_at(image, at)) > 0.5) visible++;
    }
  }
  return count > 0 ? static_cast<float>(visible) / static_cast<float>(count) : 0.0f;
}

// --- up --------------------------------------------------------------------------------------------------------------

// The brightness above minus the brightness below, -1..1, in both lenses.
float light_from_above(const LensImages& images, const std::vector<FisheyeLens>& lenses) {
  const Extent size{images.first.width, images.first.height};
  double up = 0.0, all = 0.0;
  for (const size_t which : {0u, 1u}) {
    FisheyeLens lens = lenses[which];
    lens.yaw = lens.pitch = 0.0f;
    const auto map = make_map(lens, size);
    const Image& image = which == 0 ? images.first : images.second;
    for (int i = 0; i < 90 * 30; i++) {
      const float around = 2.0f * kPi * static_cast<float>(i % 90) / 90.0f;
      const float off = 1.4f * static_cast<float>(i / 90 + 1) / 30.0f;
      const vec3 d(std::sin(off) * std::cos(around), std::sin(off) * std::sin(around), -std::cos(off));
      const ImagePoint p = map->place(d);
      if (!p.seen) continue;
      const double light = sample_at(image, p.uv) * std::sin(static_cast<double>(off));
      up += light * static_cast<double>(d.y), all += light * std::abs(static_cast<double>(d.y));
    }
  }
  return all > 0.0 ? static_cast<float>(up / all) : 0.0f;
}

// Rotates the world about the axis of the first lens; the second one looks the other way.
std::vector<FisheyeLens> turned_by(std::vector<FisheyeLens> lenses, float roll) {
  lenses[0].roll += roll, lenses[1].roll -= roll;
  const float c = std::cos(glm::radians(roll)), s = std::sin(glm::radians(roll));
  const float yaw = lenses[1].yaw, pitch = lenses[1].pitch;
  lenses[1].yaw = c * yaw + s * pitch, lenses[1].pitch = c * pitch - s * yaw;
  return lenses;
}

// The overlap gives the relative roll of the lenses, but not which way is up: light comes from there.
void turn_upright(const LensImages& images, std::vector<FisheyeLens>& lenses) {
  const float kLead = 0.15f;  // most cameras store the upper side up
  std::vector<FisheyeLens> best = lenses;
  float lightest = light_from_above(images, lenses) + kLead;
  for (const float roll : {90.0f, 180.0f, 270.0f}) {
    const std::vector<FisheyeLens> turned = turned_by(lenses, roll);
    const float light = light_from_above(images, turned);
    if (light > lightest) lightest = light, best = turned;
  }
  lenses = best;
}

}  // namespace

OppositeLenses align_front_and_back(const LensImages& images, const LensImages& coarse,
                                    const std::vector<FisheyeLens>& lenses, std::optional<float> fov) {
  constexpr float kMinAlike = 0.35f, kMinLead = 0.1f, kMinDetail = 0.1f;
  const bool may_overlap = !fov || *fov > kMinFov;
  OppositeLenses found{.lenses = lenses};
  bool overlaps = false;
  if (may_overlap) {
    const RoughFit rough = roughly_aligned(coarse, lenses, fov);
    found.lenses = rough.lenses;
    found.alike = refine(coarse, found.lenses, 1.0f, !fov);
    // A pattern that repeats itself agrees at several angles.
    overlaps = found.alike > kMinAlike && (fov || rough.alike > rough.other + kMinLead);
    if (overlaps) {
      const Image first = lens_detail(images.first, lenses[0], kFineDetail),
                  second = lens_detail(images.second, lenses[1], kFineDetail);
      found.alike = refine({first, second}, found.lenses, 0.25f, !fov);
    }
    found.source = fov ? FovSource::kTold : FovSource::kOverlap;
  }
  if (!overlaps || found.alike < kMinAlike) {
    const bool shows = detail_beside(coarse, lenses) > kMinDetail;
    found = {lenses, fov ? FovSource::kTold : shows ? FovSource::kRims : FovSource::kNothing, -1.0f};
    for (const float roll : kRolls) {
      std::vector<FisheyeLens> tried = lenses;
      tried[1].roll = roll;
      const float alike = rims_alike(images, tried);
      if (alike > found.alike) found.alike = alike, found.lenses = tried;
    }
    set_fov(found.lenses, fov.value_or(shows ? 180.0f : kUsualFov));
  }
  turn_upright(images, found.lenses);
  return found;
}

}  // namespace ods
