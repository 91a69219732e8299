// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Layered scenes in the viewer: in Chromium against closed forms (tests/support/layered_room.h), through the page, an
// exported site, <stereo-360> and an emulated headset; and what ods view makes of the file. tests/web/layered-test.js
// drives the browser.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <nlohmann/json.hpp>

#include "cli/view/export_site.h"
#include "cli/view/objects.h"
#include "cli/view/view_site.h"
#include "ods/base/error.h"
#include "ods/view/layered_file.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"
#include "tests/support/compressed_gltf.h"
#include "tests/support/layered_room.h"
#include "tests/support/made_frames.h"

namespace ods::view_layers_test {

using layered_room::kBox, layered_room::kCenter, layered_room::kEye, layered_room::kYaw, layered_room::Storage,
    layered_room::turned;

constexpr auto kPatience = std::chrono::seconds(200);
constexpr Extent kView{160, 120};
constexpr vec3 kFallback(0.8f, 0.2f, 0.4f);
constexpr vec3 kGrey(0.1f);

struct Place {
  std::string name;
  vec3 at{0.0f};  // of the eye or the head, from the middle of the box
  float yaw = 0.0f, pitch = 0.0f;
  float fov = 90.0f;  // degrees across
};

std::string text_of(const Binary& bytes) {
  return {bytes.begin(), bytes.end()};
}

// The eye of a head that looks along a yaw.
vec3 eye_of(vec3 head, float yaw, int eye) {
  return head + turned(vec3(eye == kRight ? kEye : -kEye, 0, 0), yaw);
}

// The ray through a point of an eye's view, 0..1 from the upper left corner, in the file's world.
vec3 ray_of(const Place& place, Extent view, vec2 at) {
  const float wide = std::tan(glm::radians(place.fov) / 2.0f);
  const float high = wide * static_cast<float>(view.height) / static_cast<float>(view.width);
  const float p = glm::radians(place.pitch), up = (1.0f - 2.0f * at.y) * high;
  const vec3 level((2.0f * at.x - 1.0f) * wide, std::sin(p) + up * std::cos(p), up * std::sin(p) - std::cos(p));
  return turned(level, place.yaw + kYaw);
}

struct Comparison {
  int pixels = 0;
  int wrong = 0;  // of their values
};

// The view of an eye at a place, mixed with `outside` by a part of 0..1. Pixels near an edge are mixtures, and left out.
Comparison compare_view(const Image& got, const Place& place, vec3 outside, float part) {
  const vec3 from = kCenter + turned(place.at, kYaw);
  const Extent view{got.width, got.height};
  Comparison compared;
  for (int y = 0; y < view.height; y++) {
    for (int x = 0; x < view.width; x++) {
      const auto seen_at = [&](float dx, float dy) {
        const vec2 at((static_cast<float>(x) + 0.5f + dx) / static_cast<float>(view.width),
                      (static_cast<float>(y) + 0.5f + dy) / static_cast<float>(view.height));
        return layered_room::look(from, ray_of(place, view, at));
      };
      const layered_room::Seen seen = seen_at(0.0f, 0.0f);
      bool is_pure = true;
      for (int i = 0; i < 25 && is_pure; i++) {
        const auto off = [](int step) { return 1.5f * static_cast<float>(step - 2); };
        is_pure = seen_at(off(i % 5), off(i / 5)).surface == seen.surface;
      }
      if (!is_pure) continue;
      compared.pixels++;
      const vec3 wanted = glm::mix(seen.color, outside, part);
      for (int c = 0; c < 3; c++) compared.wrong += std::abs(got.at(x, y)[c] - wanted[c]) > 1.6f / 255.0f;
    }
  }
  return compared;
}

// Returns the share of the pixels that were compared.
double expect_view(const Image& got, const Place& place, vec3 outside = kGrey, float part = 0.0f) {
  const auto [pixels, wrong] = compare_view(got, place, outside, part);
  EXPECT_EQ(wrong, 0) << place.name << ": values of " << pixels << " pixels";
  return static_cast<double>(pixels) / (got.width * got.height);
}

class LayeredView : public Cli {
 protected:
  std::string add(const std::string& name, Storage storage, const std::string& fallback = "") {
    folder.write(name, text_of(layered_room::room_glb(storage, fallback)));
    return folder.path(name);
  }

  void add_item(const std::string& path) { items.push_back(open_view_item(path)); }

  // One colour all around, for both eyes.
  void save_fallback(const std::string& name) {
    Picture picture;
    for (const int eye : {kLeft, kRight}) {
      picture.eyes.emplace_back().eye = eye;
      picture.eyes.back().radiance = made::plain({64, 32}, 255.0f * kFallback);
    }
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(picture, save, folder.path(name));
  }

  std::string browse(const nlohmann::json& job, const Answer& site) {
    return run_harness(
        {chromium(folder.path("profile")), folder.path(""), nlohmann::json::array({job}).dump(), site, kPatience});
  }
  std::string browse(const nlohmann::json& job) {
    ViewSite site(items, {});
    return browse(job, [&](const WebRequest& request) { return site.answer(request); });
  }

  Image sent(const std::string& name, int column = 0, Extent size = kView) const {
    return part_of_sent(folder.path(name), column, size);
  }

  std::vector<ViewItem> items;
};

nlohmann::json job_of(const char* part, nlohmann::json more = nlohmann::json::object()) {
  more.update({{"layered", part}, {"width", kView.width}, {"height", kView.height}});
  return more;
}

nlohmann::json look_of(const Place& place, size_t item, const char* mode = "left") {
  return {{"name", place.name}, {"item", item},    {"yaw", place.yaw}, {"pitch", place.pitch}, {"fov", place.fov},
          {"x", place.at.x},    {"y", place.at.y}, {"z", place.at.z},  {"mode", mode}};
}

// Parallax, occlusion, the lattice's holes and the sky, at each place of the head; stored in every way.
TEST_F(LayeredView, EveryPixelIsTheClosedForm) {
  NEEDS_CHROMIUM();
  add_item(add("floats.layers.glb", Storage::kFloats));
  add_item(add("packed.layers.glb", Storage::kCompressed));
  add_item(add("small.layers.glb", Storage::kQuantized));
  const std::vector<Place> places = {{"middle", vec3(0.0f)},
                                     {"left", vec3(-0.11f, 0.0f, 0.05f)},
                                     {"right", vec3(0.08f, 0.1f, -0.1f), 30.0f, 35.0f, 70.0f},
                                     {"back", vec3(0.0f, -0.1f, 0.1f), -150.0f, -20.0f}};
  nlohmann::json looks;
  for (size_t item = 0; item < items.size(); item++) {
    for (Place place : places) place.name += std::to_string(item), looks.push_back(look_of(place, item));
  }
  ASSERT_EQ(browse(job_of("draw", {{"looks", looks}})), "ok");
  for (size_t item = 0; item < items.size(); item++) {
    for (Place place : places) {
      place.name += std::to_string(item);
      place.at = eye_of(place.at, place.yaw, kLeft);
      EXPECT_GT(expect_view(sent(place.name), place), 0.4) << place.name;
    }
  }
  // The test is one of parallax: the wall beside the pillar is another one from the other place.
  Place moved = places[0];
  moved.at = vec3(-0.11f, 0.0f, 0.05f);
  EXPECT_GT(compare_view(sent("middle0"), moved, kGrey, 0.0f).wrong, 1000);
}

// Both eyes are 63 mm apart; the head stays so far from the edge of the box that both are inside.
TEST_F(LayeredView, EveryModeHasItsEyesAndTheBoxItsEdge) {
  NEEDS_CHROMIUM();
  add_item(add("room.layers.glb", Storage::kQuantized));
  const Place place{"right", vec3(0.02f, 0.0f, 0.0f), 10.0f};
  Place side = place, mixed = place, far_away{"far", vec3(9.0f, -9.0f, 9.0f)};
  side.name = "sides", mixed.name = "anaglyph";
  nlohmann::json looks = {look_of(place, 0, "right"), look_of(side, 0, "side-by-side"), look_of(mixed, 0, "anaglyph"),
                          look_of(far_away, 0)};
  looks[1]["shift"] = 4;  // degrees: the left eye's picture to the left, the right eye's to the right
  ASSERT_EQ(browse(job_of("draw", {{"looks", looks}})), "ok");
  const auto at = [&](Place from, int eye) {
    from.at = eye_of(from.at, from.yaw, eye);
    return from;
  };
  EXPECT_GT(expect_view(sent("right"), at(place, kRight)), 0.4);
  const Extent half{kView.width / 2, kView.height};
  for (const int eye : {kLeft, kRight}) {
    Place narrow = at(side, eye);
    narrow.yaw += eye == kLeft ? 2.0f : -2.0f;
    narrow.fov = 2.0f * glm::degrees(std::atan(static_cast<float>(half.width) / static_cast<float>(half.height)));
    EXPECT_GT(expect_view(sent("sides", eye * half.width, half), narrow), 0.3) << eye;
  }
  const Image anaglyph = sent("anaglyph"), right = sent("right");
  EXPECT_LT(likeness(anaglyph, right), 30.0);
  EXPECT_GT(likeness(anaglyph, right), 5.0);
  // The limits are along the axes of the box, which the viewer's are turned against.
  const vec3 limit = kBox / 2.0f - vec3(kEye, 0.0f, kEye);
  far_away.at = turned(glm::clamp(turned(far_away.at, kYaw), -limit, limit), -kYaw);
  EXPECT_GT(expect_view(sent("far"), at(far_away, kLeft)), 0.4);
}

TEST_F(LayeredView, KeysAndDragsMoveTheHead) {
  NEEDS_CHROMIUM();
  save_fallback("other_360_TB.png");
  add_item(add("room.layers.glb", Storage::kFloats));
  add_item(folder.path("other_360_TB.png"));
  EXPECT_EQ(browse(job_of("move", {{"item", 0}, {"other", 1}, {"half", kBox.y / 2.0f}})), "ok");
}

// The bytes of a compressed view, as the library decodes them: it may begin a triangle with another of its vertices.
std::string decoded(const GltfBuilder& file, const nlohmann::json& view) {
  const unsigned char* const from = file.binary.data() + view["byteOffset"].get<size_t>();
  const size_t size = view["byteLength"], count = view["count"], stride = view["byteStride"];
  const std::string mode = view["mode"];
  std::string bytes(count * stride, 0);
  int fault = 0;
  if (mode == "ATTRIBUTES") fault = meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, size);
  if (mode == "TRIANGLES") fault = meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, size);
  if (mode == "INDICES") fault = meshopt_decodeIndexSequence(bytes.data(), count, stride, from, size);
  EXPECT_EQ(fault, 0);
  if (view.contains("filter")) meshopt_decodeFilterExp(bytes.data(), count, stride);
  return bytes;
}

// A file with every codec and many sizes of elements, against the library's decoder.
TEST_F(LayeredView, DecodesWhatMeshoptimizerEncodes) {
  NEEDS_CHROMIUM();
  GltfBuilder file = make_grid(40);
  std::mt19937 twister(7);
  const auto random = [&twister] { return static_cast<uint32_t>(twister()); };
  std::string plain;
  const auto pack = [&](int view, const std::string& mode, size_t stride, const char* filter = "NONE") {
    compress_meshopt(file, view, mode, stride, filter);
    plain +=
        decoded(file, file.json["bufferViews"][static_cast<size_t>(view)]["extensions"]["EXT_meshopt_compression"]);
  };
  const auto view_of = [&](int accessor) {
    return file.json["accessors"][static_cast<size_t>(accessor)]["bufferView"].get<int>();
  };
  pack(0, "ATTRIBUTES", 12), pack(1, "ATTRIBUTES", 12), pack(2, "ATTRIBUTES", 8), pack(3, "ATTRIBUTES", 4);
  pack(4, "TRIANGLES", 4);
  for (const size_t stride : {4u, 20u, 64u, 256u}) {
    for (const size_t count : {1u, 15u, 16u, 17u, 257u, 700u}) {
      Binary noise(stride * count);
      for (size_t i = 0; i < noise.size(); i++) {  // bytes that are still, slow and wild
        const int kind = static_cast<int>(i % stride % 4);
        const uint32_t number = random();
        noise[i] = static_cast<unsigned char>(kind == 0 ? 7 : kind == 1 ? i / stride : kind == 2 ? number % 9 : number);
      }
      pack(file.add_view(noise), "ATTRIBUTES", stride);
    }
  }
  std::vector<uint32_t> scattered, exponential;
  std::vector<uint16_t> jumps;
  for (uint32_t i = 0; i < 3000; i++) {
    scattered.push_back(random() % 100 == 0 ? random() % 100000 : i / 3 + random() % 20);
    jumps.push_back(static_cast<uint16_t>(i % 2 ? 40000 + i : random() % 300));
  }
  for (size_t i = 0; i < scattered.size(); i += 3) {  // no triangle has a vertex twice
    scattered[i + 1] += 200000, scattered[i + 2] += 400000;
  }
  pack(view_of(file.add(scattered, kUint, "SCALAR")), "INDICES", 4);
  pack(view_of(file.add(scattered, kUint, "SCALAR")), "TRIANGLES", 4);
  for (uint32_t i = 0; i < 999; i++) exponential.push_back((random() % 40 - 30) << 24 | random() % 0x1000000);
  pack(view_of(file.add(exponential, kUint, "SCALAR")), "ATTRIBUTES", 12, "EXPONENTIAL");
  pack(view_of(file.add(jumps, kUshort, "SCALAR")), "INDICES", 2);
  file.json["buffers"][0]["byteLength"] = file.binary.size();
  const std::string glb = text_of(file.glb());
  const std::string end =
      browse(job_of("decode", {{"item", "file.glb"}, {"plain", "plain"}}), [&](const WebRequest& request) -> WebAnswer {
        if (request.path == "file.glb") return {.type = "model/gltf-binary", .body = glb};
        if (request.path == "plain") return {.type = "application/octet-stream", .body = plain};
        const PageFile* const page = find_page_file(request.path);
        return page ? WebAnswer{.type = std::string(media_type(request.path)), .body = std::string(page->data)}
                    : nothing_there();
      });
  EXPECT_EQ(end, "ok");
}

TEST_F(LayeredView, DamagedFilesAreOneLineEach) {
  NEEDS_CHROMIUM();
  const std::string whole = text_of(layered_room::room_glb(Storage::kQuantized));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const std::vector<std::pair<std::string, std::string>> files = {
      {whole.substr(0, whole.size() / 2), "it is cut off"},
      {changed("image/png", "image/abc"), ""},
      {changed("\x89PNG", "\x89PNX"), "does not read its textures"},
      {changed("\"indices\":2", "\"indices\":0"), "its triangles are damaged"},
      {changed("\"indices\":11", "\"indices\":99"), "has no accessors[99]"},
      {changed("\"ATTRIBUTES\"", "\"ATTRIBUTEX\""), "compressed data is damaged"},
      {changed("\"nodes\":[0,1,2,3]", "\"nodes\":[0,1,2,2]"), "not a tree"}};
  nlohmann::json numbers, words;
  for (size_t i = 0; i < files.size(); i++) {
    const std::string name = fmt::format("file{}.layers.glb", i);
    folder.write(name, files[i].first);
    if (files[i].second.empty()) continue;
    add_item(folder.path(name));
    numbers.push_back(numbers.size()), words.push_back(files[i].second);
  }
  EXPECT_EQ(browse(job_of("fail", {{"items", numbers}, {"words", words}})), "ok");
  items.clear();
  add_item(add("whole.layers.glb", Storage::kQuantized));
  EXPECT_EQ(browse(job_of("damage", {{"item", "item/0/picture.glb"}, {"count", 400}})), "ok");
}

// An exported site has the file, its fallback and the code; the element shows it without view.json.
TEST_F(LayeredView, AnExportedSiteShowsIt) {
  NEEDS_CHROMIUM();
  save_fallback("room_360_TB.png");
  const std::string path = add("room.layers.glb", Storage::kQuantized, "room_360_TB.png");
  ASSERT_EQ(run("view " + path + " --export " + folder.path("site")), 0) << err;
  EXPECT_EQ(folder.read("site/item/0/picture.glb"), folder.read("room.layers.glb"));
  EXPECT_EQ(folder.read("site/item/0/fallback.png"), folder.read("room_360_TB.png"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/item/0/poster.jpg")));
  const auto site = [this](const WebRequest& request) -> WebAnswer {
    const std::string type(media_type(request.path)), file = folder.path("site/" + request.path);
    if (std::filesystem::is_regular_file(file)) return {.type = type, .file = std::filesystem::canonical(file)};
    const PageFile* const page = find_page_file(request.path);
    return page ? WebAnswer{.type = type, .body = std::string(page->data)} : nothing_there();
  };
  ASSERT_EQ(browse(job_of("element", {{"src", "item/0/picture.glb"}, {"name", "element"}}), site), "ok");
  EXPECT_GT(expect_view(sent("element"), {"element", eye_of(vec3(0.1f, 0, 0), 10.0f, kLeft), 10.0f}), 0.4);
}

// Each eye sees the scene from its own place; outside the box, the fallback, or grey, replaces it by and by.
TEST_F(LayeredView, AHeadsetMovesInIt) {
  NEEDS_IWER();
  NEEDS_CHROMIUM();
  save_fallback("room_360_TB.png");
  add_item(add("room.layers.glb", Storage::kQuantized, "room_360_TB.png"));
  add_item(add("bare.layers.glb", Storage::kQuantized));
  const auto at = [](const char* name, vec3 place, float yaw = 0.0f) {
    return nlohmann::json{{"name", name}, {"at", {place.x, place.y, place.z}}, {"yaw", yaw}};
  };
  nlohmann::json looks = {at("began", vec3(0)),
                          at("leant", vec3(0.06f, 0.05f, -0.08f), -20.0f),
                          at("near", vec3(0, 0.17f, 0)),
                          at("away", vec3(0, 0.4f, 0)),
                          at("centred", vec3(0.4f, 0.1f, 0.3f), 40.0f),
                          at("turned", vec3(0.4f, 0.1f, 0.3f), 40.0f)};
  looks[2]["waits"] = true, looks[4]["recentre"] = true, looks[5]["turn"] = 30;
  const Extent eye_size{128, 128};
  const auto wear = [&](size_t item) {
    nlohmann::json job = job_of("wear", {{"item", item}, {"looks", looks}});
    job["width"] = 2 * eye_size.width, job["height"] = eye_size.height;
    return browse(job);
  };
  const auto expect = [&](const char* name, vec3 head, float yaw, vec3 outside, float part) {
    for (const int eye : {kLeft, kRight}) {
      const Place place{name, eye_of(head, yaw, eye), yaw};
      expect_view(sent(name, eye * eye_size.width, eye_size), place, outside, part);
    }
  };
  const float away = (0.17f - kBox.y / 2.0f) / 0.1f;
  ASSERT_EQ(wear(0), "ok");
  expect("began", vec3(0), 0.0f, kFallback, 0.0f);
  expect("leant", vec3(0.06f, 0.05f, -0.08f), -20.0f, kFallback, 0.0f);
  expect("near", vec3(0, 0.17f, 0), 0.0f, kFallback, away);
  expect("away", vec3(0, 0.4f, 0), 0.0f, kFallback, 1.0f);
  expect("centred", vec3(0), 0.0f, kFallback, 0.0f);
  expect("turned", vec3(0), 30.0f, kFallback, 0.0f);
  for (nlohmann::json& look : looks) look.erase("waits");
  ASSERT_EQ(wear(1), "ok");
  expect("near", vec3(0, 0.17f, 0), 0.0f, kGrey, 0.85f * away);
  expect("away", vec3(0, 0.4f, 0), 0.0f, kGrey, 0.85f);
}

// --- the file on the side of the server -------------------------------------------------------------------------------

TEST_F(LayeredView, TheServerSendsTheFileAndItsFallback) {
  save_fallback("room_360_TB.png");
  add_item(add("room.layers.glb", Storage::kFloats, "room_360_TB.png"));
  add_item(add("bare.layers.glb", Storage::kFloats));
  ViewSite site(items, {});
  const auto get = [&](const std::string& path) {
    return site.answer({.is_post = false, .path = path, .query = {}, .body = "", .file = ""});
  };
  const nlohmann::json view = nlohmann::json::parse(get("view.json").body);
  const nlohmann::json& first = view["items"][0];
  EXPECT_EQ(first["kind"], "layers");
  EXPECT_EQ(first["image"], "item/0/picture.glb");
  EXPECT_EQ(first["fallback"], "item/0/fallback.png");
  EXPECT_EQ(first["layout"], "top-bottom");
  EXPECT_TRUE(first.contains("thumbnail"));
  EXPECT_TRUE(view["items"][1]["fallback"].is_null());
  EXPECT_FALSE(view["items"][1].contains("thumbnail"));
  const WebAnswer scene = get("item/0/picture.glb"), fallback = get("item/0/fallback.png");
  EXPECT_EQ(scene.type, "model/gltf-binary");
  EXPECT_EQ(scene.file, std::filesystem::canonical(folder.path("room.layers.glb")));
  EXPECT_EQ(fallback.file, std::filesystem::canonical(folder.path("room_360_TB.png")));
  EXPECT_EQ(get("item/0/thumbnail.jpg").type, "image/jpeg");
  for (const char* const path :
       {"item/1/thumbnail.jpg", "item/1/fallback.png", "item/0/left.jpg", "item/0/comfort.json"}) {
    EXPECT_EQ(get(path).status, 404) << path;
  }
}

// Objects have files and places; a page moves them, and the next ods view has them there.
TEST_F(LayeredView, TheServerKeepsThePlacesOfObjects) {
  const std::string path = add("room.layers.glb", Storage::kFloats);
  folder.write("robot.glb", text_of(make_triangle().glb()));
  items.push_back(open_view_item(path));
  ObjectOptions options{{folder.path("robot.glb"), "toys"}, {"1,2,3", "4,5,6"}, {"30", "0"}};
  add_objects(options, {}, items);
  ViewSite site(items, {});
  const auto get = [&](const std::string& name) { return site.answer({false, name, {}, "", ""}); };
  const auto objects = [&] { return nlohmann::json::parse(get("view.json").body)["items"][0]["objects"]; };
  EXPECT_EQ(objects()[0], nlohmann::json::parse(R"({"file": "item/0/object-0.glb", "name": "robot.glb", "path": ")" +
                                                folder.path("robot.glb") + R"(", "at": [1, 2, 3], "turn": 30})"));
  EXPECT_EQ(get("item/0/object-1.glb").type, "model/gltf-binary");
  EXPECT_EQ(get("item/0/object-1.glb").body.substr(0, 4), "glTF");
  EXPECT_EQ(get("item/0/object-2.glb").status, 404);
  const auto post = [&](const std::string& item, const std::string& body) {
    return site.answer({true, "objects", {{"item", item}}, body, ""});
  };
  const std::string moved =
      R"({"objects": [{"name": "robot.glb", "at": [7, 8, 9], "turn": -45}, {"at": [0, 0, 0], "turn": 0}]})";
  EXPECT_EQ(post("1", moved).status, 404);
  EXPECT_EQ(post("x", moved).status, 404);
  EXPECT_THROW(post("0", R"({"objects": []})"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path("room.objects.json")));
  EXPECT_EQ(nlohmann::json::parse(post("0", moved).body)["file"], "room.objects.json");
  EXPECT_EQ(objects()[0]["at"], nlohmann::json::parse("[7, 8, 9]"));
  ASSERT_EQ(run("view " + path + " --export " + folder.path("site")), 0) << err;
  const nlohmann::json site_objects = nlohmann::json::parse(folder.read("site/view.json"))["items"][0]["objects"];
  EXPECT_EQ(site_objects, objects());
  EXPECT_EQ(folder.read("site/item/0/object-1.glb"), get("item/0/object-1.glb").body);
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/item/0/object-1.glb.js")));
  folder.write("robot.glb", "damaged");  // is left out
  ASSERT_EQ(run("view " + path + " --export " + folder.path("site")), 0) << err;
  EXPECT_NE(err.find("left out"), std::string::npos) << err;
}

TEST_F(LayeredView, ObjectsNeedALayeredSceneOrAPictureWithDepth) {
  save_fallback("room_360_TB.png");
  const std::string path = add("room.layers.glb", Storage::kFloats), end = " --export " + folder.path("site");
  EXPECT_EQ(run("view " + folder.path("room_360_TB.png") + " --with toys --at 1,2,3" + end), 2);
  EXPECT_NE(err.find("has no depth"), std::string::npos) << err;
  EXPECT_EQ(run("view " + path + " --with toys --at 1,2,3 --at 4,5,6" + end), 2);
  EXPECT_NE(err.find("--at is given 2 times and --with 1 times"), std::string::npos) << err;
  EXPECT_EQ(run("view " + path + " --with toys --at 1,2" + end), 2);
  EXPECT_EQ(run("view " + path + " --with " + folder.path("none.glb") + end), 3) << err;
  ASSERT_EQ(run("view " + path + " --with toys" + end), 0) << err;
}

// The name in the file leads only to its own folder, and not through a link.
TEST_F(LayeredView, AFallbackIsInTheFilesFolder) {
  std::filesystem::create_directory(folder.path("in"));
  save_fallback("room_360_TB.png");
  save_fallback("in/there_360_TB.png");
  std::filesystem::create_symlink(folder.path("room_360_TB.png"), folder.path("in/link_360_TB.png"));
  const auto item_of = [&](const std::string& name) {
    return open_view_item(add("in/room.layers.glb", Storage::kFloats, name));
  };
  EXPECT_EQ(item_of("there_360_TB.png").fallback, std::filesystem::canonical(folder.path("in/there_360_TB.png")));
  for (const std::string& name :
       {std::string("link_360_TB.png"), std::string("gone.png"), std::string("room.layers.glb")}) {
    const ViewItem item = item_of(name);
    EXPECT_EQ(item.fallback, "") << name;
    ASSERT_EQ(item.picture.guesses.size(), 1u) << name;
    EXPECT_NE(item.picture.guesses[0].find(name), std::string::npos) << item.picture.guesses[0];
  }
  EXPECT_THROW(item_of("../room_360_TB.png"), Error);
  EXPECT_THROW(item_of(folder.path("room_360_TB.png")), Error);
}

// Other .glb files are scenes, for the studio; a version of the future is refused.
TEST_F(LayeredView, OthersAreNotLayered) {
  GltfBuilder scene = make_triangle();
  folder.write("scene.glb", text_of(scene.glb()));
  EXPECT_FALSE(is_layered_scene(folder.path("scene.glb")));
  scene.json["asset"]["extras"]["omnistereo"] = {{"note", "not layered"}};
  folder.write("scene.glb", text_of(scene.glb()));
  EXPECT_FALSE(is_layered_scene(folder.path("scene.glb")));
  folder.write("cut.glb", text_of(scene.glb()).substr(0, 30));
  EXPECT_FALSE(is_layered_scene(folder.path("cut.glb")));
  EXPECT_FALSE(is_layered_scene(folder.path("")));
  EXPECT_FALSE(is_layered_scene(folder.path("none.glb")));
  EXPECT_EQ(run("view " + folder.path("scene.glb") + " --export " + folder.path("site")), 2);
  EXPECT_NE(err.find("render the scene first"), std::string::npos) << err;
  scene.json["asset"]["extras"]["omnistereo"] = {{"layers", 2}};
  folder.write("next.glb", text_of(scene.glb()));
  ASSERT_TRUE(is_layered_scene(folder.path("next.glb")));
  EXPECT_NE(run("view " + folder.path("next.glb") + " --export " + folder.path("site")), 0);
  EXPECT_NE(err.find("version 2"), std::string::npos) << err;
}

}  // namespace ods::view_layers_test
