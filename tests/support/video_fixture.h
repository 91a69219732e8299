// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods video on small scenes.
#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "ods/camera/camera_fields.h"
#include "ods/video/encode.h"
#include "tests/support/cli_runner.h"
#include "tests/support/gltf_builder.h"

namespace ods::cli_video_test {

class Video : public Cli {
 protected:
  void SetUp() override {
    if (!ods::has_encoder("libx264")) GTEST_SKIP() << "skipped: this machine has no libx264";
  }

  std::string words(const std::string& name, const std::string& more = "") const {
    return "video toys --width 32 --samples 1 --frames 1-4 -o " + folder.path(name) + " " + more;
  }
};

}  // namespace ods::cli_video_test
