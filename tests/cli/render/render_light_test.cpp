// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a scene's light, as users meet them.
#include "ods/image/image_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/gltf_builder.h"

namespace ods::cli_light_test {

// A picture of a triangle of a file without light, which is an object on its own.
class RenderLight : public Cli {
 protected:
  void SetUp() override { write(ods::make_triangle()); }
  void write(const ods::GltfBuilder& built) {
    const ods::Binary glb = built.glb();
    folder.write("scene.glb", {glb.begin(), glb.end()});
  }

  // The picture's pixels, R, G and B.
  std::vector<float> render(const std::string& more, const std::string& what = "") {
    const std::string from = what.empty() ? scene : what;
    EXPECT_EQ(run("render " + from + " --width 32 --samples 4 --eyes mono -o " + picture + " " + more), 0) << err;
    return ods::read_image(picture).pixels;
  }
  // The radiance of a pixel behind the camera, to the left and above, where the studio's key light is.
  float behind(const std::string& more) { return render(more)[3 * (32 * 4 + 4) + 1]; }
  bool says(const std::string& words) const { return err.find(words) != std::string::npos; }

  const std::string scene = folder.path("scene.glb");
  const std::string picture = folder.path("a.exr");
};

TEST_F(RenderLight, IsSuppliedAndSaidInOneLine) {
  render("");
  EXPECT_TRUE(says("an object without light of its own: a studio lights it (--env sky")) << err;
  EXPECT_EQ(err.find("without light"), err.rfind("without light"));
  for (const char* more : {"--env sky", "--env 0.5", "--env 0"}) {
    render(more);
    EXPECT_FALSE(says("without light")) << more;
  }
  render("--unlit");
  EXPECT_FALSE(says("without light")) << err;
  render("", "furnace");
  EXPECT_FALSE(says("light it")) << "scenes of ours have light: " << err;
}

// A scene of a hundredth of the light is looked at with more exposure, so its noise counts as much, also in a file that
// keeps the light as it is.
TEST_F(RenderLight, NoiseIsJudgedAsThePictureWillBeLookedAt) {
  const auto samples = [&](const std::string& light, const std::string& more) {
    const std::string options = " --width 32 --samples 4096 --noise 0.002 --eyes mono --denoise none --env " + light;
    EXPECT_EQ(run("render " + scene + " -o " + picture + options + more), 0) << err;
    const size_t words = err.find(" samples per pixel");
    return std::stod(err.substr(err.rfind(' ', words - 1)));
  };
  const double bright = samples("1", ""), dim = samples("0.01", "");
  EXPECT_TRUE(says("noise is judged at +")) << err;
  EXPECT_NEAR(dim / bright, 1.0, 0.1) << dim << " and " << bright;
  const double dark = samples("0.01", " --exposure 0");
  EXPECT_LT(dark, 0.7 * dim) << "the test would not notice";
}

TEST_F(RenderLight, EnvironmentsHaveNames) {
  EXPECT_EQ(behind("--env white"), 1.0f);
  EXPECT_EQ(behind("--env 0.5"), 0.5f);
  EXPECT_EQ(behind("--env 0.25,0.5,0.25"), 0.5f);
  EXPECT_EQ(behind("--env 0"), 0.0f);
  const std::vector<float> high = render("--env sky:elevation=60,azimuth=90"), low = render("--env sky:elevation=5");
  EXPECT_NE(high, low);
  EXPECT_EQ(render("--env sky"), render("--env sky:azimuth=120,elevation=35"));
  EXPECT_EQ(render("--env sky:"), render("--env sky"));
}

TEST_F(RenderLight, EnvironmentsAreTurnedAndMultiplied) {
  EXPECT_EQ(behind("--env 0.5 --env-strength 3"), 1.5f);
  EXPECT_EQ(behind("--env 0.5 --env-strength 0"), 0.0f);
  EXPECT_EQ(behind("--env 0.5 --background 2 --env-strength 3"), 2.0f) << "the background has its own brightness";
  const float turned = behind("--env sky:elevation=60,azimuth=30 --env-turn 90");
  EXPECT_NEAR(turned, behind("--env sky:elevation=60,azimuth=120"), 1e-3f * turned);
  EXPECT_GT(std::abs(turned - behind("--env sky:elevation=60,azimuth=30")), 0.05f * turned) << "could not fail";
}

TEST_F(RenderLight, BackgroundIsSeenBehind) {
  const float walls = behind("");
  EXPECT_GT(walls, 0.05f);
  EXPECT_LT(walls, 0.5f) << "the studio without its lights";
  EXPECT_GT(behind("--background env"), 2.0f * walls) << "the key light";
  EXPECT_EQ(behind("--background 0.125"), 0.125f);
  EXPECT_EQ(behind("--env 0.5 --background 0"), 0.0f);
  EXPECT_EQ(behind("--env 0.5 --background 1,2,3"), 2.0f);
  EXPECT_EQ(behind("--env 0.5 --background env"), 0.5f);
  EXPECT_NE(behind("--env 0.5 --background sky"), 0.5f);
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --eyes mono -q -o " + folder.path("sky.exr")), 0) << err;
  const float glow = ods::read_image(folder.path("sky.exr")).pixels[1];  // more or less everywhere
  EXPECT_NEAR(behind("--env 0.5 --background " + folder.path("sky.exr")), glow, 0.05f * glow);
}

TEST_F(RenderLight, UnlitShowsColorsAsTheyArePainted) {
  ods::GltfBuilder painted = ods::make_triangle();
  painted.json["materials"] =
      ods::GltfJson::parse(R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.125, 1]}}])");
  painted.primitive()["material"] = 0;
  write(painted);
  const std::vector<float> pixels = render("--unlit --background 0 --env 0 --filter box --denoise none");
  size_t seen = 0;
  for (size_t i = 0; i < pixels.size(); i += 3) {
    if (pixels[i + 1] != 0.5f) continue;
    EXPECT_EQ(pixels[i], 0.25f);
    EXPECT_EQ(pixels[i + 2], 0.125f);
    seen++;
  }
  EXPECT_GT(seen, 1u);
}

TEST_F(RenderLight, BadWordsAreRefusedInOneLine) {
  const std::tuple<const char*, int, const char*> kCases[] = {
      {"--env sky:elevation=95", 2, "from 0 to 90 degrees"},
      {"--env sky:height=3", 2, "sky:elevation=35,azimuth=120"},
      {"--env sky:elevation", 2, "sky:elevation=35"},
      {"--env sky:elevation=1;azimuth=2", 2, "sky:elevation=35"},
      {"--env -1", 2, "--env is"},
      {"--env 1,2", 2, "--env is"},
      {"--env skye", 3, "no such file as 'skye'"},
      {"--background nan", 2, "--background is"},
      {"--background moon.exr", 3, "--background: no such file as 'moon.exr'"},
      {"--background 0 --transparent", 2, "--background cannot be used with --transparent"},
      {"--lamp 1,2", 2, "--lamp is auto, none or a place"},
      {"--lamp bright", 2, "--lamp is auto, none or a place"},
      {"--lamp 1,nan,2", 2, "--lamp is auto, none or a place"},
  };
  for (const auto& [more, code, words] : kCases) {
    EXPECT_EQ(run("render " + scene + " --width 16 --samples 1 -o " + picture + " " + more), code) << more << err;
    EXPECT_TRUE(says(words)) << more << ": " << err;
    EXPECT_FALSE(says("studio lights it")) << "before any work: " << more;
    EXPECT_FALSE(std::filesystem::exists(picture));
  }
}

TEST_F(RenderLight, ALampHangsWhereItIsAskedTo) {
  const std::vector<float> dark = render("--env 0"), lit = render("--env 0 --lamp 0.3,3,1");
  float before = 0.0f, after = 0.0f;
  for (const float value : dark) before += value;
  for (const float value : lit) after += value;
  EXPECT_EQ(before, 0.0f);
  EXPECT_GT(after, 0.1f);
}

TEST_F(RenderLight, OfATransparentPictureThereIsNoGround) {
  const std::string common = "render " + scene + " --width 32 --samples 4 --eyes mono -o " + picture + " --transparent";
  ASSERT_EQ(run(common), 0) << err;
  EXPECT_TRUE(says("a studio lights it")) << err;
  const std::vector<float> pixels = ods::read_image(picture).pixels;
  EXPECT_EQ(pixels[3 * (32 * 14 + 16)], 0.0f) << "nothing below";
}

}  // namespace ods::cli_light_test
