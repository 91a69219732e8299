// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Random numbers without state: Owen-scrambled Sobol points. Any pair of any sample of any pixel can be recomputed, on
// any device, in any order.
//
// Numbers come in pairs. Each dimension pair is the two-dimensional Sobol sequence, with its order shuffled and its
// digits scrambled by its own seeds, so pairs are independent of each other and pixels are independent of their
// neighbours.
// Sources: Burley, "Practical Hash-based Owen Scrambling", 2020 (shuffled, scrambled, padded sets); the hash is
// Vegdahl's refinement of Laine and Karras, "Owen scrambling based on hashing", 2021.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/math.h"
namespace ods {
#endif

// PCG hash. Source: Jarzynski and Olano, "Hash Functions for GPU Rendering", 2020.
inline uint hash(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

inline uint hash_pair(uint a, uint b) {
  return hash(a ^ hash(b));
}

// A random permutation of the binary tree whose root is bit 0: bit k is changed only by the bits below it.
inline uint scramble_tree(uint x, uint seed) {
  x = x ^ (x * 0x3d20adeau);
  x = x + seed;
  x = x * ((seed >> 16u) | 1u);
  x = x ^ (x * 0x05526c56u);
  x = x ^ (x * 0x53a22864u);
  return x;
}

// The second Sobol coordinate of a sample, with its bits reversed: index as a polynomial over GF(2), moved from x to x
// + 1.
inline uint sobol_second_reversed(uint index) {
  index = index ^ (index >> 16u);
  index = index ^ ((index & 0xff00ff00u) >> 8u);
  index = index ^ ((index & 0xf0f0f0f0u) >> 4u);
  index = index ^ ((index & 0xccccccccu) >> 2u);
  index = index ^ ((index & 0xaaaaaaaau) >> 1u);
  return index;
}

// Uniform in [0, 1), from the high bits.
inline float unit_float(uint bits) {
  return float(bits >> 8u) * (1.0f / 16777216.0f);
}

// Pair number `dimension` of sample number `index`, each coordinate uniform in [0, 1). Every power of two of samples
// from index 0 on is stratified. seed: different for every pixel.
inline vec2 random_pair(uint seed, uint index, uint dimension) {
  uint key = hash_pair(seed, dimension);
  uint shuffled = bitfieldReverse(scramble_tree(bitfieldReverse(index), key));
  uint x = bitfieldReverse(scramble_tree(shuffled, hash(key ^ 0x9e3779b9u)));
  uint y = bitfieldReverse(scramble_tree(sobol_second_reversed(shuffled), hash(key ^ 0x85ebca6bu)));
  return vec2(unit_float(x), unit_float(y));
}

#ifdef __cplusplus
}  // namespace ods
#endif
