// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "bench/lint_pictures.h"
#include "ods/disparity/match.h"
#include "ods/picture/load_eyes.h"

using namespace ods;

void become_vr180(Made& made) {
  made.target.camera.projection = find_projection("vr180")->setting;
  made.target.eye.width = made.target.eye.height;
  made.save.layout = Layout::kSideBySide;
  made.suffix = "_180_LR";
}

// The parallax that a quarter of the places in a pair is below, degrees.
static double far_parallax(const Pair& pair) {
  static std::mutex mutex;
  static std::map<const Pair*, double> known;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(&pair);
  if (found != known.end()) return found->second;
  const std::vector<GrayView> views = make_gray_views(grey_eyes(pair.picture), ProjectionSetting(), false, 1024);
  std::vector<double> angles;
  for (const Match& match : match_tiles(views[0], views[1], {}).found) {
    if (std::abs(match.phi) < 0.85f) angles.push_back(glm::degrees(static_cast<double>(match.around)));
  }
  std::sort(angles.begin(), angles.end());
  return known[&pair] = angles.empty() ? 0.0 : angles[angles.size() / 4];
}

void add_divergence(std::vector<PicturePlant>& plants) {
  const std::vector<double> angles{0.3, 0.7, 1.0, 2.0, 3.5};
  const auto turn = [](Made& made, double s) {
    made.target.right.yaw = -static_cast<float>(s + far_parallax(*made.pair));
  };
  plants.push_back({"divergence", {Fault::kEyesDiverge}, Check::kConvergence, "degrees", angles, turn});
  plants.push_back(
      {"divergence of vr180", {Fault::kEyesDiverge}, Check::kConvergence, "degrees", angles, [=](Made& made, double s) {
         become_vr180(made);
         turn(made, s);
       }});
}
