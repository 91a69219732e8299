// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/compose/title_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cli/console/console.h"
#include "cli/options/picture_options.h"
#include "ods/files/frames.h"

namespace {

constexpr const char* kTitleExamples =
    "  ods title 'The Long Way Home' --at 0,10,3 -o title.exr\n"
    "  ods title 'first line\\nsecond line' --font 'DejaVu Serif Bold' --color '#ffd070' -o title.png\n"
    "  ods title 'Chapter 2' --frames 1-120 --fps 30 --fade-in 0.5 --fade-out 1 -o title.####.exr";

constexpr const char* kTitleSummary =
    "Makes a transparent picture of text at a given distance in stereo 360; .exr has depth, too. ods over\n"
    "composites it over pictures and videos. Use the same --ipd, --merge, ... as for the footage.";

void parse_place(const std::string& text, ods::TitleSetting& title) {
  const std::vector<float> numbers = parse_numbers(text);
  const bool legal = numbers.size() == 3 && std::abs(numbers[0]) <= 36000.0f && std::abs(numbers[1]) <= 90.0f &&
                     numbers[2] >= 0.01f && numbers[2] <= 1e6f;
  if (!legal)
    throw UsageError(fmt::format("--at must be degrees right, degrees up and metres, as 0,10,3, not '{}'", text));
  title.yaw = numbers[0], title.pitch = numbers[1], title.distance = numbers[2];
}

// #rrggbb in sRGB, or R,G,B in linear light.
void parse_color(const std::string& text, ods::vec3& color) {
  if (text.size() == 7 && text[0] == '#' && text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos) {
    const long code = std::strtol(text.c_str() + 1, nullptr, 16);
    for (int c = 0; c < 3; c++) color[c] = ods::srgb_decode(static_cast<float>(code >> (16 - 8 * c) & 255) / 255.0f);
    return;
  }
  const std::vector<float> numbers = parse_numbers(text);
  const bool legal = numbers.size() == 3 &&
                     std::all_of(numbers.begin(), numbers.end(), [](float n) { return n >= 0.0f && n <= 1e4f; });
  if (!legal) throw UsageError(fmt::format("--color must be #rrggbb, or R,G,B in linear light, not '{}'", text));
  color = ods::vec3(numbers[0], numbers[1], numbers[2]);
}

// Replaces
// , because shells make newlines hard to type.
std::string with_newlines(std::string text) {
  for (size_t at = 0; (at = text.find("\\n", at)) != std::string::npos; at++) text.replace(at, 2, 1, '\n');
  return text;
}

void add_text_options(Options& options, TitleJob& job) {
  options.argument("TEXT", job.text, "the text, in any script; \\n starts a new line");
  options.group("Text");
  options.custom(
      "--at", "YAW,PITCH,METRES", "0,0,3", [&](const std::string& text) { parse_place(text, job.title); },
      "position of the text's centre: degrees right, degrees up, distance in metres");
  options.number("--text-height", job.title.height, 1e-3f, 1e5f, "line height, metres");
  options.text("--font", "FONT", job.lettering.font, "font name, e.g. 'DejaVu Serif Bold Italic', or a font file");
  options.choice("--align", job.lettering.align, ods::kTextAlignTable, "alignment of the lines");
  options.number("--spacing", job.lettering.spacing, 0.1f, 10.0f, "line spacing, as a multiple of the font's own");
  options.custom(
      "--color", "COLOR", "#ffffff", [&](const std::string& text) { parse_color(text, job.title.color); },
      "#rrggbb (sRGB), or R,G,B in linear light");
  options.number("--opacity", job.title.opacity, 0.0f, 1.0f, "opacity of the text");
}

void add_frame_options(Options& options, TitleJob& job) {
  options.group("Video");
  options.custom(
      "--frames", "RANGE", "", [&](const std::string& text) { job.frames = ods::parse_frames(text); },
      "frames to write: 1-100, 1-100x2, ...; the name needs ####");
  options.number("--fps", job.fps, 0.01f, 1000.0f, "frames per second", "30");
  options.number("--fade-in", job.fade_in, 0.0f, 1e5f, "length, seconds", "0");
  options.number("--fade-out", job.fade_out, 0.0f, 1e5f, "length, seconds", "0");
}

}  // namespace

TitleJob parse_title(Options& options) {
  TitleJob job;
  options.describe(kTitleSummary, kTitleExamples);
  add_text_options(options, job);
  bool flat = false;
  options.flag(
      "--flat", flat,
      "place the text on a plane; by default it curves around the viewer, so that every letter is equally far");
  add_frame_options(options, job);
  options.group("Picture");
  options.text("-o,--output", ValueKind::output_file(), job.output,
               "output file: .exr .png .tif .webp; %V in the name writes one file per eye");
  job.form.usual_width = 4096;
  add_picture_options(options, job.form, job.save.sidecar);
  add_sceneless_camera_options(options, job.camera);
  options.group("Console");
  add_console_options(options);
  options.parse();
  if (job.output.empty()) throw UsageError("no output file: add -o title.exr");
  if (!ods::has_alpha(job.output)) throw UsageError("a title needs a format with alpha: .exr, .png, .tif or .webp");
  if ((job.fps || job.fade_in || job.fade_out) && !job.frames)
    throw UsageError("--fps and fades need --frames, such as 1-100");
  job.text = with_newlines(job.text);
  job.title.curved = !flat;
  job.save.tone = ods::ToneCurve::kLinear;  // so that a colour is shown as given
  return job;
}
