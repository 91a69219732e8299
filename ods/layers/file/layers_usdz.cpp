// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sources: the USDZ file format specification; UsdPreviewSurface; UsdGeomMesh and UsdGeomCamera. three.js parses the
// text by lines: each bracket of a prim ends its line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ods/base/angles.h"
#include "ods/base/decimal.h"
#include "ods/files/stored_zip.h"
#include "ods/layers/file/layer_parts.h"
#include "ods/scene/gltf/meshopt.h"

namespace ods {

namespace {

// A name in the text and in the archive: "page_0".
std::string identifier(std::string name) {
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::string texture_path(const LayerPart& part) {
  return fmt::format("textures/{}.{}", identifier(part.name), part.format == FileFormat::kPng ? "png" : "jpg");
}

// Appends a number with at most this many decimals.
void append_decimal(std::string& text, float value, int decimals) {
  const size_t start = text.size();
  fmt::format_to(std::back_inserter(text), "{:.{}f}", value, decimals);
  if (decimals > 0) text.resize(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  if (text.compare(start, std::string::npos, "-0") == 0) text.erase(start, 1);
}

// Appends "(x,y,z)", or "(u,v)".
template <class Vector>
void append_tuple(std::string& text, const Vector& vector, int decimals) {
  for (int k = 0; k < Vector::length(); k++) {
    text += k == 0 ? '(' : ',';
    append_decimal(text, vector[k], decimals);
  }
  text += ')';
}

std::string tuple_of(const vec3& v) {
  return fmt::format("({}, {}, {})", decimal(v.x), decimal(v.y), decimal(v.z));
}

// Appends a list; append_one(i) appends an element.
template <class Append>
void append_list(std::string& text, const char* name, size_t count, const Append& append_one) {
  text += fmt::format("        {} = [", name);
  for (size_t i = 0; i < count; i++) {
    if (i > 0) text += ',';
    append_one(i);
  }
  text += "]";
}

void append_mesh(std::string& text, const LayeredScene& scene, const LayerPart& part) {
  constexpr int kUvDecimals = 5;  // a fiftieth of a texel of 2048
  const LayerMesh& mesh = *part.mesh;
  const MeshOrder order = order_of(mesh);
  vec3 low(INFINITY), high(-INFINITY);
  for (const uint vertex : order.vertices) {
    low = min(low, stored_position(scene, mesh, vertex)), high = max(high, stored_position(scene, mesh, vertex));
  }
  text += fmt::format("\n    def Mesh \"{}\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {{\n",
                      identifier(part.name));
  text += "        uniform bool doubleSided = 0\n";
  text += fmt::format("        float3[] extent = [{}, {}]\n", tuple_of(low), tuple_of(high));
  append_list(text, "int[] faceVertexCounts", order.corners.size() / 3, [&](size_t) { text += '3'; });
  text += '\n';
  append_list(text, "int[] faceVertexIndices", order.corners.size(),
              [&](size_t i) { fmt::format_to(std::back_inserter(text), "{}", order.corners[i]); });
  text += fmt::format("\n        rel material:binding = </layers/materials/{}>\n", identifier(part.name));
  append_list(text, "point3f[] points", order.vertices.size(), [&](size_t i) {
    const vec3 position = stored_position(scene, mesh, order.vertices[i]);
    const float digits = std::ceil(-std::log10(rounding_step(scene, mesh, position)));
    append_tuple(text, position, std::clamp(static_cast<int>(digits), 0, 9));
  });
  text += '\n';
  append_list(text, "texCoord2f[] primvars:st", order.vertices.size(), [&](size_t i) {
    const vec2 uv = mesh.uvs[order.vertices[i]];
    append_tuple(text, vec2(uv.x, 1.0f - uv.y), kUvDecimals);
  });
  text += " (\n            interpolation = \"vertex\"\n        )\n";
  text += "        uniform token subdivisionScheme = \"none\"\n";
  if (mesh.kind == LayerKind::kSky) {
    const double scale = decimal(sky_scale(scene));
    text += fmt::format("        float3 xformOp:scale = ({0}, {0}, {0})\n", scale);
    text += "        uniform token[] xformOpOrder = [\"xformOp:scale\"]\n";
  }
  text += "    }\n";
}

// No light is reflected: the base is black, and nothing mirrors without refraction.
void append_material(std::string& text, const LayerPart& part) {
  const bool is_masked = part.mesh->kind == LayerKind::kMasked, has_opacity = has_alpha(part.mesh->kind);
  const std::string name = identifier(part.name), path = "/layers/materials/" + name;
  text += fmt::format("        def Material \"{}\"\n        {{\n", name);
  text += fmt::format("            token outputs:surface.connect = <{}/surface.outputs:surface>\n\n", path);
  text += "            def Shader \"surface\"\n            {\n";
  text += "                uniform token info:id = \"UsdPreviewSurface\"\n";
  text += "                color3f inputs:diffuseColor = (0, 0, 0)\n";
  text += fmt::format("                color3f inputs:emissiveColor.connect = <{}/texture.outputs:rgb>\n", path);
  text += "                float inputs:ior = 1\n                float inputs:metallic = 0\n";
  if (has_opacity) text += fmt::format("                float inputs:opacity.connect = <{}/texture.outputs:a>\n", path);
  if (is_masked) text += "                float inputs:opacityThreshold = 0.5\n";
  text += "                float inputs:roughness = 1\n                token outputs:surface\n            }\n\n";
  text += "            def Shader \"texture\"\n            {\n";
  text += "                uniform token info:id = \"UsdUVTexture\"\n";
  text += fmt::format("                asset inputs:file = @{}@\n", texture_path(part));
  text += "                token inputs:sourceColorSpace = \"sRGB\"\n";
  text += fmt::format("                float2 inputs:st.connect = <{}/coordinates.outputs:result>\n", path);
  text += "                token inputs:wrapS = \"clamp\"\n                token inputs:wrapT = \"clamp\"\n";
  if (has_opacity) text += "                float outputs:a\n";
  text += "                float3 outputs:rgb\n            }\n\n";
  text += "            def Shader \"coordinates\"\n            {\n";
  text += "                uniform token info:id = \"UsdPrimvarReader_float2\"\n";
  text +=
      "                string inputs:varname = \"st\"\n                float2 outputs:result\n            }\n        }\n";
}

void append_camera(std::string& text, const LayeredScene& scene) {
  constexpr double kTall = 24.0, kWide = 36.0, kFieldOfView = 70.0 * kDegree;  // of a small picture's film
  text += "\n    def Camera \"middle_of_the_box\"\n    {\n";
  text += fmt::format("        float2 clippingRange = (0.02, {})\n", decimal(2.0f * farthest(scene)));
  text += fmt::format("        float focalLength = {:.4f}\n", 0.5 * kTall / std::tan(0.5 * kFieldOfView));
  text += fmt::format("        float horizontalAperture = {}\n        float verticalAperture = {}\n", kWide, kTall);
  text += fmt::format("        float xformOp:rotateY = {}\n", decimal(-scene.yaw));
  text += "        uniform token[] xformOpOrder = [\"xformOp:rotateY\"]\n    }\n";
}

std::string scene_text(const LayeredScene& scene, const std::vector<LayerPart>& parts) {
  std::string text = "#usda 1.0\n(\n    customLayerData = {\n        dictionary omnistereo = {\n";
  text += fmt::format("            double3 box = {}\n", tuple_of(scene.box.size));
  text += fmt::format("            double3 center = {}\n", tuple_of(scene.box.center));
  text += fmt::format("            int layers = {}\n            int width = {}\n", kLayeredVersion, scene.width);
  text += fmt::format("            double yaw = {}\n        }}\n    }}\n", decimal(scene.yaw));
  text += "    defaultPrim = \"layers\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n";
  text += "def Xform \"layers\"\n{\n";
  text += fmt::format("    double3 xformOp:translate = {}\n", tuple_of(scene.box.center));
  text += "    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n";
  for (const LayerPart& part : parts) append_mesh(text, scene, part);
  text += "\n    def Scope \"materials\"\n    {\n";
  for (const LayerPart& part : parts) append_material(text, part);
  text += "    }\n";
  append_camera(text, scene);
  return text + "}\n";
}

}  // namespace

std::string layers_usdz(const LayeredScene& scene, const std::vector<LayerPart>& parts, const std::string& path) {
  constexpr size_t kAlignment = 64;  // the specification's
  std::vector<StoredFile> files = {{"layers.usda", scene_text(scene, parts)}};
  for (const LayerPart& part : parts) files.push_back({texture_path(part), part.texture});
  MemorySink sink(path);
  write_stored_zip(sink, files, kAlignment);
  return sink.take();
}

}  // namespace ods
