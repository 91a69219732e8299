// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The data of the denoiser: the light without albedo and its variance, in blocks whose margins contain the adjacent
// parts of the world.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "ods/convert/panorama.h"

namespace ods {

// A variance in 16 bits: a float without the lower half of its bits. Negative if unknown.
inline uint16_t pack_variance(float v) {
  return static_cast<uint16_t>((std::bit_cast<uint32_t>(v) + 0x8000u) >> 16);
}
inline float unpack_variance(uint16_t v) {
  return std::bit_cast<float>(static_cast<uint32_t>(v) << 16);
}

inline constexpr float kUnknown = -1.0f;  // as a variance

// An eye's light at one stage.
struct Level {
  std::vector<float> light;        // 3 per pixel: radiance / divisor()
  std::vector<uint16_t> variance;  // mean of the channels
  std::vector<uint8_t> share;      // fraction of its candidates that the previous pass used, in 1/255
};

struct NoisyPicture {
  StoredPicture shape;  // size, eyes and camera, without pixels
  Source source;
  Camera camera;
  std::vector<Cell> cells;
  const Picture* picture = nullptr;
  bool turns = false;                        // a row is a whole turn
  const std::vector<int>* owners = nullptr;  // of the pixels of a texture (ods/camera/texel_rays.h)

  int width() const { return shape.size.width; }
  int height() const { return shape.size.height; }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width()) + static_cast<size_t>(x);
  }
  // Returns whether the light of two pixels may be mixed.
  bool have_one_owner(size_t a, size_t b) const { return !owners || (*owners)[a] == (*owners)[b]; }
  const EyeImage& eye(int i) const { return picture->eyes[static_cast<size_t>(i)]; }
};

// Opens a picture, which must outlive the result and must not move. The result must not be moved.
void open_noisy(NoisyPicture& noisy, const Picture& picture, const StereoCamera& camera);

// The texel next to a cell, across its edge. Returns nullopt where the picture ends.
std::optional<Texel> neighbour_of(const NoisyPicture& noisy, int eye, const Cell& cell, int x, int y);

// Like neighbour_of(), and for positions inside the cell its own texels.
std::optional<Texel> texel_at(const NoisyPicture& noisy, int eye, const Cell& cell, int x, int y);

// The divisor of the radiance: the albedo, plus a little for light that the albedo does not colour.
inline vec3 divisor_of(vec3 albedo) {
  constexpr float kUncoloured = 0.05f;  // approximate reflectance of a polished surface
  return albedo + kUncoloured;
}
vec3 divisor(const EyeImage& eye, size_t pixel);

vec3 normal_at(const EyeImage& eye, size_t pixel);
vec3 albedo_at(const EyeImage& eye, size_t pixel);

// Returns whether the pixel shows only the sky, which has no noise.
bool is_bare_sky(const EyeImage& eye, size_t pixel);

// The first level, from radiance and variance. The bare sky has no variance.
Level first_level(const NoisyPicture& noisy, int eye);

enum Plane {
  kRed,
  kGreen,
  kBlue,
  kVariance,
  kNormalX,
  kNormalY,
  kNormalZ,
  kAlbedoR,
  kAlbedoG,
  kAlbedoB,
  kShare,
  kOwner,  // 0 everywhere in a picture without owners
  kPlaneCount
};

// Part of a cell with a margin around it.
struct Block {
  int eye = 0;
  Cell cell;       // the cell that contains it
  Cell inside;     // the block, in the eye's pixels
  int across = 0;  // columns of the margin on either side
  int down = 0;    // rows of the margin above and below
  std::array<std::vector<float>, kPlaneCount> planes;

  int stride() const { return inside.right - inside.left + 2 * across; }
  // The offset of the eye's row y in a plane, at the column inside.left; the margin's columns are before and after.
  ptrdiff_t offset(int y) const { return static_cast<ptrdiff_t>(y - inside.top + down) * stride() + across; }
  const float* row(Plane plane, int y) const { return planes[plane].data() + offset(y); }
};

// Loads a block. features: if false, normals and albedos are not changed.
void load_block(const NoisyPicture& noisy, const std::vector<Level>& levels, Block& block, bool features = true);

}  // namespace ods
