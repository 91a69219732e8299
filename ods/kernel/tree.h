// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A tree of bounding boxes over the scene's triangles, for devices without a ray tracer of their own. The host builds
// it (ods/render/gpu/tree.h). Each node has the boxes of its two children. Triangles are in the world, and their
// corners are shared bit by bit with their neighbours.
//
// No ray passes between adjacent triangles: the triangle test computes each edge from its two corners only, so both
// sides of an edge decide alike, and boxes are a little larger than they are. Rays descend to a leaf before they test
// triangles, so that the threads of a graphics card do the same at the same time (Aila, Laine, "Understanding the
// Efficiency of Ray Traversal on GPUs", 2009). Source: Davidovic et al., "3D
// Rasterization: A Bridge between Rasterization and Ray Casting", 2012; Ize, "Robust BVH Ray Traversal", 2013.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/path.h"
namespace ods {
#endif

// A child of a node as one number: a node's index, or a leaf as a negative number.
const int kNoChild = 2147483647;

inline int child_of(int first, int count) {
  return count > 0 ? -(first * 16 + count) : first;
}

inline int first_in_leaf(int child) {
  return -child / 16;
}

inline int count_in_leaf(int child) {
  return -child % 16;
}

// The result of following a ray with an end.
struct Passage {
  bool blocked;
  int clear;  // for a shadow ray: surfaces of clear glass that it met before something blocked it
};

// The distances at which a ray enters and leaves a box; it misses if enter > leave.
struct BoxHit {
  float enter;
  float leave;
};

inline BoxHit meet_box(vec3 low, vec3 high, Ray ray, vec3 inverse, float farthest) {
  vec3 a = (low - ray.origin) * inverse;
  vec3 b = (high - ray.origin) * inverse;
  vec3 near_sides = min(a, b);
  vec3 far_sides = max(a, b);
  BoxHit found;
  found.enter = max(max(near_sides.x, near_sides.y), max(near_sides.z, 0.0f));
  found.leave = min(min(min(far_sides.x, far_sides.y), far_sides.z) * 1.0000004f, farthest);
  return found;
}

// The inverse of a ray's direction without infinities: 0 times infinity would lose a box.
inline float inverse_of(float x) {
  float size = max(abs(x), 1e-18f);
  return x < 0.0f ? -1.0f / size : 1.0f / size;
}

// Intersects a ray with a triangle up to the distance `farthest`; t is negative if the ray misses.
inline Hit meet_triangle(TreeTriangle triangle, Ray ray, float farthest) {
  Hit hit;
  hit.t = -1.0f;
  hit.instance = triangle.instance;
  hit.triangle = triangle.triangle;
  vec3 a = triangle.a - ray.origin;
  vec3 b = triangle.b - ray.origin;
  vec3 c = triangle.c - ray.origin;
  vec3 ca = c - a;
  vec3 ab = a - b;
  vec3 bc = b - c;
  float u = dot(cross(ca, c + a), ray.direction);
  float v = dot(cross(ab, a + b), ray.direction);
  float w = dot(cross(bc, b + c), ray.direction);
  float sum = u + v + w;
  float slack = abs(sum) * 1.1920929e-7f;
  bool inside = min(u, min(v, w)) >= -slack || max(u, max(v, w)) <= slack;
  vec3 normal = cross(ab, ca);
  float slope = dot(normal, ray.direction);
  if (!inside || slope == 0.0f || sum == 0.0f) return hit;
  float t = dot(normal, a) / slope;
  if (!(t >= 0.0f && t <= farthest)) return hit;
  hit.t = t;
  hit.u = clamp(u / sum, 0.0f, 1.0f);
  hit.v = clamp(v / sum, 0.0f, 1.0f);
  return hit;
}

#ifdef __cplusplus
struct TreeTracer : PathTracer {
  const TreeNode* tree_nodes = nullptr;
  const TreeTriangle* tree_triangles = nullptr;

  const TreeNode& scene_tree_node(int i) const { return tree_nodes[i]; }
  const TreeTriangle& scene_tree_triangle(int i) const { return tree_triangles[i]; }
#endif

  // Returns whether a hit lets this kind of ray of the path pass as if nothing were there.
  inline bool lets_pass(int kind, TreeTriangle triangle, Ray ray, Hit hit) {
    int decides = triangle.decides;
    if ((decides & (kHasNoBack | kHasNoFront)) != 0) {
      float along = dot(cross(triangle.b - triangle.a, triangle.c - triangle.a), ray.direction);
      if ((decides & kHasNoBack) != 0 ? along > 0.0f : along < 0.0f) return true;
    }
    return (decides & kDecidesAll) != 0 && (is_absent(kind, hit.instance) || passes(hit, alpha_draw(kind, hit)));
  }

  // The first hit along a ray of the path.
  inline Hit nearest_in_tree(Ray ray, int kind) {
    Hit nearest;
    nearest.t = -1.0f;
    nearest.u = 0.0f;
    nearest.v = 0.0f;
    nearest.instance = -1;
    nearest.triangle = -1;
    float farthest = kFarAway;
    vec3 inverse = vec3(inverse_of(ray.direction.x), inverse_of(ray.direction.y), inverse_of(ray.direction.z));
    int stack[kTreeDepth];
    int depth = 0;
    int at = 0;
    while (at != kNoChild) {
      while (at >= 0 && at != kNoChild) {
        TreeNode node = scene_tree_node(at);
        BoxHit a = meet_box(node.low_a, node.high_a, ray, inverse, farthest);
        BoxHit b = meet_box(node.low_b, node.high_b, ray, inverse, farthest);
        int nearer = a.enter <= a.leave ? child_of(node.first_a, node.count_a) : kNoChild;
        int other = b.enter <= b.leave ? child_of(node.first_b, node.count_b) : kNoChild;
        if (nearer == kNoChild || (other != kNoChild && b.enter < a.enter)) {
          int swapped = nearer;
          nearer = other;
          other = swapped;
        }
        if (other != kNoChild) {
          stack[depth] = other;
          depth += 1;
        }
        at = nearer;
        if (at == kNoChild && depth > 0) {
          depth -= 1;
          at = stack[depth];
        }
      }
      while (at < 0) {
        int first = first_in_leaf(at);
        int count = count_in_leaf(at);
        for (int i = 0; i < count; i++) {
          TreeTriangle triangle = scene_tree_triangle(first + i);
          Hit hit = meet_triangle(triangle, ray, farthest);
          if (hit.t < 0.0f || (hit.t == farthest && nearest.t >= 0.0f)) continue;
          if (lets_pass(kind, triangle, ray, hit)) continue;
          nearest = hit;
          farthest = hit.t;
        }
        at = kNoChild;
        if (depth > 0) {
          depth -= 1;
          at = stack[depth];
        }
      }
    }
    return nearest;
  }

  // Follows a ray of the path up to a distance. Clear glass does not block shadow rays.
  inline Passage along_tree(Ray ray, float distance, int kind) {
    Passage passage;
    passage.blocked = false;
    passage.clear = 0;
    vec3 inverse = vec3(inverse_of(ray.direction.x), inverse_of(ray.direction.y), inverse_of(ray.direction.z));
    int stack[kTreeDepth];
    int depth = 0;
    int at = 0;
    while (at != kNoChild) {
      while (at >= 0 && at != kNoChild) {
        TreeNode node = scene_tree_node(at);
        BoxHit a = meet_box(node.low_a, node.high_a, ray, inverse, distance);
        BoxHit b = meet_box(node.low_b, node.high_b, ray, inverse, distance);
        int other = b.enter <= b.leave ? child_of(node.first_b, node.count_b) : kNoChild;
        at = a.enter <= a.leave ? child_of(node.first_a, node.count_a) : kNoChild;
        if (at == kNoChild) {
          at = other;
          other = kNoChild;
        }
        if (other != kNoChild) {
          stack[depth] = other;
          depth += 1;
        }
        if (at == kNoChild && depth > 0) {
          depth -= 1;
          at = stack[depth];
        }
      }
      while (at < 0) {
        int first = first_in_leaf(at);
        int count = count_in_leaf(at);
        for (int i = 0; i < count && !passage.blocked; i++) {
          TreeTriangle triangle = scene_tree_triangle(first + i);
          Hit hit = meet_triangle(triangle, ray, distance);
          if (hit.t < 0.0f || lets_pass(kind, triangle, ray, hit)) continue;
          if (kind == kShadowRay && (triangle.decides & kDecidesShadow) != 0 && is_clear(hit, true)) {
            passage.clear += 1;
          } else {
            passage.blocked = true;
          }
        }
        at = kNoChild;
        if (depth > 0 && !passage.blocked) {
          depth -= 1;
          at = stack[depth];
        }
      }
    }
    return passage;
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
