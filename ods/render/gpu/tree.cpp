// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/tree.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>

#include "ods/scene/doubled_faces.h"

namespace ods {
namespace {

constexpr int kBins = 16;
constexpr size_t kMaxInLeaf = 8;
constexpr size_t kWorthATask = 4096;  // triangles
constexpr int kHalvesFrom = 32;       // the depth from which nodes are halved, so that kTreeDepth suffices

struct Box {
  vec3 low{std::numeric_limits<float>::max()};
  vec3 high{std::numeric_limits<float>::lowest()};

  void add(vec3 point) { low = min(low, point), high = max(high, point); }
  void add(const Box& box) { low = min(low, box.low), high = max(high, box.high); }
  vec3 middle() const { return 0.5f * low + 0.5f * high; }
  float area() const {
    const vec3 size = max(high - low, vec3(0.0f));
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

Box box_of(const TreeTriangle& triangle) {
  Box box;
  box.add(triangle.a), box.add(triangle.b), box.add(triangle.c);
  return box;
}

struct Bin {
  Box box;
  size_t count = 0;
};

struct Builder {
  const std::vector<Box>& boxes;  // by triangle
  std::vector<uint32_t>& order;   // triangles; each node owns a range of it
  std::vector<TreeNode>& nodes;
  std::atomic<int> used{1};

  Box around(size_t begin, size_t end) const {
    Box box;
    for (size_t i = begin; i < end; i++) box.add(boxes[order[i]]);
    return box;
  }

  // Divides a range in two, each with at least one triangle, and returns where the second starts.
  size_t split(size_t begin, size_t end, int depth) const {
    Box middles;
    for (size_t i = begin; i < end; i++) middles.add(boxes[order[i]].middle());
    const vec3 size = middles.high - middles.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const float low = middles.low[axis], scale = static_cast<float>(kBins) * 0.9999f / size[axis];
    const auto bin_of = [&](uint32_t i) {
      return std::clamp(static_cast<int>((boxes[i].middle()[axis] - low) * scale), 0, kBins - 1);
    };
    const auto halve = [&] {
      const size_t half = (begin + end) / 2;
      std::nth_element(order.begin() + static_cast<ptrdiff_t>(begin), order.begin() + static_cast<ptrdiff_t>(half),
                       order.begin() + static_cast<ptrdiff_t>(end),
                       [&](uint32_t a, uint32_t b) { return boxes[a].middle()[axis] < boxes[b].middle()[axis]; });
      return half;
    };
    if (depth >= kHalvesFrom || !(size[axis] > 0.0f) || !(scale < std::numeric_limits<float>::max())) return halve();
    std::array<Bin, kBins> bins;
    for (size_t i = begin; i < end; i++) {
      Bin& bin = bins[static_cast<size_t>(bin_of(order[i]))];
      bin.box.add(boxes[order[i]]);
      bin.count++;
    }
    std::array<float, kBins> above;  // cost of the bins from each one on
    Box box;
    size_t count = 0;
    for (size_t i = kBins - 1; i > 0; i--) {
      box.add(bins[i].box);
      count += bins[i].count;
      above[i] = count > 0 ? box.area() * static_cast<float>(count) : 0.0f;
    }
    int best = 0;
    float best_cost = std::numeric_limits<float>::max();
    box = {};
    count = 0;
    for (int i = 1; i < kBins; i++) {
      box.add(bins[static_cast<size_t>(i - 1)].box);
      count += bins[static_cast<size_t>(i - 1)].count;
      if (count == 0 || count == end - begin) continue;
      const float cost = box.area() * static_cast<float>(count) + above[static_cast<size_t>(i)];
      if (cost < best_cost) best = i, best_cost = cost;
    }
    if (best == 0) return halve();
    const auto middle =
        std::partition(order.begin() + static_cast<ptrdiff_t>(begin), order.begin() + static_cast<ptrdiff_t>(end),
                       [&](uint32_t i) { return bin_of(i) < best; });
    return static_cast<size_t>(middle - order.begin());
  }

  // Returns whether splitting a range costs more than testing all its triangles.
  bool is_leaf(size_t begin, size_t end) const {
    return end - begin <= 2 || (end - begin <= kMaxInLeaf && flat(begin, end));
  }

  // Returns whether the boxes of a range overlap so much that a split gains nothing.
  bool flat(size_t begin, size_t end) const {
    float sum = 0.0f;
    for (size_t i = begin; i < end; i++) sum += boxes[order[i]].area();
    return sum > around(begin, end).area() * static_cast<float>(end - begin) * 0.5f;
  }

  // Makes a node of a range of at least two triangles.
  void build(size_t node_index, size_t begin, size_t end, int depth) {
    const size_t middle = split(begin, end, depth);
    const Box a = around(begin, middle), b = around(middle, end);
    TreeNode& node = nodes[node_index];
    node.low_a = a.low, node.high_a = a.high, node.low_b = b.low, node.high_b = b.high;
    const auto place = [&](size_t from, size_t to, int& first, int& count) {
      const bool leaf = is_leaf(from, to);
      first = leaf ? static_cast<int>(from) : used++;
      count = leaf ? static_cast<int>(to - from) : 0;
      return !leaf;
    };
    const bool build_a = place(begin, middle, node.first_a, node.count_a);
    const bool build_b = place(middle, end, node.first_b, node.count_b);
    const auto first = [&] {
      if (build_a) build(static_cast<size_t>(node.first_a), begin, middle, depth + 1);
    };
    const auto second = [&] {
      if (build_b) build(static_cast<size_t>(node.first_b), middle, end, depth + 1);
    };
    if (end - begin >= kWorthATask) {
      tbb::parallel_invoke(first, second);
    } else {
      first();
      second();
    }
  }
};

// TreeTriangle::decides, but for doubled faces.
int decides(const Material& material, const Instance& instance) {
  const int all = material.alpha_mode != kAlphaOpaque || has_absences(instance) ? kDecidesAll : 0;
  return all + (material.transmission > 0.0f ? kDecidesShadow : 0);
}

std::vector<TreeTriangle> world_triangles(const Scene& scene) {
  std::vector<TreeTriangle> triangles;
  triangles.reserve(triangles_in_tree(scene) + 2);
  const std::vector<std::vector<char>> doubled = find_doubled_faces(scene);
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (is_hidden(scene, i)) continue;
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    const int decided = decides(scene.materials[static_cast<size_t>(mesh.material)], instance);
    const std::vector<char>& twice = doubled[static_cast<size_t>(instance.mesh)];
    const int one_sided = handedness_of(instance) > 0.0f ? kHasNoBack : kHasNoFront;
    const Vertex* vertices = scene.vertices.data() + mesh.first_vertex;
    for (uint t = 0; t < mesh.triangle_count; t++) {
      const uvec3 corners = scene.triangles[mesh.first_triangle + t];
      const auto corner = [&](uint c) { return to_world(instance, vertices[c].position); };
      const int sides = !twice.empty() && twice[t] ? one_sided : 0;
      triangles.push_back({corner(corners.x), static_cast<int>(i), corner(corners.y), static_cast<int>(t),
                           corner(corners.z), decided + sides});
    }
  }
  return triangles;
}

}  // namespace

size_t triangles_in_tree(const Scene& scene) {
  size_t count = 0;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (!is_hidden(scene, i)) count += scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangle_count;
  }
  return count;
}

SceneTree make_tree(const Scene& scene) {
  SceneTree tree;
  tree.triangles = world_triangles(scene);
  // The root needs two triangles. Those without an area are never hit.
  while (tree.triangles.size() < 2) tree.triangles.push_back({vec3(0.0f), -1, vec3(0.0f), -1, vec3(0.0f), 0});
  const size_t count = tree.triangles.size();
  std::vector<Box> boxes(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) { boxes[i] = box_of(tree.triangles[i]); });
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  tree.nodes.resize(count);
  Builder builder{boxes, order, tree.nodes};
  builder.build(0, 0, count, 0);
  tree.nodes.resize(static_cast<size_t>(builder.used));
  std::vector<TreeTriangle> sorted(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) { sorted[i] = tree.triangles[order[i]]; });
  tree.triangles = std::move(sorted);
  return tree;
}

}  // namespace ods
