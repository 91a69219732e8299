// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/comfort_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/base/base64.h"
#include "ods/base/quote.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"

using ods::ComfortLevel;

namespace {

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

// As a JPEG.
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

std::string thing_html(const PageThing& thing, const std::string& path) {
  const std::string crop =
      thing.crop.pixels.empty() ? "" : "<div class=\"crop\">" + picture_html(thing.crop, thing.title, path) + "</div>";
  return fmt::format(
      "<li{}>{}<div><p><b class=\"{}\">{}</b> {}</p><p class=\"soft\">{}</p><p>{}</p><p>{}</p></div></li>\n",
      crop.empty() ? " class=\"bare\"" : "", crop, comfort_level_name(thing.level), comfort_level_name(thing.level),
      ods::xml_text(thing.title), ods::xml_text(thing.where), ods::xml_text(thing.what), ods::xml_text(thing.cure));
}

// A curve over time with its limits as dashed lines. A break in it is a value that is unknown.
std::string curve_html(const PageCurve& curve) {
  constexpr double kWidth = 640.0, kHeight = 150.0, kLeft = 44.0, kRight = 8.0, kTop = 10.0, kBottom = 22.0;
  double most = 1e-9, end = 1e-9;
  for (const auto& [seconds, value] : curve.points) {
    end = std::max(end, seconds);
    if (std::isfinite(value)) most = std::max(most, value);
  }
  const bool shows_limit = std::isfinite(curve.limits.caution) && curve.limits.caution > 0.0;
  if (shows_limit) most = std::max(most, 1.2 * curve.limits.caution);
  const auto x_of = [&](double seconds) { return kLeft + (kWidth - kLeft - kRight) * seconds / end; };
  const auto y_of = [&](double value) { return kHeight - kBottom - (kHeight - kTop - kBottom) * value / most; };
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}, {}\">", kWidth, kHeight,
                                ods::xml_text(curve.title), ods::xml_text(curve.unit));
  for (const auto& [level, value] : {std::pair{ComfortLevel::kCaution, curve.limits.caution},
                                     {ComfortLevel::kWarning, curve.limits.warning},
                                     {ComfortLevel::kError, curve.limits.error}}) {
    if (!(value > 0.0) || value > most) continue;
    svg += fmt::format(
        "<line class=\"{}\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"currentColor\" "
        "stroke-dasharray=\"4 4\"/>",
        comfort_level_name(level), kLeft, kWidth - kRight, y_of(value), y_of(value));
  }
  std::string path;
  bool draws = false;
  for (const auto& [seconds, value] : curve.points) {
    if (std::isfinite(value)) path += fmt::format("{}{:.1f} {:.1f}", draws ? "L" : "M", x_of(seconds), y_of(value));
    draws = std::isfinite(value);
  }
  svg += fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\" stroke-linecap=\"round\"/>", path);
  svg += fmt::format("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2}\" y2=\"{2}\" stroke=\"var(--line)\"/>", kLeft,
                     kWidth - kRight, kHeight - kBottom);
  svg += fmt::format("<text x=\"4\" y=\"{:.0f}\">{:.3g}</text><text x=\"4\" y=\"{:.0f}\">0</text>", kTop + 8.0, most,
                     kHeight - kBottom);
  svg +=
      fmt::format("<text x=\"{}\" y=\"{}\">0 s</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.3g} s</text></svg>",
                  kLeft, kHeight - 6.0, kWidth - kRight, kHeight - 6.0, end);
  return fmt::format("<figure>{}<figcaption>{}, {}</figcaption></figure>\n", svg, ods::xml_text(curve.title),
                     ods::xml_text(curve.unit));
}

std::string bar_html(const ComfortPage& page) {
  std::string bar = "<div class=\"bar\">", words;
  for (const auto& [level, share] : page.shares) {
    bar += fmt::format("<i class=\"{}\" style=\"flex:{:.5f}\"></i>", comfort_level_name(level), share);
    words += fmt::format("<span class=\"{}\">{} {:.1f} %</span> ", comfort_level_name(level), comfort_level_name(level),
                         100.0 * share);
  }
  return bar + "</div><p>" + words + "<small>of the picture, by solid angle</small></p>\n";
}

}  // namespace

void write_page(const std::string& path, const ComfortPage& page) {
  std::string html = kHead;
  html += fmt::format("<title>{0}: {1}</title>\n</head>\n<body>\n<h1>{0}: <b class=\"{1}\">{1}</b></h1>\n",
                      ods::xml_text(page.title), comfort_level_name(page.level));
  for (const std::string& line : page.lines) html += "<p>" + ods::xml_text(line) + "</p>\n";
  if (!page.shares.empty()) html += bar_html(page);
  for (const PagePicture& picture : page.pictures) {
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        picture_html(picture.light, picture.caption, path), ods::xml_text(picture.caption));
  }
  if (!page.things.empty()) html += "<h2>What strains most</h2>\n<ol>\n";
  for (const PageThing& thing : page.things) html += thing_html(thing, path);
  if (!page.things.empty()) html += "</ol>\n";
  if (!page.cures.empty()) html += "<h2>What would help</h2>\n";
  for (const std::string& cure : page.cures) html += "<p>" + ods::xml_text(cure) + "</p>\n";
  if (!page.curves.empty()) html += "<h2>Over time</h2>\n";
  for (const PageCurve& curve : page.curves) html += curve_html(curve);
  html += "<h2>Where the limits come from</h2>\n<table>\n";
  for (const auto& [what, source] : page.sources) {
    html += fmt::format("<tr><td>{}</td><td class=\"soft\">{}</td></tr>\n", ods::xml_text(what), ods::xml_text(source));
  }
  html += "</table>\n</body>\n</html>\n";
  ods::write_file(path, html);
}
