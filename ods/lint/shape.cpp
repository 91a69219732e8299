// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks a picture's size, without its pixels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/camera/codec_level.h"
#include "ods/lint/checks.h"

namespace ods {

constexpr double kVideoRate = 30.0;  // pictures per second

// Two eyes squeezed into 16:9, which decoders support well and players stretch.
static bool is_squeezed_sphere(const Subject& subject, Extent file) {
  const bool has_eyes = arrangement_of(subject.layout()).is_halves() && is_full_lat_long(subject.projection());
  return has_eyes && std::abs(file.width * 9 - file.height * 16) <= 16;
}

static void check_aspect(const Subject& subject, LintReport& report) {
  if (subject.projection().kind == kPerspective) return skip(report, Check::kShape, "a window may have any shape");
  judge(report, Check::kShape);
  const Layout layout = subject.layout();
  const Extent squeeze = squeeze_of(layout, report.eye_count);
  const int width = report.eye.width * squeeze.width, height = report.eye.height * squeeze.height;
  const int natural = natural_height(subject.projection(), width);
  // Rounding moves an edge by one pixel, squeezing by another.
  const double off = std::max(0, std::abs(height - natural) - squeeze.height) / static_cast<double>(natural);
  if (off == 0.0 || is_squeezed_sphere(subject, report.file)) return;
  std::string remedy = "crop or pad the picture to that shape, or specify which part of the sphere it shows (`range`)";
  if (is_full_lat_long(subject.projection()))
    remedy += "; if the whole sphere is there, squeezed, ods convert stretches it";
  if (std::abs(height * 2 - natural) <= 2)
    remedy = "its eyes look squeezed: read it as top-bottom-half, or stretch them";
  if (std::abs(height - natural * 2) <= 4)
    remedy = "its eyes look squeezed: read it as side-by-side-half, or stretch them";
  if (std::abs(width * 2 - height * 3) <= 2) remedy += "; 3:2 may be a cube (`projection` cube-3x2)";
  if (width == height) remedy += "; square eyes may be vr180 or a fisheye (`projection` vr180)";
  report.findings.push_back(
      {Fault::kWrongAspect, off / (off + 0.005),
       fmt::format("an eye is {}x{}; {} of that width is {} high", width, height, report.projection, natural), remedy});
}

static void check_video(LintReport& report) {
  judge(report, Check::kVideoLevels);
  std::string none;
  for (Codec codec : kCodecs) {
    if (!smallest_level(codec, report.file, kVideoRate).empty()) continue;
    none += fmt::format("{}{}", none.empty() ? "" : ", ", codec_name(codec));
  }
  if (none.empty()) return;
  report.findings.push_back({Fault::kVideoLevels, 1.0,
                             fmt::format("{}x{} at {:.0f} pictures a second is beyond every level of {}",
                                         report.file.width, report.file.height, kVideoRate, none),
                             "as a still it is fine; videos of 5760x5760 or less play (ods sizes lists the levels)"});
}

// The smallest MAX_TEXTURE_SIZE of WebGL on headsets (ods/camera/sizes.h).
constexpr int kTexture = 8192;

static void check_headsets(LintReport& report) {
  judge(report, Check::kHeadsets);
  const auto [width, height] = report.file;
  const auto add = [&](const std::string& evidence, const std::string& remedy) {
    report.findings.push_back({Fault::kHeadsetSize, 1.0, evidence, remedy});
  };
  if (std::max(width, height) > kTexture) {
    add(fmt::format("{}x{} is larger than the textures of {} pixels that every browser in a headset has: it is shown "
                    "smaller, or not at all",
                    width, height, kTexture),
        fmt::format(
            "ods convert `width` {} for headsets (ods sizes lists what they take)",
            std::min(kTexture, static_cast<int>(int64_t{kTexture} * report.eye.width / std::max(width, height)))));
  }
  if (width % 2 != 0 || height % 2 != 0) {
    add(fmt::format("{}x{} has an odd side: no video that headsets play can have it", width, height),
        "give it even sides");
  }
}

void check_shape(const Subject& subject, LintReport& report) {
  check_aspect(subject, report);
  check_headsets(report);
  check_video(report);
}

}  // namespace ods
