// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/page_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/comfort/comfort_report.h"
#include "cli/comfort/heat.h"
#include "cli/comfort/video_report.h"
#include "ods/camera/pixel.h"

using ods::ComfortReport, ods::Image, ods::Strain, ods::StrainedPlace, ods::vec2, ods::vec3;

namespace {

constexpr int kCropWidth = 256, kCropHeight = 224;  // pixels
constexpr float kCropAngle = 40.0f;                 // degrees across
constexpr float kDegree = 3.14159265f / 180.0f;

// What a viewer sees who looks at a place.
Image crop_of(const Judged& judged, double azimuth, double elevation) {
  const ods::Camera camera = ods::make_camera(judged.seen.camera);
  const float theta = static_cast<float>(azimuth) * kDegree, phi = static_cast<float>(elevation) * kDegree;
  const vec3 ahead = ods::look_at_angles(theta, phi).direction;
  const vec3 right = ods::look_at_angles(theta + 90.0f * kDegree, 0.0f).direction, up = cross(right, ahead);
  const float pixel = 2.0f * std::tan(0.5f * kCropAngle * kDegree) / kCropWidth;
  Image crop(kCropWidth, kCropHeight, 3);
  for (int y = 0; y < kCropHeight; y++) {
    for (int x = 0; x < kCropWidth; x++) {
      const vec3 way = ahead + right * (pixel * static_cast<float>(x - kCropWidth / 2)) +
                       up * (pixel * static_cast<float>(kCropHeight / 2 - y));
      const ods::ImagePoint place = ods::place_of(camera.projection, normalize(way));
      if (!place.seen) continue;
      const glm::ivec2 from = ods::pixel_at(place.uv, judged.light);
      std::copy_n(judged.light.at(from.x, from.y), 3, crop.at(x, y));
    }
  }
  return crop;
}

std::string cure_line(const StrainedPlace& place) {
  const std::string cure = cure_text(place);
  return cure.empty() ? "" : "Cure: " + cure;
}

PageThing thing_of(const StrainedPlace& place, const Judged& judged) {
  const ods::StrainRow& strain = ods::strain_row(place.strain);
  return {place.level,
          fmt::format("{}, {:.2f} m away", thing_text(place), place.distance),
          direction_text(place) + fmt::format("; {} of the picture", share_text(place.share)),
          fmt::format("{}: {:.3g} {}", strain.title, place.value, strain.unit),
          cure_line(place),
          crop_of(judged, place.azimuth, place.elevation)};
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

ComfortPage page_of(const ComfortJob& job, const Looked& looked, const ComfortReport& report) {
  ComfortPage page;
  page.title = file_name(job.scene.name);
  page.level = verdict(job, looked, report);
  page.lines.push_back(
      fmt::format("Eyes {:.3g} m apart; the nearest thing is {:.2f} m away.", looked.camera.ipd, report.nearest));
  if (!looked.why_matched.empty()) page.lines.push_back(looked.why_matched + ".");
  if (looked.measured) page.lines.push_back(measured_text(*looked.measured) + ".");
  if (looked.match) {
    page.lines.push_back(
        fmt::format("Judged by matching the eyes: +-{:.0f} minutes of arc; {:.0f} % of the picture "
                    "could be matched.",
                    looked.match->precision, 100.0 * looked.match->share));
  }
  for (const ods::ComfortLevel level : ods::kComfortLevels) {
    page.shares.emplace_back(level, report.share[static_cast<size_t>(level)]);
  }
  page.pictures.push_back({"What strains: caution yellow, warning orange, error red", heat_of(looked.eyes[0], report)});
  for (const StrainedPlace& place : report.places) page.things.push_back(thing_of(place, looked.eyes[0]));
  page.cures = cure_lines(job, looked, report);
  for (const ods::StrainRow& row : ods::kStrainTable) {
    const bool is_rule = row.member == Strain::kRule;
    if (is_rule != (job.comfort.rules == ods::ComfortRules::kStrain) && !row.source.empty()) {
      page.sources.emplace_back(row.title, row.source);
    }
  }
  return page;
}

ComfortPage page_of(const ComfortJob& job, const ods::VideoComfort& video) {
  ComfortPage page;
  page.title = file_name(job.scene.name);
  page.level = ods::worst_level(video);
  page.lines.push_back(looked_text(video));
  const Judged judged{*video.seen, light_of(video.grey)};
  page.pictures.push_back(
      {"The worst moment's left eye: caution yellow, warning orange, error red", heat_of(judged, video.report)});
  for (const ods::VideoStrain& strain : video.strains) {
    PageThing thing{strain.level, times_text(strain), "", strain_text(strain), "", {}};
    if (strain.place) {
      thing.where = fmt::format("{:.2f} m away, {}", strain.place->distance, direction_text(*strain.place));
      thing.cure = cure_line(*strain.place);
      const bool is_shown = !video.report.places.empty() && video.report.places[0].azimuth == strain.place->azimuth;
      if (is_shown) thing.crop = crop_of(judged, strain.place->azimuth, strain.place->elevation);
    }
    page.things.push_back(std::move(thing));
  }
  const auto add = [&](const char* title, const char* unit, ods::StrainLimits limits, auto value_of) {
    PageCurve curve{title, unit, {}, limits};
    for (const ods::VideoMoment& moment : video.moments) curve.points.emplace_back(moment.seconds, value_of(moment));
    page.curves.push_back(std::move(curve));
  };
  using Moment = const ods::VideoMoment&;
  const double unknown = std::nan("");
  add("The nearest thing", "metres", {}, [](Moment m) { return m.nearest; });
  add("The most that eyes must converge", "degrees", {}, [](Moment m) { return m.vergence; });
  add("Vertical disparity at its worst", "minutes of arc", ods::strain_limits(Strain::kVertical, job.comfort.viewer),
      [](Moment m) { return m.vertical; });
  for (const auto& [ride, member] : {std::pair{ods::Ride::kTurn, &ods::VideoMoment::turn},
                                     {ods::Ride::kTilt, &ods::VideoMoment::tilt},
                                     {ods::Ride::kSpeed, &ods::VideoMoment::speed},
                                     {ods::Ride::kAcceleration, &ods::VideoMoment::acceleration}}) {
    const ods::RideRow& row = ods::ride_row(ride);
    add(row.title.data(), row.unit.data(), row.limits,
        [&, member = member](Moment m) { return m.is_carried ? m.*member : unknown; });
  }
  for (const ods::RideRow& row : ods::kRideTable) page.sources.emplace_back(row.title, row.source);
  return page;
}
