// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Written layered scenes, read by the reader of scenes and by the programs of others: ODS_NODE_MODULES names a folder
// with gltf-validator and three (npm install gltf-validator three); without them, those tests are skipped.
#include "ods/layers/file/write_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "ods/base/error.h"
#include "ods/files/zip_archive.h"
#include "ods/layers/file/layers_info.h"
#include "ods/scene/gltf/gltf.h"
#include "tests/support/layered_box.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods::write_layers_test {

// A vertex of a file, in the world.
struct Corner {
  vec3 position;
  vec2 uv;
};
using Triangle = std::array<Corner, 3>;

const std::vector<std::string> kNames = {"page 0", "page 1", "page 2", "page 3", "charts 0", "sky", "sky 1"};

vec3 in_world(const Instance& instance, const vec3& p) {
  const vec4 point(p, 1.0f);
  return {dot(instance.row0, point), dot(instance.row1, point), dot(instance.row2, point)};
}

const Instance& instance_named(const Scene& scene, const std::string& name) {
  for (const NamedObject& object : scene.objects) {
    if (object.name == name && object.count == 1) return scene.instances[object.first_instance];
  }
  ADD_FAILURE() << "there is no single " << name;
  return scene.instances.front();
}

const Material& material_named(const Scene& scene, const std::string& name) {
  return scene
      .materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance_named(scene, name).mesh)].material)];
}

std::vector<Triangle> triangles_of(const Scene& scene, const std::string& name) {
  const Instance& instance = instance_named(scene, name);
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  std::vector<Triangle> found;
  for (uint t = 0; t < mesh.triangle_count; t++) {
    const uvec3 corners = scene.triangles[mesh.first_triangle + t];
    Triangle& triangle = found.emplace_back();
    for (int k = 0; k < 3; k++) {
      const Vertex& vertex = scene.vertices[mesh.first_vertex + corners[k]];
      triangle[static_cast<size_t>(k)] = {in_world(instance, vertex.position), vertex.uv0};
    }
  }
  return found;
}

// The maximum distance in positions and in texture coordinates between two triangles, whichever corner is first.
Corner difference(const Triangle& a, const Triangle& b) {
  Corner least{vec3(INFINITY), vec2(INFINITY)};
  for (size_t turn = 0; turn < 3; turn++) {
    float away = 0.0f, uv = 0.0f;
    for (size_t k = 0; k < 3; k++) {
      away = std::max(away, length(a[k].position - b[(k + turn) % 3].position));
      uv = std::max(uv, glm::length(a[k].uv - b[(k + turn) % 3].uv));
    }
    if (away < least.position.x) least = {vec3(away), vec2(uv)};
  }
  return least;
}

// The place of a mesh's vertex in the file's world.
vec3 place_of(const LayerMesh& mesh, const LayeredScene& scene, uint vertex, float sky_scale) {
  const vec3 position = mesh.positions[vertex];
  return mesh.kind == LayerKind::kSky ? scene.box.center + sky_scale * position : position;
}

class WriteLayers : public testing::Test {
 protected:
  Scene written(const LayeredScene& scene, const WriteLayersOptions& options = {}) {
    const std::string path = folder.path("box.glb");
    const uint64_t size = write_layers(scene, path, options);
    EXPECT_EQ(size, std::filesystem::file_size(path));
    return load_gltf(path);
  }

  TemporaryFolder folder;
  const LayeredScene box = layered_box();
};

const WriteLayersOptions kPlain{.plain = true};

// --- the scene in the file

TEST_F(WriteLayers, KeepsEveryTriangle) {
  const float quarter = 0.25f * 2.0f * std::numbers::pi_v<float> / static_cast<float>(box.width);
  constexpr float kSkyScale = 100.0f;  // the least, for a sky of 1 m
  for (const bool is_plain : {false, true}) {
    const Scene scene = written(box, {.plain = is_plain});
    EXPECT_EQ(scene.warnings, std::vector<std::string>());
    for (size_t m = 0; m < box.meshes.size(); m++) {
      const LayerMesh& mesh = box.meshes[m];
      const std::vector<Triangle> found = triangles_of(scene, kNames[m]);
      ASSERT_EQ(found.size(), mesh.triangles.size()) << kNames[m];
      for (const uvec3& corners : mesh.triangles) {
        Triangle wanted;
        for (int k = 0; k < 3; k++) {
          wanted[static_cast<size_t>(k)] = {place_of(mesh, box, corners[k], kSkyScale), mesh.uvs[corners[k]]};
        }
        Corner least{vec3(INFINITY), vec2(INFINITY)};
        for (const Triangle& triangle : found) {
          const Corner one = difference(wanted, triangle);
          if (one.position.x < least.position.x) least = one;
        }
        const float distance = length(wanted[0].position - box.box.center);
        EXPECT_LT(least.position.x, is_plain ? 1e-5f * distance : quarter * distance) << kNames[m];
        EXPECT_LE(least.uv.x, 1.0f / 65535.0f) << kNames[m];
      }
    }
  }
}

// Blended triangles are drawn in their order, so files keep it.
TEST_F(WriteLayers, BlendsPanesInTheirOrder) {
  LayeredScene glass = box;
  glass.meshes.push_back(
      square(LayerKind::kBlended, box.box.center - vec3(0, 0, 1), vec3(0.4f, 0, 0), vec3(0, 0.4f, 0), 4, 7));
  std::vector<uvec3>& triangles = glass.meshes.back().triangles;
  std::mt19937 random(3);
  std::ranges::shuffle(triangles, random);
  for (const bool is_plain : {false, true}) {
    const Scene scene = written(glass, {.plain = is_plain});
    const Material& material = material_named(scene, "panes 0");
    EXPECT_EQ(material.alpha_mode, kAlphaBlend);
    EXPECT_EQ(material.unlit, 1);
    const std::vector<Triangle> found = triangles_of(scene, "panes 0");
    ASSERT_EQ(found.size(), triangles.size());
    for (size_t i = 0; i < triangles.size(); i++) {
      Triangle wanted;
      for (int k = 0; k < 3; k++) {
        const uint corner = triangles[i][k];
        wanted[static_cast<size_t>(k)] = {glass.meshes.back().positions[corner], glass.meshes.back().uvs[corner]};
      }
      EXPECT_LT(difference(wanted, found[i]).position.x, 1e-3f);
    }
  }
}

TEST_F(WriteLayers, HasUnlitMaterials) {
  for (const bool is_plain : {false, true}) {
    const Scene scene = written(box, {.plain = is_plain});
    for (size_t m = 0; m < box.meshes.size(); m++) {
      const Material& material = material_named(scene, kNames[m]);
      EXPECT_EQ(material.unlit, 1);
      EXPECT_EQ(material.double_sided, 0);
      EXPECT_EQ(material.alpha_mode, box.meshes[m].kind == LayerKind::kMasked ? kAlphaMask : kAlphaOpaque);
      EXPECT_EQ(material.alpha_cutoff, 0.5f);
      const Texture& texture = scene.textures[static_cast<size_t>(material.base_color_slot.texture)];
      EXPECT_EQ(texture.wrap_u, kWrapClamp);
      EXPECT_EQ(texture.wrap_v, kWrapClamp);
      EXPECT_EQ(texture.srgb, 1);
    }
  }
}

TEST_F(WriteLayers, KeepsTheTextures) {
  const WriteLayersOptions kinds[] = {{}, {.textures = LayerTextures::kJpeg}, kPlain, {.quality = 60}};
  for (const WriteLayersOptions& options : kinds) {
    const Scene scene = written(box, options);
    for (size_t m = 0; m < box.meshes.size(); m++) {
      const Image& wanted = box.meshes[m].texture;
      const Texture& texture =
          scene.textures[static_cast<size_t>(material_named(scene, kNames[m]).base_color_slot.texture)];
      ASSERT_EQ(texture.width, wanted.width);
      ASSERT_EQ(texture.height, wanted.height);
      double sum = 0.0;
      for (size_t i = 0; i < 64 * 64; i++) {
        const uint texel = scene.texels[texture.first_texel + i];
        for (int k = 0; k < wanted.channels; k++) {
          const float code = static_cast<float>(texel >> (8 * k) & 255u) / 255.0f;
          const float error = code - wanted.pixels[i * static_cast<size_t>(wanted.channels) + static_cast<size_t>(k)];
          EXPECT_LT(std::abs(error), k == 3 ? 0.01f : 0.2f) << "channel " << k;
          sum += error * error;
        }
      }
      EXPECT_LT(std::sqrt(sum / (64 * 64)), options.quality == 60 ? 0.04 : 0.025) << kNames[m];
    }
  }
}

// A crack of one rounding between two meshes would sparkle.
TEST_F(WriteLayers, RoundsSharedPointsAlike) {
  LayeredScene scene = box;
  LayerMesh& neighbour = scene.meshes[1];
  neighbour = scene.meshes[0];
  for (vec3& position : neighbour.positions) {
    if (position.x < box.box.center.x + 1.99f) position.z += 1.7f;  // shares its right edge
  }
  const Scene found = written(scene);
  std::vector<std::set<std::array<float, 3>>> places(2);
  for (size_t m = 0; m < 2; m++) {
    for (const Triangle& triangle : triangles_of(found, kNames[m])) {
      for (const Corner& corner : triangle) {
        places[m].insert({corner.position.x, corner.position.y, corner.position.z});
      }
    }
  }
  size_t shared = 0;
  for (const auto& place : places[0]) shared += places[1].count(place);
  EXPECT_EQ(shared, 5u);
}

// Near and far vertices in one mesh, as in a landscape seen through a window.
TEST_F(WriteLayers, MovesNoVertexByAQuarterOfAPixel) {
  LayeredScene scene = box;
  scene.meshes.resize(1);
  LayerMesh& mesh = scene.meshes[0];
  mesh.positions.clear(), mesh.uvs.clear(), mesh.triangles.clear();
  const vec3 half = 0.5f * scene.box.size;
  for (uint i = 0; i < 3000; i++) {
    const float distance = 0.1f * std::pow(1.004f, static_cast<float>(i));  // to 16 km
    const vec3 direction = normalize(vec3(std::sin(float(i)), 0.5f * std::cos(3.0f * float(i)), std::cos(float(i))));
    mesh.positions.push_back(scene.box.center + (distance + length(half)) * direction);
    mesh.uvs.push_back(vec2(static_cast<float>(i) / 3000.0f, 0.5f));
    if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  for (const int width : {2048, 8192, 16384}) {
    scene.width = width;
    const float quarter = 0.25f * 2.0f * std::numbers::pi_v<float> / static_cast<float>(width);
    float worst = 0.0f;
    for (const Triangle& triangle : triangles_of(written(scene), "page 0")) {
      for (const Corner& corner : triangle) {
        const vec3 wanted = mesh.positions[static_cast<size_t>(std::lround(corner.uv.x * 3000.0f))];
        const vec3 outside = max(abs(wanted - scene.box.center) - half, vec3(0.0f));
        worst = std::max(worst, length(corner.position - wanted) / length(outside));
      }
    }
    EXPECT_LT(worst, quarter * 1.02f) << width;  // single precision, of world coordinates
    EXPECT_GT(worst, quarter * 0.25f) << width << ": it is finer than it needs to be";
  }
}

TEST_F(WriteLayers, HasIndicesOf32BitsForManyVertices) {
  LayeredScene scene = box;
  scene.meshes.resize(1);
  for (const int n : {255, 256}) {  // 65,536 and 66,049 vertices
    scene.meshes[0] = square(LayerKind::kOpaque, scene.box.center - vec3(0.0f, 0.0f, 3.0f), vec3(2.0f, 0.0f, 0.0f),
                             vec3(0.0f, 2.0f, 0.0f), n, 0);
    for (const bool is_plain : {false, true}) {
      std::map<std::pair<int, int>, int> corners;
      for (const Triangle& triangle : triangles_of(written(scene, {.plain = is_plain}), "page 0")) {
        for (const Corner& corner : triangle) {
          const vec2 at = corner.uv * static_cast<float>(n);
          corners[{static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))}]++;
        }
      }
      EXPECT_EQ(corners.size(), static_cast<size_t>((n + 1) * (n + 1)));
      EXPECT_EQ((corners[{n / 2, n / 2}]), 6);
    }
  }
}

TEST_F(WriteLayers, LeavesOutEmptyMeshes) {
  LayeredScene scene = box;
  scene.meshes[1].triangles.clear();
  const Scene found = written(scene);
  EXPECT_EQ(found.meshes.size(), box.meshes.size() - 1);
  triangles_of(found, "page 2");  // the fourth mesh: numbers have no gap
  scene.meshes.clear();
  const std::string path = folder.path("empty.glb");
  write_layers(scene, path);
  EXPECT_TRUE(read_layers_info(path).has_value());
}

TEST_F(WriteLayers, HasACameraInTheMiddleOfTheBox) {
  const Scene scene = written(box);
  ASSERT_EQ(scene.view_points.size(), 1u);
  EXPECT_EQ(scene.view_points[0].name, "middle of the box");
  EXPECT_LT(length(scene.view_points[0].position - box.box.center), 1e-6f);
  EXPECT_NEAR(scene.view_points[0].yaw, box.yaw, 1e-4f);
}

TEST_F(WriteLayers, EnclosesAllInTheSky) {
  LayeredScene scene = box;
  scene.meshes[0].positions[0] = scene.box.center + vec3(0.0f, 0.0f, -700.0f);
  for (const Triangle& triangle : triangles_of(written(scene), "sky")) {
    for (const Corner& corner : triangle) EXPECT_GE(corner.position.y - scene.box.center.y, 1399.9f);
  }
}

// --- the file

TEST_F(WriteLayers, RequiresNoExtensionIfPlain) {
  write_layers(box, folder.path("a.glb"), kPlain);
  EXPECT_EQ(folder.read("a.glb").find("extensionsRequired"), std::string::npos);
  write_layers(box, folder.path("b.glb"));
  EXPECT_NE(folder.read("b.glb").find(R"("extensionsRequired":["EXT_meshopt_compression","EXT_texture_webp"])"),
            std::string::npos);
  write_layers(box, folder.path("c.glb"), {.textures = LayerTextures::kJpeg});
  EXPECT_NE(folder.read("c.glb").find(R"("extensionsRequired":["EXT_meshopt_compression"])"), std::string::npos);
}

TEST_F(WriteLayers, WritesAllOrNothing) {
  for (const char* name : {"a.gltf", "glb", "a.usd"}) {
    EXPECT_THROW(write_layers(box, folder.path(name)), Error) << name;
  }
  EXPECT_THROW(write_layers(box, folder.path("a.glb"), {}, {{}, [] { return true; }}), Error);
  EXPECT_EQ(folder.names(), std::vector<std::string>());
  write_layers(box, folder.path("A.GLB"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"A.GLB"});
}

TEST_F(WriteLayers, ReportsItsProgress) {
  std::vector<double> reports;
  write_layers(box, folder.path("a.glb"), {}, {[&](double done) { reports.push_back(done); }, {}});
  EXPECT_EQ(reports.size(), box.meshes.size());
  EXPECT_TRUE(std::ranges::is_sorted(reports));
  EXPECT_EQ(reports.back(), 1.0);
}

TEST(LayersCost, CountsWhatIsDrawn) {
  LayeredScene scene = layered_box();
  scene.meshes[2].triangles.clear();
  const LayersCost cost = cost_of(scene);
  EXPECT_EQ(cost.triangles, 3u * 32 + 8 + 2 * 2);
  EXPECT_EQ(cost.vertices, 3u * 25 + 9 + 2 * 4);
  EXPECT_EQ(cost.draw_calls, 6u);
  EXPECT_EQ(cost.texture_bytes, 6u * (4 * 64 * 64 * 4 / 3));
}

// --- USDZ

TEST_F(WriteLayers, WritesUsdz) {
  const std::string path = folder.path("box.usdz");
  const uint64_t size = write_layers(box, path);
  EXPECT_EQ(size, std::filesystem::file_size(path));
  const std::string bytes = folder.read("box.usdz");
  EXPECT_EQ(bytes.find("#usda 1.0\n"), 64u) << "the first file";
  ZipArchive archive({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, path);
  EXPECT_EQ(archive.names().size(), 1 + box.meshes.size());
  for (const std::string& name : archive.names()) {
    const std::vector<unsigned char> file = archive.read(name);
    EXPECT_EQ(bytes.find(std::string(file.begin(), file.end())) % 64, 0u) << name << " is compressed, or not aligned";
  }
  const std::vector<unsigned char> usda = archive.read("layers.usda");
  const std::string text(usda.begin(), usda.end());
  for (const std::string& name : archive.names()) {
    EXPECT_TRUE(name == "layers.usda" || text.find("@" + name + "@") != std::string::npos) << name;
  }
  EXPECT_EQ(text.find("\r"), std::string::npos);
  EXPECT_TRUE(archive.holds("textures/charts_0.png"));
  EXPECT_TRUE(archive.holds("textures/page_3.jpg"));
}

// --- programs of others

// The folder that ODS_NODE_MODULES names, if it has this package; else empty.
std::string node_modules(const std::string& package) {
  const char* const modules = std::getenv("ODS_NODE_MODULES");
  return modules && std::filesystem::exists(std::string(modules) + "/" + package) ? modules : "";
}

// Loaders of three.js expect a browser. A picture is as large as its bytes.
constexpr const char* kBrowser = R"(
globalThis.self = globalThis;
globalThis.createImageBitmap = async (blob) => ({ width: blob.size, height: 1, close() {} });
class FakeImage extends EventTarget { set src(url) { queueMicrotask(() => this.dispatchEvent(new Event('load'))); } }
globalThis.document = { createElementNS: () => new FakeImage() };
const { readFileSync } = await import('node:fs');
const bytes = (path) => { const file = readFileSync(path); return file.buffer.slice(file.byteOffset, file.byteOffset + file.length); };
)";

class LayersElsewhere : public WriteLayers {
 protected:
  // What a script prints. It may import packages of ODS_NODE_MODULES.
  std::string node(const std::string& script) {
    folder.write("test.mjs", script);
    std::error_code exists;
    std::filesystem::create_directory_symlink(std::getenv("ODS_NODE_MODULES"), folder.path("node_modules"), exists);
    return run_line("cd '" + folder.path("") + "' && timeout 60 node test.mjs").out;
  }
};

TEST_F(LayersElsewhere, AreValid) {
  if (node_modules("gltf-validator").empty()) {
    GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no gltf-validator (npm install gltf-validator)";
  }
  write_layers(box, folder.path("a.glb"));
  write_layers(box, folder.path("b.glb"), kPlain);
  write_layers(box, folder.path("c.glb"), {.textures = LayerTextures::kJpeg});
  EXPECT_EQ(node(R"(
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';
for (const name of ['a.glb', 'b.glb', 'c.glb']) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(name)));
  console.log(name, issues.numErrors, issues.numWarnings, info.drawCallCount, info.totalTriangleCount);
  for (const { severity, code, message, pointer } of issues.messages) {
    if (severity < 2) console.log(code, message, pointer);
  }
}
)"),
            "a.glb 0 0 7 140\nb.glb 0 0 7 140\nc.glb 0 0 7 140\n");
}

TEST_F(LayersElsewhere, AreReadByThreeJs) {
  if (node_modules("three").empty()) GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no three (npm install three)";
  write_layers(box, folder.path("a.glb"));
  write_layers(box, folder.path("b.glb"), kPlain);
  const std::string said = node(std::string(kBrowser) + R"(
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
for (const name of ['a.glb', 'b.glb']) {
  const gltf = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(bytes(name), '');
  const meshes = [];
  gltf.scene.updateMatrixWorld(true);
  gltf.scene.traverse((node) => { if (node.isMesh) meshes.push(node); });
  const all = new THREE.Box3();
  for (const mesh of meshes) if (!mesh.userData.omnistereo) all.expandByObject(mesh);
  const tenths = (v) => v.toArray().map((x) => x.toFixed(1)).join(' ');
  const triangles = meshes.reduce((sum, mesh) => sum + mesh.geometry.index.count / 3, 0);
  const camera = gltf.cameras[0];
  console.log(meshes.length, triangles, tenths(all.min), tenths(all.max));
  console.log(meshes.every((mesh) => mesh.material.isMeshBasicMaterial && mesh.material.map.image.width > 300));
  console.log(meshes.filter((mesh) => mesh.material.alphaTest === 0.5).map((mesh) => mesh.name).join(),
              meshes.filter((mesh) => mesh.userData.omnistereo?.sky).map((mesh) => mesh.name).join());
  console.log(tenths(camera.getWorldPosition(new THREE.Vector3())), tenths(camera.getWorldDirection(new THREE.Vector3())));
  console.log(gltf.asset.extras.omnistereo.layers, gltf.asset.extras.omnistereo.width);
}
)");
  const std::string each =
      "7 140 -0.9 -0.1 -4.8 3.1 2.9 0.2\ntrue\ncharts_0 sky,sky_1\n1.1 1.4 -2.3 0.5 0.0 -0.9\n1 8192\n";
  EXPECT_EQ(said, each + each);
}

TEST_F(LayersElsewhere, AreReadAsUsdzByThreeJs) {
  if (node_modules("three").empty()) GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no three (npm install three)";
  write_layers(box, folder.path("box.usdz"));
  EXPECT_EQ(node(std::string(kBrowser) + R"(
import * as THREE from 'three';
import { USDLoader } from 'three/addons/loaders/USDLoader.js';
const scene = new USDLoader().parse(bytes('box.usdz'));
const meshes = [];
scene.updateMatrixWorld(true);
scene.traverse((node) => { if (node.isMesh) meshes.push(node); });
const all = new THREE.Box3();
for (const mesh of meshes) if (!mesh.name.startsWith('sky')) all.expandByObject(mesh);
const tenths = (v) => v.toArray().map((x) => x.toFixed(1)).join(' ');
const corners = ({ index, attributes }) => (index ?? attributes.position).count;
console.log(meshes.length, meshes.reduce((sum, mesh) => sum + corners(mesh.geometry) / 3, 0), tenths(all.min), tenths(all.max));
console.log(meshes.every(({ material }) => material.emissiveMap && material.color.getHex() === 0));
console.log(meshes.filter((mesh) => mesh.material.alphaTest === 0.5).map((mesh) => mesh.name).join());
const [a, b, c, normal] = Array.from({ length: 4 }, () => new THREE.Vector3());
const middle = new THREE.Vector3(1.1, 1.4, -2.3);
console.log(meshes.every(({ geometry, matrixWorld }) => {
  const at = (i, v) => v.fromBufferAttribute(geometry.attributes.position, geometry.index?.getX(i) ?? i).applyMatrix4(matrixWorld);
  normal.crossVectors(at(1, b).sub(at(0, a)), at(2, c).sub(a));
  return normal.dot(a.sub(middle)) < 0;
}), 'seen from the box');
// The upper left corner of the wall in front: v points up.
const { position, uv } = meshes[0].geometry.attributes;
for (let i = 0; i < position.count; i++) {
  if (position.getX(i) < -1.99 && position.getY(i) > 1.49) { console.log(uv.getX(i), uv.getY(i)); break; }
}
)"),
            "7 140 -0.9 -0.1 -4.8 3.1 2.9 0.2\ntrue\ncharts_0\ntrue seen from the box\n0 1\n");
}

}  // namespace ods::write_layers_test
