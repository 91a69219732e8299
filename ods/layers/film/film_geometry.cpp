// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/film_geometry.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "ods/layers/charts.h"
#include "ods/layers/film/film_surfaces.h"
#include "ods/layers/footprint.h"
#include "ods/layers/head_room.h"
#include "ods/layers/simplify.h"
#include "ods/layers/visibility.h"

namespace ods {

namespace {

constexpr float kPixelsMoved = 0.5f;    // pixels by which simplified surfaces may move
constexpr float kLongestEdge = 100.0f;  // texels
constexpr float kMaxExtent = 120.0f;    // texels of a chart
constexpr float kLargestPiece = 1000.0f;
constexpr int kSizeStep = 64, kLargestTexture = 2048;

// A surface while it gets its charts.
struct Made {
  FilmSurface surface;
  PieceMesh mesh;
  std::vector<Chart> charts;
  float free_half = 1e30f;
};

float longest_edge_of(const PieceMesh& mesh) {
  float longest = 0.0f;
  for (const Piece& piece : mesh.pieces) {
    for (int i = 0; i < 3; i++) {
      const vec3 edge = mesh.positions[piece.corners[i]] - mesh.positions[piece.corners[(i + 1) % 3]];
      longest = std::max(longest, length(edge));
    }
  }
  return longest;
}

void divide_long_edges(PieceMesh& mesh, float longest) {
  for (;;) {
    EdgeCuts cuts;
    for (size_t i = 0; i < mesh.pieces.size(); i++) {
      const uvec3 corners = mesh.pieces[i].corners;
      for (int k = 0; k < 3; k++) {
        const uint a = corners[k], b = corners[(k + 1) % 3];
        if (length(mesh.positions[a] - mesh.positions[b]) > longest) mark_edge(mesh, cuts, a, b);
      }
    }
    if (cuts.empty()) return;
    divide(mesh, std::move(cuts));
  }
}

Made make_surface(WholeSurface whole, const std::vector<char>& seen, const Mover& mover, const HeadBox& box,
                  float pixel, size_t index) {
  Made made;
  const FilmView view = view_of(whole, mover, box);
  made.free_half = view.free_half;
  made.surface = std::move(whole.surface);
  std::vector<uvec3> triangles;
  for (size_t t = 0; t < whole.triangles.size(); t++) {
    if (view.faces[t] && seen[t]) triangles.push_back(whole.triangles[t]);
  }
  if (triangles.empty()) return made;
  float texel = pixel * std::max(view.nearest, kEyeRoom);
  std::vector<vec3>& positions = made.surface.positions;
  if (!mover.deforms) {
    made.surface.error = kPixelsMoved * texel;
    triangles = simplified(positions, triangles, made.surface.error);
  }
  const std::vector<uint> kept = leave_out_unused(positions, triangles);
  for (std::vector<vec3>& shape : made.surface.shapes) {
    std::vector<vec3> some;
    for (const uint old : kept) some.push_back(shape[old]);
    shape = std::move(some);
  }
  made.mesh.positions = std::move(positions);
  made.mesh.error = made.surface.error;
  for (const uvec3& corners : triangles) made.mesh.pieces.push_back({corners, 0, PieceState::kChart});
  if (mover.deforms) {
    texel = std::max(texel, longest_edge_of(made.mesh) / kLargestPiece);
  } else {
    divide_long_edges(made.mesh, kLongestEdge * texel);
  }
  made.charts = flat_charts(made.mesh, index, texel, kMaxExtent);
  made.surface.positions = made.mesh.positions;
  return made;
}

std::vector<Chart*> charts_of_kind(std::vector<Made>& all, bool is_masked) {
  std::vector<Chart*> charts;
  for (Made& made : all) {
    if (made.surface.is_masked != is_masked) continue;
    for (Chart& chart : made.charts) charts.push_back(&chart);
  }
  return charts;
}

// The smallest size of textures of which one holds all charts; if none does, the largest.
int fitting_size(const std::vector<Chart*>& charts) {
  double area = 0.0;
  int least = 1;
  for (const Chart* chart : charts) {
    area += static_cast<double>(chart->width) * chart->height;
    least = std::max({least, chart->width, chart->height});
  }
  const int first = std::max(least, static_cast<int>(std::sqrt(area)));
  for (int size = (first + kSizeStep - 1) / kSizeStep * kSizeStep; size < kLargestTexture; size += kSizeStep) {
    if (pack_charts(charts, size, 0) == 1) return size;
  }
  return kLargestTexture;
}

void pack_film(std::vector<Made>& all, FilmGeometry& geometry) {
  const std::vector<Chart*> opaque = charts_of_kind(all, false), masked = charts_of_kind(all, true);
  geometry.texture_size = 0;
  for (const auto& charts : {opaque, masked}) {
    if (!charts.empty()) geometry.texture_size = std::max(geometry.texture_size, fitting_size(charts));
  }
  const int first = pack_charts(opaque, geometry.texture_size, 0);
  const int rest = pack_charts(masked, geometry.texture_size, first);
  geometry.textures = static_cast<size_t>(first + rest);
  geometry.kinds.assign(static_cast<size_t>(first), LayerKind::kOpaque);
  geometry.kinds.resize(geometry.textures, LayerKind::kMasked);
}

// The mesh of a mover in a texture.
class MoverBuilder {
 public:
  MoverBuilder(MoverMesh& mesh, int size) : mesh_(mesh), size_(static_cast<float>(size)) {}

  uint vertex(const FilmSurface& surface, size_t chart_number, const Chart& chart, uint corner) {
    const uint64_t key = uint64_t{chart_number} << 32 | corner;
    const auto [found, is_new] = index_.try_emplace(key, static_cast<uint>(mesh_.positions.size()));
    if (!is_new) return found->second;
    const bool deforms = !surface.shapes.empty();
    mesh_.positions.push_back(deforms ? surface.shapes[0][corner] : surface.positions[corner]);
    mesh_.uvs.push_back(in_chart(chart, surface.positions[corner]) / size_);
    mesh_.shapes.resize(surface.shapes.size());
    for (size_t frame = 0; frame < surface.shapes.size(); frame++) {
      mesh_.shapes[frame].push_back(surface.shapes[frame][corner]);
    }
    return found->second;
  }
  void triangle(uvec3 corners) { mesh_.triangles.push_back(corners); }

 private:
  MoverMesh& mesh_;
  float size_;
  std::unordered_map<uint64_t, uint> index_;
};

MoverMesh& mesh_in(LayerMover& mover, size_t texture, LayerKind kind) {
  const auto found = std::ranges::find(mover.meshes, texture, &MoverMesh::texture);
  if (found != mover.meshes.end()) return *found;
  mover.meshes.push_back({kind, texture, {}, {}, {}, {}});
  return mover.meshes.back();
}

// Adds the triangles of a chart to its mover, and its texels. number: of the chart.
void add_chart(const Made& made, uint surface, const Chart& chart, size_t number, FilmGeometry& geometry) {
  const size_t texture = static_cast<size_t>(chart.texture);
  MoverBuilder builder(mesh_in(geometry.film.movers[made.surface.mover], texture, geometry.kinds[texture]),
                       geometry.texture_size);
  const size_t width = static_cast<size_t>(chart.width);
  std::vector<size_t> texel_of(width * static_cast<size_t>(chart.height), ~size_t{0});
  for (const size_t piece : chart.pieces) {
    FilmTriangle triangle{surface, made.mesh.pieces[piece].corners, {}};
    uvec3 corners;
    for (int i = 0; i < 3; i++) {
      triangle.at[i] = in_chart(chart, made.surface.positions[triangle.corners[i]]);
      corners[i] = builder.vertex(made.surface, number, chart, triangle.corners[i]);
    }
    builder.triangle(corners);
    const uint index = static_cast<uint>(geometry.triangles.size());
    geometry.triangles.push_back(triangle);
    for_each_texel(triangle.at, geometry.texture_size, [&](int x, int y, bool is_inside) {
      if (x < chart.x || y < chart.y || x >= chart.x + chart.width || y >= chart.y + chart.height) return true;
      size_t& known = texel_of[static_cast<size_t>(y - chart.y) * width + static_cast<size_t>(x - chart.x)];
      const FilmTexel texel{texel_index(geometry.texture_size, chart.texture, x, y), index, static_cast<int>(number),
                            vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f, is_inside};
      if (known == ~size_t{0}) {
        known = geometry.texels.size();
        geometry.texels.push_back(texel);
      } else if (is_inside && !geometry.texels[known].is_inside) {
        geometry.texels[known] = texel;
      }
      return true;
    });
  }
}

}  // namespace

FilmGeometry build_film(Scene& scene, const std::vector<Mover>& movers, std::span<const double> times,
                        const HeadBox& box, int width) {
  std::vector<WholeSurface> wholes = surfaces_of(scene, movers, times);
  const std::vector<std::vector<char>> seen = seen_triangles(scene, wholes, movers, times, box);
  std::vector<Made> all(wholes.size());
  const float pixel = pixel_angle(width);
  tbb::parallel_for(size_t{0}, wholes.size(), [&](size_t i) {
    const Mover& mover = movers[wholes[i].surface.mover];
    all[i] = make_surface(std::move(wholes[i]), seen[i], mover, box, pixel, i);
  });
  float free_half = 1e30f;
  for (const Made& made : all) free_half = std::min(free_half, made.free_half);
  check_head_room(free_half, box.size, ", another `position`, or frames in which what moves is farther away");

  FilmGeometry geometry;
  for (const double time : times) geometry.film.times.push_back(static_cast<float>(time - times.front()));
  for (const Mover& mover : movers) {
    geometry.film.movers.push_back({"mover " + std::to_string(geometry.film.movers.size()), {}, mover.poses});
  }
  pack_film(all, geometry);
  size_t chart_number = 0;
  for (size_t i = 0; i < all.size(); i++) {
    for (const Chart& chart : all[i].charts) add_chart(all[i], static_cast<uint>(i), chart, chart_number++, geometry);
    geometry.surfaces.push_back(std::move(all[i].surface));
  }
  return geometry;
}

}  // namespace ods
