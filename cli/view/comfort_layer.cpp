// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/comfort_layer.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/comfort/comfort_report.h"
#include "cli/comfort/heat.h"
#include "ods/base/quote.h"
#include "ods/picture/cryptomatte.h"
#include "ods/picture/save.h"
#include "ods/view/camera_json.h"

static std::string text_of(const ods::ComfortReport& report) {
  if (report.places.empty()) return "Nothing strains the eyes";
  const ods::StrainedPlace& worst = report.places[0];
  return fmt::format("Most: {}, {:.2f} m away, {}", ods::strain_row(worst.strain).title, worst.distance,
                     direction_text(worst));
}

ods::Json verdict_json(const ods::StereoCamera& camera, const ods::ComfortReport& report, ods::ComfortLevel level) {
  ods::Json json = {{"camera", camera_json(ods::make_camera(camera))},
                    {"level", comfort_level_name(level)},
                    {"text", text_of(report)}};
  if (report.places.empty()) return json;
  json["worst"] = {{"yaw", report.places[0].azimuth}, {"pitch", report.places[0].elevation}};
  return json;
}

ComfortLayer comfort_layer(const ods::ViewItem& item) {
  ComfortJob job;
  job.input = ComfortInput::kPicture;
  job.scene.name = item.path;
  job.format = item.known;
  job.heat = "shown";  // so that colours are read, too
  const Looked looked = look_at_picture(job);
  std::vector<ods::ComfortReport> reports;
  for (const Judged& each : looked.eyes) reports.push_back(ods::judge_comfort(each.seen, job.comfort));
  ComfortLayer layer;
  const ods::Json json = verdict_json(looked.camera, reports[0], verdict(job, looked, reports[0]));
  layer.json = ods::json_document(json);
  const ods::Picture heat = heat_picture(looked, reports);
  const ods::PictureRows rows = ods::rows_of(heat, false);
  layer.left = ods::eye_bytes(rows, 0, ods::FileFormat::kJpeg, {});
  layer.right = rows.eyes.size() == 2 ? ods::eye_bytes(rows, 1, ods::FileFormat::kJpeg, {}) : layer.left;
  return layer;
}
