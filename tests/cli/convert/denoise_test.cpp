// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods denoise as its user meets it.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include "ods/image/compare.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "tests/support/cli_runner.h"

namespace ods::cli_denoise_test {

class DenoiseCommand : public Cli {
 protected:
  std::string make(const std::string& name, const std::string& words) {
    const std::string path = folder.path(name);
    EXPECT_EQ(run("render toys -q --statistics --width 96 -o " + path + " " + words), 0) << err;
    return path;
  }
  double error_of(const std::string& path, const ods::LoadedEyes& truth) {
    return ods::compare_eyes(truth.eyes, ods::load_eyes(path).eyes).whole.rmse;
  }
};

TEST_F(DenoiseCommand, APictureBecomesCleanerAndCanBeDoneAgain) {
  const std::string noisy = make("noisy.exr", "--samples 8"), clean = folder.path("clean.exr");
  EXPECT_EQ(run("denoise " + noisy + " -o " + clean), 0) << err;
  EXPECT_EQ(out, clean + "\n");
  const std::string again = folder.path("again.exr");
  EXPECT_EQ(run("denoise -q " + clean + " -o " + again + " --threads 1"), 0) << err;
  EXPECT_EQ(run("compare " + clean + " " + again + " --max-error 0"), 0) << out;
  const std::string alone = folder.path("alone.exr");
  EXPECT_EQ(run("denoise -q " + noisy + " -o " + alone + " --each-eye"), 0) << err;
  EXPECT_EQ(run("compare " + clean + " " + alone + " --max-error 0"), 5) << out;
}

TEST_F(DenoiseCommand, TheErrorFalls) {
  const std::string truth = folder.path("truth.exr"), noisy = folder.path("noisy.exr"),
                    clean = folder.path("clean.exr");
  EXPECT_EQ(run("render furnace -q --width 64 --samples 512 -o " + truth), 0) << err;
  EXPECT_EQ(run("render furnace -q --width 64 --samples 4 --statistics -o " + noisy), 0) << err;
  EXPECT_EQ(run("denoise -q " + noisy + " -o " + clean), 0) << err;
  const ods::LoadedEyes reference = ods::load_eyes(truth);
  EXPECT_LT(error_of(clean, reference), 0.8 * error_of(noisy, reference));
}

TEST_F(DenoiseCommand, PicturesForTheScreenAreDevelopedAsByOthers) {
  const std::string noisy = make("noisy_LR.exr", "--samples 4 --layout side-by-side");
  const std::string clean = folder.path("clean.exr"), png = folder.path("png_LR.png"), other = folder.path("o_LR.png");
  EXPECT_EQ(run("denoise -q " + noisy + " -o " + clean), 0) << err;
  EXPECT_EQ(run("denoise -q " + noisy + " -o " + png + " --exposure 1 --tone linear"), 0) << err;
  EXPECT_EQ(run("convert -q " + clean + " -o " + other + " --exposure 1 --tone linear"), 0) << err;
  EXPECT_EQ(run("compare " + png + " " + other + " --max-error 0.005"), 0) << out << err;
}

TEST_F(DenoiseCommand, PixelsOfNaNAreCounted) {
  const std::string noisy = make("noisy.exr", "--samples 4");
  ods::StoredPicture stored = ods::open_picture(noisy);
  ods::PictureRows rows;
  rows.eye = stored.size, rows.eyes = {ods::kLeft, ods::kRight};
  rows.layers = {{{"R", "G", "B"}, ods::LayerRule::kLight, ods::SampleType::kHalf},
                 {{"variance.R", "variance.G", "variance.B"}, ods::LayerRule::kMean, ods::SampleType::kFloat}};
  rows.fill = [](int index, int y, std::span<float> row) {
    for (float& value : row) value = 1.0f;
    if (index == 0 && y == 3) row[4] = -1.0f;  // a file cannot hold NaN
  };
  ods::save_picture(rows, &stored.camera, {}, noisy);
  EXPECT_EQ(run("denoise " + noisy + " -o " + folder.path("clean.exr")), 0) << err;
  EXPECT_NE(err.find("1 pixels"), std::string::npos) << err;
  EXPECT_NE(err.find("no albedo"), std::string::npos) << err;
}

// Before anything is rendered or read.
TEST_F(DenoiseCommand, OpenImageDenoiseMustBeInstalled) {
  if (dlopen("libOpenImageDenoise.so.2", RTLD_LAZY) != nullptr) GTEST_SKIP() << "skipped: it is installed";
  for (const std::string words : {"render toys --width 16384 --denoise oidn", "denoise absent.exr --oidn"}) {
    EXPECT_EQ(run(words + " -o " + folder.path("a.png")), 3) << words;
    EXPECT_NE(err.find("Open Image Denoise is not installed"), std::string::npos) << err;
  }
  EXPECT_EQ(files(), 0u);
}

}  // namespace ods::cli_denoise_test
