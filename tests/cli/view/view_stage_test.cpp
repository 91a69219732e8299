// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in stereo pictures with depth: the command and its files, and in Chromium against closed forms:
// vertices against the library's own projection, outlines against the rays of the stereo camera, in the page and in an
// emulated headset. tests/web/stage-test.js drives the browser.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "cli/view/export_site.h"
#include "ods/kernel/camera/project.h"
#include "ods/view/camera_json.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"
#include "tests/support/stored_pictures.h"

namespace ods::view_stage_test {

using Json = nlohmann::json;

constexpr auto kPatience = std::chrono::seconds(300);
constexpr Extent kEye{1024, 512}, kView{240, 180};

struct Box {
  vec3 low, high;
};
constexpr vec3 kPlace(0.4f, 1.5f, 0.3f);  // of the viewer
constexpr float kYaw = 30.0f;
constexpr Box kRoom{{-3, 0, -3}, {3, 2.8f, 3}};

// The world: its middle is ahead, which is 30 degrees to the right of -Z. heading: degrees to the right of ahead.
vec3 at_heading(float heading, float away, float height) {
  const float angle = glm::radians(kYaw + heading);
  return {kPlace.x + away * std::sin(angle), height, kPlace.z - away * std::cos(angle)};
}

Box box_at(vec3 middle, float half) {
  return {middle - half, middle + half};
}

// Returns the distance at which a ray comes into a box, or leaves it (is_inside), or INFINITY.
float meet_box(const Ray& ray, const Box& box, bool is_inside = false) {
  float near = 0.0f, far = INFINITY;
  for (int i = 0; i < 3; i++) {
    const float a = (box.low[i] - ray.origin[i]) / ray.direction[i],
                b = (box.high[i] - ray.origin[i]) / ray.direction[i];
    near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
  }
  return near > far ? INFINITY : is_inside ? far : near;
}

// Pillars hide a part of each object.
std::vector<Box> pillars() {
  std::vector<Box> all;
  for (const float heading : {6.0f, 52.0f}) {
    const vec3 foot = at_heading(heading, 0.8f, 0.0f);
    all.push_back({foot - vec3(0.05f, 0.0f, 0.05f), foot + vec3(0.05f, 1.56f, 0.05f)});
  }
  return all;
}

float distance_of(const Ray& ray) {
  float least = meet_box(ray, kRoom, true);
  for (const Box& pillar : pillars()) least = std::min(least, meet_box(ray, pillar));
  return least;
}

struct Cube {
  vec3 at;
  float half;
};
// Ahead, where the head is turned by 48 degrees, and standing on the floor.
std::vector<Cube> cubes() {
  return {{at_heading(0.0f, 1.2f, 1.55f), 0.12f},
          {at_heading(48.0f, 1.0f, 1.5f), 0.1f},
          {at_heading(20.0f, 2.0f, 0.2f), 0.2f}};
}

float cube_distance(const Ray& ray) {
  float least = INFINITY;
  for (const auto& [at, half] : cubes()) least = std::min(least, meet_box(ray, box_at(at, half)));
  return least;
}

StereoCamera stereo_of() {
  StereoCamera stereo;
  stereo.projection = projection_named("lat-long");
  stereo.position = kPlace;
  stereo.yaw = kYaw;
  stereo.top = stereo.bottom = kUsualMerge;
  return stereo;
}

// The line of sight of an eye in a direction of the camera's frame.
Ray sight(int eye, vec3 direction) {
  static const StereoCamera stereo = stereo_of();
  return camera_ray(make_camera(stereo), eye, direction_to_lat_long(direction));
}

// The direction of a point of a view, from its upper left corner, 0..1.
vec3 view_direction(vec2 at, float yaw, float pitch, Extent view) {
  const float high = static_cast<float>(view.height) / static_cast<float>(view.width);
  const float p = glm::radians(pitch), y = glm::radians(yaw), up = (1.0f - 2.0f * at.y) * high,
              across = 2.0f * at.x - 1.0f;
  const vec3 level(across, std::sin(p) + up * std::cos(p), up * std::sin(p) - std::cos(p));
  return {level.x * std::cos(y) - level.z * std::sin(y), level.y, level.z * std::cos(y) + level.x * std::sin(y)};
}

class Stage : public Cli {
 protected:
  std::string projection = "lat-long";  // of the picture,
  Extent size = kEye;                   // and of each eye

  // The room as a picture with depth; returns its path.
  std::string save_room(const std::string& name = "room_360_TB.exr", bool has_depth = true) {
    StereoCamera stereo = stereo_of();
    stereo.projection = projection_named(projection);
    const Camera camera = make_camera(stereo);
    MadePicture made = make_picture(stereo, size, {kLeft, kRight});
    add_colour(made, [camera](int eye, vec2 uv, float* to) {
      const Ray ray = camera_ray(camera, eye, uv);
      const vec3 at = ray.origin + distance_of(ray) * ray.direction;
      const float tile = std::fmod(std::floor(2.0f * at.x) + std::floor(2.0f * at.y) + std::floor(2.0f * at.z), 2.0f);
      to[0] = to[2] = 0.2f, to[1] = tile == 0.0f ? 0.1f : 0.3f;
    });
    if (has_depth) {
      add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat,
                       [camera](int eye, vec2 uv, float* to) { *to = distance_of(camera_ray(camera, eye, uv)); });
    }
    made.picture.is_float = true;
    SaveOptions save;
    save.layout = Layout::kTopBottom;
    const std::string path = folder.path(name);
    const Conversion conversion = convert(made.picture, same_format(made.picture));
    save_picture(conversion.rows, keeps_layers(path) ? &made.picture.camera : nullptr, save, path);
    return path;
  }

  std::string browse(Json job) {
    if (!job.contains("cases")) {
      ViewItem item = open_view_item(save_room());
      OpenOptions open;
      item.stage = std::make_shared<const PictureStage>(make_stage(open_picture(item.path, open)));
      export_site({item}, folder.path("site"), {}, nullptr);
    }
    const auto site = [this](const WebRequest& request) -> WebAnswer {
      const std::string file = folder.path("site/" + request.path), type(media_type(request.path));
      if (std::filesystem::is_regular_file(file)) return {.type = type, .file = file};
      const PageFile* const page = find_page_file(request.path);
      return page ? WebAnswer{.type = type, .body = std::string(page->data)} : nothing_there();
    };
    return run_harness(
        {chromium(folder.path("profile")), folder.path(""), Json::array({std::move(job)}).dump(), site, kPatience});
  }

  static Json placed(const std::vector<Cube>& all) {
    Json list = Json::array();
    for (const auto& [at, half] : all) list.push_back({{"at", {at.x, at.y, at.z}}, {"half", half}});
    return list;
  }

  static Json looks_job(const char* part, const Json& looks, Extent view = kView) {
    return {{"stage", part},
            {"width", view.width},
            {"height", view.height},
            {"objects", placed(cubes())},
            {"looks", looks}};
  }

  void need_browser() { NEEDS_CHROMIUM(); }
};

struct Counts {
  int seen = 0, hidden = 0, wrong = 0;
  std::string first;
};

// Compares a sent picture with the rays of an eye. Only pixels beside an edge of the true outline may differ.
Counts compare_outline(const std::string& path, int column, int eye, float yaw, float pitch, Extent view = kView,
                       float tangent = 1.0f, float texel = 1.8f) {
  const Image image = part_of_sent(path, column, view);
  Counts counts;
  const auto kind_at = [&](float x, float y) {
    const vec2 at((x / static_cast<float>(view.width) - 0.5f) * tangent + 0.5f,
                  (y / static_cast<float>(view.height) - 0.5f) * tangent + 0.5f);
    const Ray ray = sight(eye, view_direction(at, yaw, pitch, view));
    const float cube = cube_distance(ray), room = distance_of(ray);
    return cube < room ? 'c' : cube < INFINITY ? 'h' : 'r';
  };
  for (int y = 0; y < view.height; y++) {
    for (int x = 0; x < view.width; x++) {
      const float fx = static_cast<float>(x) + 0.5f, fy = static_cast<float>(y) + 0.5f;
      const char kind = kind_at(fx, fy);
      bool is_edge = false;
      // Outlines are exact to a pixel; what hides is exact to the picture's own texels, by default 1.2 pixels.
      for (const float off : {-1.0f, 1.0f})
        is_edge = is_edge || kind_at(fx + off, fy) != kind || kind_at(fx, fy + off) != kind;
      for (const float off : {-texel, texel}) {
        is_edge = is_edge || (kind != 'r' && (kind_at(fx + off, fy) != kind || kind_at(fx, fy + off) != kind));
      }
      if (is_edge) continue;
      const float* const pixel = image.at(x, y);
      const bool is_green = pixel[1] > 0.94f && pixel[0] < 0.94f;
      counts.seen += kind == 'c', counts.hidden += kind == 'h';
      if (is_green == (kind == 'c')) continue;
      if (counts.wrong++ == 0)
        counts.first = fmt::format("{} at {}, {}: {} {} {}", kind, x, y, pixel[0], pixel[1], pixel[2]);
    }
  }
  return counts;
}

// --- the shader's formula -------------------------------------------------------------------------------------------

std::vector<StereoCamera> cameras() {
  StereoCamera plain;
  plain.projection = projection_named("lat-long");
  std::vector<StereoCamera> all(7, plain);
  all[1].top = all[1].bottom = kUsualMerge;
  all[2].top = all[2].bottom = {kMergeCosine, 0.0f, 90.0f, 1.0f};
  all[3].top = {kMergeLinear, 60.0f, 75.0f, 1.0f}, all[3].bottom = {kMergeSmoothstep, 40.0f, 90.0f, 1.0f};
  all[4].neck = 0.08f, all[4].top = all[4].bottom = kUsualMerge;
  all[5].convergence = kToeIn;
  all[6].convergence = kShift, all[6].axis = vec3(0.0f, 0.8f, 0.6f);
  return all;
}

TEST_F(Stage, VerticesAreSeenAsTheLibraryProjectsThem) {
  need_browser();
  std::mt19937 random(7);
  std::uniform_real_distribution<float> heading(-kPi, kPi), height(-1.2f, 1.2f), away(std::log(0.35f), std::log(30.0f));
  Json cases = Json::array();
  for (const StereoCamera& stereo : cameras()) {
    const Camera camera = make_camera(stereo);
    for (const int eye : {kLeft, kRight, kMono}) {
      Json points = Json::array(), seen = Json::array();
      for (int i = 0; i < 200; i++) {
        const float a = heading(random), h = height(random), d = std::exp(away(random));
        const vec3 point = d * vec3(std::sin(a) * std::cos(h), std::sin(h), -std::cos(a) * std::cos(h));
        const ImagePosition position = project_point(camera, eye, point);
        if (!position.seen) continue;
        const vec3 from = point - position.origin;
        points.push_back({point.x, point.y, point.z});
        seen.push_back({from.x, from.y, from.z});
      }
      EXPECT_GT(points.size(), 150u);
      cases.push_back({{"camera", camera_json(camera, true)}, {"eye", eye}, {"points", points}, {"seen", seen}});
    }
  }
  ASSERT_EQ(browse({{"stage", "vertices"}, {"cases", cases}}), "ok");
  fmt::print("largest error of a vertex: {} minutes of arc\n", folder.read("worst"));
}

// --- what is seen ---------------------------------------------------------------------------------------------------

// The looks whose outlines are compared: name, mode, yaw, pitch, moves. All are drawn in one session of the browser, which
// takes longer to start than to draw.
Json outline_looks() {
  Json looks = Json::array();
  for (const auto& [yaw, moves] : {std::pair{0, false}, {48, false}, {48, true}, {20, true}}) {
    for (const char* const mode : {"left", "right"}) {
      looks.push_back({{"name", fmt::format("{}{}{}", mode, yaw, moves)},
                       {"mode", mode},
                       {"yaw", yaw},
                       {"pitch", yaw == 20 ? -30 : 0},
                       {"moves", moves}});
    }
  }
  return looks;
}

void expect_outlines(const TemporaryFolder& folder) {
  for (const Json& look : outline_looks()) {
    const std::string name = look["name"];
    const int eye = look["mode"] == "left" ? kLeft : kRight;
    const Counts counts = compare_outline(folder.path(name), 0, eye, look["yaw"], look["pitch"]);
    EXPECT_EQ(counts.wrong, 0) << name << ": " << counts.first;
    EXPECT_GT(counts.seen, 100) << name;
    EXPECT_GT(counts.hidden, look["yaw"] == 20 ? -1 : 20) << name;
    // The other eye's outline, and that of an eye in the middle, are different: the test can fail.
    for (const int other : {1 - eye, static_cast<int>(kMono)}) {
      EXPECT_GT(compare_outline(folder.path(name), 0, other, look["yaw"], look["pitch"]).wrong, 20) << name;
    }
  }
}

void expect_sides(const TemporaryFolder& folder) {
  for (int i = 0; i < 2; i++) {
    const int column = i * kView.width;
    EXPECT_EQ(compare_outline(folder.path("both"), column, i, 48, 0).wrong, 0) << i;
    EXPECT_EQ(compare_outline(folder.path("swapped"), column, 1 - i, 48, 0).wrong, 0) << i;
  }
}

// The floor beside the foot of a cube gets darker, nothing gets brighter, and what is far from all cubes is the same.
void expect_shadows(const TemporaryFolder& folder) {
  const Image shaded = part_of_sent(folder.path("shaded"), 0, kView),
              plain = part_of_sent(folder.path("plain"), 0, kView);
  const vec3 foot = cubes()[2].at;
  int darker = 0, far = 0;
  for (int y = 0; y < kView.height; y++) {
    for (int x = 0; x < kView.width; x++) {
      const vec2 at((static_cast<float>(x) + 0.5f) / static_cast<float>(kView.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(kView.height));
      const Ray ray = sight(kLeft, view_direction(at, 20, -30, kView));
      const float after = shaded.at(x, y)[1], before = plain.at(x, y)[1];
      ASSERT_LE(after, before + 1.5f / 255.0f) << x << " " << y;
      if (cube_distance(ray) < distance_of(ray) + 0.02f) continue;
      const vec3 place = ray.origin + distance_of(ray) * ray.direction;
      darker += after < 0.95f * before && place.y < 0.01f && length(place - foot) < 0.8f;
      const bool is_far =
          std::ranges::all_of(cubes(), [&](const Cube& cube) { return length(place - cube.at) > 1.8f; });
      far += is_far;
      ASSERT_TRUE(!is_far || std::abs(after - before) < 1.5f / 255.0f) << x << " " << y;
    }
  }
  EXPECT_GT(darker, 50);
  EXPECT_GT(far, 50);
}

// Rays of both eyes, and their distances in the room.
Json some_rays() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> heading(-kPi, kPi), rise(-1.0f, 1.0f);
  Json rays = Json::array();
  for (int i = 0; i < 600; i++) {
    const float a = heading(random), y = rise(random), level = std::sqrt(1.0f - y * y);
    const vec3 direction(level * std::sin(a), y, -level * std::cos(a));
    const int eye = i % 2;
    rays.push_back({{"along", {direction.x, direction.y, direction.z}},
                    {"eye", eye},
                    {"away", distance_of(sight(eye, direction))}});
  }
  return rays;
}

// Away from the edges of surfaces, which are as exact as the picture's texels.
void expect_distances(const TemporaryFolder& folder) {
  std::vector<float> errors = Json::parse(folder.read("meets.json")).get<std::vector<float>>();
  std::ranges::sort(errors);
  const float middle = errors[errors.size() / 2], most = errors[errors.size() * 99 / 100];
  fmt::print("the test of depth: median {:.2f} mm, p99 {:.2f} mm, width {}\n", 1000.0f * middle, 1000.0f * most,
             kEye.width);
  EXPECT_LT(middle, 0.002f);
  EXPECT_LT(most, 0.010f);
}

TEST_F(Stage, TheyAreSeenAsByTheCameraWhereverTheHeadTurns) {
  need_browser();
  Json job = looks_job("looks", outline_looks());
  job["rays"] = some_rays();
  const Json both = {{"mode", "side-by-side"}, {"yaw", 48}, {"width", 2 * kView.width}};
  for (const auto& [name, swap] : {std::pair{"both", false}, {"swapped", true}}) {
    Json look = both;
    look["name"] = name, look["swap"] = swap;
    job["looks"].push_back(look);
  }
  for (const auto& [name, shade] : {std::pair{"shaded", true}, {"plain", false}})
    job["looks"].push_back({{"name", name}, {"yaw", 20}, {"pitch", -30}, {"shade", shade}});
  ASSERT_EQ(browse(job), "ok");
  expect_outlines(folder), expect_sides(folder), expect_shadows(folder), expect_distances(folder);
}

// A half of the sphere, cubes whose faces meet behind an object, and a picture that is squeezed to half its width.
struct OtherPicture {
  const char* projection;
  Extent size;
  std::vector<float> yaws;
  float texel;  // pixels of the view that hide together
};

TEST_F(Stage, TheyAreSeenInEveryKindOfPicture) {
  need_browser();
  for (const OtherPicture& other :
       {OtherPicture{"vr180", {512, 512}, {0, 40}, 1.8f}, OtherPicture{"cube-3x2", {768, 512}, {0, 48}, 2.5f},
        OtherPicture{"lat-long", {512, 512}, {0, 48}, 3.6f}}) {
    projection = other.projection, size = other.size;
    Json looks = Json::array();
    for (const float yaw : other.yaws) {
      looks.push_back({{"name", fmt::format("{}-{}-{}", projection, size.width, yaw)}, {"yaw", yaw}});
    }
    ASSERT_EQ(browse(looks_job("looks", looks)), "ok") << projection;
    for (size_t i = 0; i < other.yaws.size(); i++) {
      const std::string path = folder.path(looks[i]["name"].get<std::string>());
      const Counts counts = compare_outline(path, 0, kLeft, other.yaws[i], 0, kView, 1.0f, other.texel);
      EXPECT_EQ(counts.wrong, 0) << path << ": " << counts.first;
      EXPECT_GT(counts.seen, 100) << path;
    }
  }
}

TEST_F(Stage, AHeadsetsEyesSeeThemInTheirPlaces) {
  need_browser();
  NEEDS_IWER();
  const Json looks = {{{"name", "ahead"}, {"yaw", 0}}, {{"name", "turned"}, {"yaw", 48}}};
  const Extent eye_view{240, 240};
  ASSERT_EQ(browse(looks_job("wear", looks, {480, 240})), "ok");
  for (int eye = 0; eye < 2; eye++) {
    for (const auto& [name, yaw] : {std::pair("ahead", 0.0f), std::pair("turned", 48.0f)}) {
      const Counts counts = compare_outline(folder.path(name), eye * eye_view.width, eye, yaw, 0, eye_view);
      EXPECT_EQ(counts.wrong, 0) << name << " " << eye << ": " << counts.first;
      EXPECT_GT(counts.seen, 100) << name;
    }
  }
}

// An object that is dragged stands on the picture's floor.
TEST_F(Stage, DragsMoveThemOverThePicturesSurfaces) {
  need_browser();
  const Cube cube = {at_heading(0.0f, 1.8f, 0.15f), 0.15f};
  const vec3 to = at_heading(-14.0f, 1.6f, 0.15f);
  const auto seen_at = [&](vec3 point) -> Json {
    static const StereoCamera stereo = stereo_of();
    const ImagePosition position = project_point(make_camera(stereo), kLeft, point);
    const vec3 world = point - position.origin;
    const Camera camera = make_camera(stereo);
    const vec3 d(dot(world, camera.right), dot(world, camera.up), dot(world, camera.back));
    const float p = glm::radians(-40.0f), up = d.y * std::cos(p) + d.z * std::sin(p),
                ahead = d.y * std::sin(p) - d.z * std::cos(p);
    return {(d.x / ahead + 1.0f) / 2.0f * static_cast<float>(kView.width),
            static_cast<float>(kView.height) / 2.0f - up / ahead * static_cast<float>(kView.width) / 2.0f};
  };
  // The pointer goes as the foot of the cube goes.
  const Json from = seen_at(cube.at), foot = seen_at(cube.at - vec3(0, 0.15f, 0)),
             there = seen_at(to - vec3(0, 0.15f, 0));
  Json job = looks_job("drag", {{{"name", "before"}, {"yaw", 0}, {"pitch", -40}}});
  job["objects"] = placed({cube});
  job["from"] = from;
  job["to"] = {from[0].get<float>() + there[0].get<float>() - foot[0].get<float>(),
               from[1].get<float>() + there[1].get<float>() - foot[1].get<float>()};
  ASSERT_EQ(browse(job), "ok");
  const Json place = Json::parse(folder.read("place"));
  for (int i = 0; i < 3; i++)
    EXPECT_NEAR(place["at"][static_cast<size_t>(i)].get<float>(), to[i], i == 1 ? 0.01f : 0.05f) << i;
  EXPECT_TRUE(place["command"].get<std::string>().starts_with(
      "ods render SCENE --position 0.4,1.5,0.3 --yaw 30 --with 'thing 0.glb' --at "))
      << place["command"];
}

// --- the command ----------------------------------------------------------------------------------------------------

TEST_F(Stage, ASiteHasTheDepthAndTheObjects) {
  const std::string path = save_room(), end = " --export " + folder.path("site");
  ASSERT_EQ(run("view " + path + " --with toys" + end), 0) << err;
  const Json item = Json::parse(folder.read("site/view.json"))["items"][0];
  EXPECT_EQ(item["objects"].size(), 1u);
  EXPECT_EQ(item["stage"]["depth"], "item/0/depth.png");
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/item/0/depth.png.js")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/item/0/object-0.glb")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/later-objects.js")));
  EXPECT_NEAR(item["objects"][0]["at"][1].get<float>(), 0.0f, 0.02f) << "not on the floor";
  ASSERT_EQ(run("view " + path + end), 0) << err;
  EXPECT_FALSE(Json::parse(folder.read("site/view.json"))["items"][0].contains("stage")) << "no object, no depth";
  folder.write("room_360_TB.objects.json", R"({"objects": [{"file": "toys", "at": [1, 2, 3]}]})");
  ASSERT_EQ(run("view " + path + end), 0) << err;
  EXPECT_EQ(Json::parse(folder.read("site/view.json"))["items"][0]["objects"][0]["at"], Json::parse("[1, 2, 3]"));
}

TEST_F(Stage, APictureWithoutDepthIsOneLine) {
  const std::string path = save_room("room_360_TB.png", false), end = " --export " + folder.path("site");
  EXPECT_EQ(run("view " + path + " --with toys --at 1,2,3" + end), 2);
  EXPECT_NE(err.find("has no depth"), std::string::npos) << err;
  EXPECT_NE(err.find("--depth FILE"), std::string::npos) << err;
  EXPECT_EQ(run("view " + path + " --near 1 --with toys" + end), 2);
  EXPECT_EQ(run("view " + path + " --depth " + path + end), 2) << err;
  EXPECT_NE(err.find("--with"), std::string::npos) << err;
}

// A picture's depth from another file.
TEST_F(Stage, DepthMayBeInAFileBesideThePicture) {
  const std::string depth = save_room("depth.exr"), path = save_room("room_360_TB.png", false);
  ASSERT_EQ(run("view " + path + " --depth " + depth + " --with toys --at 1,2,3 --export " + folder.path("site")), 0)
      << err;
  EXPECT_NE(err.find("no light above white"), std::string::npos) << err;
  const Json item = Json::parse(folder.read("site/view.json"))["items"][0];
  EXPECT_EQ(item["stage"]["eyes"], 2);
  EXPECT_EQ(item["live"], false);
}

}  // namespace ods::view_stage_test
