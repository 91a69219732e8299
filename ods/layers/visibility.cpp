// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/layers/footprint.h"

namespace ods {

namespace {

constexpr int kSpan = 2 * PanoramaPages::kReach + 1;
constexpr int kNoShift = PanoramaPages::kReach * kSpan + PanoramaPages::kReach;
constexpr float kSmallest = 0.004f;      // metres: of depth_tolerance()
constexpr float kGrazing = 0.05f;        // cosine
constexpr float kBehindMirror = 0.005f;  // metres behind a mirror's plane, from where on it hides a point
constexpr float kPartlySeen = 64.0f;     // texels: shorter pieces that are partly seen are not divided
constexpr float kPartlyHidden = 80.0f;
constexpr float kAtMirror = 2.0f;
constexpr int kMirrorReach = 3;  // texels: behind a mirror's outline, the points between others
constexpr float kMaxChartPiece = 100.0f;
constexpr float kSampleSpacing = 5.0f;  // texels
constexpr int kMaxSamples = 24;         // along an edge
constexpr int kMaxDivisions = 24;

}  // namespace

float pixel_angle(int width) {
  return 2.0f * std::numbers::pi_v<float> / static_cast<float>(width);
}

float depth_tolerance(const PieceMesh& mesh, float cosine) {
  return 4.0f * mesh.error / std::max(cosine, kGrazing) + kSmallest;
}

PanoramaPages::PanoramaPages(const Probe& probe) : probe_(probe) {
  const PageGrid& grid = probe.grid;
  const std::vector<float>& distances = probe.maps[kMiddle].distances;
  shifts_.assign(distances.size(), kNoShift);
  tbb::parallel_for(0, grid.pages() * grid.size(), [&](int row) {
    for (int x = 0; x < grid.size(); x++) {
      const PageTexel at{row / grid.size(), x, row % grid.size()};
      const size_t texel = index_of(grid, at);
      const float far = distances[texel];
      const vec3 here = ray_of(grid, at) * far;
      int best = 4 * kReach * kReach + 1;
      for (int dy = -kReach; dy <= kReach; dy++) {
        for (int dx = -kReach; dx <= kReach; dx++) {
          const PageTexel other{at.page, x + dx, at.y + dy};
          if (other.x < 0 || other.y < 0 || other.x >= grid.size() || other.y >= grid.size()) continue;
          const size_t beside = index_of(grid, other);
          const float slack = 3.0f * grid.pixel() * distances[beside] + kSmallest;
          if (dx * dx + dy * dy >= best || distances[beside] >= far - slack) continue;
          const vec3 there = ray_of(grid, other) * distances[beside];
          if (far < kFarAway && abs(dot(unpack_direction(probe.normals[beside]), here - there)) < slack) continue;
          best = dx * dx + dy * dy;
          shifts_[texel] = static_cast<int8_t>((dy + kReach) * kSpan + dx + kReach);
        }
      }
    }
  });
}

size_t PanoramaPages::source(size_t texel) const {
  const int shift = shifts_[texel];
  const std::ptrdiff_t by = (shift / kSpan - kReach) * grid().size() + shift % kSpan - kReach;
  return static_cast<size_t>(static_cast<std::ptrdiff_t>(texel) + by);
}

vec3 PanoramaPages::point(size_t source) const {
  return ray_of(grid(), texel_at(grid(), source)) * probe_.maps[kMiddle].distances[source];
}

bool PanoramaPages::shows(size_t texel, vec3 on_plane, vec3 normal, float tolerance) const {
  const size_t from = source(texel);
  const float distance = probe_.maps[kMiddle].distances[from];
  if (distance >= kFarAway) return false;
  return abs(dot(normal, point(from) - on_plane)) <= tolerance + grid().pixel() * distance;
}

namespace {

// Returns whether a texel shows a mirror in front of a point that is seen directly.
bool hides_by_mirror(const DistanceMap& map, size_t texel, const PieceMesh& mesh, vec3 point) {
  const int mirror = map.mirrors.empty() || mesh.mirror >= 0 ? -1 : map.mirrors[texel];
  if (mirror < 0) return false;
  const FlatMirror& before = mesh.probe->mirrors[static_cast<size_t>(mirror)];
  return height_above(before, mesh.probe->box.center + point) <= -kBehindMirror;
}

// Returns whether a texel of a map shows the space of a point: directly, or in the mirror in which the point is seen.
// In front of a mirror, its texels are as any that are farther away.
bool shows_space_of(const DistanceMap& map, size_t texel, const PieceMesh& mesh, vec3 point) {
  if (mesh.mirror >= 0) return map.mirrors[texel] == mesh.mirror;
  return !hides_by_mirror(map, texel, mesh, point);
}

}  // namespace

bool sees(const DistanceMap& map, const PieceMesh& mesh, vec3 point, vec3 normal, int reach) {
  const vec3 ray = point - map.place;
  const float distance = length(ray);
  const float cosine = -dot(normal, ray) / distance;
  if (cosine < -kGrazing) return false;
  const float nearest = distance - depth_tolerance(mesh, cosine);
  const auto [page, at] = place_in_pages(map.grid, ray);
  const int last = map.grid.size() - 1;
  const PageTexel own{page, std::min(static_cast<int>(at.x), last), std::min(static_cast<int>(at.y), last)};
  if (hides_by_mirror(map, index_of(map.grid, own), mesh, point)) return false;
  for (int dy = -reach; dy <= reach; dy++) {
    for (int dx = -reach; dx <= reach; dx++) {
      const int x = std::clamp(static_cast<int>(at.x) + dx, 0, map.grid.size() - 1);
      const int y = std::clamp(static_cast<int>(at.y) + dy, 0, map.grid.size() - 1);
      const size_t texel = index_of(map.grid, {page, x, y});
      if (map.distances[texel] >= nearest && shows_space_of(map, texel, mesh, point)) return true;
    }
  }
  return false;
}

namespace {

enum class Share { kNothing, kSome, kAll };

Share share_of(size_t some, size_t all) {
  return some == 0 ? Share::kNothing : some == all ? Share::kAll : Share::kSome;
}

// Texels along the longest edge of a piece in its page.
float length_in_page(const PageGrid& grid, const PieceMesh& mesh, const Piece& piece) {
  float most = 0.0f;
  for (int i = 0; i < 3; i++) {
    const vec2 from = to_page(grid, piece.page, mesh.positions[piece.corners[i]]);
    const vec2 to = to_page(grid, piece.page, mesh.positions[piece.corners[(i + 1) % 3]]);
    most = std::max(most, length(to - from));
  }
  return most;
}

// The share of a piece that its page shows.
Share shown_share(const PanoramaPages& pages, const PieceMesh& mesh, const Piece& piece, vec3 normal) {
  const PageGrid& grid = pages.grid();
  vec2 at[3];
  for (int i = 0; i < 3; i++) at[i] = to_page(grid, piece.page, mesh.positions[piece.corners[i]]);
  const vec3 on_plane = mesh.positions[piece.corners.x];
  const float tolerance = depth_tolerance(mesh, 1.0f);
  size_t all = 0, shown = 0;
  for_each_texel(at, grid.size(), [&](int x, int y, bool inside) {
    const size_t texel = index_of(grid, {piece.page, x, y});
    all++;
    if ((!inside || pages.side(texel) == mesh.side) && pages.shows(texel, on_plane, normal, tolerance)) shown++;
    return shown == 0 || shown == all;
  });
  return share_of(shown, all);
}

// Texels along the longest edge of a piece, as seen from the middle if it faced it.
float length_in_texels(const PieceMesh& mesh, const Piece& piece, float pixel) {
  const int i = longest_edge(mesh, piece);
  const vec3 a = mesh.positions[piece.corners[i]], b = mesh.positions[piece.corners[(i + 1) % 3]];
  return length(b - a) / (pixel * std::min(length(a), length(b)));
}

// Returns the share of a piece's points for which a test holds: points on a grid whose spacing is kSampleSpacing or more.
template <typename Test>
Share share_of_points(const PieceMesh& mesh, const Piece& piece, float texels, const Test& test) {
  const int steps = std::clamp(static_cast<int>(std::ceil(texels / kSampleSpacing)), 2, kMaxSamples);
  const vec3 a = mesh.positions[piece.corners.x], b = mesh.positions[piece.corners.y],
             c = mesh.positions[piece.corners.z];
  size_t all = 0, some = 0;
  for (int i = 0; i <= steps; i++) {
    for (int j = 0; i + j <= steps; j++) {
      const float u = static_cast<float>(i) / static_cast<float>(steps);
      const float v = static_cast<float>(j) / static_cast<float>(steps);
      all++;
      some += test(a + u * (b - a) + v * (c - a)) ? 1 : 0;
      if (some > 0 && some < all) return Share::kSome;
    }
  }
  return share_of(some, all);
}

// Returns whether the page shows any of the points of a piece.
bool is_shown_somewhere(const PanoramaPages& pages, const PieceMesh& mesh, const Piece& piece, vec3 normal,
                        float texels) {
  const float tolerance = depth_tolerance(mesh, 1.0f);
  return share_of_points(mesh, piece, texels, [&](vec3 point) {
           const vec2 at = to_page(pages.grid(), piece.page, point);
           const int last = pages.grid().size() - 1;
           const PageTexel texel{piece.page, std::clamp(static_cast<int>(at.x), 0, last),
                                 std::clamp(static_cast<int>(at.y), 0, last)};
           return pages.shows(index_of(pages.grid(), texel), point, normal, tolerance);
         }) != Share::kNothing;
}

// The share of a piece that any place sees.
Share seen_share(const Probe& probe, const PieceMesh& mesh, const Piece& piece, vec3 normal, float texels) {
  const int reach = mesh.mirror >= 0 ? kMirrorReach : 1;
  return share_of_points(mesh, piece, texels, [&](vec3 point) {
    return std::any_of(probe.maps.begin(), probe.maps.end(),
                       [&](const DistanceMap& map) { return sees(map, mesh, point, normal, reach); });
  });
}

// Returns whether a part of a piece is behind a mirror, where it would hide what the mirror shows.
bool is_behind_mirror(const Probe& probe, const PieceMesh& mesh, const Piece& piece, float texels) {
  if (probe.mirrors.empty() || mesh.mirror >= 0) return false;
  return share_of_points(mesh, piece, texels, [&](vec3 point) {
           return std::any_of(probe.maps.begin(), probe.maps.end(), [&](const DistanceMap& map) {
             const auto [page, at] = place_in_pages(map.grid, point - map.place);
             const int last = map.grid.size() - 1;
             const PageTexel texel{page, std::min(static_cast<int>(at.x), last),
                                   std::min(static_cast<int>(at.y), last)};
             return hides_by_mirror(map, index_of(map.grid, texel), mesh, point);
           });
         }) != Share::kNothing;
}

// The state of a piece; kUnknown if it must be divided first.
PieceState decide(const PanoramaPages& pages, const PieceMesh& mesh, const Piece& piece, float pixel) {
  const vec3 normal =
      normal_of(mesh.positions[piece.corners.x], mesh.positions[piece.corners.y], mesh.positions[piece.corners.z]);
  const bool faces = dot(normal, mesh.positions[piece.corners.x]) < 0.0f;
  const float texels = length_in_texels(mesh, piece, pixel);
  if (!mesh.masked && faces && bent_edges(mesh, pages.grid(), piece) != 0) {
    if (is_shown_somewhere(pages, mesh, piece, normal, texels)) return PieceState::kUnknown;
  } else if (!mesh.masked && faces) {
    const Share shown = shown_share(pages, mesh, piece, normal);
    if (shown == Share::kAll) return PieceState::kPage;
    if (shown == Share::kSome && length_in_page(pages.grid(), mesh, piece) > kPartlySeen) return PieceState::kUnknown;
  }
  const Share seen = seen_share(pages.probe(), mesh, piece, normal, texels);
  if (seen == Share::kNothing) return PieceState::kDropped;
  const float partly = is_behind_mirror(pages.probe(), mesh, piece, texels) ? kAtMirror : kPartlyHidden;
  const float largest =
      seen == Share::kSome ? partly : std::min(kMaxChartPiece, 0.4f * static_cast<float>(pages.grid().size()));
  return texels > largest ? PieceState::kUnknown : PieceState::kChart;
}

}  // namespace

void decide_pieces(const PanoramaPages& pages, PieceMesh& mesh, float pixel) {
  for (int round = 0; round < kMaxDivisions; round++) {
    tbb::parallel_for(size_t{0}, mesh.pieces.size(), [&](size_t i) {
      Piece& piece = mesh.pieces[i];
      if (piece.state == PieceState::kUnknown) piece.state = decide(pages, mesh, piece, pixel);
    });
    EdgeCuts cuts;
    for (size_t i = 0; i < mesh.pieces.size(); i++) {
      const Piece piece = mesh.pieces[i];
      if (piece.state != PieceState::kUnknown) continue;
      int edges = bent_edges(mesh, pages.grid(), piece);
      if (edges == 0) edges = 1 << longest_edge(mesh, piece);
      for (int edge = 0; edge < 3; edge++) {
        if (edges >> edge & 1) mark_edge(mesh, cuts, piece.corners[edge], piece.corners[(edge + 1) % 3]);
      }
    }
    if (cuts.empty()) return;
    divide(mesh, cuts);
  }
  for (Piece& piece : mesh.pieces) {
    if (piece.state == PieceState::kUnknown) piece.state = PieceState::kChart;
  }
}

}  // namespace ods
