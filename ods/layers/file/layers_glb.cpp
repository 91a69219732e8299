// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/angles.h"
#include "ods/layers/file/film_glb.h"
#include "ods/layers/file/glb_draft.h"
#include "ods/layers/file/layer_parts.h"
#include "ods/layers/file/layers_info.h"
#include "ods/scene/gltf/glb_bytes.h"

namespace ods {

namespace {

void add_material(Glb& glb, const LayerPart& part) {
  Json material = unlit_material(part.name, add_texture(glb, part.name, part.format, part.texture));
  if (part.mesh->kind == LayerKind::kMasked) material["alphaMode"] = "MASK", material["alphaCutoff"] = 0.5;
  if (part.mesh->kind == LayerKind::kBlended) material["alphaMode"] = "BLEND";
  if (part.change.exists()) {
    const ChangePlace& at = part.change;
    material["extras"]["omnistereo"]["change"] = {at.scale.x, at.scale.y, at.offset.x, at.offset.y,
                                                  at.low.x,   at.low.y,   at.high.x,   at.high.y};
  }
  glb.json["materials"].push_back(material);
}

// The mesh, its material of the same number, and its node.
void add_part(Glb& glb, const LayeredScene& scene, const LayerPart& part) {
  const LayerMesh& mesh = *part.mesh;
  const MeshOrder order = order_of(mesh);
  std::vector<vec3> positions;
  std::vector<vec2> uvs;
  for (const uint vertex : order.vertices) {
    positions.push_back(stored_position(scene, mesh, vertex));
    uvs.push_back(mesh.uvs[vertex]);
  }
  Json primitive;
  primitive["attributes"]["POSITION"] =
      add_positions(glb, positions, [&](size_t vertex) { return rounding_step(scene, mesh, positions[vertex]); });
  primitive["attributes"]["TEXCOORD_0"] = add_uvs(glb, uvs);
  primitive["indices"] = add_indices(glb, order);
  primitive["material"] = glb.json["materials"].size();
  add_material(glb, part);
  Json node = {{"name", part.name}, {"mesh", glb.json["meshes"].size()}};
  glb.json["meshes"].push_back({{"name", part.name}, {"primitives", {primitive}}});
  if (mesh.kind == LayerKind::kSky) {
    const float scale = sky_scale(scene);
    node["scale"] = {scale, scale, scale};
    node["extras"]["omnistereo"]["sky"] = true;
  }
  glb.json["nodes"].push_back(node);
}

// Returns the number of the buffer view with the light of the probes; none if there are no probes.
std::optional<size_t> add_probes(Glb& glb, const LightProbes& probes) {
  if (probes.probes.empty()) return {};
  static_assert(sizeof(LightProbe) == 28 * sizeof(float));
  return add_bytes(glb, bytes_of(probes.probes));
}

void add_camera(Glb& glb, const LayeredScene& scene) {
  constexpr double kFieldOfView = 70.0 * kDegree, kNear = 0.02;
  glb.json["cameras"] = {
      {{"name", "middle of the box"},
       {"type", "perspective"},
       {"perspective", {{"yfov", kFieldOfView}, {"znear", kNear}, {"zfar", 2.0f * farthest(scene)}}}}};
  const double half = -0.5 * scene.yaw * kDegree;  // glTF turns to the left
  glb.json["nodes"].push_back(
      {{"name", "middle of the box"}, {"camera", 0}, {"rotation", {0.0, std::sin(half), 0.0, std::cos(half)}}});
}

void add_extensions(Glb& glb, const std::vector<LayerPart>& parts, const FilmTextures& film) {
  Json used = {kUnlit}, required = Json::array();
  if (!glb.plain) required.push_back(kMeshopt);
  const auto is_webp = [](const auto& part) { return part.format == FileFormat::kWebp; };
  if (std::ranges::any_of(parts, is_webp) || std::ranges::any_of(film.moving, is_webp)) {
    required.push_back(kWebpTexture);
  }
  used.insert(used.end(), required.begin(), required.end());
  glb.json["extensionsUsed"] = used;
  if (!required.empty()) glb.json["extensionsRequired"] = required;
}

}  // namespace

std::string layers_glb(const LayeredScene& scene, const std::vector<LayerPart>& parts, const FilmTextures& film,
                       bool plain, const std::string& path) {
  Json json;
  Glb glb{plain, json, {}, 0};
  glb.json["asset"] = {{"version", "2.0"}, {"generator", "ods " ODS_VERSION}};
  add_extensions(glb, parts, film);
  glb.json["scene"] = 0;
  glb.json["scenes"] = {{{"name", "layers"}, {"nodes", {0}}}};
  const vec3 center = scene.box.center;
  glb.json["nodes"] = {{{"name", "layers"}, {"translation", {center.x, center.y, center.z}}}};
  for (const LayerPart& part : parts) add_part(glb, scene, part);
  const std::vector<size_t> changes = add_film(glb, scene, film);
  Json& about = glb.json["asset"]["extras"]["omnistereo"] = layers_metadata(scene, add_probes(glb, scene.light.probes));
  if (!changes.empty()) about["film"]["changes"] = changes;
  add_camera(glb, scene);
  for (size_t i = 1; i < glb.json["nodes"].size(); i++) glb.json["nodes"][0]["children"].push_back(i);
  if (!parts.empty() || !film.moving.empty()) {
    glb.json["samplers"] = {{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}}};
  }
  if (!glb.binary.empty()) glb.json["buffers"] = {{{"byteLength", glb.binary.size()}}};
  if (glb.unpacked > 0) {
    Json fallback = {{"byteLength", glb.unpacked}};
    fallback["extensions"][kMeshopt] = {{"fallback", true}};
    glb.json["buffers"].push_back(fallback);
  }
  return glb_bytes(json_document(glb.json), glb.binary, path, "a lower `quality` or width needs less");
}

}  // namespace ods
