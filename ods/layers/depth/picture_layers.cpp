// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/picture_layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/convert/convert.h"
#include "ods/layers/depth/depth_surface.h"
#include "ods/layers/depth/hidden_panorama.h"
#include "ods/layers/head_room.h"
#include "ods/layers/layer_views.h"
#include "ods/layers/light/display.h"
#include "ods/layers/light/push.h"
#include "ods/layers/light/sky_mesh.h"
#include "ods/layers/page_meshes.h"
#include "ods/layers/probes/harmonics.h"

namespace ods {

namespace {

constexpr int kMaxWidth = 16384;
constexpr int kMaxDivisions = 16;
constexpr const char* kHidden = "hidden page";
constexpr size_t kBytesPerTexel = 400;  // at most: the mesh of a page before it is simplified
constexpr int kWidestSky = 1024;        // of the page of a sky that only closes what is open
constexpr double kRare = 1e-4;          // the share of texels that may be nearer than the box allows: errors of depth

// Half the side of the largest cube around the middle without a surface in it, but for a few texels.
float free_half(const DepthPanorama& panorama) {
  std::vector<float> halves;
  for_each_inner_texel(panorama.grid, [&](PageTexel at) {
    const vec3 along = abs(ray_of(panorama.grid, at));
    const float nearness = panorama.nearness[index_of(panorama.grid, at)];
    if (nearness > 0.0f) halves.push_back(std::max({along.x, along.y, along.z}) / nearness);
  });
  if (halves.empty()) return kFarDepth;
  const auto rare = halves.begin() + static_cast<ptrdiff_t>(kRare * static_cast<double>(halves.size()));
  std::ranges::nth_element(halves, rare);
  return *rare;
}

int width_of(const StoredPicture& picture, const PictureLayersOptions& options) {
  if (options.width) return *options.width;
  const Extent size = fitting_extent(picture, {kLatLong});
  return std::clamp(size.width, 64, kMaxWidth);
}

void check_memory_for(const PageGrid& grid) {
  const size_t page = index_of(grid, {1, 0, 0});
  check_memory(texel_count(grid) * 2 * (sizeof(vec3) + sizeof(float)) + 4 * page * kBytesPerTexel,
               "the layers of the picture", "a smaller `width` needs less");
}

// The pieces of a surface, all of which its pages show.
PieceMesh pieces_of(SeenSurface surface, const PageGrid& grid) {
  PieceMesh mesh = cut_to_pages(std::move(surface), grid);
  for (int round = 0; round < kMaxDivisions; round++) {
    EdgeCuts cuts;
    for (size_t i = 0; i < mesh.pieces.size(); i++) {
      const Piece piece = mesh.pieces[i];
      const int bent = bent_edges(mesh, grid, piece);
      for (int edge = 0; edge < 3; edge++) {
        if (bent >> edge & 1) mark_edge(mesh, cuts, piece.corners[edge], piece.corners[(edge + 1) % 3]);
      }
    }
    if (cuts.empty()) break;
    divide(mesh, cuts);
  }
  for (Piece& piece : mesh.pieces) piece.state = PieceState::kPage;
  return mesh;
}

// The colours of a page's surfaces, which continue where there are none.
Image page_colors(const DepthPanorama& panorama, int page) {
  const int size = panorama.grid.size();
  Image image(size, size, 3);
  const size_t first = index_of(panorama.grid, {page, 0, 0});
  std::vector<int> owners;
  for (size_t i = 0; i < image.pixels.size() / 3; i++) owners.push_back(panorama.nearness[first + i] > 0.0f ? 0 : -1);
  for (size_t i = 0; i < image.pixels.size(); i++) {
    image.pixels[i] = panorama.colors[first + i / 3][static_cast<int>(i % 3)];
  }
  push_outwards(image, owners, std::vector<int>(owners.size(), -1), 0);
  return image;
}

// Adds the surfaces of a panorama, with its pages as textures.
void add_surfaces(const DepthPanorama& panorama, float reach, const char* noun, const PictureLayersOptions& options,
                  LayeredScene& scene) {
  std::vector<PieceMesh> pieces;
  pieces.push_back(pieces_of(depth_surface(panorama, reach), panorama.grid));
  LayeredScene part;
  part.box = scene.box;
  int count = 0;
  const std::vector<int> texture_of = textures_of_pages(panorama.grid, pieces, count);
  part.meshes.resize(static_cast<size_t>(count));
  add_page_meshes(panorama.grid, pieces, texture_of, part);
  for (size_t page = 0; page < texture_of.size(); page++) {
    if (texture_of[page] < 0) continue;
    LayerMesh& mesh = part.meshes[static_cast<size_t>(texture_of[page])];
    mesh.noun = noun;
    mesh.texture = displayed(page_colors(panorama, static_cast<int>(page)), options.exposure, options.tone);
  }
  std::ranges::move(part.meshes, std::back_inserter(scene.meshes));
}

// The sky as a lat-long picture: behind surfaces, the nearest part that is seen. If the picture shows no sky, all of
// it, as if it were far away.
Environment sky_of_picture(const DepthPanorama& panorama, bool has_sky) {
  const int across = std::min(panorama.grid.inner() * panorama.grid.across() * 4, has_sky ? kMaxWidth : 4 * kWidestSky);
  Image image(across, across / 2, 3);
  const size_t pixels = image.pixels.size() / 3;
  std::vector<int> owners(pixels, -1);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; x++) {
      const float azimuth = ((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width) - 0.5f) * 2.0f * kPi;
      const float elevation = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height)) * kPi;
      const size_t texel = texel_towards(panorama.grid, direction_of(azimuth, elevation));
      const float nearness = panorama.nearness[texel];
      if (nearness == kNothing || (has_sky && nearness != 0.0f)) continue;
      owners[static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)] = 0;
      for (int c = 0; c < 3; c++) image.at(x, y)[c] = panorama.colors[texel][c];
    }
  });
  push_outwards(image, owners, std::vector<int>(pixels, -1), 0);
  Environment sky;
  sky.radiance = vec3(1.0f);
  sky.width = image.width, sky.height = image.height;
  for (size_t i = 0; i < pixels; i++) {
    sky.texels.emplace_back(image.pixels[3 * i], image.pixels[3 * i + 1], image.pixels[3 * i + 2]);
  }
  return sky;
}

void add_sky(const DepthPanorama& panorama, const PictureLayersOptions& options, LayeredScene& layers) {
  Scene background;
  background.environment = sky_of_picture(panorama, std::ranges::count(panorama.nearness, 0.0f) > 0);
  std::ranges::move(make_sky(background, panorama.grid.size(), options.exposure, options.tone),
                    std::back_inserter(layers.meshes));
}

// The light at the middle, from everything that the picture shows: what lights real-time objects.
LightProbes probe_at_middle(const DepthPanorama& panorama, vec3 middle) {
  LightProbe probe;
  probe.weight = 1.0f;
  const float side = 0.5f * kPi;  // of a face, radians
  const float texels = static_cast<float>(panorama.grid.inner() * panorama.grid.across());
  for_each_inner_texel(panorama.grid, [&](PageTexel at) {
    const vec3 ray = ray_of(panorama.grid, at), along = abs(ray);
    const float largest = std::max({along.x, along.y, along.z});
    // d(tan a) d(tan b) / (1 + tan^2 a + tan^2 b)^(3/2): the solid angle of a texel of even angles a and b.
    const vec3 slopes = along / largest;
    const float area =
        (1.0f + slopes.x * slopes.x) * (1.0f + slopes.y * slopes.y) * (1.0f + slopes.z * slopes.z) / 2.0f;
    const float solid = area * largest * largest * largest * (side / texels) * (side / texels);
    const auto values = harmonics(ray);
    for (size_t i = 0; i < values.size(); i++)
      probe.radiance[i] += solid * values[i] * panorama.colors[index_of(panorama.grid, at)];
  });
  LightProbes probes;
  probes.origin = middle;
  probes.count = glm::ivec3(1);
  probes.probes = {probe};
  return probes;
}

// Counts what eyes in the box see. A ray that leaves the layers where the picture shows the sky meets the sky.
PictureLayersCounts count_of(const LayeredScene& layers, const DepthPanorama& front) {
  PictureLayersCounts counts;
  for (const LayerMesh& mesh : layers.meshes) counts.triangles += mesh.triangles.size();
  const LayerViews views(layers);
  size_t rays = 0, hidden = 0, open = 0;
  for (int eye = 0; eye < LayerViews::kEyes; eye++) {
    const LayerViews::View view = views.from_eye(eye);
    rays += view.directions.size();
    for (size_t i = 0; i < view.directions.size(); i++) {
      if (view.meshes[i] >= 0) {
        hidden += layers.meshes[static_cast<size_t>(view.meshes[i])].noun == kHidden ? 1 : 0;
        continue;
      }
      open += front.nearness[texel_towards(front.grid, view.directions[i])] > 0.0f ? 1 : 0;
    }
  }
  counts.hidden = static_cast<double>(hidden) / static_cast<double>(rays);
  counts.open = static_cast<double>(open) / static_cast<double>(rays);
  return counts;
}

}  // namespace

LayeredScene picture_layers(const StoredPicture& picture, const PictureLayersOptions& given,
                            PictureLayersCounts* counts, const Progress& progress) {
  if (!depth_layer(picture)) throw Error(ErrorKind::kUsage, "the picture has no depth");
  PictureLayersOptions options = given;
  if (!picture.is_float) options.exposure = 0.0f, options.tone = ToneCurve::kLinear;
  const auto done = [&](double share) {
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
    if (progress.report) progress.report(share);
  };
  LayeredScene layers;
  layers.width = width_of(picture, options);
  layers.box = {picture.camera.position, options.box};
  layers.yaw = picture.camera.yaw;
  layers.light = {options.exposure, options.tone, {}};
  const PageGrid grid = page_grid(layers.width);
  check_memory_for(grid);
  const Source source = make_source(picture);
  const Reprojection reprojection = make_reprojection(source);
  const float reach = 0.5f * length(options.box);
  const DepthPanorama front = look_from_middle(reprojection, grid, reach);
  check_head_room(free_half(front), options.box, "");
  done(0.3);
  add_surfaces(front, reach, "page", options, layers);
  done(0.7);
  const DepthPanorama hidden = hidden_panorama(reprojection, front, page_grid(layers.width / 2), reach);
  add_surfaces(hidden, reach, kHidden, options, layers);
  add_sky(front, options, layers);
  layers.light.probes = probe_at_middle(front, layers.box.center);
  done(0.9);
  if (counts) *counts = count_of(layers, front);
  done(1.0);
  return layers;
}

}  // namespace ods
