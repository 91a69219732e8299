// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "bench/lint_pictures.h"
#include "ods/disparity/match.h"

using namespace ods;

void become_vr180(Made& made) {
  made.target.camera.projection = find_projection("vr180")->setting;
  made.target.eye.width = made.target.eye.height;
  made.save.layout = Layout::kSideBySide;
  made.suffix = "_180_LR";
}

// The luminance of both eyes in their final form, but without faults.
static std::vector<Image> eyes_of(const Made& made) {
  const Conversion conversion = convert(made.pair->picture, made.target);
  const PictureRows& rows = conversion.rows;
  const size_t channels = count_channels(rows.layers);
  std::vector<Image> eyes(2, Image(rows.eye.width, rows.eye.height, 1));
  std::vector<float> row(static_cast<size_t>(rows.eye.width) * channels);
  for (int i = 0; i < 2; i++) {
    for (int y = 0; y < rows.eye.height; y++) {
      rows.fill(i, y, row);
      for (int x = 0; x < rows.eye.width; x++) {
        const float* light = &row[static_cast<size_t>(x) * channels];
        *eyes[static_cast<size_t>(i)].at(x, y) = 0.2126f * light[0] + 0.7152f * light[1] + 0.0722f * light[2];
      }
    }
  }
  return eyes;
}

// The parallax, degrees, at the first quartile of the places: of the half that vr180 shows, or of the whole.
static double far_parallax(const Made& made) {
  static std::mutex mutex;
  static std::map<std::pair<const Pair*, std::string>, double> known;
  const std::pair key(made.pair, made.suffix);
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  const std::vector<GrayView> views = make_gray_views(eyes_of(made), made.target.camera.projection, false, 1024);
  std::vector<double> angles;
  for (const Match& match : match_tiles(views[0], views[1], {}).found) {
    if (std::abs(match.phi) < 0.85f) angles.push_back(glm::degrees(static_cast<double>(match.around)));
  }
  std::sort(angles.begin(), angles.end());
  return known[key] = angles.empty() ? 0.0 : angles[angles.size() / 4];
}

void add_divergence(std::vector<PicturePlant>& plants) {
  const std::vector<double> angles{0.3, 0.7, 1.0, 2.0, 3.4};
  const auto turn = [](Made& made, double s) { made.target.right.yaw = -static_cast<float>(s + far_parallax(made)); };
  plants.push_back({"divergence", {Fault::kEyesDiverge}, Check::kConvergence, "degrees", angles, turn});
  plants.push_back(
      {"divergence of vr180", {Fault::kEyesDiverge}, Check::kConvergence, "degrees", angles, [=](Made& made, double s) {
         become_vr180(made);
         turn(made, s);
       }});
}
