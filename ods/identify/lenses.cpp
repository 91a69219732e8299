// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/lenses.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ods/camera/odd_halves.h"
#include "ods/disparity/rim.h"
#include "ods/identify/pairs.h"
#include "ods/identify/thumbnail.h"
#include "ods/picture/load_eyes.h"

namespace ods {

// --- front and back --------------------------------------------------------------------------------------------------

constexpr float kMinAlike = 0.5f, kMinSame = 0.7f;

static float sample(const Image& image, vec2 uv) {
  const float x = uv.x * static_cast<float>(image.width) - 0.5f, y = uv.y * static_cast<float>(image.height) - 0.5f;
  const int x0 = std::clamp(static_cast<int>(x), 0, image.width - 2),
            y0 = std::clamp(static_cast<int>(y), 0, image.height - 2);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const float top = std::lerp(*image.at(x0, y0), *image.at(x0 + 1, y0), fx);
  return std::lerp(top, std::lerp(*image.at(x0, y0 + 1), *image.at(x0 + 1, y0 + 1), fx), fy);
}

namespace {

struct Halves {
  const Image& first;
  const Image& second;
};

class Correlation {
 public:
  void add(double a, double b) { count_++, a_ += a, b_ += b, aa_ += a * a, bb_ += b * b, ab_ += a * b; }
  double count() const { return count_; }
  // The correlation; -1 if the values hardly vary.
  float value() const {
    const double va = aa_ / count_ - a_ * a_ / count_ / count_, vb = bb_ / count_ - b_ * b_ / count_ / count_;
    if (!(va > 1e-4 && vb > 1e-4)) return -1.0f;
    return static_cast<float>((ab_ / count_ - a_ * b_ / count_ / count_) / std::sqrt(va * vb));
  }

 private:
  double count_ = 0.0, a_ = 0.0, b_ = 0.0, aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

}  // namespace

// The correlation of the images in the zone that both lenses see beside them; -1 if there is none.
static float alikeness(const Halves& halves, const std::vector<FisheyeLens>& lenses) {
  constexpr int kAround = 720, kAcross = 9;
  const Extent size{halves.first.width, halves.first.height};
  FisheyeLens back = lenses[1];
  back.yaw += 180.0f;
  const auto first = make_map(lenses[0], size), second = make_map(back, size);
  const float maximum = 0.9f * glm::radians(0.5f * lenses[0].fov - 90.0f);  // the outermost rim is dark
  Correlation both;
  for (int i = 0; i < kAround * kAcross; i++) {
    const float around = 2.0f * kPi * static_cast<float>(i % kAround) / kAround;
    const float behind = maximum * (2.0f * static_cast<float>(i / kAround) / (kAcross - 1) - 1.0f);
    const vec3 d(std::cos(behind) * std::cos(around), std::cos(behind) * std::sin(around), std::sin(behind));
    const ImagePoint p = first->place(d), q = second->place(d);
    if (!p.seen || !q.seen) continue;
    both.add(static_cast<double>(sample(halves.first, p.uv)), static_cast<double>(sample(halves.second, q.uv)));
  }
  return both.count() < kAround ? -1.0f : both.value();
}

// The correlation of equal positions in both circles: two eyes see nearly the same there.
static float sameness(const Halves& halves, const std::vector<FisheyeLens>& lenses) {
  constexpr int kSide = 64;
  const vec2 size(static_cast<float>(halves.first.width), static_cast<float>(halves.first.height));
  Correlation both;
  for (int i = 0; i < kSide * kSide; i++) {
    const vec2 off =
        (vec2(static_cast<float>(i % kSide), static_cast<float>(i / kSide)) + 0.5f) / (0.5f * kSide) - 1.0f;
    const vec2 p = (lenses[0].center + lenses[0].radius * off) / size;
    const vec2 q = (lenses[1].center + lenses[1].radius * off) / size;
    if (length(off) > 0.85f || !inside_picture(p) || !inside_picture(q)) continue;
    both.add(static_cast<double>(sample(halves.first, p)), static_cast<double>(sample(halves.second, q)));
  }
  return both.count() > 0.0 ? both.value() : -1.0f;
}

static void set_fov(std::vector<FisheyeLens>& lenses, float fov) {
  for (FisheyeLens& lens : lenses) lens.fov = fov;
}

// Optimizes one parameter after another, in decreasing steps.
static float refine(const Halves& halves, std::vector<FisheyeLens>& lenses) {
  float best = alikeness(halves, lenses);
  using Change = void (*)(std::vector<FisheyeLens>&, float);
  const Change kChanges[] = {[](std::vector<FisheyeLens>& l, float by) { set_fov(l, l[0].fov + by); },
                             [](std::vector<FisheyeLens>& l, float by) { l[1].roll += by; },
                             [](std::vector<FisheyeLens>& l, float by) { l[1].yaw += by; },
                             [](std::vector<FisheyeLens>& l, float by) { l[1].pitch += by; }};
  for (float step = 1.0f; step > 0.04f; step *= 0.5f) {
    for (int round = 0; round < 3; round++) {
      for (const Change change : kChanges) {
        for (const float by : {step, -step}) {
          std::vector<FisheyeLens> tried = lenses;
          change(tried, by);
          if (!(tried[0].fov > 181.0f && tried[0].fov < 280.0f)) continue;
          const float alike = alikeness(halves, tried);
          if (alike > best) best = alike, lenses = tried;
        }
      }
    }
  }
  return best;
}

// The brightness above minus the brightness below, -1..1, in both lenses.
static float light_from_above(const Halves& halves, const std::vector<FisheyeLens>& lenses) {
  const Extent size{halves.first.width, halves.first.height};
  double up = 0.0, all = 0.0;
  for (const size_t which : {0u, 1u}) {
    FisheyeLens lens = lenses[which];
    lens.yaw = lens.pitch = 0.0f;
    const auto map = make_map(lens, size);
    const Image& image = which == 0 ? halves.first : halves.second;
    for (int i = 0; i < 90 * 30; i++) {
      const float around = 2.0f * kPi * static_cast<float>(i % 90) / 90.0f;
      const float off = 1.4f * static_cast<float>(i / 90 + 1) / 30.0f;
      const vec3 d(std::sin(off) * std::cos(around), std::sin(off) * std::sin(around), -std::cos(off));
      const ImagePoint p = map->place(d);
      if (!p.seen) continue;
      const double light = static_cast<double>(sample(image, p.uv)) * std::sin(static_cast<double>(off));
      up += light * static_cast<double>(d.y), all += light * std::abs(static_cast<double>(d.y));
    }
  }
  return all > 0.0 ? static_cast<float>(up / all) : 0.0f;
}

// The overlap gives the relative roll of the lenses, but not which way is up: light comes from there.
static void turn_upright(const Halves& halves, std::vector<FisheyeLens>& lenses) {
  const float kLead = 0.15f;  // most cameras store the upper side up
  std::vector<FisheyeLens> best = lenses;
  float lightest = light_from_above(halves, lenses) + kLead;
  for (const float roll : {90.0f, 180.0f, 270.0f}) {
    std::vector<FisheyeLens> turned = lenses;
    turned[0].roll += roll;
    // Rotates the world about the axis of the first lens; the second one looks the other way.
    turned[1].roll -= roll;
    const float c = std::cos(glm::radians(roll)), s = std::sin(glm::radians(roll));
    const float yaw = turned[1].yaw, pitch = turned[1].pitch;
    turned[1].yaw = c * yaw + s * pitch, turned[1].pitch = c * pitch - s * yaw;
    if (alikeness(halves, turned) < 0.8f * alikeness(halves, lenses)) {
      turned[1].yaw = c * yaw - s * pitch, turned[1].pitch = c * pitch + s * yaw;
    }
    const float light = light_from_above(halves, turned);
    if (light > lightest) lightest = light, best = turned;
  }
  lenses = best;
}

// Aligns the lenses where both see the same, and returns the best correlation.
static float align(const Halves& halves, std::vector<FisheyeLens>& lenses) {
  std::vector<FisheyeLens> best = lenses;
  float maximum = -1.0f;
  for (const float roll : {0.0f, 90.0f, 180.0f, 270.0f}) {
    for (float fov = 184.0f; fov <= 230.0f; fov += 2.0f) {
      std::vector<FisheyeLens> tried = lenses;
      set_fov(tried, fov);
      tried[1].roll = roll;
      const float alike = alikeness(halves, tried);
      if (alike > maximum) maximum = alike, best = tried;
    }
  }
  if (maximum < 0.3f) return maximum;
  lenses = best;
  return refine(halves, lenses);
}

std::optional<SeenLenses> find_lenses(const Image& first, const Image& second, float fov) {
  const std::optional<Rim> rims[] = {find_rim(first), find_rim(second)};
  if (!rims[0] || !rims[1]) return std::nullopt;
  if (std::abs(rims[0]->radius / rims[1]->radius - 1.0f) > 0.08f) return std::nullopt;
  SeenLenses seen;
  for (const std::optional<Rim>& rim : rims) {
    FisheyeLens& lens = seen.lenses.emplace_back();
    lens.center = rim->center, lens.radius = rim->radius, lens.fov = fov;
  }
  const Halves halves{first, second};
  std::vector<FisheyeLens> aligned = seen.lenses;
  seen.alike = align(halves, aligned);
  const PointPairs pairs = find_pairs(first, second);
  const bool is_stereo = (pairs.places > 0 && static_cast<double>(pairs.found.size()) > 0.3 * pairs.places) ||
                         sameness(halves, seen.lenses) > std::max(seen.alike, kMinSame);
  seen.front_and_back = !is_stereo && seen.alike > kMinAlike;
  if (!seen.front_and_back && !is_stereo && pairs.places > 0) return std::nullopt;
  if (!seen.front_and_back) return seen;
  turn_upright(halves, aligned);
  seen.lenses = aligned;
  return seen;
}

// --- files -----------------------------------------------------------------------------------------------------------

static Image cut(const Image& image, EyeCorner corner, Extent size) {
  Image part(size.width, size.height, 1);
  for (int y = 0; y < size.height; y++) std::copy_n(image.at(corner.x, corner.y + y), size.width, part.at(0, y));
  return part;
}

// Averages whole blocks of pixels, so that positions do not move.
static Image reduced(const Image& image, int by) {
  Image small(image.width / by, image.height / by, 1);
  for (int y = 0; y < small.height; y++) {
    for (int x = 0; x < small.width; x++) {
      float sum = 0.0f;
      for (int i = 0; i < by * by; i++) sum += std::max(0.0f, *image.at(x * by + i % by, y * by + i / by));
      *small.at(x, y) = sum / static_cast<float>(by * by);
    }
  }
  return small;
}

static bool is_inscribed(const FisheyeLens& lens, Extent eye) {
  const vec2 size(static_cast<float>(eye.width), static_cast<float>(eye.height));
  const float near = 0.008f * std::min(size.x, size.y);
  return length(lens.center - 0.5f * size) < near && std::abs(lens.radius - 0.5f * std::min(size.x, size.y)) < near;
}

// Two lenses have separate circles; a single circle that fills the picture is cut at its middle, and each half has a
// part of its rim.
static bool are_apart(const std::vector<FisheyeLens>& lenses, Layout layout, Extent eye) {
  const EyeCorner first = eye_corner(layout, eye, 0), second = eye_corner(layout, eye, 1);
  const vec2 shift(static_cast<float>(second.x - first.x), static_cast<float>(second.y - first.y));
  return length(lenses[1].center + shift - lenses[0].center) > lenses[0].radius;
}

static std::string lens_text(const FisheyeLens& lens) {
  return fmt::format("{:.1f},{:.1f},{:.1f}", lens.center.x, lens.center.y, lens.radius);
}

static std::optional<ProjectionSetting> known_projection(const FormatHint& known, const std::string& path) {
  if (known.projection) return known.projection;
  const NamedProjection* named = read_name(path).projection;
  return named ? std::optional(named->setting) : std::nullopt;
}

static std::optional<Layout> known_layout(const FormatHint& known, const std::string& path) {
  return known.layout ? known.layout : read_name(path).layout;
}

// The square around an image circle; black outside the image.
static Image around_circle(const Image& image, const FisheyeLens& lens, int side) {
  Image square(side, side, 1);
  const int left = static_cast<int>(std::lround(lens.center.x)) - side / 2,
            top = static_cast<int>(std::lround(lens.center.y)) - side / 2;
  for (int y = std::max(0, -top); y < std::min(side, image.height - top); y++) {
    for (int x = std::max(0, -left); x < std::min(side, image.width - left); x++)
      *square.at(x, y) = *image.at(left + x, top + y);
  }
  return square;
}

// Returns whether the parallax shows that the first half is the right eye's, as Canon's dual fisheye lens stores it.
static bool is_right_first(const Halves& halves, const std::vector<FisheyeLens>& lenses) {
  constexpr float kSure = 0.5f;
  const int side = 2 * static_cast<int>(lenses[0].radius);
  ProjectionSetting projection = find_projection("fisheye")->setting;
  projection.fov = lenses[0].fov;
  const PointPairs pairs =
      find_pairs(around_circle(halves.first, lenses[0], side), around_circle(halves.second, lenses[1], side));
  return static_cast<float>(parallax_in(pairs, projection).order) < -kSure;
}

bool wants_lenses(const FormatHint& known, const std::string& path, bool is_open) {
  const std::optional<ProjectionSetting> told = known_projection(known, path);
  const std::optional<Layout> layout = known_layout(known, path);
  const bool is_done = !known.lenses.empty() || known.camera || known.one_eye || names_eye(path);
  if (is_done || (layout && !arrangement_of(*layout).is_halves())) return false;
  return told ? is_fisheye(told->kind) : known.front_and_back || is_open;
}

FormatHint with_lenses(const StoredPicture& whole, const std::string& path, const FormatHint& known,
                       std::vector<std::string>& notes) {
  const std::optional<ProjectionSetting> told = known_projection(known, path);
  std::optional<Layout> layout = known_layout(known, path);
  if (whole.size.width < 64 || whole.size.height < 64) return known;
  const bool is_wide = whole.size.width > whole.size.height;
  if (!layout) layout = is_wide ? Layout::kSideBySide : Layout::kTopBottom;
  const std::optional<Extent> eye = unpacked_size(*layout, without_middle(*layout, whole.size));
  if (!eye) return known;
  constexpr int kLongest = 1100;  // maximum side of a half, pixels
  const int by = 1 + std::max(eye->width, eye->height) / kLongest;
  const Image grey = grey_eyes(whole)[0];
  const auto half = [&](int index) { return shown(reduced(cut(grey, eye_corner(*layout, *eye, index), *eye), by)); };
  const Image first = half(0), second = half(1);
  std::optional<SeenLenses> seen = find_lenses(first, second, told ? told->fov : 180.0f);
  if (!seen) return known;
  const bool right_first =
      !seen->front_and_back && !known_layout(known, path) && is_right_first({first, second}, seen->lenses);
  if (known.front_and_back && !seen->front_and_back) return known;  // circles that touch the halves' edges
  for (FisheyeLens& lens : seen->lenses) lens.center *= static_cast<float>(by), lens.radius *= static_cast<float>(by);
  if (!are_apart(seen->lenses, *layout, *eye)) return known;
  FormatHint all = known;
  all.layout = layout;
  if (seen->front_and_back) {
    all.front_and_back = true, all.lenses = seen->lenses, all.projection = find_projection("fisheye")->setting;
    notes.push_back(
        fmt::format("two fisheyes that look ahead and back, {:.1f} degrees each (`circle` {},{}): they agree by "
                    "{:.2f} where both see",
                    seen->lenses[0].fov, lens_text(seen->lenses[0]), lens_text(seen->lenses[1]), seen->alike));
    return all;
  }
  if (is_inscribed(seen->lenses[0], *eye) && is_inscribed(seen->lenses[1], *eye)) return known;
  all.lenses = seen->lenses, all.projection = told ? *told : find_projection("fisheye")->setting;
  for (FisheyeLens& lens : all.lenses) lens.kind = all.projection->kind;
  if (right_first) {
    std::swap(all.lenses[0], all.lenses[1]);
    all.layout = layout_with({arrangement_of(*layout).how, true});
  }
  notes.push_back(fmt::format("a pair of fisheyes whose circles do not touch the edges{}: `circle` {},{}",
                              right_first ? ", the right eye first" : "", lens_text(all.lenses[0]),
                              lens_text(all.lenses[1])));
  return all;
}

}  // namespace ods
