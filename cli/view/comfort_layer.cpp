// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/comfort_layer.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "ods/base/quote.h"
#include "ods/comfort/heat.h"
#include "ods/files/file_input.h"
#include "ods/files/private_folder.h"
#include "ods/picture/cryptomatte.h"
#include "ods/picture/save.h"
#include "ods/view/camera_json.h"

static std::string text_of(const ods::StrainedPlace* worst) {
  if (!worst) return "Nothing strains the eyes";
  return fmt::format("Most: {}, {:.2f} m away, {}", ods::strain_row(worst->strain).title, worst->distance,
                     ods::direction_text(worst->azimuth, worst->elevation));
}

ods::Json verdict_json(const ods::StereoCamera& camera, const ods::ComfortVerdict& verdict) {
  const ods::StrainedPlace* const worst = verdict.worst();
  ods::Json json = {{"camera", camera_json(ods::make_camera(camera))},
                    {"level", comfort_level_name(verdict.level)},
                    {"text", text_of(worst)}};
  if (worst) json["worst"] = {{"yaw", worst->azimuth}, {"pitch", worst->elevation}};
  return json;
}

ComfortLayer comfort_layer(const ods::ViewItem& item) {
  const std::string scratch = ods::temporary_folder();
  const ods::JudgedPicture judged = ods::judge_picture(item.path, {{}, item.known, true, scratch});
  ComfortLayer layer;
  layer.json = ods::json_document(verdict_json(judged.camera, judged.verdict));
  const ods::Picture heat = ods::heat_picture(judged);
  const ods::PictureRows rows = ods::rows_of(heat, false);
  layer.left = ods::eye_bytes(rows, 0, ods::FileFormat::kJpeg, {});
  layer.right = rows.eyes.size() == 2 ? ods::eye_bytes(rows, 1, ods::FileFormat::kJpeg, {}) : layer.left;
  return layer;
}
