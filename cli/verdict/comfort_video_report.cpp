// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verdict/comfort_video_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/console/print.h"
#include "cli/verdict/comfort_report.h"
#include "ods/base/decimal.h"
#include "ods/base/json_reader.h"

using ods::Json;

namespace {

Json moment_json(const ods::VideoMoment& moment, bool has_strains) {
  Json json = {{"seconds", moment.seconds},
               {"level", comfort_level_name(moment.level)},
               {"matched", moment.matched},
               {"nearest", ods::json_number(moment.nearest)},
               {"middle", moment.middle}};
  json["vergence"] = has_strains ? Json(moment.vergence) : Json();
  json["vertical"] = has_strains ? Json(moment.vertical) : Json();
  if (moment.is_carried) {
    json["turn"] = moment.turn;
    json["tilt"] = moment.tilt;
    json["speed"] = moment.speed;
    json["acceleration"] = moment.acceleration;
  }
  if (moment.cut) {
    json["cut"] = *moment.cut;
    json["cut_at"] = moment.cut_at;
  }
  return json;
}

}  // namespace

std::string sampled_frames_text(const ods::VideoComfort& video) {
  const std::string all = video.frames > 0 ? fmt::format("{} of {} frames", video.moments.size(), video.frames)
                                           : fmt::format("{} frames", video.moments.size());
  return fmt::format("checked {}, one every {:.2g} s; by matching: +-{:.0f} minutes of arc", all, video.every,
                     video.precision);
}

std::string times_text(const ods::VideoStrain& strain) {
  if (strain.from == strain.to) return fmt::format("at {:.2f} s", strain.worst);
  return fmt::format("from {:.2f} to {:.2f} s, worst at {:.2f} s", strain.from, strain.to, strain.worst);
}

std::string strain_text(const ods::VideoStrain& strain) {
  return fmt::format("{}, {:.3g} {}", strain.title, strain.value, strain.unit);
}

void print_text(const ComfortJob& job, const ods::VideoComfort& video) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const ods::VideoMoment& moment : video.moments) nearest = std::min(nearest, moment.nearest);
  put_out(fmt::format("{}: {}; eyes {:.3g} m apart, nearest {:.2f} m\n", job.scene.name,
                      comfort_level_name(video.level), video.worst.camera.ipd, nearest));
  put_out(fmt::format("{}\n", sampled_frames_text(video)));
  for (const ods::VideoStrain& strain : video.strains) {
    std::string place;
    if (strain.place) {
      const std::string remedy = remedy_text(*strain.place);
      place = fmt::format(", {:.2f} m away, {}{}{}", strain.place->distance, direction_text(*strain.place),
                          remedy.empty() ? "" : "; ", remedy);
    }
    put_out(fmt::format("{}: {}: {}{}\n", comfort_level_name(strain.level), times_text(strain), strain_text(strain),
                        place));
  }
}

void print_json(const ComfortJob& job, const ods::VideoComfort& video) {
  Json json = {{"path", job.scene.name},
               {"level", comfort_level_name(video.level)},
               {"ipd", ods::decimal(video.worst.camera.ipd)},
               {"frames", video.frames},
               {"seconds", video.seconds},
               {"every", video.every},
               {"precision", video.precision},
               {"moments", Json::array()},
               {"strains", Json::array()}};
  const bool has_strains = job.comfort.rules == ods::ComfortRules::kStrain;
  for (const ods::VideoMoment& moment : video.moments) json["moments"].push_back(moment_json(moment, has_strains));
  for (const ods::VideoStrain& strain : video.strains) {
    Json each = {{"name", strain.name},   {"level", comfort_level_name(strain.level)},
                 {"from", strain.from},   {"to", strain.to},
                 {"worst", strain.worst}, {"value", strain.value},
                 {"unit", strain.unit}};
    if (strain.place) {
      each["distance"] = strain.place->distance;
      each["azimuth"] = strain.place->azimuth;
      each["elevation"] = strain.place->elevation;
    }
    json["strains"].push_back(std::move(each));
  }
  put_json(json);
}
