// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Lettering, and where it stands: against closed forms.
#include "ods/compose/title.h"

#include <gtest/gtest.h>
#include <time.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "ods/base/error.h"
#include "ods/picture/picture.h"
#include "tests/support/temporary_folder.h"

namespace ods::title_test {

constexpr Extent kEye{2048, 1024};

struct Pixels {
  std::vector<float> rows;
  const float* at(int x, int y) const { return &rows[static_cast<size_t>(5 * (y * kEye.width + x))]; }
};

Pixels draw(const StereoCamera& camera, const TitleSetting& setting, int eye, const std::string& text = "O") {
  const Title title = make_title(camera, kEye, setting, draw_lettering(text, lettering_em(camera, kEye, setting)));
  Pixels pixels;
  pixels.rows.resize(static_cast<size_t>(5 * kEye.width * kEye.height));
  const size_t row = static_cast<size_t>(5 * kEye.width);
  for (int y = 0; y < kEye.height; y++) {
    fill_title_row(title, eye, y, std::span(pixels.rows).subspan(static_cast<size_t>(y) * row, row));
  }
  return pixels;
}

double theta_of(double x) {
  return (x / kEye.width - 0.5) * 2.0 * std::numbers::pi;
}

double phi_of(double y) {
  return (0.5 - y / kEye.height) * std::numbers::pi;
}

struct Seen {
  double theta = 0.0, phi = 0.0;  // of the middle of what is seen
  double solid_angle = 0.0;
};

Seen look_at(const Pixels& pixels) {
  Seen seen;
  for (int y = 0; y < kEye.height; y++) {
    const double phi = phi_of(y + 0.5);
    const double size = std::cos(phi) * std::pow(std::numbers::pi / kEye.height, 2);
    for (int x = 0; x < kEye.width; x++) {
      const double alpha = static_cast<double>(pixels.at(x, y)[3]);
      seen.solid_angle += alpha * size;
      seen.theta += alpha * size * theta_of(x + 0.5);
      seen.phi += alpha * size * phi;
    }
  }
  seen.theta /= seen.solid_angle, seen.phi /= seen.solid_angle;
  return seen;
}

// The place of the letters' middle on their card, which has the size of whole pixels: metres to the right and up.
glm::dvec2 middle_of(const Lettering& lettering, double height) {
  const Image& image = lettering.coverage;
  glm::dvec2 sum(0.0);
  double all = 0.0;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const double value = static_cast<double>(*image.at(x, y));
      sum += value * glm::dvec2(x + 0.5 - 0.5 * image.width, 0.5 * image.height - y - 0.5);
      all += value;
    }
  }
  return sum / all * height / static_cast<double>(lettering.em);
}

// theta_L - theta_R = 2 asin(r / distance), half of it to either side.
TEST(Title, HasTheParallaxOfItsDistance) {
  const double pixel = 2.0 * std::numbers::pi / kEye.width;
  for (const bool curved : {true, false}) {
    for (const float distance : {0.7f, 2.0f, 20.0f}) {
      StereoCamera camera;
      camera.ipd = 0.065f;
      TitleSetting setting;
      setting.yaw = 40.0f;
      setting.distance = distance;
      setting.height = 0.2f * distance;
      setting.curved = curved;
      const Seen left = look_at(draw(camera, setting, kLeft)), right = look_at(draw(camera, setting, kRight));
      const Lettering lettering = draw_lettering("O", lettering_em(camera, kEye, setting));
      const glm::dvec2 off = middle_of(lettering, static_cast<double>(setting.height)) / static_cast<double>(distance);
      const double half = std::asin(0.0325 / static_cast<double>(distance));
      const double middle = 40.0 / 180.0 * std::numbers::pi + off.x;
      EXPECT_NEAR(left.theta, middle + half, 0.05 * pixel) << distance;
      EXPECT_NEAR(right.theta, middle - half, 0.05 * pixel) << distance;
      EXPECT_NEAR(left.phi, off.y, 0.05 * pixel);
    }
  }
}

TEST(Title, CoversWhatItsLettersCover) {
  StereoCamera camera;
  camera.ipd = 0.0f;
  TitleSetting setting;
  setting.distance = 5.0f;
  setting.height = 0.5f;
  for (const float height : {0.5f, 0.05f}) {  // the smaller one is a few pixels high
    setting.height = height;
    const Lettering lettering = draw_lettering("O", lettering_em(camera, kEye, setting));
    double sum = 0.0;
    for (const float value : lettering.coverage.pixels) sum += static_cast<double>(value);
    const double area = sum * std::pow(static_cast<double>(height / lettering.em), 2);
    EXPECT_NEAR(look_at(draw(camera, setting, kLeft)).solid_angle, area / 25.0, 0.02 * area / 25.0) << height;
  }
}

// At the horizon: a curved card is equally far from an eye beside its axis.
TEST(Title, DepthIsAlongTheRay) {
  StereoCamera camera;
  camera.ipd = 0.2f;
  TitleSetting setting;
  setting.distance = 2.0f;
  setting.height = 0.4f;
  const Pixels curved = draw(camera, setting, kLeft, "OOOO");
  setting.curved = false;
  const Pixels flat = draw(camera, setting, kLeft, "OOOO");
  const double beside = std::sqrt(4.0 - 0.01);  // from the circle to the cylinder
  int seen = 0;
  for (int y = 0; y < kEye.height; y++) {
    for (int x = 0; x < kEye.width; x++) {
      const double phi = phi_of(y + 0.5);
      if (curved.at(x, y)[3] > 0.0f) {
        EXPECT_NEAR(static_cast<double>(curved.at(x, y)[4]), beside / std::cos(phi), 1e-4);
        seen++;
      } else {
        EXPECT_EQ(curved.at(x, y)[4], kFarDepth);
      }
      if (flat.at(x, y)[3] > 0.0f) {
        // The eye stands r to the left of its ray's heading; the card at z = -2.
        const double theta = theta_of(x + 0.5), ahead = 2.0 - 0.1 * std::sin(theta);
        EXPECT_NEAR(static_cast<double>(flat.at(x, y)[4]), ahead / std::cos(theta) / std::cos(phi), 1e-3);
      }
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(Title, ItsWidthIsAnAngle) {
  TitleSetting setting;
  setting.distance = 2.0f, setting.height = 0.5f;
  const Lettering lettering = draw_lettering("HHHHHHHH", 64.0f);
  const float metres = static_cast<float>(lettering.coverage.width) / lettering.em * 0.5f;
  EXPECT_NEAR(title_width(make_title(StereoCamera(), kEye, setting, lettering)), glm::degrees(metres / 2.0f), 1e-3f);
  for (const bool curved : {true, false}) {
    setting.curved = curved;
    setting.height = 0.5f;
    const Title wide = make_title(StereoCamera(), kEye, setting, lettering);
    EXPECT_GT(title_width(wide), kComfortableWidth);
    setting.height = comfortable_height(wide);
    const Title narrow = make_title(StereoCamera(), kEye, setting, lettering);
    EXPECT_NEAR(title_width(narrow), kComfortableWidth, 1e-3f);
    EXPECT_NEAR(comfortable_height(narrow), setting.height, 1e-6f);
  }
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// A line that goes all around covers few rows; the others do not cost more than the rows of a single word.
TEST(Title, ALongLineCostsWhatItCovers) {
  const auto seconds = [](const std::string& text) {
    double minimum = std::numeric_limits<double>::max();
    for (int i = 0; i < 3; i++) {  // the first loads fonts
      const double start = cpu_seconds();
      draw(StereoCamera(), {}, kLeft, text);
      minimum = std::min(minimum, cpu_seconds() - start);
    }
    return minimum;
  };
  EXPECT_LT(seconds(std::string(100, 'W')), 4.0 * seconds("WWWW"));
}

// There a pixel's neighbours are so far off that the card seems to lie between them.
TEST(Title, NothingIsSeenAtGrazingAngles) {
  StereoCamera camera;
  camera.neck = 0.2f;
  TitleSetting setting;
  setting.yaw = 20.0f, setting.pitch = 10.0f, setting.distance = 1.0f, setting.height = 2.0f, setting.curved = false;
  const Lettering lettering = draw_lettering(std::string(100, 'W'), lettering_em(camera, kEye, setting));
  const Title title = make_title(camera, kEye, setting, lettering);
  std::vector<float> row(static_cast<size_t>(5 * kEye.width));
  for (int y = 0; y < kEye.height; y++) {
    if (std::abs(phi_of(y + 0.5)) < glm::radians(70.0)) continue;  // the card ends at 45, and leans by 10
    fill_title_row(title, kLeft, y, row);
    for (size_t i = 3; i < row.size(); i += 5) ASSERT_EQ(row[i], 0.0f) << i / 5 << " " << y;
  }
}

TEST(Title, IsMultipliedByItsAlpha) {
  TitleSetting setting;
  setting.color = vec3(0.5f, 1.0f, 2.0f);
  setting.opacity = 0.25f;
  const Pixels pixels = draw(StereoCamera(), setting, kLeft);
  float maximum = 0.0f;
  for (size_t i = 0; i < pixels.rows.size(); i += 5) {
    const float* pixel = &pixels.rows[i];
    maximum = std::max(maximum, pixel[3]);
    EXPECT_FLOAT_EQ(pixel[0], 0.5f * pixel[3]);
    EXPECT_FLOAT_EQ(pixel[2], 2.0f * pixel[3]);
  }
  EXPECT_NEAR(maximum, 0.25f, 1e-3f);
}

TEST(Title, ComfortGoesWithTheEyes) {
  StereoCamera camera;
  camera.ipd = 0.065f;
  EXPECT_FLOAT_EQ(nearest_comfortable(camera, 0.0f), 0.6f);
  EXPECT_FLOAT_EQ(nearest_comfortable(camera, -89.0f), 3.5f);
  camera.ipd = 0.0325f;
  EXPECT_FLOAT_EQ(nearest_comfortable(camera, 89.0f), 1.75f);
  camera.top.mode = kMergeCosine;
  EXPECT_NEAR(nearest_comfortable(camera, 90.0f), 0.0f, 1e-3f);
}

TEST(Lettering, LaysOutLinesAndScripts) {
  const Lettering one = draw_lettering("ods", 64.0f), two = draw_lettering("ods\nods", 64.0f);
  EXPECT_EQ(one.em, 64.0f);
  EXPECT_EQ(one.characters_lost, 0);
  EXPECT_FALSE(one.font.empty());
  EXPECT_NEAR(one.coverage.height, 48, 12);  // of a d
  EXPECT_NEAR(two.coverage.height - one.coverage.height, 75, 20);
  EXPECT_EQ(two.coverage.width, one.coverage.width);
  EXPECT_GT(draw_lettering("שלום עולם", 64.0f).coverage.width, 100);
  EXPECT_EQ(draw_lettering("\U000F0000", 64.0f).characters_lost, 1);
}

TEST(Lettering, HugeTextStaysWithinLimits) {
  const Lettering huge = draw_lettering(std::string(2000, 'W'), 2048.0f);
  EXPECT_LT(huge.em, 2048.0f);
  EXPECT_LT(1.0 * huge.coverage.width * huge.coverage.height, 1.1 * (1 << 26));
}

TEST(Lettering, TakesFontFiles) {
  const char* const path = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no DejaVu fonts here";
  LetteringOptions options;
  options.font = path;
  const Lettering bold = draw_lettering("ods", 64.0f, options);
  EXPECT_EQ(bold.font, "DejaVu Sans");
  options.font = "DejaVu Sans";
  EXPECT_GT(bold.coverage.width, draw_lettering("ods", 64.0f, options).coverage.width);
}

TEST(Lettering, RefusesWhatIsNoText) {
  const TemporaryFolder folder;
  folder.write("no.ttf", "this is no font");
  EXPECT_THROW(draw_lettering("", 64.0f), Error);
  EXPECT_THROW(draw_lettering(" \n ", 64.0f), Error);
  EXPECT_THROW(draw_lettering("\xff\xfe", 64.0f), Error);
  LetteringOptions options;
  for (const std::string& font : {folder.path("no.ttf"), folder.path("absent.ttf")}) {
    options.font = font;
    EXPECT_THROW(draw_lettering("ods", 64.0f, options), Error);
  }
}

}  // namespace ods::title_test
