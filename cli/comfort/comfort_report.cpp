// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/comfort_report.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

using ods::ComfortLevel, ods::ComfortReport, ods::ComfortRules, ods::Strain, ods::StrainedPlace;
using Json = nlohmann::ordered_json;

namespace {

std::string_view level_name(ComfortLevel level) {
  return ods::name_in(ods::kComfortLevelTable, level);
}

// "23 degrees right, 12 down".
std::string direction_text(const StrainedPlace& place) {
  const auto around = std::lround(std::abs(place.azimuth)), above = std::lround(std::abs(place.elevation));
  std::string text = around == 0     ? "ahead"
                     : around == 180 ? "behind"
                                     : fmt::format("{} degrees {}", around, place.azimuth < 0.0 ? "left" : "right");
  if (above > 0)
    text += fmt::format(", {}{} {}", above, around == 0 || around == 180 ? " degrees" : "",
                        place.elevation < 0.0 ? "down" : "up");
  return text;
}

std::string share_text(double share) {
  return share > 0.0 && share < 0.001 ? "<0.1 %" : fmt::format("{:.1f} %", 100.0 * share);
}

void print_place(const StrainedPlace& place) {
  const ods::StrainRow& strain = ods::strain_row(place.strain);
  const std::string name = place.name.empty() ? "an area" : "'" + place.name + "'";
  fmt::print("{}: {}, {:.2f} m away, {} ({} of the picture): {}, {:.3g} {}; {:.2f} m would do\n",
             level_name(place.level), name, place.distance, direction_text(place), share_text(place.share),
             strain.title, place.value, strain.unit, place.enough);
}

void print_cures(const ods::StereoCamera& camera, const ods::ComfortOptions& options, const ComfortReport& report) {
  if (ods::worst_level(report) < ComfortLevel::kWarning) return;
  if (options.rules != ComfortRules::kStrain) return fmt::print("cure: move these things, or the camera\n");
  fmt::print("cure: move these things, or the camera; or --ipd {:.3g} instead of {:.3g}\n",
             std::floor(1e3 * double{report.largest_ipd}) / 1e3, camera.ipd);
  const auto& limits = ods::strain_limits(Strain::kVertical, options.viewer);
  if (report.most[static_cast<size_t>(Strain::kVertical)] > limits.warning) {
    fmt::print("cure of what is above or below: a pole merge that begins earlier, as --merge cosine,30,90\n");
  }
}

}  // namespace

void print_text(const std::string& name, const ods::StereoCamera& camera, const ods::ComfortOptions& options,
                const ComfortReport& report) {
  fmt::print("{}: {}; eyes {:.3g} m apart, nearest {:.2f} m\n", name, level_name(ods::worst_level(report)), camera.ipd,
             report.nearest);
  for (const ComfortLevel level : ods::kComfortLevels) {
    fmt::print("{}{} {}", level == ComfortLevel::kOk ? "" : ", ", level_name(level),
               share_text(report.share[static_cast<size_t>(level)]));
  }
  fmt::print(" of the picture, by solid angle\n");
  for (const StrainedPlace& place : report.places) print_place(place);
  print_cures(camera, options, report);
}

void print_json(const std::string& name, const ods::StereoCamera& camera, const ods::ComfortOptions& options,
                const ComfortReport& report) {
  Json json = {{"path", name},
               {"level", level_name(ods::worst_level(report))},
               {"ipd", camera.ipd},
               {"viewer_ipd", options.viewer.ipd},
               {"gaze", options.viewer.gaze_degrees}};
  json["focus"] = std::isfinite(options.viewer.focus) ? Json(options.viewer.focus) : Json("infinity");
  json["nearest"] = std::isfinite(report.nearest) ? Json(report.nearest) : Json();
  json["unknown"] = report.unknown;
  json["largest_ipd"] = report.largest_ipd;
  for (const ComfortLevel level : ods::kComfortLevels) {
    json["share"][level_name(level)] = report.share[static_cast<size_t>(level)];
  }
  for (const ods::StrainRow& strain : ods::kStrainTable) {
    const bool is_rule = strain.member == Strain::kRule;
    if (is_rule == (options.rules == ComfortRules::kStrain)) continue;
    json["most"][strain.name] = report.most[static_cast<size_t>(strain.member)];
  }
  json["places"] = Json::array();
  for (const StrainedPlace& place : report.places) {
    json["places"].push_back({{"name", place.name},
                              {"level", level_name(place.level)},
                              {"strain", ods::strain_row(place.strain).name},
                              {"value", place.value},
                              {"unit", ods::strain_row(place.strain).unit},
                              {"azimuth", place.azimuth},
                              {"elevation", place.elevation},
                              {"distance", place.distance},
                              {"enough", place.enough},
                              {"share", place.share}});
  }
  std::puts(json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}
