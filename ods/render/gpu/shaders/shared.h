// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The data that the host and its shaders share: the picture that is rendered, as a buffer, and the constants of a
// dispatch. The same bytes on both sides (scalar layout); addresses are those of buffers on the device.
#ifdef __cplusplus
#pragma once
#include <array>
#include <cstdint>

#include "ods/kernel/path.h"
#define ODS_ADDRESS(Type) uint64_t
namespace ods {
#else
#define ODS_ADDRESS(Type) Type
#endif

const int kGroupSize = 64;   // invocations of a work group: the pixels of a block, one slot each
const int kSlotChunks = 26;  // of 16 bytes (ods/render/gpu/shaders/slot.glsl)

// Lists of the slots that a stage has to serve. Each stage has two that take turns: one is filled while the other is
// read. Add the round's parity for this round's list.
const int kBeginLists = 0;
const int kTraceLists = 2;
const int kShadeLists = 4;
const int kLists = 6;
const int kNoList = -1;

// A block of the picture in the current pass.
struct GpuBlock {
  uint noisy;  // PictureSamples::noisy
  int first;   // the samples first .. last - 1 of each of its noisy pixels
  int last;
  float weight;  // samples of its noisy pixels, for paths that both eyes share
};

struct GpuView {
#ifdef __cplusplus
  std::array<uint, kCameraBytes / sizeof(uint)> camera;
#else
  Camera camera;
#endif
  EnvironmentInfo environment;
  EnvironmentInfo background;
#ifdef __cplusplus
  Media media;  // the volumes that the camera is in
#else
  ivec4 media;
  int media_count;
#endif

  int width;
  int height;
  int columns;    // blocks across
  int blocks;     // per eye
  int first_eye;  // as in EyeSamples
  int second_eye;
  int filter_shape;
  int bounces;
  int light_sampling;
  float clamp;
  float layer_unit;
  float far_depth;  // of a pixel that shows no surface
  uint seed;
  int light_pick_count;
  int portal_count;
  int shares;  // 1: paths of one eye contribute light to the other
  int is_transparent;
  int straight_solids;
  uint slot_count;
  int has_squares;  // 1: the planes of statistics exist: squares
  int has_alone;    //    alone and weights
  int has_layers;   //    normal, albedo, depth
  int has_hits;     //    hits

  ODS_ADDRESS(Vertices) vertices;
  ODS_ADDRESS(Triangles) triangles;
  ODS_ADDRESS(Meshes) meshes;
  ODS_ADDRESS(Instances) instances;
  ODS_ADDRESS(Materials) materials;
  ODS_ADDRESS(LayersOfMaterials) material_layers;
  ODS_ADDRESS(Textures) textures;
  ODS_ADDRESS(Texels) texels;
  ODS_ADDRESS(Textures) reduced_textures;
  ODS_ADDRESS(Texels) reduced_texels;
  ODS_ADDRESS(Lights) lights;
  ODS_ADDRESS(LightPicks) light_picks;
  ODS_ADDRESS(LightNodes) light_nodes;
  ODS_ADDRESS(LightWays) light_ways;
  ODS_ADDRESS(EnvironmentTexels) environment_texels;
  ODS_ADDRESS(EnvironmentRows) environment_rows;
  ODS_ADDRESS(Portals) portals;
  ODS_ADDRESS(Floats) tables;
  ODS_ADDRESS(TreeNodes) tree_nodes;
  ODS_ADDRESS(TreeTriangles) tree_triangles;
  ODS_ADDRESS(Floats) merge_map;
  ODS_ADDRESS(Floats) head_tilt_map;
  ODS_ADDRESS(TexelTable) texel_rays;

  // The planes of PictureSamples, one eye after the other. Whole numbers of 64 bits are two of 32, the low one first;
  // squares are pairs of floats whose sum they are.
  ODS_ADDRESS(Words) light;
  ODS_ADDRESS(Floats) squares;
  ODS_ADDRESS(Words) alone;
  ODS_ADDRESS(Words) weights;
  ODS_ADDRESS(Integers) normal;
  ODS_ADDRESS(Integers) albedo;
  ODS_ADDRESS(Floats) depth;
  ODS_ADDRESS(Words) hits;
  ODS_ADDRESS(Words) caught;
  ODS_ADDRESS(Words) light_with;
  ODS_ADDRESS(Words) light_without;

  ODS_ADDRESS(Blocks) pass;  // of the current pass, by block
  ODS_ADDRESS(Slots) slots;
  ODS_ADDRESS(Words) lists;  // for each list: three numbers of work groups, and its length
  ODS_ADDRESS(Words) slots_in_lists;
};

struct GpuRound {
  ODS_ADDRESS(Views) view;
  int first_block;  // counted over both eyes
  int is_reversed;  // 1: blocks are counted from the last
  int takes_depth;  // 1: each pixel's depth is found before its first sample
  int is_first;     // 1: every slot is at the start, and the list of `begin` is all slots
  int parity;       // 0 and 1 in turn
};

#ifdef __cplusplus
static_assert(sizeof(GpuBlock) == 16 && sizeof(Media) == 20);
}  // namespace ods
#endif
