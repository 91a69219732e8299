// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The files that a killed stitch leaves on the disk, and their use by the next one.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/stitch/stitch.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

class StitchJournal : public ::testing::Test {
 protected:
  void SetUp() override {
    SlitOptions slits;
    slits.slits = 80;
    rig = make_slit_rig({}, {160, 80}, {kLeft, kRight}, slits);
    for (size_t i = 0; i < rig.views.size(); i++) {
      made.push_back(make_picture(rig.views[i], rig.view, {kMono}));
      add_colour(made.back(),
                 [i](int, vec2 uv, float* out) { out[0] = uv.x, out[1] = uv.y, out[2] = static_cast<float>(i % 7); });
    }
    options.journal = folder.path("journal");
    options.journal_key = 7;
  }

  OpenView open = [this](size_t i) {
    opened++;
    return made[i].picture;
  };

  // Leaves a journal of which half is done.
  void stop_halfway() {
    const auto stop = [](double part) {
      if (part >= 0.5) throw Error(ErrorKind::kInput, "killed");
    };
    EXPECT_THROW(stitch(rig, open, options, stop), Error);
    opened = 0;
  }

  void expect_right(const Stitched& stitched) const {
    const std::vector<Image> images = images_of(stitched.rows), direct = images_of(stitch(rig, open, {}).rows);
    for (size_t eye : {0u, 1u}) EXPECT_TRUE(images[eye].pixels == direct[eye].pixels) << eye;
  }

  const TemporaryFolder folder;
  SlitRig rig;
  std::vector<MadePicture> made;
  std::atomic<int> opened{0};
  StitchOptions options;
};

constexpr size_t kPixels = 4096;  // where they begin in so small a journal

// A power cut: the marks are on the disk, the pixels that they speak of are not.
TEST_F(StitchJournal, MarksAheadOfTheirPixelsAreNotBelieved) {
  stop_halfway();
  std::string bytes = folder.read("journal");
  ASSERT_GT(bytes.size(), kPixels);
  folder.write("journal", bytes.substr(0, kPixels) + std::string(bytes.size() - kPixels, '\0'));
  const Stitched all = stitch(rig, open, options);
  EXPECT_EQ(opened, static_cast<int>(rig.views.size())) << "nothing of it is used";
  expect_right(all);
}

TEST_F(StitchJournal, OnePixelThatIsLostCostsItsBatchAlone) {
  stop_halfway();
  std::string bytes = folder.read("journal");
  bytes[kPixels + 8] = static_cast<char>(bytes[kPixels + 8] + 1);
  folder.write("journal", bytes);
  const Stitched rest = stitch(rig, open, options);
  EXPECT_LT(opened, static_cast<int>(rig.views.size()));
  EXPECT_GT(opened, static_cast<int>(rig.views.size() / 2));
  expect_right(rest);
}

// Another power cut: the new key is on the disk, but marks and pixels of the job before are still there.
TEST_F(StitchJournal, MarksOfAnotherKeyAreNotBelieved) {
  stop_halfway();
  std::string bytes = folder.read("journal");
  const size_t key = 32;
  bytes[key] = static_cast<char>(bytes[key] + 1);
  folder.write("journal", bytes);
  options.journal_key = 8;
  const Stitched all = stitch(rig, open, options);
  EXPECT_EQ(opened, static_cast<int>(rig.views.size()));
  expect_right(all);
}

TEST_F(StitchJournal, WhatIsNoJournalIsLeftAsItIs) {
  folder.write("victim", "a diary");
  std::filesystem::create_symlink(folder.path("victim"), options.journal);
  EXPECT_THROW(stitch(rig, open, options), Error);
  options.journal = folder.path("victim");
  EXPECT_THROW(stitch(rig, open, options), Error);
  EXPECT_EQ(folder.read("victim"), "a diary");
}

}  // namespace
}  // namespace ods
