// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verdict/comfort_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/console/print.h"
#include "cli/options/eye_options.h"
#include "ods/base/decimal.h"
#include "ods/base/json_reader.h"

using ods::ComfortLevel, ods::ComfortRules, ods::JudgedPicture, ods::Strain, ods::StrainedPlace;
using ods::Json;

namespace {

using Shares = ods::EnumArray<ComfortLevel, double>;

std::string shares_text(const Shares& shares) {
  std::string text;
  for (const ComfortLevel level : ods::kComfortLevels) {
    text += fmt::format("{}{} {}", level == ComfortLevel::kOk ? "" : ", ", comfort_level_name(level),
                        share_text(shares[level]));
  }
  return text;
}

void print_place(const StrainedPlace& place) {
  const std::string remedy = remedy_text(place);
  const ods::StrainRow& strain = ods::strain_row(place.strain);
  put_out(fmt::format("{}: {}, {:.2f} m away, {} ({} of the picture): {}, {:.3g} {}{}{}\n",
                      comfort_level_name(place.level), thing_text(place), place.distance, direction_text(place),
                      share_text(place.share), strain.title, place.value, strain.unit, remedy.empty() ? "" : "; ",
                      remedy));
}

Json shares_json(const Shares& shares) {
  Json json;
  for (const ComfortLevel level : ods::kComfortLevels) json[comfort_level_name(level)] = shares[level];
  return json;
}

Json place_json(const JudgedPicture& judged, const StrainedPlace& place) {
  return {{"name", place.name},
          {"eye", ods::eye_name(judged.verdict.per_eye[place.eye].eye)},
          {"level", comfort_level_name(place.level)},
          {"strain", ods::strain_row(place.strain).name},
          {"value", place.value},
          {"unit", ods::strain_row(place.strain).unit},
          {"azimuth", place.azimuth},
          {"elevation", place.elevation},
          {"distance", place.distance},
          {"enough", place.enough},
          {"ipd", ods::decimal(place.ipd)},
          {"share", place.share}};
}

// Metres in whole millimetres, rounded down.
double millimetres(float metres) {
  return std::floor(1e3 * double{metres}) / 1e3;
}

}  // namespace

std::string direction_text(const StrainedPlace& place) {
  return ods::direction_text(place.azimuth, place.elevation);
}

std::string thing_text(const StrainedPlace& place) {
  return place.name.empty() ? "an area" : "'" + place.name + "'";
}

std::string share_text(double share) {
  return share > 0.0 && share < 0.001 ? "<0.1 %" : fmt::format("{:.1f} %", 100.0 * share);
}

std::string remedy_text(const StrainedPlace& place) {
  const std::string move = ods::remedy_by_distance(place);
  if (move.empty() || place.strain == Strain::kRule || !(millimetres(place.ipd) > 0.0)) return move;
  return move + fmt::format(", or --ipd {:.3f}", millimetres(place.ipd));
}

std::string measured_text(const ods::MeasuredEyes& eyes) {
  std::string text = "The file does not record how the eyes were placed; measured from the pixels: ";
  const ods::StereoCamera& camera = eyes.camera;
  text += camera.convergence == ods::kParallel
              ? fmt::format("eyes {:.3g} m apart", camera.ipd)
              : fmt::format("eyes {:.3g} m apart that converge at {:.3g} m", camera.ipd, camera.convergence_distance);
  if (!eyes.is_known) return text;
  text += eyes.is_merged ? ", a pole merge with " + merge_curve_text(*camera.merge_map) : ", no pole merge";
  return text + fmt::format(" (+-{:.0f} %, measured up to {:.0f} degrees up and {:.0f} down)",
                            std::max(1.0, 100.0 * eyes.error), eyes.up, eyes.down);
}

std::vector<std::string> remedy_lines(const ComfortJob& job, const JudgedPicture& judged) {
  const ods::ComfortVerdict& verdict = judged.verdict;
  std::vector<std::string> lines;
  for (const std::string& name : judged.hidden) {
    lines.push_back(
        fmt::format("'{}' reaches into the circle of the eyes, where nothing is seen: move it, or the camera", name));
  }
  if (!verdict.worst() || verdict.worst()->level < ComfortLevel::kWarning) return lines;
  const bool is_rule = job.comfort.rules != ComfortRules::kStrain;
  const double ipd = millimetres(verdict.largest_ipd);
  lines.push_back(
      "move these things, or the camera" +
      (is_rule || !(ipd > 0.0) ? "" : fmt::format("; or --ipd {:.3g} instead of {:.3g}", ipd, judged.camera.ipd)));
  if (verdict.max[Strain::kVertical] > ods::strain_limits(Strain::kVertical, job.comfort.viewer).warning) {
    lines.emplace_back("above and below: --merge auto keeps as much stereo as the distances there allow");
  }
  return lines;
}

// --- for people and for programs -------------------------------------------------------------------------------------

void print_text(const ComfortJob& job, const JudgedPicture& judged) {
  const ods::ComfortVerdict& verdict = judged.verdict;
  put_out(fmt::format("{}: {}; eyes {:.3g} m apart, nearest {:.2f} m\n", job.scene.name,
                      comfort_level_name(verdict.level), judged.camera.ipd, verdict.nearest));
  if (!judged.why_matched.empty()) put_out(fmt::format("{}: judged by matching them\n", judged.why_matched));
  if (judged.measured) put_out(fmt::format("{}\n", measured_text(*judged.measured)));
  if (verdict.match) {
    put_out(fmt::format("by matching: +-{:.0f} minutes of arc; {:.0f} % of the picture could be matched\n",
                        verdict.match->precision, 100.0 * verdict.match->share));
    if (verdict.apart > ComfortLevel::kOk) {
      put_out(
          fmt::format("{}: one eye sees things {:.0f} minutes of arc higher than the other: ods lint has the remedy\n",
                      comfort_level_name(verdict.apart), verdict.match->apart));
    }
  }
  const std::vector<ods::EyeComfort>& eyes = verdict.per_eye;
  if (eyes.size() == 2 && eyes[0].level != eyes[1].level) {
    put_out(fmt::format("{} eye: {}; {} eye: {}\n", ods::eye_name(eyes[0].eye), comfort_level_name(eyes[0].level),
                        ods::eye_name(eyes[1].eye), comfort_level_name(eyes[1].level)));
  }
  put_out(fmt::format("{} of the picture, by solid angle; where people look: {}\n", shares_text(verdict.share),
                      shares_text(verdict.looked)));
  if (verdict.head_roll > 0.0 && verdict.head_roll < 89.0) {
    put_out(fmt::format("a head may tilt sideways by {:.2g} degrees before the eyes must diverge vertically too far\n",
                        verdict.head_roll));
  }
  for (const StrainedPlace& place : verdict.places) print_place(place);
  for (const std::string& remedy : remedy_lines(job, judged)) put_out(fmt::format("remedy: {}\n", remedy));
}

void print_json(const ComfortJob& job, const JudgedPicture& judged) {
  const ods::ComfortVerdict& verdict = judged.verdict;
  const ods::Viewer& viewer = job.comfort.viewer;
  Json json = {{"path", job.scene.name},
               {"level", comfort_level_name(verdict.level)},
               {"ipd", ods::decimal(judged.camera.ipd)},
               {"viewer_ipd", ods::decimal(viewer.ipd)},
               {"gaze", viewer.gaze_degrees},
               {"roll", viewer.roll_degrees}};
  json["focus"] = std::isfinite(viewer.focus) ? Json(ods::decimal(viewer.focus)) : Json("infinity");
  json["nearest"] = ods::json_number(verdict.nearest);
  json["unknown"] = verdict.unknown;
  for (const ods::EyeComfort& eye : verdict.per_eye)
    json["eyes"][ods::eye_name(eye.eye)] = comfort_level_name(eye.level);
  if (const std::optional<ods::MatchQuality>& match = verdict.match) {
    json["matched"] = {{"share", match->share}, {"precision", match->precision}, {"apart", match->apart}};
    if (!judged.why_matched.empty()) json["matched"]["why"] = judged.why_matched;
  }
  if (judged.measured) {
    const ods::MeasuredEyes& eyes = *judged.measured;
    json["measured"] = {{"merged", eyes.is_known ? Json(eyes.is_merged) : Json()},
                        {"convergence", ods::convergence_name(eyes.camera.convergence)},
                        {"error", eyes.error},
                        {"up", eyes.up},
                        {"down", eyes.down}};
    if (eyes.is_merged) {
      for (int row = 0; row < eyes.camera.merge_map->height; row++) {
        json["measured"]["shares"].push_back(*eyes.camera.merge_map->at(0, row));
      }
    }
  }
  json["largest_ipd"] = job.comfort.rules == ComfortRules::kStrain ? Json(ods::decimal(verdict.largest_ipd)) : Json();
  json["head_roll"] = verdict.head_roll;
  json["share"] = shares_json(verdict.share);
  json["looked"] = shares_json(verdict.looked);
  for (const ods::StrainRow& strain : ods::kStrainTable) {
    const bool is_rule = strain.member == Strain::kRule;
    if (is_rule == (job.comfort.rules == ComfortRules::kStrain)) continue;
    json["most"][strain.name] = verdict.max[strain.member];
  }
  json["places"] = Json::array();
  for (const StrainedPlace& place : verdict.places) json["places"].push_back(place_json(judged, place));
  json["hidden"] = judged.hidden;
  put_json(json);
}
