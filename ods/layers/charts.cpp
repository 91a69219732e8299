// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/charts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace ods {

namespace {

constexpr float kFlat = 0.906f;    // cosine of 25 degrees
constexpr float kSteepest = 0.1f;  // cosine between a chart's surface and the ray along which it is projected
constexpr float kMaxExtent = 120.0f;
constexpr float kCrumb = 1.0f;  // texels
constexpr int kTurns = 12;      // orientations tried within a quarter of a turn

struct PieceShape {
  vec3 corners[3];
  vec3 normal;
  vec3 center;
};

PieceShape shape_of(const PieceMesh& mesh, const Piece& piece) {
  PieceShape shape;
  for (int i = 0; i < 3; i++) shape.corners[i] = mesh.positions[piece.corners[i]];
  shape.center = (shape.corners[0] + shape.corners[1] + shape.corners[2]) / 3.0f;
  shape.normal = normal_of(shape.corners[0], shape.corners[1], shape.corners[2]);
  return shape;
}

// The place that sees most of a piece under the largest angle.
int best_place(const Probe& probe, const PieceMesh& mesh, const PieceShape& shape) {
  int best = kMiddle;
  float most = -2.0f;
  for (int place = 0; place < kPlaces; place++) {
    const DistanceMap& map = probe.maps[static_cast<size_t>(place)];
    const vec3 ray = shape.center - map.place;
    const float distance = length(ray);
    int seen = sees(map, mesh, shape.center, shape.normal) ? 1 : 0;
    for (const vec3& corner : shape.corners) {
      seen += sees(map, mesh, mix(corner, shape.center, 0.1f), shape.normal) ? 1 : 0;
    }
    const float angle = -dot(shape.normal, ray) / (distance * distance * distance);
    const float score = seen > 0 ? static_cast<float>(seen) * std::max(angle, 1e-6f) : angle - 1.0f;
    if (score > most) most = score, best = place;
  }
  return best;
}

// Projects along the ray from a place to a point, or along the normal if the surface is nearly edge-on.
Chart begin_chart(const Probe& probe, const PieceMesh& mesh, const PieceShape& seed, float pixel) {
  Chart chart;
  chart.place = best_place(probe, mesh, seed);
  chart.origin = seed.center;
  const vec3 ray = seed.center - probe.maps[static_cast<size_t>(chart.place)].place;
  const float distance = length(ray);
  vec3 along = ray / distance;
  if (-dot(along, seed.normal) < 2.0f * kSteepest) along = normalize(along - seed.normal * 0.25f);
  const Frame frame = frame_around(along);
  chart.across = frame.tangent / (distance * pixel);
  chart.down = frame.bitangent / (distance * pixel);
  return chart;
}

struct Extent2 {
  vec2 low{1e30f};
  vec2 high{-1e30f};
  void add(vec2 at) {
    low = min(low, at);
    high = max(high, at);
  }
  vec2 size() const { return high - low; }
};

// The neighbours of the pieces that need charts, by edge.
using EdgeNeighbours = std::map<uint64_t, std::array<int, 2>>;

EdgeNeighbours neighbours_of(const PieceMesh& mesh) {
  EdgeNeighbours edges;
  for (size_t i = 0; i < mesh.pieces.size(); i++) {
    const Piece& piece = mesh.pieces[i];
    if (piece.state != PieceState::kChart) continue;
    for (int corner = 0; corner < 3; corner++) {
      const uint a = piece.corners[corner], b = piece.corners[(corner + 1) % 3];
      const auto [found, is_new] = edges.try_emplace(edge_key(a, b), std::array<int, 2>{static_cast<int>(i), -1});
      if (!is_new) found->second[1] = static_cast<int>(i);
    }
  }
  return edges;
}

// Turns a chart so that its box is the smallest, its longer side across, and sets its size.
void fit_box(const PieceMesh& mesh, Chart& chart) {
  const vec3 across = chart.across, down = chart.down;
  float smallest = 1e30f;
  Extent2 best;
  vec2 turn_of_best(1.0f, 0.0f);
  for (int turn = 0; turn < kTurns; turn++) {
    const float angle = 0.5f * std::numbers::pi_v<float> * static_cast<float>(turn) / kTurns;
    const vec2 cs(std::cos(angle), std::sin(angle));
    Extent2 box;
    for (const size_t piece : chart.pieces) {
      for (int i = 0; i < 3; i++) {
        const vec3 to = mesh.positions[mesh.pieces[piece].corners[i]] - chart.origin;
        const vec2 at(dot(across, to), dot(down, to));
        box.add({cs.x * at.x + cs.y * at.y, cs.x * at.y - cs.y * at.x});
      }
    }
    const float area = (box.size().x + 2.0f) * (box.size().y + 2.0f);
    if (area < smallest) smallest = area, best = box, turn_of_best = cs;
  }
  chart.across = turn_of_best.x * across + turn_of_best.y * down;
  chart.down = turn_of_best.x * down - turn_of_best.y * across;
  if (best.size().y > best.size().x) {  // lying charts make lower rows
    std::swap(chart.across, chart.down);
    std::swap(best.low.x, best.low.y);
    std::swap(best.high.x, best.high.y);
  }
  const bool crumb = best.size().x <= kCrumb && best.size().y <= kCrumb;
  const float gutter = crumb ? 0.0f : static_cast<float>(Chart::kGutter);
  chart.width = crumb ? 1 : static_cast<int>(std::ceil(best.size().x)) + 2 * Chart::kGutter;
  chart.height = crumb ? 1 : static_cast<int>(std::ceil(best.size().y)) + 2 * Chart::kGutter;
  // The box begins at the gutter: moves the origin along the surface's projection.
  const vec2 shift = best.low - gutter;
  const float scale = dot(chart.across, chart.across);
  chart.origin += (chart.across * shift.x + chart.down * shift.y) / scale;
}

// Adds neighbours to a chart that begins with a piece, as long as it remains flat and small.
void grow(const PieceMesh& mesh, const std::vector<PieceShape>& shapes, const EdgeNeighbours& edges, vec3 along,
          size_t first, float max_extent, Chart& chart, std::vector<char>& taken) {
  Extent2 box;
  const auto add = [&](size_t piece) {
    Extent2 grown = box;
    for (const vec3& corner : shapes[piece].corners) {
      grown.add({dot(chart.across, corner - chart.origin), dot(chart.down, corner - chart.origin)});
    }
    if (!chart.pieces.empty() && std::max(grown.size().x, grown.size().y) > max_extent) return;
    box = grown;
    taken[piece] = 1;
    chart.pieces.push_back(piece);
  };
  add(first);
  const vec3 flat = shapes[first].normal;
  for (size_t next = 0; next < chart.pieces.size(); next++) {
    const Piece& piece = mesh.pieces[chart.pieces[next]];
    for (int corner = 0; corner < 3; corner++) {
      const uint a = piece.corners[corner], b = piece.corners[(corner + 1) % 3];
      for (const int other : edges.at(edge_key(a, b))) {
        if (other < 0 || taken[static_cast<size_t>(other)]) continue;
        const PieceShape& shape = shapes[static_cast<size_t>(other)];
        if (dot(shape.normal, flat) < kFlat || -dot(shape.normal, along) < kSteepest) continue;
        add(static_cast<size_t>(other));
      }
    }
  }
}

// begin: makes the chart of a first piece, by its shape.
template <typename Begin>
std::vector<Chart> charts_of(const PieceMesh& mesh, size_t index, float max_extent, const Begin& begin) {
  std::vector<Chart> charts;
  const EdgeNeighbours edges = neighbours_of(mesh);
  if (edges.empty()) return charts;
  std::vector<PieceShape> shapes;
  for (const Piece& piece : mesh.pieces) shapes.push_back(shape_of(mesh, piece));
  std::vector<char> taken(mesh.pieces.size());
  for (size_t i = 0; i < mesh.pieces.size(); i++) {
    if (mesh.pieces[i].state != PieceState::kChart || taken[i]) continue;
    Chart chart = begin(shapes[i]);
    chart.mesh = index;
    const vec3 along = normalize(cross(chart.across, chart.down));
    grow(mesh, shapes, edges, along, i, max_extent, chart, taken);
    fit_box(mesh, chart);
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace

vec2 in_chart(const Chart& chart, vec3 point) {
  const vec2 corner(static_cast<float>(chart.x), static_cast<float>(chart.y));
  if (chart.width == 1 && chart.height == 1) return corner + 0.5f;
  return corner + vec2(dot(chart.across, point - chart.origin), dot(chart.down, point - chart.origin));
}

std::vector<Chart> make_charts(const Probe& probe, const std::vector<PieceMesh>& meshes, float pixel, int size) {
  const float max_extent = std::min(kMaxExtent, static_cast<float>(size) * 0.5f);
  std::vector<std::vector<Chart>> found(meshes.size());
  tbb::parallel_for(size_t{0}, meshes.size(), [&](size_t i) {
    found[i] = charts_of(meshes[i], i, max_extent,
                         [&](const PieceShape& seed) { return begin_chart(probe, meshes[i], seed, pixel); });
  });
  std::vector<Chart> charts;
  for (std::vector<Chart>& some : found) std::move(some.begin(), some.end(), std::back_inserter(charts));
  return charts;
}

std::vector<Chart> flat_charts(const PieceMesh& mesh, size_t index, float texel, float max_extent) {
  return charts_of(mesh, index, max_extent, [&](const PieceShape& seed) {
    Chart chart;
    chart.origin = seed.center;
    const Frame frame = frame_around(-seed.normal);
    chart.across = frame.tangent / texel;
    chart.down = frame.bitangent / texel;
    return chart;
  });
}

int pack_charts(std::vector<Chart*> charts, int size, int first) {
  std::stable_sort(charts.begin(), charts.end(), [](const Chart* a, const Chart* b) {
    return std::pair(b->height, b->width) < std::pair(a->height, a->width);
  });
  int texture = first, x = 0, y = 0, row = 0;  // the row of charts that is being filled: its place and height
  for (Chart* chart : charts) {
    if (x + chart->width > size) x = 0, y += row, row = 0;
    if (y + chart->height > size) texture++, x = 0, y = 0, row = 0;
    chart->texture = texture, chart->x = x, chart->y = y;
    x += chart->width;
    row = std::max(row, chart->height);
  }
  return charts.empty() ? 0 : texture - first + 1;
}

}  // namespace ods
