// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/compose/testcard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>

#include "ods/compose/testcard_painter.h"

namespace ods {

// --- the cards -------------------------------------------------------------------------------------------------------

constexpr float kSmallPlate = 2.4f;  // degrees high

// Each line is visible to one eye only.
static void add_eyes(CardView& view, float y) {
  view.letter("LEFT EYE", 0.0f, y + 2.4f, 26.0f, 4.4f, kLeftColor).eye = kLeft;
  view.letter("RIGHT EYE", 0.0f, y - 2.4f, 26.0f, 4.4f, kRightColor).eye = kRight;
}

static void add_depths(CardView& view, float y, std::span<const float> distances, float nearest) {
  float x = -4.0f * static_cast<float>(distances.size() - 1);
  for (float distance : distances) {
    const vec3 color = distance < nearest ? kNotSafe : distance < 1.5f * nearest ? kAmber : kSafe;
    view.letter(fmt::format("{:.2g}", distance), x, y, 6.4f, 6.4f, color).inverse_depth = 1.0f / distance;
    x += 8.0f;
  }
}

static void add_sharpness(CardView& view, float y) {
  float x = -26.0f;
  for (int pixels : {1, 2, 3, 4}) {
    view.add(CardPattern::kBars, x, y + 1.7f, 7.0f, 8.0f).pixels = pixels;
    view.letter(fmt::format("{} PX", pixels), x, y - 4.2f, 7.0f, kSmallPlate);
    x += 8.5f;
  }
  view.add(CardPattern::kStar, 15.0f, y - 0.5f, 13.0f, 13.0f);
}

// Objects closer than 0.6 m are hard to fuse ahead of the viewer, closer than 3.5 m straight up and down: the rules of
// the page "Omnidirectional stereo (ODS) with POV-Ray".
static void add_quarter(std::vector<Card>& cards, float yaw, const std::string& name) {
  static const float kDistances[] = {0.4f, 0.6f, 1.0f, 1.5f, 2.0f, 3.5f, 8.0f, 20.0f};
  CardView view(cards, yaw, 0.0f);
  view.add(CardPattern::kRing, 0.0f, 0.0f, 86.0f, 86.0f);
  view.letter(name, 0.0f, 1.5f, 34.0f, 6.0f);
  add_eyes(view, 11.0f);
  view.add(CardPattern::kGreys, 0.0f, 19.0f, 36.0f, 5.0f);
  add_depths(view, -8.0f, kDistances, 0.6f);
  view.letter("DISTANCES IN METRES", 0.0f, -13.3f, 30.0f, kSmallPlate);
  add_sharpness(view, -21.0f);
}

static void add_pole(std::vector<Card>& cards, float pitch, const std::string& name) {
  static const float kDistances[] = {1.5f, 3.5f, 8.0f};
  CardView view(cards, 0.0f, pitch);
  view.add(CardPattern::kRing, 0.0f, 0.0f, 60.0f, 60.0f);
  view.letter(name, 0.0f, -16.0f, 24.0f, 5.0f);
  add_eyes(view, 14.0f);
  add_depths(view, 0.0f, kDistances, 3.5f);
}

// Degree labels: every 30 along the horizon between the quarters, and up and down all around.
static void add_degrees(std::vector<Card>& cards) {
  for (int yaw = -180; yaw < 180; yaw += 30) {
    CardView view(cards, static_cast<float>(yaw), 0.0f);
    if (yaw % 90 != 0) view.letter(fmt::format("{}", yaw), 0.0f, -1.6f, 6.0f, 2.6f);
    for (int pitch : {-60, -30, 30, 60}) {
      CardView(cards, static_cast<float>(yaw), static_cast<float>(pitch))
          .letter(fmt::format("{}{}", pitch > 0 ? "+" : "", pitch), 0.0f, 1.6f, 5.0f, kSmallPlate);
    }
  }
}

void set_reach(std::vector<Card>& cards, const StereoCamera& stereo, Extent eye) {
  // Covers a pixel beyond the corner, and the eye's offset from the centre.
  const float step = 2.0f * kPi / static_cast<float>(std::max(8, std::min(eye.width, eye.height)));
  const float away = std::hypot(0.5f * stereo.ipd, stereo.neck);
  for (Card& each : cards) {
    const float angle = std::atan(length(each.half)) + std::asin(std::min(1.0f, away * each.inverse_depth)) + step;
    each.reach = std::cos(std::min(angle, 1.5f));
  }
}

double letter_height(const ProjectionSetting& projection, int width) {
  const double angle = glm::radians(kCapital * static_cast<double>(kSmallPlate));
  return angle * pixels_per_radian(projection, width);
}

Testcard make_testcard(const StereoCamera& stereo, Extent eye, const std::vector<std::string>& lines) {
  assert(eye.width > 0 && eye.height > 0);
  Testcard card;
  StereoCamera centred = stereo;
  centred.position = vec3(0.0f);
  card.camera = make_camera(centred);
  card.eye = eye;
  add_degrees(card.cards);
  add_quarter(card.cards, 0.0f, "FRONT");
  add_quarter(card.cards, 90.0f, "RIGHT");
  add_quarter(card.cards, 180.0f, "BACK");
  add_quarter(card.cards, -90.0f, "LEFT");
  add_pole(card.cards, 90.0f, "UP");
  add_pole(card.cards, -90.0f, "DOWN");
  CardView front(card.cards, 0.0f, 0.0f);
  float y = 31.0f;
  for (const std::string& line : lines) front.letter(line, 0.0f, y -= 2.6f, 44.0f, kSmallPlate);
  set_reach(card.cards, stereo, eye);
  const auto nearer = [](const Card& a, const Card& b) { return a.inverse_depth < b.inverse_depth; };
  std::stable_sort(card.cards.begin(), card.cards.end(), nearer);
  return card;
}

// --- drawing ---------------------------------------------------------------------------------------------------------

namespace {

// The point where a pixel's ray hits the card. Lengths are in the card's units: tangents.
struct Spot {
  vec2 at;
  float pixel;  // the pixel's size there
  int x, y;     // the pixel
};

}  // namespace

// A pixel's coverage by an edge at this signed distance, positive inside.
static float inside(float distance, float pixel) {
  return std::clamp(distance / pixel + 0.5f, 0.0f, 1.0f);
}

static float distance_to(const Stroke& stroke, vec2 at) {
  const vec2 along = stroke.to - stroke.from, from = at - stroke.from;
  const float t = std::clamp(dot(from, along) / std::max(dot(along, along), 1e-12f), 0.0f, 1.0f);
  return length(from - along * t);
}

static void paint_plate(const Card& card, const Spot& spot, int eye, float edge, vec3& color) {
  const float border = std::max(0.04f * card.half.y, 0.7f * spot.pixel);
  color = mix(color, card.color, inside(edge, spot.pixel));
  color = mix(color, kPlateColor, inside(edge - 2.0f * border, spot.pixel));
  if (card.eye != kMono && card.eye != eye) return;
  float nearest = 1e30f;
  for (const Stroke& stroke : card.strokes) nearest = std::min(nearest, distance_to(stroke, spot.at));
  color = mix(color, card.color, inside(card.stroke - nearest, spot.pixel));
}

static void paint_ring(const Card& card, const Spot& spot, vec3& color) {
  const float thickness = std::max(0.003f, 0.8f * spot.pixel);
  color = mix(color, kWhite, 0.8f * inside(thickness - std::abs(length(spot.at) - card.half.x), spot.pixel));
}

static void paint_star(const Card& card, const Spot& spot, vec3& color) {
  const int spokes = 24;
  const float radius = length(spot.at);
  const float turn = std::atan2(spot.at.y, spot.at.x) / (2.0f * kPi) * static_cast<float>(spokes);
  const float off = turn - std::floor(turn);  // the first half is bright
  const float from_edge = (off < 0.5f ? std::min(off, 0.5f - off) : -std::min(off - 0.5f, 1.0f - off));
  const float spoke = inside(from_edge * radius * 2.0f * kPi / static_cast<float>(spokes), spot.pixel);
  color = mix(color, mix(kBlack, kWhite, spoke), inside(card.half.x - radius, spot.pixel));
}

static void paint_bars(const Card& card, const Spot& spot, float edge, vec3& color) {
  const int along = spot.at.y > 0.0f ? spot.x : spot.y;
  color = mix(color, along / card.pixels % 2 == 0 ? kWhite : kBlack, inside(edge, spot.pixel));
}

static void paint_greys(const Card& card, const Spot& spot, float edge, vec3& color) {
  const float place = std::clamp(0.5f + 0.5f * spot.at.x / card.half.x, 0.0f, 0.9999f) * 11.0f;
  const int step = static_cast<int>(place);
  int value = static_cast<int>(std::lround(25.5f * static_cast<float>(step)));
  const bool patch =
      std::abs(place - static_cast<float>(step) - 0.5f) < 0.25f && std::abs(spot.at.y) < 0.5f * card.half.y;
  if (patch && step == 0) value = 4;
  if (patch && step == 10) value = 251;
  color = mix(color, code(value, value, value), inside(edge, spot.pixel));
}

static void paint_cells(const Card& card, const Spot& spot, float edge, vec3& color) {
  const float width = 2.0f * card.half.x / static_cast<float>(card.count);
  const float place = (spot.at.x + card.half.x) / width;
  const int cell = std::clamp(static_cast<int>(std::floor(place)), 0, card.count - 1);
  const float from_gap = (0.5f - std::abs(place - static_cast<float>(cell) - 0.5f)) * width - 0.06f * width;
  const float inner = std::min(from_gap, edge - 0.1f * card.half.y);
  color = mix(color, kBlack, inside(edge, spot.pixel));
  color = mix(color, cell == card.lit ? kWhite : kPlateColor, inside(inner, spot.pixel));
}

static void paint_sweep(const Card& card, const Spot& spot, float edge, vec3& color) {
  const float half = 0.03f * card.half.x, middle = (2.0f * card.phase - 1.0f) * (card.half.x - half);
  color = mix(color, kBlack, inside(edge, spot.pixel));
  color = mix(color, kWhite, inside(std::min(edge, half - std::abs(spot.at.x - middle)), spot.pixel));
}

static void paint(const Card& card, const Spot& spot, int eye, vec3& color) {
  const float edge = std::min(card.half.x - std::abs(spot.at.x), card.half.y - std::abs(spot.at.y));  // to the border
  if (edge < -spot.pixel - 0.01f) return;
  switch (card.pattern) {
    case CardPattern::kPlate:
      return paint_plate(card, spot, eye, edge, color);
    case CardPattern::kRing:
      return paint_ring(card, spot, color);
    case CardPattern::kStar:
      return paint_star(card, spot, color);
    case CardPattern::kBars:
      return paint_bars(card, spot, edge, color);
    case CardPattern::kGreys:
      return paint_greys(card, spot, edge, color);
    case CardPattern::kCells:
      return paint_cells(card, spot, edge, color);
    case CardPattern::kSweep:
      return paint_sweep(card, spot, edge, color);
  }
}

// Sky above, ground below, and a line every ten degrees, all at infinity.
static vec3 background(vec3 d, float pixel) {
  const float level = std::sqrt(d.x * d.x + d.z * d.z);
  const float phi = std::atan2(d.y, level), theta = std::atan2(d.x, -d.z);
  const auto line = [&](float angle, float scale, float step, float half) {
    const float off = std::abs(angle - step * std::round(angle / step)) * scale;
    return inside(std::max(half, 0.5f * pixel) - off, pixel);
  };
  const float ten = glm::radians(10.0f), thirty = glm::radians(30.0f);
  vec3 color = mix(code(70, 58, 48), code(52, 66, 86), inside(phi, pixel));
  const float fine =
      std::max(line(phi, 1.0f, ten, 0.0005f), std::abs(phi) < 1.4f ? line(theta, level, ten, 0.0005f) : 0.0f);
  const float bold = std::max(line(phi, 1.0f, thirty, 0.0012f), line(theta, level, thirty, 0.0012f));
  color = mix(color, code(120, 125, 130), fine);
  return mix(color, code(190, 195, 200), bold);
}

bool is_on_card(const Card& card, vec3 direction, float margin) {
  assert(card.inverse_depth == 0.0f);
  const float toward = dot(direction, card.middle);
  if (toward < card.reach) return false;
  const vec2 at = vec2(dot(direction, card.right), dot(direction, card.up)) / toward, beyond = abs(at) - card.half;
  return std::max(beyond.x, beyond.y) <= margin / toward;
}

static vec3 testcard_color(const Testcard& testcard, const Ray& ray, int eye, float angle, int x, int y) {
  vec3 color = background(ray.direction, angle);
  for (const Card& card : testcard.cards) {
    const float toward = dot(ray.direction, card.middle);
    if (toward < card.reach) continue;
    // p dot middle = distance, divided by the distance, which may be infinite.
    const float t = (1.0f - card.inverse_depth * dot(ray.origin, card.middle)) / toward;
    const vec3 p = ray.origin * card.inverse_depth + ray.direction * t;
    const Spot spot{vec2(dot(p, card.right), dot(p, card.up)), angle * t, x, y};
    if (t > 0.0f) paint(card, spot, eye, color);
  }
  return color;
}

void fill_testcard_row(const Testcard& card, int eye, int y, std::span<float> row) {
  fill_testcard_pixels(card, eye, 0, y, row);
}

void fill_testcard_pixels(const Testcard& card, int eye, int first, int y, std::span<float> row) {
  const float width = static_cast<float>(card.eye.width), height = static_cast<float>(card.eye.height);
  for (size_t i = 0; i < row.size() / 3; i++) {
    const int x = first + static_cast<int>(i);
    const vec2 uv((static_cast<float>(x) + 0.5f) / width, (static_cast<float>(y) + 0.5f) / height);
    const Ray ray = camera_ray(card.camera, eye, uv);
    const Ray below = camera_ray(card.camera, eye, uv, uv + vec2(0.0f, 1.0f / height), vec2(0.0f));
    const Ray beside = camera_ray(card.camera, eye, uv, uv + vec2(1.0f / width, 0.0f), vec2(0.0f));
    const float pixel = std::max(length(below.direction - ray.direction), length(beside.direction - ray.direction));
    const bool empty = ray.direction == vec3(0.0f);
    const vec3 color = empty ? kBlack : testcard_color(card, ray, eye, pixel, x, y);
    for (int c = 0; c < 3; c++) row[3 * i + static_cast<size_t>(c)] = color[c];
  }
}

}  // namespace ods
