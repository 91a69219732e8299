// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Animated glTF files, made in memory.
#pragma once
#include <cmath>

#include "tests/support/gltf_builder.h"

namespace ods {

// Adds a channel to animation 0.
inline void animate(GltfBuilder& file, const GltfJson& target, const std::vector<float>& times,
                    const std::vector<float>& values, const std::string& type,
                    const std::string& interpolation = "LINEAR") {
  GltfJson& animation = file.json["animations"][0];
  const size_t index = animation["samplers"].size();
  animation["samplers"].push_back({{"input", file.add<float>(times, kFloat, "SCALAR")},
                                   {"output", file.add<float>(values, kFloat, type)},
                                   {"interpolation", interpolation}});
  animation["channels"].push_back({{"sampler", index}, {"target", target}});
}

inline GltfJson node_target(int node, const std::string& path) {
  return {{"node", node}, {"path", path}};
}

inline GltfJson pointer(const std::string& path) {
  return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", path}}}}}};
}

// A strip whose far end is attached to a turning joint, and whose middle to both joints.
inline GltfBuilder make_skinned(bool second_set) {
  GltfBuilder file = make_triangle();
  file.json["nodes"] = GltfJson::parse(R"([{"mesh": 0, "skin": 0, "translation": [9, 9, 9]}, {"children": [2]},
                                       {"translation": [1, 0, 0]}])");
  file.json["scenes"][0]["nodes"] = {0, 1};
  file.primitive()["attributes"]["POSITION"] = file.add<float>({0, 0, 0, 1, 0.5f, 0, 2, 0, 0}, kFloat, "VEC3");
  file.primitive()["attributes"]["NORMAL"] = file.add<float>({0, 0, 1, 0, 0, 1, 0, 1, 0}, kFloat, "VEC3");
  const std::string set = second_set ? "_1" : "_0";
  if (second_set) {
    file.primitive()["attributes"]["JOINTS_0"] =
        file.add<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kUbyte, "VEC4");
    file.primitive()["attributes"]["WEIGHTS_0"] = file.add<float>({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kFloat, "VEC4");
  }
  file.primitive()["attributes"]["JOINTS" + set] =
      file.add<uint16_t>({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, kUshort, "VEC4");
  file.primitive()["attributes"]["WEIGHTS" + set] =
      file.add<float>({second_set ? 0.0f : 1.0f, 0, 0, 0, 0.25f, 0.75f, 0, 0, 1, 0, 0, 0}, kFloat, "VEC4");
  const int matrices = file.add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                                       kFloat, "MAT4");
  file.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
  const float s = std::sqrt(0.5f);
  animate(file, node_target(2, "rotation"), {0, 2}, {0, 0, 0, 1, 0, 0, s, s}, "VEC4");
  return file;
}

inline GltfBuilder make_morphed() {
  GltfBuilder file = make_triangle();
  file.primitive()["attributes"]["NORMAL"] = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3");
  const int up = file.add<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}, kFloat, "VEC3");
  const int tilt = file.add<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}, kFloat, "VEC3");
  file.json["accessors"].push_back(
      {{"componentType", kFloat},
       {"count", 3},
       {"type", "VEC3"},
       {"sparse",
        {{"count", 1},
         {"indices", {{"bufferView", file.add_view({2, 0, 0, 0})}, {"componentType", kUshort}}},
         {"values", {{"bufferView", file.json["accessors"][size_t(up)]["bufferView"]}}}}}});
  const int corner = static_cast<int>(file.json["accessors"].size()) - 1;
  file.primitive()["targets"] = {{{"POSITION", up}, {"NORMAL", tilt}}, {{"POSITION", corner}}};
  file.json["meshes"][0]["weights"] = {0.5, 0.0};
  animate(file, node_target(0, "weights"), {0, 1}, {0, 0, 2, 4}, "SCALAR");
  return file;
}

}  // namespace ods
