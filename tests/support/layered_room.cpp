// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/layered_room.h"

#include <array>
#include <cmath>
#include <limits>

#include "ods/image/image_file.h"
#include "ods/image/tone.h"
#include "tests/support/compressed_gltf.h"

namespace ods::layered_room {

constexpr int kPage = 512;      // texels of a texture
constexpr int kCells = 4;       // surfaces in it, each way
constexpr int kSquares = 4;     // of a surface, each way
constexpr float kHuge = 20.0f;  // the sky's cube, metres

enum Page { kSky, kWalls, kLattice, kPane };

// A rectangle seen from its front: its upper left corner, and the edges to the right and down.
struct Sheet {
  Page page;
  int cell;  // its place in the page
  vec3 corner, across, down;
};

// The four sides of a box, and its bottom and top, as seen from inside; from outside with the corners exchanged.
static void add_box(std::vector<Sheet>& sheets, Page page, int cell, vec3 low, vec3 high, bool outside, bool has_top) {
  const vec3 size = high - low, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  const auto add = [&](vec3 corner, vec3 across, vec3 down) {
    if (outside) corner += across, across = -across;
    sheets.push_back({page, cell++, corner, across, down});
  };
  add(low + y, x, -y);       // the wall at the low z
  add(low + x + y, z, -y);   // at the high x
  add(high, -x, -y);         // at the high z
  add(low + y + z, -z, -y);  // at the low x
  if (outside) return;
  add(low, x, z);
  if (has_top) add(low + y + z, x, -z);
}

static const std::vector<Sheet>& sheets() {
  static const std::vector<Sheet> all = [] {
    std::vector<Sheet> list;
    add_box(list, kSky, 0, kCenter - kHuge, kCenter + kHuge, false, true);
    add_box(list, kWalls, 0, vec3(-2, 0, -2.5f), vec3(2, 2.6f, 2.2f), false, false);
    add_box(list, kWalls, 6, vec3(-0.1f, 0, -1.3f), vec3(0.25f, 2.0f, -0.9f), true, false);
    list.push_back({kWalls, 10, vec3(1.2f, 2, -1), vec3(0, 0, -0.8f), vec3(0, -2, 0)});  // seen from the high x only
    list.push_back({kLattice, 0, vec3(0.6f, 1.9f, -1.2f), vec3(0.6f, 0, 0), vec3(0, -0.8f, 0)});
    list.push_back({kPane, 0, vec3(-0.9f, 1.9f, -1.0f), vec3(0.6f, 0, 0), vec3(0, -0.8f, 0)});
    return list;
  }();
  return all;
}

// The square of a pattern that has texture coordinates within a cell, 0..1.
static int square_at(const Sheet& sheet, vec2 at) {
  const glm::ivec2 place = clamp(glm::ivec2(at * float(kSquares)), glm::ivec2(0), glm::ivec2(kSquares - 1));
  return (place.y * kSquares + place.x) + kSquares * kSquares * (sheet.cell + kCells * kCells * sheet.page);
}

// The rest of the lattice's page is transparent, too: holes at its edges stay holes when texels are mixed.
static bool is_hole(const Sheet& sheet, int square) {
  return sheet.page == kLattice && (sheet.cell > 0 || (square + square / kSquares) % 2 == 1);
}

static vec3 color_of(int square) {
  const auto part = [square](int step) { return float(40 + (square * step) % 190) / 255.0f; };
  return {part(37), part(91), part(53)};
}

static float alpha_of(const Sheet& sheet, int square) {
  if (sheet.page == kPane) return static_cast<float>(51 * (1 + square % 4)) / 255.0f;
  return is_hole(sheet, square) ? 0.0f : 1.0f;
}

static std::string page_png(Page page) {
  FileHeader header;
  header.format = FileFormat::kPng;
  header.width = header.height = kPage;
  header.channels = {{"R"}, {"G"}, {"B"}};
  if (page == kLattice || page == kPane) header.channels.push_back({"A"});
  const size_t channels = header.channels.size();
  return image_bytes("page.png", header, [page, channels](int y, std::span<float> row) {
    constexpr int kCell = kPage / kCells;
    for (int x = 0; x < kPage; x++) {
      const Sheet sheet{page, y / kCell * kCells + x / kCell, {}, {}, {}};
      const int square = square_at(sheet, vec2(float(x % kCell) + 0.5f, float(y % kCell) + 0.5f) / float(kCell));
      const vec3 color = color_of(square);
      for (size_t c = 0; c < 3; c++) row[size_t(x) * channels + c] = color[int(c)];
      if (channels == 4) row[size_t(x) * channels + 3] = alpha_of(sheet, square);
    }
  });
}

struct Corners {
  std::vector<vec3> positions;
  std::vector<vec2> uvs;
  std::vector<uint16_t> indices;
};

static Corners corners_of(Page page) {
  Corners corners;
  for (const Sheet& sheet : sheets()) {
    if (sheet.page != page) continue;
    const vec2 cell(float(sheet.cell % kCells), float(sheet.cell / kCells));
    const auto first = uint16_t(corners.positions.size());
    for (const vec2 at : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
      corners.positions.push_back(sheet.corner + at.x * sheet.across + at.y * sheet.down);
      corners.uvs.push_back((cell + at) / float(kCells));
    }
    for (const int i : {0, 2, 1, 1, 2, 3}) corners.indices.push_back(uint16_t(first + i));
  }
  return corners;
}

template <class T>
static Binary bytes_of(const std::vector<T>& values) {
  Binary bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

static int view_of(const GltfBuilder& file, int accessor) {
  return file.json["accessors"][size_t(accessor)]["bufferView"];
}

// Positions within -1..1 of a node that is scaled, padded to four numbers; texture coordinates 0..1.
static GltfJson add_quantized(GltfBuilder& file, const Corners& corners) {
  std::vector<int16_t> positions;
  std::vector<uint16_t> uvs;
  for (const vec3 p : corners.positions) {
    for (int i = 0; i < 3; i++) positions.push_back(int16_t(std::lround((p - kCenter)[i] / kHuge * 32767.0f)));
    positions.push_back(0);
  }
  for (const vec2 uv : corners.uvs) {
    for (int i = 0; i < 2; i++) uvs.push_back(uint16_t(std::lround(uv[i] * 65535.0f)));
  }
  const int position = file.add(positions, kShort, "VEC4"), uv = file.add(uvs, kUshort, "VEC2");
  file.json["accessors"][size_t(position)].update({{"type", "VEC3"}, {"normalized", true}});
  file.json["accessors"][size_t(uv)]["normalized"] = true;
  file.json["bufferViews"][size_t(view_of(file, position))]["byteStride"] = 8;
  return {{"POSITION", position}, {"TEXCOORD_0", uv}};
}

static void add_page(GltfBuilder& file, Page page, Storage storage) {
  const Corners corners = corners_of(page);
  GltfJson attributes;
  if (storage == Storage::kQuantized) {
    attributes = add_quantized(file, corners);
  } else {
    attributes = {
        {"POSITION", file.add_bytes(bytes_of(corners.positions), 3 * corners.positions.size(), kFloat, "VEC3")},
        {"TEXCOORD_0", file.add_bytes(bytes_of(corners.uvs), 2 * corners.uvs.size(), kFloat, "VEC2")}};
  }
  const int indices = file.add(corners.indices, kUshort, "SCALAR");
  if (storage != Storage::kFloats) {
    const bool is_small = storage == Storage::kQuantized;
    compress_meshopt(file, view_of(file, attributes["POSITION"]), "ATTRIBUTES", is_small ? 8 : 12);
    compress_meshopt(file, view_of(file, attributes["TEXCOORD_0"]), "ATTRIBUTES", is_small ? 4 : 8);
    compress_meshopt(file, view_of(file, indices), page == kSky ? "INDICES" : "TRIANGLES", 2);
  }
  const std::string png = page_png(page);
  const int image = file.add_view(Binary(png.begin(), png.end()));
  const auto number = file.json["images"].size();
  file.json["images"].push_back({{"bufferView", image}, {"mimeType", "image/png"}});
  file.json["textures"].push_back({{"source", number}});
  GltfJson material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", number}}}}}};
  material["extensions"]["KHR_materials_unlit"] = GltfJson::object();
  if (page == kLattice) material["alphaMode"] = "MASK";
  if (page == kPane) material["alphaMode"] = "BLEND";
  file.json["materials"].push_back(material);
  file.json["meshes"].push_back(
      {{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", number}}}}});
  GltfJson node = {{"mesh", number}};
  if (page == kSky) node["extras"]["omnistereo"]["sky"] = true;
  if (storage == Storage::kQuantized) {
    node["scale"] = {kHuge, kHuge, kHuge};
    node["translation"] = {kCenter.x, kCenter.y, kCenter.z};
  }
  file.json["nodes"].push_back(node);
}

Binary room_glb(Storage storage, const std::string& fallback) {
  GltfBuilder file;
  file.json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  for (const char* const list : {"accessors", "bufferViews", "images", "textures", "materials", "meshes", "nodes"}) {
    file.json[list] = GltfJson::array();
  }
  for (const Page page : {kPane, kLattice, kWalls, kSky}) add_page(file, page, storage);  // the player sorts them
  GltfJson ours = {{"layers", 1},
                   {"center", {kCenter.x, kCenter.y, kCenter.z}},
                   {"box", {kBox.x, kBox.y, kBox.z}},
                   {"yaw", kYaw},
                   {"width", 8192}};
  if (!fallback.empty()) ours["fallback"] = fallback;
  file.json["asset"]["extras"]["omnistereo"] = ours;
  file.json["scenes"] = {{{"nodes", {0, 1, 2, 3}}}};
  if (!file.json.contains("buffers")) file.json["buffers"] = {GltfJson::object()};
  file.json["buffers"][0]["byteLength"] = file.binary.size();
  return file.glb();
}

// The colour of glass with this square over what is behind it, blended in linear light.
static Seen through(const Sheet& pane, int square, const Seen& behind) {
  constexpr int kMany = 10000;  // more than there are squares
  const float alpha = alpha_of(pane, square);
  const vec3 own = color_of(square);
  Seen seen{behind.surface + kMany * (1 + square), behind.color};
  for (int c = 0; c < 3; c++) {
    seen.color[c] = srgb_encode(alpha * srgb_decode(own[c]) + (1.0f - alpha) * srgb_decode(behind.color[c]));
  }
  return seen;
}

Seen look(vec3 from, vec3 direction) {
  Seen seen;
  float nearest = std::numeric_limits<float>::max();
  for (const Sheet& sheet : sheets()) {
    const vec3 origin = sheet.page == kSky ? kCenter : from;
    const vec3 normal = cross(sheet.down, sheet.across);  // toward those who see its front
    const float toward = dot(direction, normal);
    if (toward >= 0.0f) continue;
    const float distance = dot(sheet.corner - origin, normal) / toward;
    const vec3 at = origin + distance * direction - sheet.corner;
    const vec2 uv(dot(at, sheet.across) / dot(sheet.across, sheet.across),
                  dot(at, sheet.down) / dot(sheet.down, sheet.down));
    const bool is_met = distance > 0.0f && std::min(uv.x, uv.y) >= 0.0f && std::max(uv.x, uv.y) <= 1.0f;
    const float order = sheet.page == kSky ? 1e6f : distance;  // behind everything
    const int square = square_at(sheet, uv);
    if (!is_met || order >= nearest || is_hole(sheet, square)) continue;
    if (sheet.page == kPane) {  // the last in the list
      seen = through(sheet, square, seen);
      continue;
    }
    nearest = order;
    seen = {square, color_of(square)};
  }
  return seen;
}

vec3 turned(vec3 v, float degrees) {
  const float angle = glm::radians(degrees), s = std::sin(angle), c = std::cos(angle);
  return {v.x * c - v.z * s, v.y, v.z * c + v.x * s};
}

}  // namespace ods::layered_room
