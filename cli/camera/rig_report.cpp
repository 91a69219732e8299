// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/camera/rig_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/console/print.h"
#include "ods/stitch/slit_error.h"

namespace {

void print_errors(const ods::SlitRig& rig, float nearest) {
  const float distances[] = {nearest, 2.0f * nearest, 10.0f * nearest};
  std::string line = "largest error in pixels (arc minutes):\n  elevation";
  for (const float distance : distances) {
    line += fmt::format("   {:>31}", fmt::format("at {:.3g} m: across  up/down  step", distance));
  }
  put_out(fmt::format("{}\n", line));
  for (const float elevation : {90.0f, 60.0f, 30.0f, 0.0f, -30.0f, -60.0f, -90.0f}) {
    const ods::vec2 seen = rig.camera.projection.latitude;
    if (elevation < seen.x || elevation > seen.y) continue;
    line = fmt::format("  {:9}", elevation);
    for (const float distance : distances) {
      const ods::SlitError error = slit_error(rig, glm::radians(elevation), distance);
      const auto pixels = [&](float angle) { return picture_pixels(rig, angle); };
      line +=
          fmt::format("   {:>31}", fmt::format("{:.3f}  {:.3f}  {:.3f} ({:.2f}')", pixels(error.across),
                                               pixels(error.along), pixels(error.step), ods::arc_minutes(error.step)));
    }
    put_out(fmt::format("{}\n", line));
  }
}

void print_detail(const ods::SlitRig& rig) {
  std::string elevations = "  elevation      ", columns = "  columns        ", minutes = "  arc minutes    ";
  const ods::vec2 seen = rig.camera.projection.latitude;
  for (const float elevation : {85.0f, 75.0f, 60.0f, 30.0f, 0.0f, -30.0f, -60.0f, -75.0f, -85.0f}) {
    if (elevation < seen.x || elevation > seen.y) continue;
    const ods::ViewDetail detail = view_detail(rig, glm::radians(elevation));
    elevations += fmt::format("{:7}", elevation);
    columns += fmt::format("{:7.2f}", detail.across);
    minutes += fmt::format("{:7.2f}", ods::arc_minutes(detail.angle));
  }
  put_out(fmt::format(
      "width of a view's pixel in columns of the picture; above 1, less horizontal detail than when rendered "
      "directly\n"
      "{}\n{}\n{}\n",
      elevations, columns, minutes));
}

std::string cost_text(const ods::SlitRig& rig) {
  const double pixels = static_cast<double>(rig.views.size()) * rig.view.width * rig.view.height;
  const double picture = static_cast<double>(rig.eyes.size()) * rig.eye.width * rig.eye.height;
  return fmt::format("{} slits of {} views for {} eye{}: {} views of {}x{}, {:.3g} Mpixels, {:.2g} times the picture's",
                     rig.options.slits, rig.options.pitches, rig.eyes.size(), rig.eyes.size() == 1 ? "" : "s",
                     rig.views.size(), rig.view.width, rig.view.height, pixels * 1e-6, pixels / picture);
}

}  // namespace

void print_plan(const ods::SlitRig& rig, float nearest) {
  put_out(fmt::format("{}\n", cost_text(rig)));
  print_errors(rig, nearest);
  print_detail(rig);
  if (rig.options.depth != ods::ViewDepth::kNone) {
    put_out(fmt::format("these are errors at occlusion edges; depth corrects the surfaces themselves\n"));
  }
  ods::SlitOptions every = rig.options;
  every.slits = rig.eye.width;
  if (!slit_fault(rig.camera, rig.eye, every).empty()) return;
  const ods::SlitRig all = make_slit_rig(rig.camera, rig.eye, rig.eyes, every);
  const ods::SlitError error = largest_slit_error(all, nearest);
  put_out(fmt::format("a slit for every column would be off by {:.3f} pixels at most: {}\n",
                      picture_pixels(all, std::max(error.whole, error.step)), cost_text(all)));
}
