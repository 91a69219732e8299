// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/verdict/comfort_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/console/console.h"
#include "cli/verdict/comfort_report.h"
#include "cli/verdict/comfort_video_report.h"
#include "ods/base/base64.h"
#include "ods/base/quote.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/heat.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"

using ods::ComfortLevel, ods::Image, ods::JudgedPicture, ods::StrainedPlace, ods::vec2, ods::vec3;

namespace {

constexpr int kCropWidth = 256, kCropHeight = 224;  // pixels
constexpr float kCropAngle = 40.0f;                 // degrees across
constexpr float kDegree = 3.14159265f / 180.0f;

constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<style>
:root { --back: #fff; --ink: #1c1c1e; --soft: #6b6b70; --line: #dcdce0;
        --ok: #2e7d4f; --caution: #96700a; --warning: #c2410c; --error: #b91c1c; }
@media (prefers-color-scheme: dark) {
  :root { --back: #17181a; --ink: #ececee; --soft: #a0a0a8; --line: #37383c;
          --ok: #6fcf97; --caution: #f2c94c; --warning: #ff9455; --error: #ff7b72; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.2rem; max-width: 58rem; background: var(--back); color: var(--ink);
       font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.4rem; margin: 0 0 .3rem; } h2 { font-size: 1.1rem; margin: 2rem 0 .6rem; }
p { margin: .3rem 0; } small, figcaption, .soft { color: var(--soft); font-size: .875rem; }
.ok { color: var(--ok); } .caution { color: var(--caution); } .warning { color: var(--warning); }
.error { color: var(--error); } b[class] { text-transform: capitalize; }
.bar { display: flex; height: .75rem; border-radius: .4rem; overflow: hidden; margin: .6rem 0; }
.bar i { background: currentColor; }
figure { margin: .8rem 0; } img { display: block; width: 100%; height: auto; border-radius: .4rem; }
ol { list-style: none; margin: 0; padding: 0; display: grid; gap: .8rem;
     grid-template-columns: repeat(auto-fill, minmax(min(100%, 26rem), 1fr)); }
li { display: grid; grid-template-columns: 8rem 1fr; gap: .8rem; padding: .7rem; border: 1px solid var(--line);
     border-radius: .6rem; }
.bare { display: block; }
.crop { position: relative; align-self: start; }
.crop::after { content: ""; position: absolute; left: 50%; top: 50%; width: 1.4rem; height: 1.4rem; margin: -.7rem;
               border: 2px solid #fff; border-radius: 50%; box-shadow: 0 0 0 1px #000; }
svg { display: block; width: 100%; height: auto; } svg text { font: 11px system-ui, sans-serif; fill: var(--soft); }
table { border-collapse: collapse; } td { padding: .15rem 1rem .15rem 0; vertical-align: top; }
</style>
)";

// The picture as a JPEG.
std::string data_uri(const ods::Image& light, const std::string& path) {
  ods::FileHeader header;
  header.format = ods::FileFormat::kJpeg;
  header.width = light.width, header.height = light.height;
  header.channels = {{"R"}, {"G"}, {"B"}};
  header.quality = 85;
  const std::string bytes = ods::image_bytes(path, header, [&](int y, std::span<float> row) {
    for (int x = 0; x < light.width; x++) {
      const float* pixel = light.at(x, y);
      const ods::vec3 shown = ods::tone_map(ods::vec3(pixel[0], pixel[1], pixel[2]), 0.0f, ods::ToneCurve::kNeutral);
      for (int c = 0; c < 3; c++) row[static_cast<size_t>(3 * x + c)] = ods::srgb_encode(shown[c]);
    }
  });
  return "data:image/jpeg;base64," + ods::encode_base64(bytes);
}

std::string picture_html(const ods::Image& light, const std::string& words, const std::string& path) {
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">", data_uri(light, path), light.width,
                     light.height, ods::xml_text(words));
}

// The view of the eye that looks at a place.
Image crop_of(const JudgedPicture& judged, const StrainedPlace& place) {
  const ods::Camera camera = ods::make_camera(judged.camera);
  const Image& light = judged.light[place.eye];
  const float theta = static_cast<float>(place.azimuth) * kDegree, phi = static_cast<float>(place.elevation) * kDegree;
  const vec3 ahead = ods::look_at_angles(theta, phi).direction;
  const vec3 right = ods::look_at_angles(theta + 90.0f * kDegree, 0.0f).direction, up = cross(right, ahead);
  const float pixel = 2.0f * std::tan(0.5f * kCropAngle * kDegree) / kCropWidth;
  Image crop(kCropWidth, kCropHeight, 3);
  for (int y = 0; y < kCropHeight; y++) {
    for (int x = 0; x < kCropWidth; x++) {
      const vec3 way = ahead + right * (pixel * static_cast<float>(x - kCropWidth / 2)) +
                       up * (pixel * static_cast<float>(kCropHeight / 2 - y));
      const ods::ImagePoint point = ods::place_of(camera.projection, normalize(way));
      if (!point.seen) continue;
      const glm::ivec2 from = ods::pixel_at(point.uv, light);
      std::copy_n(light.at(from.x, from.y), 3, crop.at(x, y));
    }
  }
  return crop;
}

std::string level_html(ComfortLevel level) {
  return fmt::format("<b class=\"{0}\">{0}</b>", comfort_level_name(level));
}

std::string line_html(const std::string& text) {
  return "<p>" + ods::xml_text(text) + "</p>\n";
}

// crop: the picture of the thing as HTML, or empty.
std::string thing_html(ComfortLevel level, const std::string& crop, const std::string& title, const std::string& where,
                       const std::string& what, const std::string& remedy) {
  return fmt::format("<li{}>{}<div><p>{} {}</p><p class=\"soft\">{}</p><p>{}</p><p>{}</p></div></li>\n",
                     crop.empty() ? " class=\"bare\"" : "", crop, level_html(level), ods::xml_text(title),
                     ods::xml_text(where), ods::xml_text(what),
                     ods::xml_text(remedy.empty() ? "" : "Remedy: " + remedy));
}

std::string crop_html(const JudgedPicture& judged, const StrainedPlace& place, const std::string& path) {
  return "<div class=\"crop\">" + picture_html(crop_of(judged, place), thing_text(place), path) + "</div>";
}

std::string list_html(const std::string& things) {
  return things.empty() ? "" : "<h2>The worst strains</h2>\n<ol>\n" + things + "</ol>\n";
}

// points: seconds and value; not finite where it is unknown. Limits are dashed lines; 0 or infinite: none.
using Points = std::vector<std::pair<double, double>>;
std::string curve_html(std::string_view title, std::string_view unit, const ods::StrainLimits& limits,
                       const Points& points) {
  constexpr double kWidth = 640.0, kHeight = 150.0, kLeft = 44.0, kRight = 8.0, kTop = 10.0, kBottom = 22.0;
  double maximum = 1e-9, end = 1e-9;
  for (const auto& [seconds, value] : points) {
    end = std::max(end, seconds);
    if (std::isfinite(value)) maximum = std::max(maximum, value);
  }
  const bool shows_limit = std::isfinite(limits.caution) && limits.caution > 0.0;
  if (shows_limit) maximum = std::max(maximum, 1.2 * limits.caution);
  const auto x_of = [&](double seconds) { return kLeft + (kWidth - kLeft - kRight) * seconds / end; };
  const auto y_of = [&](double value) { return kHeight - kBottom - (kHeight - kTop - kBottom) * value / maximum; };
  std::string svg =
      fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}, {}\">", kWidth, kHeight, title, unit);
  for (const auto& [level, value] : {std::pair{ComfortLevel::kCaution, limits.caution},
                                     {ComfortLevel::kWarning, limits.warning},
                                     {ComfortLevel::kError, limits.error}}) {
    if (!(value > 0.0) || value > maximum) continue;
    svg += fmt::format(
        "<line class=\"{}\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"currentColor\" "
        "stroke-dasharray=\"4 4\"/>",
        comfort_level_name(level), kLeft, kWidth - kRight, y_of(value), y_of(value));
  }
  std::string path;
  bool draws = false;
  for (const auto& [seconds, value] : points) {
    if (std::isfinite(value)) path += fmt::format("{}{:.1f} {:.1f}", draws ? "L" : "M", x_of(seconds), y_of(value));
    draws = std::isfinite(value);
  }
  svg += fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\" stroke-linecap=\"round\"/>", path);
  svg += fmt::format("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2}\" y2=\"{2}\" stroke=\"var(--line)\"/>", kLeft,
                     kWidth - kRight, kHeight - kBottom);
  svg += fmt::format("<text x=\"4\" y=\"{:.0f}\">{:.3g}</text><text x=\"4\" y=\"{:.0f}\">0</text>", kTop + 8.0, maximum,
                     kHeight - kBottom);
  svg +=
      fmt::format("<text x=\"{}\" y=\"{}\">0 s</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.3g} s</text></svg>",
                  kLeft, kHeight - 6.0, kWidth - kRight, kHeight - 6.0, end);
  return fmt::format("<figure>{}<figcaption>{}, {}</figcaption></figure>\n", svg, title, unit);
}

std::string shares_html(const ods::ComfortVerdict& verdict) {
  std::string bar = "<div class=\"bar\">", words;
  for (const ComfortLevel level : ods::kComfortLevels) {
    const double share = verdict.share[level];
    bar += fmt::format("<i class=\"{}\" style=\"flex:{:.5f}\"></i>", comfort_level_name(level), share);
    words += fmt::format("<span class=\"{0}\">{0} {1:.1f} %</span> ", comfort_level_name(level), 100.0 * share);
  }
  return bar + "</div><p>" + words + "<small>of the picture, by solid angle</small></p>\n";
}

// The eye with the worst place.
std::string heat_html(const JudgedPicture& judged, const std::string& whose, const std::string& path) {
  const ods::ComfortVerdict& verdict = judged.verdict;
  const size_t eye = verdict.worst() ? verdict.worst()->eye : 0;
  const std::string caption = fmt::format("{} {} eye: caution yellow, warning orange, error red", whose,
                                          ods::eye_name(verdict.per_eye[eye].eye));
  const Image heat = ods::heat_of(judged.light[eye], verdict.per_eye[eye].levels);
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", picture_html(heat, caption, path), caption);
}

std::string source_html(std::string_view what, std::string_view source) {
  return fmt::format("<tr><td>{}</td><td class=\"soft\">{}</td></tr>\n", what, source);
}

void save(const ComfortJob& job, ComfortLevel level, const std::string& body, const std::string& sources) {
  const std::string title = ods::xml_text(std::filesystem::path(job.scene.name).filename().string());
  std::string html = kHead;
  html += fmt::format("<title>{0}: {1}</title>\n</head>\n<body>\n<h1>{0}: {2}</h1>\n", title, comfort_level_name(level),
                      level_html(level));
  html += body;
  html += "<h2>Where the limits come from</h2>\n<table>\n" + sources + "</table>\n</body>\n</html>\n";
  ods::write_file(job.html, html);
  announce_file(job.html);
}

}  // namespace

void save_page(const ComfortJob& job, const JudgedPicture& judged) {
  const ods::ComfortVerdict& verdict = judged.verdict;
  std::string body = line_html(
      fmt::format("Eyes {:.3g} m apart; the nearest thing is {:.2f} m away.", judged.camera.ipd, verdict.nearest));
  if (!judged.why_matched.empty()) body += line_html(judged.why_matched + ".");
  if (judged.measured) body += line_html(measured_text(*judged.measured) + ".");
  if (verdict.match) {
    body +=
        line_html(fmt::format("Judged by matching the eyes: +-{:.0f} minutes of arc; {:.0f} % of the picture "
                              "could be matched.",
                              verdict.match->precision, 100.0 * verdict.match->share));
  }
  body += shares_html(verdict) + heat_html(judged, "The", job.html);
  std::string things, sources;
  for (const StrainedPlace& place : verdict.places) {
    const ods::StrainRow& strain = ods::strain_row(place.strain);
    things += thing_html(place.level, crop_html(judged, place, job.html),
                         fmt::format("{}, {:.2f} m away", thing_text(place), place.distance),
                         direction_text(place) + fmt::format("; {} of the picture", share_text(place.share)),
                         fmt::format("{}: {:.3g} {}", strain.title, place.value, strain.unit), remedy_text(place));
  }
  body += list_html(things);
  const std::vector<std::string> remedies = remedy_lines(job, judged);
  if (!remedies.empty()) body += "<h2>What would help</h2>\n";
  for (const std::string& remedy : remedies) body += line_html(remedy);
  for (const ods::StrainRow& row : ods::kStrainTable) {
    const bool is_rule = row.member == ods::Strain::kRule, has_rule = job.comfort.rules != ods::ComfortRules::kStrain;
    if (is_rule == has_rule && !row.source.empty()) sources += source_html(row.title, row.source);
  }
  save(job, verdict.level, body, sources);
}

void save_page(const ComfortJob& job, const ods::VideoComfort& video) {
  std::string body = line_html(sampled_frames_text(video)) + heat_html(video.worst, "The worst moment's", job.html);
  std::string things, sources;
  const StrainedPlace* const shown = video.worst.verdict.worst();
  for (const ods::VideoStrain& strain : video.strains) {
    std::string crop, where, remedy;
    if (const std::optional<StrainedPlace>& place = strain.place) {
      where = fmt::format("{:.2f} m away, {}", place->distance, direction_text(*place));
      remedy = remedy_text(*place);
      if (shown && shown->azimuth == place->azimuth) crop = crop_html(video.worst, *place, job.html);
    }
    things += thing_html(strain.level, crop, times_text(strain), where, strain_text(strain), remedy);
  }
  body += list_html(things) + "<h2>Over time</h2>\n";
  using Moment = ods::VideoMoment;
  const auto add = [&](std::string_view title, std::string_view unit, const ods::StrainLimits& limits,
                       double Moment::*value, bool needs_motion) {
    Points points;
    for (const Moment& moment : video.moments) {
      points.emplace_back(moment.seconds, needs_motion && !moment.is_carried ? std::nan("") : moment.*value);
    }
    body += curve_html(title, unit, limits, points);
  };
  const ods::StrainLimits vertical = ods::strain_limits(ods::Strain::kVertical, job.comfort.viewer);
  add("The nearest thing", "metres", {}, &Moment::nearest, false);
  if (job.comfort.rules == ods::ComfortRules::kStrain) {
    add("Maximum convergence", "degrees", {}, &Moment::vergence, false);
    add("Vertical disparity at its worst", "minutes of arc", vertical, &Moment::vertical, false);
  }
  for (const auto& [ride, member] : {std::pair{ods::Ride::kTurn, &Moment::turn},
                                     {ods::Ride::kTilt, &Moment::tilt},
                                     {ods::Ride::kSpeed, &Moment::speed},
                                     {ods::Ride::kAcceleration, &Moment::acceleration}}) {
    const ods::RideRow& row = ods::ride_row(ride);
    add(row.title, row.unit, row.limits, member, true);
  }
  for (const ods::RideRow& row : ods::kRideTable) sources += source_html(row.title, row.source);
  save(job, video.level, body, sources);
}
