// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A layered scene: what the eyes of a head that moves within a small box see of a scene, as triangles with baked light.
// The triangles are the scene's own, simplified to half a pixel of the panorama and cut; their textures are the
// panorama from the middle of the box, as pages of a cube, and charts for everything that the middle does not see.
//
// World coordinates as in the scene: metres, right-handed, +Y up. Texture coordinates as in glTF: (0, 0) is the upper
// left corner of the texture, (1, 1) its lower right one. Triangles are counter-clockwise as seen from the box.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/image/image.h"
#include "ods/image/tone.h"
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

// The light that arrives at a place from all directions, in real spherical harmonics of the orders 0 to 2.
struct LightProbe {
  static constexpr int kHarmonics = 9;
  float weight = 0.0f;  // 1: in free space that the box sees; 0: inside or behind something, not to be used
  std::array<vec3, kHarmonics> radiance{};  // scene-linear; ods/layers/probes/harmonics.h has the order
};

// Metres between the outermost probes and the bounds of what the box sees, unless those are very near.
inline constexpr float kProbeMargin = 0.15f;

// Places of such light in a grid. Probe (i, j, k) is at origin + step * (i, j, k), its index is
// i + count.x * (j + count.y * k).
struct LightProbes {
  vec3 origin{0.0f};  // metres, in the scene
  vec3 step{1.0f};
  glm::ivec3 count{0};
  std::vector<LightProbe> probes;
};

// The data by which real-time objects are lit like the scene.
struct LayerLightInfo {
  float exposure = 0.0f;  // stops, of all textures
  ToneCurve tone = ToneCurve::kNeutral;
  LightProbes probes;
};

// The place of something that moves at one frame. A point p of it is at place + rotation * (scale * p).
struct LayerPose {
  vec3 place{0.0f};                       // metres, in the scene
  vec4 rotation{0.0f, 0.0f, 0.0f, 1.0f};  // quaternion x, y, z, w
  vec3 scale{1.0f};
  bool shown = true;
};

inline vec3 at_pose(const LayerPose& pose, vec3 p) {
  const vec3 axis(pose.rotation), v = pose.scale * p;
  return pose.place + v + 2.0f * cross(axis, cross(axis, v) + pose.rotation.w * v);
}

// The triangles of something that moves that share a texture.
struct MoverMesh {
  LayerKind kind = LayerKind::kOpaque;  // or kMasked
  size_t texture = 0;                   // of LayerFilm::lights
  std::vector<vec3> positions;          // metres, from its own origin
  std::vector<vec2> uvs;
  std::vector<uvec3> triangles;
  std::vector<std::vector<vec3>> shapes;  // if it deforms: the positions at each frame, `positions` at the first
};

// Something that moves as a whole, with triangles that exist from wherever the box sees them during the film.
struct LayerMover {
  std::string name;  // for files: "mover 0"
  std::vector<MoverMesh> meshes;
  std::vector<LayerPose> poses;  // by frame
};

// The place of a layer's light change in the textures of changes: texture coordinates uv of the layer are at
// clamp(uv * scale + offset, low, high) of those.
struct ChangePlace {
  vec2 scale{0.0f}, offset{0.0f};
  vec2 low{0.0f}, high{0.0f};
  bool exists() const { return scale.x > 0.0f; }
};

// The change of the still layers' light by what moves: shadows, reflections, lamps. A displayed colour in linear light,
// 0..1, becomes (colour + kDarkLight) * ratio - kDarkLight. A channel of a texture is ratio / (ratio + kRatioUnit), so
// no change is 128 of 255.
struct LightChange {
  std::vector<ChangePlace> places;  // by mesh; absent ones, as of the sky, do not change
  std::vector<Image> ratios;        // by LayerFilm::light_times, 3 channels, all of one size; empty: nothing changes
};
inline constexpr float kDarkLight = 0.01f;
inline constexpr float kRatioUnit = 127.0f / 128.0f;

// A film of things that move among still layers. Their light changes slower than their place: every texture exists once
// for each of light_times, and viewers mix two of them.
struct LayerFilm {
  std::vector<float> times;                // seconds of the frames: ascending, the first is 0
  std::vector<float> light_times;          // seconds: ascending, the first is 0, the last at most that of the frames
  std::vector<std::vector<Image>> lights;  // by texture, then by time; as LayerMesh::texture
  std::vector<LayerMover> movers;          // empty: nothing moves
  LightChange change;                      // of the still layers' light
};

// The bytes of textures on the graphics card: 4 for each texel, and a third for mipmaps.
constexpr size_t texture_bytes(size_t texels) {
  return 4 * texels * 4 / 3;
}

struct LayeredScene {
  std::string name;  // of the scene that was baked, without folders; empty if unknown
  LayerLightInfo light;
  HeadBox box;
  float yaw = 0.0f;      // degrees: the heading of the panorama's centre, as in StereoCamera
  int width = 8192;      // of the lat-long panorama whose pixel is the unit of all errors
  std::string fallback;  // name of a stereo picture from the middle, in the same folder; may be empty
  std::vector<LayerMesh> meshes;
  LayerFilm film;
};

}  // namespace ods
