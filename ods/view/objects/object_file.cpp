// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/objects/object_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/image/image_file.h"
#include "ods/scene/gltf/glb_bytes.h"
#include "ods/scene/motion.h"

namespace ods {

namespace {

constexpr double kRates[] = {30.0, 15.0, 10.0};  // frames a second, about: the first that has few enough bytes
constexpr double kLongest = 10.0;                // seconds
constexpr size_t kMostBytes = size_t{64} << 20;
constexpr int kLargestTexture = 2048;
constexpr float kGlassAlpha = 0.25f;  // of clear glass

enum { kUintType = 5125, kFloatType = 5126 };          // component types of glTF
enum { kArrayBuffer = 34962, kElementArray = 34963 };  // targets

// The vertices of a mesh at one moment.
struct Shape {
  std::vector<vec3> positions, normals;
  bool operator==(const Shape&) const = default;
};

// An object at all of its moments.
struct Motion {
  size_t frames = 1;
  double rate = kRates[0];
  std::vector<std::vector<glm::mat4>> matrices;  // by instance, by frame; one if it rests
  std::map<int, std::vector<Shape>> shapes;      // by mesh, by frame; those that deform
};

struct Object {
  const Scene& scene;
  std::vector<size_t> instances;  // that the page draws
  Motion motion;
  Json json;
  std::string binary;
  std::map<int, size_t> meshes;                          // of the scene -> of the file
  std::map<std::pair<int, bool>, size_t> textures = {};  // by texture and whether it has alpha
};

Shape shape_of(const Scene& scene, int mesh) {
  Shape shape;
  const Mesh& from = scene.meshes[static_cast<size_t>(mesh)];
  for (uint i = from.first_vertex; i < from.first_vertex + from.vertex_count; i++) {
    shape.positions.push_back(scene.vertices[i].position);
    shape.normals.push_back(scene.vertices[i].normal);
  }
  return shape;
}

// A hidden instance is flattened to a point.
glm::mat4 matrix_of(const Scene& scene, size_t number) {
  const Instance& instance = scene.instances[number];
  glm::mat4 matrix = glm::transpose(glm::mat4(instance.row0, instance.row1, instance.row2, vec4(0, 0, 0, 1)));
  if (is_hidden(scene, number)) {
    for (int axis = 0; axis < 3; axis++) matrix[axis] = vec4(0.0f);
  }
  return matrix;
}

std::set<int> deforming_meshes(const Animation& animation) {
  std::set<int> meshes;
  for (const Deformation& deformation : animation.deformations) meshes.insert(deformation.mesh);
  return meshes;
}

// Sets the number of frames; returns why there is one only, although the scene moves.
std::string plan_frames(const Scene& scene, Motion& motion) {
  const double length = length_of(scene.animation);
  if (length <= 0.0) return "";
  if (length > kLongest) {
    return fmt::format("its animation has {:.0f} s, more than {:.0f}: it stands still", length, kLongest);
  }
  size_t bytes = scene.animation.instances.size() * sizeof(glm::mat4);
  for (const int mesh : deforming_meshes(scene.animation)) {
    bytes += scene.meshes[static_cast<size_t>(mesh)].vertex_count * 2 * sizeof(vec3);
  }
  for (const double rate : kRates) {
    const auto frames = static_cast<size_t>(std::max(std::lround(length * rate), 2L));
    motion.frames = frames;
    motion.rate = static_cast<double>(frames) / length;
    if (bytes * frames <= kMostBytes) return "";
  }
  const size_t needed = bytes * motion.frames >> 20;
  motion.frames = 1;
  return fmt::format("its animation needs {} MB, more than {}: it stands still", needed, kMostBytes >> 20);
}

// Leaves the scene at its first moment.
std::string sample_motion(Scene& scene, Motion& motion) {
  play(scene.animation, "");
  const std::string note = plan_frames(scene, motion);
  motion.matrices.resize(scene.instances.size());
  const std::set<int> deforming = motion.frames > 1 ? deforming_meshes(scene.animation) : std::set<int>();
  for (size_t frame = 0; frame < motion.frames; frame++) {
    set_time(scene, static_cast<double>(frame) / motion.rate);
    for (size_t i = 0; i < scene.instances.size(); i++) motion.matrices[i].push_back(matrix_of(scene, i));
    for (const int mesh : deforming) motion.shapes[mesh].push_back(shape_of(scene, mesh));
  }
  const auto rests = [](const auto& all) {
    return std::ranges::all_of(all, [&](const auto& one) { return one == all.front(); });
  };
  for (auto& matrices : motion.matrices) {
    if (rests(matrices)) matrices.resize(1);
  }
  std::erase_if(motion.shapes, [&](const auto& each) { return rests(each.second); });
  set_time(scene, 0.0);
  return note;
}

std::vector<size_t> drawn_instances(const Scene& scene, const Motion& motion) {
  std::vector<size_t> drawn;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const auto is_shown = [](const glm::mat4& matrix) { return matrix[0] != vec4(0.0f); };
    if (scene.instances[i].role == kOrdinary && std::ranges::any_of(motion.matrices[i], is_shown)) drawn.push_back(i);
  }
  return drawn;
}

void check_size(const Scene& scene, const std::vector<size_t>& instances, const std::string& path) {
  size_t triangles = 0;
  for (const size_t i : instances) {
    triangles += scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangle_count;
  }
  if (triangles == 0) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' has no triangles that could be shown as an object", path));
  }
  if (triangles > kMaxObjectTriangles) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is too large for an object: {} triangles, at most {}; simplify it",
                                               path, triangles, kMaxObjectTriangles));
  }
}

// --- the file

size_t add_to(Json& list, Json value) {
  list.push_back(std::move(value));
  return list.size() - 1;
}

size_t add_view(Object& object, const void* bytes, size_t size, int target = 0) {
  object.binary.resize((object.binary.size() + 3) / 4 * 4);
  Json view = {{"buffer", 0}, {"byteOffset", object.binary.size()}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  object.binary.append(static_cast<const char*>(bytes), size);
  return add_to(object.json["bufferViews"], view);
}

template <class T>
size_t add_accessor(Object& object, const std::vector<T>& values, const char* type, int component, int target) {
  const size_t view = add_view(object, values.data(), values.size() * sizeof(T), target);
  const size_t count = values.size() * sizeof(T) / (std::strcmp(type, "SCALAR") == 0 ? sizeof(uint) : sizeof(T));
  return add_to(object.json["accessors"],
                {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
}

// POSITION and NORMAL.
Json add_shape(Object& object, const Shape& shape) {
  Json attributes;
  attributes["POSITION"] = add_accessor(object, shape.positions, "VEC3", kFloatType, kArrayBuffer);
  attributes["NORMAL"] = add_accessor(object, shape.normals, "VEC3", kFloatType, kArrayBuffer);
  vec3 low = shape.positions.front(), high = low;
  for (const vec3& p : shape.positions) low = min(low, p), high = max(high, p);
  Json& accessor = object.json["accessors"][attributes["POSITION"].get<size_t>()];
  accessor["min"] = {low.x, low.y, low.z};
  accessor["max"] = {high.x, high.y, high.z};
  return attributes;
}

size_t add_uvs(Object& object, const Mesh& mesh, const TextureSlot& slot) {
  std::vector<vec2> uvs;
  for (uint i = mesh.first_vertex; i < mesh.first_vertex + mesh.vertex_count; i++) {
    const Vertex& vertex = object.scene.vertices[i];
    const vec2 uv = slot.uv_set == 0 ? vertex.uv0 : vertex.uv1;
    uvs.push_back(slot.offset + slot.axis_u * uv.x + slot.axis_v * uv.y);
  }
  return add_accessor(object, uvs, "VEC2", kFloatType, kArrayBuffer);
}

vec4 code_values(const Scene& scene, const Texture& texture, int x, int y) {
  const size_t at = static_cast<size_t>(y) * static_cast<size_t>(texture.width) + static_cast<size_t>(x);
  const uint bits = scene.texels[texture.first_texel + at];
  return vec4(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u, bits >> 24) / 255.0f;
}

// The mean code value of a texture, 0..1; 1 without a texture.
vec4 mean_of_slot(const Scene& scene, const TextureSlot& slot) {
  if (slot.texture < 0) return vec4(1.0f);
  const Texture& texture = scene.textures[static_cast<size_t>(slot.texture)];
  glm::dvec4 sum(0.0);
  for (int y = 0; y < texture.height; y++) {
    for (int x = 0; x < texture.width; x++) sum += glm::dvec4(code_values(scene, texture, x, y));
  }
  return vec4(sum / (double{1.0} * texture.width * texture.height));
}

vec4 mean_color(const Scene& scene, const Mesh& mesh) {
  glm::dvec4 sum(0.0);
  for (uint i = mesh.first_vertex; i < mesh.first_vertex + mesh.vertex_count; i++) {
    sum += glm::dvec4(scene.vertices[i].color);
  }
  return vec4(sum / static_cast<double>(mesh.vertex_count));
}

// Reduced by whole numbers until it is small enough.
std::string encoded_texture(const Scene& scene, const Texture& texture, bool alpha) {
  const int divide = (std::max(texture.width, texture.height) + kLargestTexture - 1) / kLargestTexture;
  FileHeader header;
  header.format = alpha ? FileFormat::kPng : FileFormat::kJpeg;
  header.width = std::max(texture.width / divide, 1), header.height = std::max(texture.height / divide, 1);
  header.quality = 92;
  header.channels = {{"R"}, {"G"}, {"B"}};
  if (alpha) header.channels.push_back({"A"});
  const size_t channels = header.channels.size();
  return image_bytes("a texture", header, [&](int y, std::span<float> row) {
    for (int x = 0; x < header.width; x++) {
      vec4 sum(0.0f);
      for (int i = 0; i < divide * divide; i++) {
        sum += code_values(scene, texture, std::min(x * divide + i % divide, texture.width - 1),
                           std::min(y * divide + i / divide, texture.height - 1));
      }
      for (size_t c = 0; c < channels; c++) {
        row[static_cast<size_t>(x) * channels + c] = sum[static_cast<int>(c)] / static_cast<float>(divide * divide);
      }
    }
  });
}

int gltf_wrap(int wrap) {
  return wrap == kWrapRepeat ? 10497 : wrap == kWrapMirror ? 33648 : 33071;
}

size_t add_texture(Object& object, int number, bool alpha) {
  const auto [found, is_new] = object.textures.try_emplace({number, alpha}, 0);
  if (!is_new) return found->second;
  const Texture& texture = object.scene.textures[static_cast<size_t>(number)];
  const std::string bytes = encoded_texture(object.scene, texture, alpha);
  const size_t image = add_to(object.json["images"], {{"bufferView", add_view(object, bytes.data(), bytes.size())},
                                                      {"mimeType", alpha ? "image/png" : "image/jpeg"}});
  const bool nearest = texture.nearest == 1;
  const size_t sampler = add_to(object.json["samplers"], {{"magFilter", nearest ? 9728 : 9729},
                                                          {"minFilter", nearest ? 9728 : 9987},
                                                          {"wrapS", gltf_wrap(texture.wrap_u)},
                                                          {"wrapT", gltf_wrap(texture.wrap_v)}});
  return found->second = add_to(object.json["textures"], {{"source", image}, {"sampler", sampler}});
}

Json color_of(vec4 color) {
  color = clamp(color, vec4(0.0f), vec4(1.0f));
  return {color.x, color.y, color.z, color.w};
}

size_t add_material(Object& object, const Mesh& mesh) {
  const Scene& scene = object.scene;
  const Material& from = scene.materials[static_cast<size_t>(mesh.material)];
  const vec4 rough = mean_of_slot(scene, from.metallic_roughness_slot);
  const vec3 glow = from.emission * vec3(mean_of_slot(scene, from.emission_slot));
  vec4 color = from.base_color * mean_color(scene, mesh);
  const bool is_glass = from.transmission > 0.0f && from.alpha_mode == kAlphaOpaque;
  if (is_glass) color.w = glm::mix(1.0f, kGlassAlpha, std::min(from.transmission, 1.0f));
  Json surface = {{"baseColorFactor", color_of(color)},
                  {"metallicFactor", from.metallic * rough.z},
                  {"roughnessFactor", from.roughness * rough.y}};
  if (from.base_color_slot.texture >= 0) {
    const bool alpha = from.alpha_mode != kAlphaOpaque;
    surface["baseColorTexture"] = {{"index", add_texture(object, from.base_color_slot.texture, alpha)}};
  }
  Json material = {{"pbrMetallicRoughness", surface},
                   {"emissiveFactor", {glow.x, glow.y, glow.z}},
                   {"doubleSided", from.double_sided == 1}};
  if (from.alpha_mode == kAlphaMask) material["alphaMode"] = "MASK", material["alphaCutoff"] = from.alpha_cutoff;
  if (from.alpha_mode == kAlphaBlend || is_glass) material["alphaMode"] = "BLEND";
  return add_to(object.json["materials"], material);
}

// Returns the number of the mesh in the file.
size_t add_mesh_of(Object& object, int number) {
  const auto [found, is_new] = object.meshes.try_emplace(number, 0);
  if (!is_new) return found->second;
  const Scene& scene = object.scene;
  const Mesh& mesh = scene.meshes[static_cast<size_t>(number)];
  Json primitive;
  const auto moving = object.motion.shapes.find(number);
  if (moving == object.motion.shapes.end()) {
    primitive["attributes"] = add_shape(object, shape_of(scene, number));
  } else {
    for (const Shape& shape : moving->second) {
      primitive["extras"]["omnistereo"]["frames"].push_back(add_shape(object, shape));
    }
    primitive["attributes"] = primitive["extras"]["omnistereo"]["frames"][0];
  }
  const TextureSlot& slot = scene.materials[static_cast<size_t>(mesh.material)].base_color_slot;
  if (slot.texture >= 0) primitive["attributes"]["TEXCOORD_0"] = add_uvs(object, mesh, slot);
  const auto first = scene.triangles.begin() + mesh.first_triangle;
  primitive["indices"] =
      add_accessor(object, std::vector<uvec3>(first, first + mesh.triangle_count), "SCALAR", kUintType, kElementArray);
  primitive["material"] = add_material(object, mesh);
  return found->second = add_to(object.json["meshes"], {{"primitives", {primitive}}});
}

Json numbers_of(const glm::mat4& matrix) {
  Json numbers;
  for (int i = 0; i < 16; i++) numbers.push_back(matrix[i / 4][i % 4]);
  return numbers;
}

void add_node(Object& object, size_t instance) {
  const std::vector<glm::mat4>& matrices = object.motion.matrices[instance];
  Json node = {{"mesh", add_mesh_of(object, object.scene.instances[instance].mesh)},
               {"matrix", numbers_of(matrices.front())}};
  if (matrices.size() > 1) {
    node["extras"]["omnistereo"]["matrices"] = add_accessor(object, matrices, "MAT4", kFloatType, 0);
  }
  object.json["scenes"][0]["nodes"].push_back(add_to(object.json["nodes"], node));
}

}  // namespace

ObjectFile make_object_file(Scene scene, const std::string& path) {
  Motion motion;
  std::string note = sample_motion(scene, motion);
  if (!note.empty()) note = fmt::format("'{}': {}", path, note);
  const std::vector<size_t> instances = drawn_instances(scene, motion);
  check_size(scene, instances, path);
  Object object{scene, instances, std::move(motion), {}, "", {}};
  object.json["asset"] = {{"version", "2.0"}, {"generator", "ods " ODS_VERSION}};
  object.json["asset"]["extras"]["omnistereo"] = {
      {"object", 1}, {"frames", object.motion.frames}, {"rate", object.motion.rate}};
  object.json["scene"] = 0;
  object.json["scenes"] = {{{"nodes", Json::array()}}};
  for (const size_t i : instances) add_node(object, i);
  object.json["buffers"] = {{{"byteLength", object.binary.size()}}};
  return {glb_bytes(json_document(object.json), object.binary, path, "simplify the object"), note};
}

}  // namespace ods
