// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Local frames of directions.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/math.h"
namespace ods {
#endif

// Unit vectors at right angles.
struct Frame {
  vec3 tangent;
  vec3 bitangent;
  vec3 normal;
};

// A frame around a unit normal. Source: Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
inline Frame frame_around(vec3 n) {
  Frame frame;
  frame.normal = n;
  float side = n.z < 0.0f ? -1.0f : 1.0f;
  float a = -1.0f / (side + n.z);
  float b = n.x * n.y * a;
  frame.tangent = vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x);
  frame.bitangent = vec3(b, side + n.y * n.y * a, -n.y);
  return frame;
}

inline vec3 to_frame(Frame frame, vec3 w) {
  return vec3(dot(w, frame.tangent), dot(w, frame.bitangent), dot(w, frame.normal));
}

inline vec3 from_frame(Frame frame, vec3 w) {
  return frame.tangent * w.x + frame.bitangent * w.y + frame.normal * w.z;
}

#ifdef __cplusplus
}  // namespace ods
#endif
