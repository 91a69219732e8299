// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Slits against the exact camera: where points come to lie, and what stitched pictures look like.
#include "ods/stitch/stitch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ods/base/error.h"
#include "ods/kernel/camera/project.h"
#include "ods/stitch/slit_error.h"
#include "ods/stitch/view_files.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods::stitch_test {

const std::vector<int> kBoth = {kLeft, kRight};

SlitRig make_rig(int slits, Extent eye = {512, 256}, StereoCamera camera = {}) {
  SlitOptions options;
  options.slits = slits;
  EXPECT_EQ(slit_fault(camera, eye, options), "");
  return make_slit_rig(camera, eye, kBoth, options);
}

// --- where points lie -----------------------------------------------------------------------------------------------

double angle_between(vec3 a, vec3 b) {
  const glm::dvec3 x(a), y(b);
  return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y));
}

// The maximum displacement of a point by the views that show a direction of the picture.
struct Off {
  double angle = 0.0;
  float latitude = 0.0f;
  float distance = 0.0f;
};
Off off_at(const SlitRig& rig, size_t eye, vec3 point) {
  const Camera camera = make_camera(rig.camera);
  const ImagePosition exact = project_point(camera, rig.eyes[eye], point);
  Off off;
  off.latitude = camera.projection.center.y + (0.5f - exact.uv.y) * camera.projection.span.y;
  off.distance = exact.depth;
  const vec3 looks = camera_ray(camera, rig.eyes[eye], exact.uv).direction;
  for (int slit = 0; slit < rig.options.slits; slit++) {
    for (int pitch = 0; pitch < rig.options.pitches; pitch++) {
      // The direction in which this view sees the point is the picture's place where it is shown.
      const vec3 seen = normalize(point - rig.views[view_index(rig, eye, slit, pitch)].position);
      const float longitude = std::atan2(seen.x, -seen.z), latitude = std::asin(seen.y);
      const float beside = std::remainder(longitude - slit_longitude(rig, slit), 2.0f * kPi);
      const bool in_slit = std::abs(beside) <= 0.5f * slit_width(rig) * (1.0f + rig.options.blend);
      const float fade = pitch_fade(rig);
      const bool in_pitch =
          latitude <= pitch_border(rig, pitch - 1) + fade && latitude >= pitch_border(rig, pitch) - fade;
      if (in_slit && in_pitch) off.angle = std::max(off.angle, angle_between(looks, seen));
    }
  }
  return off;
}

TEST(SlitError, NoPointIsOffByMoreAndSomeAreByHalf) {
  StereoCamera merged;
  merged.top = merged.bottom = {kMergeCosine, 30.0f, 90.0f, 1.0f};
  for (const auto& [camera, caps] : {std::pair(StereoCamera(), false), {merged, false}, {StereoCamera(), true}}) {
    SlitOptions options;
    options.slits = 24, options.pitches = caps ? 3 : 2, options.caps = caps;
    const SlitRig rig = make_slit_rig(camera, {1024, 512}, kBoth, options);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> any(-1.0f, 1.0f);
    for (const float distance : {0.4f, 1.0f, 5.0f}) {
      for (const float elevation : {0.0f, 0.3f, 0.7f, 1.2f, 1.5f, -0.5f}) {
        double maximum = 0.0;
        float bound = 0.0f;
        for (int i = 0; i < 400; i++) {
          const float theta = any(random) * kPi;
          const vec3 point = distance * vec3(std::sin(theta) * std::cos(elevation), std::sin(elevation),
                                             -std::cos(theta) * std::cos(elevation));
          const ImagePosition exact = project_point(make_camera(camera), rig.eyes[static_cast<size_t>(i % 2)], point);
          if (!exact.seen) continue;  // within the circle
          const Off off = off_at(rig, static_cast<size_t>(i % 2), point);
          bound = slit_error(rig, off.latitude, off.distance).whole;
          EXPECT_LE(off.angle, bound) << distance << " " << elevation;
          maximum = std::max(maximum, off.angle);
        }
        if (maximum > 0.0) {  // else all were within the circle
          EXPECT_GE(maximum, 0.5f * bound) << distance << " m, " << elevation;
        }
      }
    }
  }
}

TEST(SlitError, IsTheClosedForm) {
  const SlitRig rig = make_rig(360, {4096, 2048});
  const float r = 0.5f * rig.camera.ipd, reach = 0.5f * slit_width(rig) * 1.5f, phi = glm::radians(60.0f);
  const SlitError error = slit_error(rig, phi, 1.0f);
  EXPECT_NEAR(error.across, r * (1.0f - std::cos(reach)), 0.01f * error.across);
  EXPECT_NEAR(error.along, r * std::sin(reach) * std::sin(phi), 0.01f * error.along);
  EXPECT_NEAR(picture_pixels(rig, error.step), 0.32f, 0.01f);  // science: 0.64 of a picture 8192 wide
}

TEST(SlitError, ASlitForEveryColumnIsTheExactPicture) {
  const SlitRig rig = make_rig(2048, {2048, 1024});
  EXPECT_LT(picture_pixels(rig, largest_slit_error(rig, 1.0f).whole), 0.05f);
}

TEST(SlitError, PlansTheFewestSlitsThatAreEnough) {
  const Extent eye{4096, 2048};
  SlitOptions options;
  options.slits = slits_for(StereoCamera(), eye, options, 1.0f, 0.5f);
  EXPECT_NEAR(options.slits, 266, 3);  // science.md: r W / (p d)
  const auto pixels = [&] {
    const SlitRig rig = make_slit_rig(StereoCamera(), eye, {kRight}, options);
    const SlitError error = largest_slit_error(rig, 1.0f);
    return picture_pixels(rig, std::max(error.whole, error.step));
  };
  EXPECT_LE(pixels(), 0.5f);
  options.slits--;
  EXPECT_GT(pixels(), 0.5f);
  options.depth = ViewDepth::kRay;
  EXPECT_NEAR(slits_for(StereoCamera(), eye, options, 1.0f, 0.5f), 27, 1);
  StereoCamera merged;
  merged.top.mode = kMergeCosine;
  EXPECT_THROW(slits_for(merged, eye, SlitOptions(), 1.0f, 0.25f), Error);
}

// A view's pixel is a step of its tangent; the way out from its middle makes it smaller, twice as fast along as across.
TEST(ViewDetail, IsTheClosedForm) {
  for (const float scale : {1.0f, 2.0f}) {
    SlitOptions options;
    options.slits = 360, options.scale = scale;
    const SlitRig rig = make_slit_rig({}, {4096, 2048}, kBoth, options);
    for (const float degrees : {-89.0f, -75.0f, -60.0f, -20.0f, 10.0f, 45.0f, 80.0f, 85.0f}) {
      const float latitude = glm::radians(degrees), out = std::cos(std::abs(latitude) - 0.25f * kPi) / scale;
      const ViewDetail detail = view_detail(rig, latitude);
      EXPECT_NEAR(detail.across, out / std::cos(latitude), 0.01f * detail.across) << degrees;
      EXPECT_NEAR(detail.along, out * out * scale, 0.01f * detail.along) << degrees;
      EXPECT_NEAR(detail.angle, out * 2.0f * kPi / 4096.0f, 0.01f * detail.angle) << degrees;
    }
  }
}

// --- pictures -------------------------------------------------------------------------------------------------------

// The colour that a ray hits on a ball of 2 m around the centre, with smooth colours; in front of it, optionally, a
// smaller grey ball.
struct Met {
  vec3 colour;
  float distance;
};
Met meet(const Ray& ray, bool with_ball) {
  const auto hit = [&](vec3 centre, float radius, float sign) {
    const vec3 from = ray.origin - centre;
    const float along = dot(from, ray.direction), inside = along * along - dot(from, from) + radius * radius;
    return inside < 0.0f ? -1.0f : -along + sign * std::sqrt(inside);
  };
  const float ball = with_ball ? hit(vec3(0.3f, 0.5f, -0.9f), 0.2f, -1.0f) : -1.0f;
  const float t = ball > 0.0f ? ball : hit(vec3(0.0f), 2.0f, 1.0f);
  const vec3 p = ray.origin + t * ray.direction;
  if (ball > 0.0f) return {vec3(0.5f + 0.3f * std::sin(30.0f * p.y)), t};
  return {0.5f + 0.4f * vec3(std::sin(7.0f * p.x + 3.0f * p.y), std::sin(8.0f * p.y), std::sin(6.0f * p.z)), t};
}

PixelFunction colours(const StereoCamera& rig, bool with_ball) {
  return [camera = make_camera(rig), with_ball](int eye, vec2 uv, float* out) {
    const vec3 colour = meet(camera_ray(camera, eye, uv), with_ball).colour;
    for (int c = 0; c < 3; c++) out[c] = colour[c];
  };
}

// kPlane: what a depth buffer would hold.
PixelFunction depths(const StereoCamera& rig, bool with_ball, ViewDepth depth) {
  return [camera = make_camera(rig), with_ball, depth](int eye, vec2 uv, float* out) {
    const Ray ray = camera_ray(camera, eye, uv);
    *out = meet(ray, with_ball).distance * (depth == ViewDepth::kPlane ? -dot(ray.direction, camera.back) : 1.0f);
  };
}

struct Views {
  std::vector<MadePicture> made;
  OpenView open = [this](size_t i) { return made[i].picture; };
};
void make_views(const SlitRig& rig, bool with_ball, Views& views) {
  for (const StereoCamera& view : rig.views) {
    views.made.push_back(make_picture(view, rig.view, {kMono}));
    views.made.back().memory.reserve(2);
    add_colour(views.made.back(), colours(view, with_ball));
    if (rig.options.depth == ViewDepth::kNone) continue;
    add_layer<float>(views.made.back(), {"Z"}, LayerRule::kNearest, SampleType::kFloat,
                     depths(view, with_ball, rig.options.depth));
  }
}

// Decibels of the colours against the camera's own picture; of other layers, the largest error.
struct Judged {
  double psnr;
  double depth_off = 0.0;
  std::vector<Image> images;
};
Judged judge(const SlitRig& rig, const Stitched& stitched, bool with_ball) {
  Judged judged{0.0, 0.0, images_of(stitched.rows)};
  const Camera camera = make_camera(rig.camera);
  double sum = 0.0;
  for (size_t eye = 0; eye < 2; eye++) {
    const Image& image = judged.images[eye];
    for (int y = 0; y < image.height; y++) {
      for (int x = 0; x < image.width; x++) {
        const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                      (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height));
        const Met met = meet(camera_ray(camera, rig.eyes[eye], uv), with_ball);
        for (int c = 0; c < 3; c++) sum += std::pow(static_cast<double>(image.at(x, y)[c] - met.colour[c]), 2.0);
        if (image.channels == 4) {
          judged.depth_off =
              std::max(judged.depth_off, std::abs(static_cast<double>(image.at(x, y)[3] - met.distance)));
        }
      }
    }
  }
  judged.psnr = -10.0 * std::log10(sum / (6.0 * rig.eye.width * rig.eye.height));
  return judged;
}

Judged stitched_psnr(const SlitRig& rig, bool with_ball = false) {
  Views views;
  make_views(rig, with_ball, views);
  const Stitched stitched = stitch(rig, views.open, {});
  EXPECT_TRUE(stitched.faults.empty());
  return judge(rig, stitched, with_ball);
}

TEST(Stitch, IsTheDirectPicture) {
  EXPECT_GT(stitched_psnr(make_rig(64, {256, 128})).psnr, 60.0);
  StereoCamera camera;  // elsewhere, turned and tilted
  camera.position = {0.1f, -0.2f, 0.05f};
  camera.yaw = 77.0f, camera.pitch = 20.0f, camera.roll = -10.0f, camera.ipd = 0.1f;
  EXPECT_GT(stitched_psnr(make_rig(64, {256, 128}, camera)).psnr, 60.0);
}

TEST(Stitch, ConvergesWithMoreSlits) {
  StereoCamera camera;
  camera.ipd = 0.4f;  // so that it shows
  const double few = stitched_psnr(make_rig(16, {256, 128}, camera)).psnr;
  const double more = stitched_psnr(make_rig(64, {256, 128}, camera)).psnr;
  const double all = stitched_psnr(make_rig(256, {256, 128}, camera)).psnr;
  EXPECT_GT(more, few + 8.0);
  EXPECT_GT(all, more + 3.0);
}

// Decibels of the lowest 15 degrees, of a pattern of waves about four pixels of the horizon long.
double psnr_near_the_pole(int slits, float scale) {
  SlitOptions options;
  options.slits = slits, options.scale = scale;
  const SlitRig rig = make_slit_rig({}, {128, 64}, {kLeft}, options);
  const auto wave = [](const Camera& camera, int eye, vec2 uv, Extent size) {  // the mean of a pixel
    constexpr int kSamples = 4;
    float sum = 0.0f;
    for (int i = 0; i < kSamples * kSamples; i++) {
      const vec2 in_pixel((static_cast<float>(i % kSamples) + 0.5f) / kSamples - 0.5f,
                          (static_cast<float>(i / kSamples) + 0.5f) / kSamples - 0.5f);
      const Ray ray = camera_ray(camera, eye, uv + in_pixel / vec2(size.width, size.height));
      const vec3 p = ray.origin + ray.direction * (1.6f / std::abs(ray.direction.y));  // floor and ceiling
      sum += 0.5f + 0.4f * std::sin(20.0f * p.x) * std::sin(20.0f * p.z);
    }
    return sum / (kSamples * kSamples);
  };
  std::vector<MadePicture> made;
  for (const StereoCamera& view : rig.views) {
    made.push_back(make_picture(view, rig.view, {kMono}));
    made.back().memory.reserve(1);
    add_colour(made.back(), [&, camera = make_camera(view)](int, vec2 uv, float* out) {
      for (int c = 0; c < 3; c++) out[c] = wave(camera, kMono, uv, rig.view);
    });
  }
  const Image image = images_of(stitch(rig, [&](size_t i) { return made[i].picture; }, {}).rows)[0];
  double sum = 0.0;
  const int from = image.height * 11 / 12;
  for (int y = from; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / 128.0f, (static_cast<float>(y) + 0.5f) / 64.0f);
      sum += std::pow(static_cast<double>(image.at(x, y)[0] - wave(make_camera(rig.camera), kLeft, uv, rig.eye)), 2.0);
    }
  }
  return -10.0 * std::log10(sum / (128.0 * (image.height - from)));
}

TEST(Stitch, NearThePolesFinerViewsAreSharperAndMoreSlitsAreNot) {
  const double usual = psnr_near_the_pole(32, 1.0f);
  EXPECT_NEAR(psnr_near_the_pole(128, 1.0f), usual, 1.5);
  EXPECT_GT(psnr_near_the_pole(32, 2.0f), usual + 3.0);
}

TEST(Stitch, PartsOfThePicture) {
  StereoCamera camera;
  camera.projection.longitude = {-90.0f, 90.0f};
  camera.projection.latitude = {-60.0f, 80.0f};
  EXPECT_GT(stitched_psnr(make_rig(40, {160, 124}, camera)).psnr, 55.0);
}

// Straight up and straight down, and the others where they leave off.
TEST(Stitch, CapsAreThePoles) {
  SlitOptions options;
  options.slits = 64, options.pitches = 4, options.caps = true;
  ASSERT_EQ(slit_fault({}, {256, 128}, options), "");
  const SlitRig rig = make_slit_rig({}, {256, 128}, kBoth, options);
  const float looks[] = {90.0f, 30.0f, -30.0f, -90.0f}, borders[] = {60.0f, 0.0f, -60.0f, -90.0f};
  for (int pitch = 0; pitch < 4; pitch++) {
    EXPECT_NEAR(rig.views[view_index(rig, 1, 5, pitch)].pitch, looks[pitch], 1e-3f);
    EXPECT_NEAR(glm::degrees(pitch_border(rig, pitch)), borders[pitch], 1e-3f);
  }
  EXPECT_GT(stitched_psnr(rig).psnr, 60.0);
  options.pitches = 2;
  EXPECT_NE(slit_fault({}, {256, 128}, options), "");
}

TEST(Stitch, PaddingDoesNotWidenViewsToHalfTheWorld) {
  for (const auto& [padding, scale] : {std::pair{4096, 1.0f}, {4, 0.01f}}) {
    SlitOptions options;
    options.slits = 64, options.padding = padding, options.scale = scale;
    EXPECT_NE(slit_fault({}, {256, 128}, options).find("with their padding"), std::string::npos) << padding;
  }
}

// Without a blend every pixel has one view, and those whose middles lie on borders have not none.
TEST(Stitch, NothingIsLostOnSharpBorders) {
  SlitOptions options;
  options.slits = 20, options.blend = 0.0f;
  const SlitRig rig = make_slit_rig({}, {250, 125}, kBoth, options);  // 12.5 columns a slit, 62.5 rows a pitch
  EXPECT_GT(stitched_psnr(rig).psnr, 50.0);
}

TEST(Stitch, OtherCameras) {
  StereoCamera neck, toed, shifted;
  neck.neck = 0.1f;
  toed.convergence = kToeIn, toed.convergence_distance = 3.0f;
  toed.projection.latitude = {-60.0f, 60.0f};
  shifted.convergence = kShift;
  EXPECT_GT(stitched_psnr(make_rig(128, {256, 128}, neck)).psnr, 50.0);
  EXPECT_GT(stitched_psnr(make_rig(64, {256, 84}, toed)).psnr, 55.0);
  EXPECT_GT(stitched_psnr(make_rig(64, {256, 128}, shifted)).psnr, 60.0);
}

TEST(Stitch, DepthPutsSurfacesWhereTheyBelong) {
  StereoCamera camera;
  camera.ipd = 0.3f;
  for (const ViewDepth depth : {ViewDepth::kRay, ViewDepth::kPlane}) {
    SlitRig rig = make_rig(12, {256, 128}, camera);
    const double without = stitched_psnr(rig).psnr;
    SlitOptions options = rig.options;
    options.depth = depth;
    rig = make_slit_rig(camera, rig.eye, kBoth, options);
    const Judged with = stitched_psnr(rig);
    EXPECT_GT(with.psnr, without + 15.0);
    EXPECT_GT(with.psnr, 50.0);
    EXPECT_LT(with.depth_off, 0.01);
  }
}

TEST(Stitch, CountsWhatIsHidden) {
  StereoCamera camera;
  camera.ipd = 0.3f;
  SlitOptions options;
  options.slits = 12;
  options.depth = ViewDepth::kRay;
  const SlitRig rig = make_slit_rig(camera, {256, 128}, kBoth, options);
  Views views;
  make_views(rig, true, views);
  const Stitched stitched = stitch(rig, views.open, {});
  EXPECT_GT(stitched.unseen, 0);
  EXPECT_LT(stitched.unseen, 256 * 128 / 50);
  EXPECT_GT(judge(rig, stitched, true).psnr, 30.0);
}

// --- faults ---------------------------------------------------------------------------------------------------------

TEST(Stitch, TellsAllViewsAtFault) {
  const SlitRig rig = make_rig(12, {64, 32});
  Views views;
  make_views(rig, false, views);
  const OpenView open = [&](size_t i) {
    if (i == 3 || i == 30) throw Error(ErrorKind::kInput, "it is not there");
    StoredPicture picture = views.made[i].picture;
    if (i == 7) picture.size.width--;
    return picture;
  };
  const Stitched stitched = stitch(rig, open, {});
  ASSERT_EQ(stitched.faults.size(), 3u);
  EXPECT_EQ(stitched.faults[0].view, 3u);
  EXPECT_EQ(stitched.faults[1].view, 7u);
  EXPECT_NE(stitched.faults[1].what.find("not"), std::string::npos);
  EXPECT_EQ(stitched.faults[2].view, 30u);
  const std::vector<Image> images = images_of(stitched.rows);
  EXPECT_EQ(images[0].at(8, 28)[0], 0.0f);  // the lower view of the second slit
  EXPECT_NE(images[0].at(8, 4)[0], 0.0f);
  EXPECT_THROW(stitch(rig, [](size_t) -> StoredPicture { throw Error(ErrorKind::kInput, "none"); }, {}), Error);
}

TEST(Stitch, EveryViewIsReadOnce) {
  const SlitRig rig = make_rig(40, {80, 40});
  Views views;
  make_views(rig, false, views);
  std::vector<std::atomic<int>> times(rig.views.size());
  const OpenView open = [&](size_t i) {
    times[i]++;
    return views.made[i].picture;
  };
  double last = 0.0;
  stitch(rig, open, {}, [&](double part) {
    EXPECT_GT(part, last);
    last = part;
  });
  EXPECT_EQ(last, 1.0);
  for (const auto& count : times) EXPECT_EQ(count, 1);
}

TEST(Stitch, GoesOnWhereAProcessWasKilled) {
  const TemporaryFolder folder;
  const SlitRig rig = make_rig(80, {160, 80});
  Views views;
  make_views(rig, false, views);
  std::atomic<int> opened{0};
  const OpenView open = [&](size_t i) {
    opened++;
    return views.made[i].picture;
  };
  StitchOptions options;
  options.journal = folder.path("journal");
  options.journal_key = 7;
  const auto stop = [](double part) {
    if (part >= 0.5) throw Error(ErrorKind::kInput, "killed");
  };
  EXPECT_THROW(stitch(rig, open, options, stop), Error);
  opened = 0;
  const Stitched rest = stitch(rig, open, options);
  EXPECT_LT(opened, static_cast<int>(rig.views.size() * 6 / 10));
  const std::vector<Image> images = images_of(rest.rows), direct = images_of(stitch(rig, open, {}).rows);
  for (size_t eye : {0u, 1u}) EXPECT_EQ(images[eye].pixels, direct[eye].pixels);
  opened = 0;
  options.journal_key = 8;                          // other views
  EXPECT_THROW(stitch(rig, open, options), Error);  // while the first picture is still open
  options.journal = folder.path("other");
  EXPECT_THROW(stitch(rig, open, options, stop), Error);
  opened = 0;
  options.journal_key = 9;
  const Stitched anew = stitch(rig, open, options);
  EXPECT_EQ(opened, static_cast<int>(rig.views.size()));
  EXPECT_EQ(images_of(anew.rows)[1].pixels, direct[1].pixels);
}

// Four views of 8x16 in a sheet of two columns: each is of one grey.
TEST(ViewFiles, SheetsHoldSeveralViews) {
  const TemporaryFolder folder;
  SlitRig rig = make_rig(4, {32, 16});
  rig.view = {8, 16};
  ViewFiles files{folder.path("sheet.##.png"), 2, 2};
  for (int number = 1; number <= 4; number++) {
    PictureRows rows;
    rows.eye = {16, 32}, rows.eyes = {kMono}, rows.layers = {{{"R", "G", "B"}}};
    rows.fill = [=](int, int y, std::span<float> row) {
      for (size_t i = 0; i < row.size(); i++) row[i] = 0.1f * static_cast<float>(2 * (y / 16) + (i / 3 < 8 ? 0 : 1));
    };
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(rows, nullptr, save, folder.path("sheet.0" + std::to_string(number) + ".png"));
  }
  ASSERT_EQ(names_fault(rig, files), "");
  EXPECT_TRUE(missing_views(rig, files, true).empty());
  for (const bool by_columns : {false, true}) {
    files.by_columns = by_columns;
    const OpenView open = open_view_files(rig, files);
    for (size_t i = 0; i < rig.views.size(); i++) {
      const StoredPicture view = open(i);
      EXPECT_EQ(view.size.width, 8);
      const size_t at[2][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}};
      const float light = 0.1f * static_cast<float>(at[by_columns][i % 4]);
      const float code = 255.0f * (light <= 0.0f ? 0.0f : 1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f);
      EXPECT_NEAR(static_cast<float>(*view.eyes[0].layers[0].first), code, 1.0f) << i;
    }
  }
  std::filesystem::remove(folder.path("sheet.02.png"));
  EXPECT_EQ(view_ranges(rig, files, missing_views(rig, files, false)), "2");
  files.columns = 100;
  EXPECT_NE(names_fault(rig, files), "");
}

}  // namespace ods::stitch_test
