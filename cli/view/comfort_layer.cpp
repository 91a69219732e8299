// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/comfort_layer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/comfort/heat.h"
#include "ods/files/file_input.h"
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
  const std::string scratch = std::filesystem::temp_directory_path().string();
  const ods::JudgedPicture judged = ods::judge_picture(item.path, {{}, item.known, true, scratch});
  ComfortLayer layer;
  const ods::Json json = verdict_json(judged.camera, judged.verdict);
  layer.json = json.dump(-1, ' ', false, ods::Json::error_handler_t::replace);
  // Image libraries want files.
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string path = (folder / fmt::format("ods-view-{}-heat-%V.jpg", getpid())).string();
  const std::vector<std::string> files = ods::save_picture(ods::heat_picture(judged), judged.camera, {}, path);
  layer.left = ods::take_file(files.front());
  layer.right = files.size() == 2 ? ods::take_file(files.back()) : layer.left;
  return layer;
}
