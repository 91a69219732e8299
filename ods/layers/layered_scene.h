// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A layered scene: what the eyes of a head that moves within a small box see of a scene, as triangles with baked light.
// The triangles are the scene's own, simplified to half a pixel of the panorama and cut; their textures are the panorama
// from the middle of the box, as pages of a cube, and charts for everything that the middle does not see.
//
// World coordinates as in the scene: metres, right-handed, +Y up. Texture coordinates as in glTF: (0, 0) is the upper
// left corner of the texture, (1, 1) its lower right one. Triangles are counter-clockwise as seen from the box.
#pragma once
#include <string>
#include <vector>

#include "ods/image/image.h"
#include "ods/kernel/math.h"

namespace ods {

inline constexpr int kLayeredVersion = 1;

// The space within which eyes may be.
struct HeadBox {
  vec3 center{0.0f};
  vec3 size{0.3f};  // metres
};

// How a texture is drawn.
enum class LayerKind {
  kOpaque,   // with a depth test
  kMasked,   // alpha is coverage: drawn where it is at least 0.5, or by alpha to coverage
  kBlended,  // of glass, blended over what is behind it by straight alpha, in linear light; drawn last, in this order
  kSky,      // at infinity: a cube around the eye, drawn first, without depth
};

// The triangles that share a texture: one draw call.
struct LayerMesh {
  LayerKind kind = LayerKind::kOpaque;
  std::string noun = "page";  // what it is, for names in files: page, charts, masked charts, panes, sky
  std::vector<vec3> positions;
  std::vector<vec2> uvs;  // one for each position
  std::vector<uvec3> triangles;
  Image texture;  // 3 channels, or 4 with straight alpha if has_alpha(); displayed values, sRGB-encoded, 0..1
};

// Returns whether textures of this kind have alpha.
constexpr bool has_alpha(LayerKind kind) {
  return kind == LayerKind::kMasked || kind == LayerKind::kBlended;
}

struct LayeredScene {
  HeadBox box;
  float yaw = 0.0f;      // degrees: the heading of the panorama's centre, as in StereoCamera
  int width = 8192;      // of the lat-long panorama whose pixel is the unit of all errors
  std::string fallback;  // name of a stereo picture from the middle, in the same folder; empty if there is none
  std::vector<LayerMesh> meshes;
};

}  // namespace ods
