// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/comfort_answers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/view/comfort_layer.h"
#include "ods/base/json_reader.h"
#include "ods/comfort/areas.h"
#include "ods/comfort/heat.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"

namespace {

constexpr int kJudgedWidth = 1024;

ods::SeenDepth depth_of(const ods::LiveSeen& seen, size_t eye) {
  const ods::EyeImage& image = seen.picture->eyes[eye];
  return {seen.camera, image.eye, ods::nearest_of_blocks(image.depth, kJudgedWidth), {}, {}};
}

std::string png_of(const ods::Image& image) {
  ods::FileHeader header;
  header.width = image.width;
  header.height = image.height;
  header.channels = {{"R"}, {"G"}, {"B"}};
  return ods::image_bytes("heat.png", header, [&](int y, std::span<float> row) {
    std::transform(image.at(0, y), image.at(0, y) + row.size(), row.data(), ods::srgb_encode);
  });
}

}  // namespace

WebAnswer heat_answer(const ods::LiveSeen& seen, int eye) {
  if (!seen.picture) return {.status = 204};
  const size_t index = std::min(static_cast<size_t>(eye), seen.picture->eyes.size() - 1);
  const ods::Image& light = seen.picture->eyes[index].radiance;
  assert(light.width <= kJudgedWidth);  // the studio's whole picture is never larger
  const ods::ComfortVerdict verdict = ods::judge_comfort(depth_of(seen, index));
  return {.type = "image/png", .body = png_of(ods::heat_of(light, verdict.per_eye[0].levels))};
}

ods::Json comfort_json(const ods::LiveSeen& seen) {
  if (!seen.picture) return nullptr;
  std::vector<ods::SeenDepth> eyes;
  for (size_t i = 0; i < seen.picture->eyes.size(); i++) eyes.push_back(depth_of(seen, i));
  const ods::ComfortVerdict verdict = ods::judge_comfort(eyes);
  const auto limit = static_cast<float>(ods::kFusionLimit);
  const ods::Image map = ods::merge_map_of(ods::comfortable_shares(eyes, seen.camera, limit));
  ods::Json json = verdict_json(seen.camera, verdict);
  json["share"] = verdict.share;
  json["nearest"] = ods::json_number(verdict.nearest);
  json["auto"] = merge_json(map);
  return json;
}

ods::Json merge_json(const ods::Image& map) {
  ods::Json json = ods::Json::array();
  for (int row = 0; row < map.height; row++) json.push_back(std::round(double{*map.at(0, row)} * 1e3) / 1e3);
  return json;
}

void add_comfort(ods::Json& pick, const ods::StereoCamera& camera, const ods::LivePick& found, int eye) {
  if (!found.places[eye]) return;
  const ods::PointComfort point = ods::judge_point(camera, eye, *found.places[eye], found.distance);
  pick["comfort"] = {{"level", ods::comfort_level_name(point.level)},
                     {"distance", point.distance},
                     {"near", point.near},
                     {"vertical", point.vertical}};
}
