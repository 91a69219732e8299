// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/noisy_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ods/kernel/counterpart.h"

namespace ods {

static std::vector<Cell> cells_of(const Projection& projection, Extent size) {
  std::vector<Cell> cells;
  for (int y = 0; y < size.height; y = cells.back().bottom) {
    for (int x = 0; x < size.width; x = cells.back().right) {
      cells.push_back(cell_of(projection, size, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}));
    }
  }
  return cells;
}

void open_noisy(NoisyPicture& noisy, const Picture& picture, const StereoCamera& camera) {
  noisy.picture = &picture;
  const Image& first = picture.eyes[0].radiance;
  noisy.shape.size = {first.width, first.height};
  noisy.shape.camera = camera;
  for (const EyeImage& eye : picture.eyes) noisy.shape.eyes.push_back({eye.eye, {}});
  noisy.source = make_source(noisy.shape);
  noisy.camera = make_camera(camera);
  noisy.cells = cells_of(noisy.camera.projection, noisy.shape.size);
  noisy.turns = wraps_around(noisy.camera.projection);
  if (camera.texel_rays) noisy.owners = &camera.texel_rays->owners;
}

std::optional<Texel> neighbour_of(const NoisyPicture& noisy, int eye, const Cell& cell, int x, int y) {
  if (noisy.turns && y >= 0 && y < noisy.height()) {
    const int column = x % noisy.width();
    return Texel{eye, column < 0 ? column + noisy.width() : column, y};
  }
  if (has_image_circle(noisy.camera.projection.kind)) {
    return has_texel(noisy.source, cell, x, y) ? std::optional(Texel{eye, x, y}) : std::nullopt;
  }
  const Texel texel = texel_of(noisy.source, eye, cell, x, y);
  const bool is_outside = x < cell.left || x >= cell.right || y < cell.top || y >= cell.bottom;
  const bool is_nearest = texel.source_eye == eye && texel.x == std::clamp(x, cell.left, cell.right - 1) &&
                          texel.y == std::clamp(y, cell.top, cell.bottom - 1);
  if (is_outside && is_nearest) return {};  // the picture ends here
  return texel;
}

std::optional<Texel> texel_at(const NoisyPicture& noisy, int eye, const Cell& cell, int x, int y) {
  const bool is_own = x >= cell.left && x < cell.right && y >= cell.top && y < cell.bottom;
  return is_own ? Texel{eye, x, y} : neighbour_of(noisy, eye, cell, x, y);
}

// --- a pixel ---------------------------------------------------------------------------------------------------------

static vec3 finite_at(const Image& image, size_t pixel) {
  if (image.pixels.empty()) return vec3(0.0f);
  const float* at = &image.pixels[3 * pixel];
  const vec3 value(at[0], at[1], at[2]);
  return std::isfinite(value.x + value.y + value.z) ? value : vec3(0.0f);
}

vec3 normal_at(const EyeImage& eye, size_t pixel) {
  return finite_at(eye.normal, pixel);
}

vec3 albedo_at(const EyeImage& eye, size_t pixel) {
  return clamp(finite_at(eye.albedo, pixel), 0.0f, 1.0f);
}

vec3 divisor(const EyeImage& eye, size_t pixel) {
  return eye.albedo.pixels.empty() ? vec3(1.0f) : divisor_of(albedo_at(eye, pixel));
}

bool is_bare_sky(const EyeImage& eye, size_t pixel) {
  if (eye.depth.pixels.empty() || eye.normal.pixels.empty()) return false;
  return eye.depth.pixels[pixel] >= kFarDepth && normal_at(eye, pixel) == vec3(0.0f);
}

static float variance_at(const EyeImage& eye, size_t pixel, vec3 divided_by) {
  const float* v = &eye.variance.pixels[3 * pixel];
  const float sum = v[0] + v[1] + v[2];
  const bool is_known = std::isfinite(sum) && v[0] >= 0.0f && v[1] >= 0.0f && v[2] >= 0.0f &&
                        (eye.samples.pixels.empty() || eye.samples.pixels[pixel] >= 2.0f);
  if (!is_known) return kUnknown;
  const vec3 scaled = vec3(v[0], v[1], v[2]) / (divided_by * divided_by);
  return (scaled.x + scaled.y + scaled.z) * (1.0f / 3.0f);
}

// --- levels and blocks -----------------------------------------------------------------------------------------------

// Returns whether the pixel and its neighbours show only the sky. At silhouettes, the other eye's paths may contribute
// light of a surface that none of the pixel's own samples meets: that is noise, like in the pixels beside it.
static bool is_only_sky(const NoisyPicture& noisy, const EyeImage& eye, int x, int y) {
  if (!is_bare_sky(eye, noisy.index(x, y))) return false;
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, noisy.height() - 1); row++) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, noisy.width() - 1); column++) {
      if (normal_at(eye, noisy.index(column, row)) != vec3(0.0f)) return false;
    }
  }
  return true;
}

Level first_level(const NoisyPicture& noisy, int which) {
  const EyeImage& eye = noisy.eye(which);
  const size_t count = static_cast<size_t>(noisy.width()) * static_cast<size_t>(noisy.height());
  Level level{std::vector<float>(3 * count), std::vector<uint16_t>(count), std::vector<uint8_t>(count)};
  tbb::parallel_for(0, noisy.height(), [&](int y) {
    for (int x = 0; x < noisy.width(); x++) {
      const size_t i = noisy.index(x, y);
      const vec3 by = divisor(eye, i);
      const float* radiance = &eye.radiance.pixels[3 * i];
      // Light of NaN marks a pixel to be filled in.
      for (size_t c = 0; c < 3; c++) level.light[3 * i + c] = radiance[c] / by[static_cast<int>(c)];
      level.variance[i] = pack_variance(is_only_sky(noisy, eye, x, y) ? 0.0f : variance_at(eye, i, by));
    }
  });
  return level;
}

static void put_nothing(Block& block, size_t to) {
  for (std::vector<float>& plane : block.planes) plane[to] = 0.0f;
  block.planes[kVariance][to] = kUnknown;
}

static void put_pixel(const Level& level, const EyeImage& eye, size_t i, bool features, Block& block, size_t to) {
  const float* light = &level.light[3 * i];
  const bool is_known = std::isfinite(light[0] + light[1] + light[2]);
  for (size_t c = 0; c < 3; c++) block.planes[kRed + c][to] = is_known ? light[c] : 0.0f;
  block.planes[kVariance][to] = is_known ? unpack_variance(level.variance[i]) : kUnknown;
  block.planes[kShare][to] = static_cast<float>(level.share[i]) * (1.0f / 255.0f);
  if (!features) return;
  const vec3 normal = normal_at(eye, i), albedo = albedo_at(eye, i);
  for (int c = 0; c < 3; c++) {
    block.planes[static_cast<size_t>(kNormalX + c)][to] = normal[c];
    block.planes[static_cast<size_t>(kAlbedoR + c)][to] = albedo[c];
  }
}

void load_block(const NoisyPicture& noisy, const std::vector<Level>& levels, Block& block, bool features) {
  const Cell& inside = block.inside;
  const size_t count =
      static_cast<size_t>(block.stride()) * static_cast<size_t>(inside.bottom - inside.top + 2 * block.down);
  for (std::vector<float>& plane : block.planes) plane.resize(count);
  size_t to = 0;
  for (int y = inside.top - block.down; y < inside.bottom + block.down; y++) {
    for (int x = inside.left - block.across; x < inside.right + block.across; x++, to++) {
      const auto from = texel_at(noisy, block.eye, block.cell, x, y);
      if (!from) {
        put_nothing(block, to);
        continue;
      }
      const auto eye = static_cast<size_t>(from->source_eye);
      const size_t pixel = noisy.index(from->x, from->y);
      put_pixel(levels[eye], noisy.eye(from->source_eye), pixel, features, block, to);
      if (noisy.owners) block.planes[kOwner][to] = static_cast<float>((*noisy.owners)[pixel]);
    }
  }
}

}  // namespace ods
