// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Two eyes at one place show nearly the same picture; two parts of one picture do not. So every way to cut a file is
// tried.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/disparity/match.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

// Low resolution averages noise out and makes the match less sensitive to parallax.
constexpr int kCoarse = 192;
constexpr int kEnoughTiles = 8;

struct Cut {
  Layout layout = Layout::kTopBottom;
  Matches matches;
  double lopsided = 0.0;  // fraction of the parallax that has one sign, 0..1
};

Cut try_cut(const Subject& subject, Layout layout, const std::vector<Image>& eyes,
            const EyeCorrection& correction = {}) {
  Cut cut;
  cut.layout = layout;
  std::vector<GrayView> views = make_gray_views(eyes, subject.projection(), subject.info.is_float, kCoarse);
  if (moves_pixels(correction)) views[1] = corrected_view(views[1], correction);
  Search search;
  search.correlation = 0.7f;
  search.down = subject.format.camera.head_tilt_map ? search.around : 0.04f;
  cut.matches = match_tiles(views[0], views[1], search);
  for (const Match& match : cut.matches.found) {
    cut.lopsided += std::tanh(4.0 * static_cast<double>(match.around / cut.matches.pixel)) /
                    static_cast<double>(cut.matches.found.size());
  }
  cut.lopsided = std::abs(cut.lopsided);
  return cut;
}

std::string matching(const Cut& cut) {
  return fmt::format("{:.0f} % of {} places match", 100.0 * cut.matches.share(), cut.matches.tiles);
}

// The layout name for eyes of this shape: squeezed eyes are named by the shape of the file, not of an eye.
std::string cut_name(const Subject& subject, Layout layout) {
  const Extent eye = *unpacked_size(layout, {subject.packed.width, subject.packed.height});
  const double aspect = static_cast<double>(eye.width) / eye.height;
  const double natural = 1000.0 / natural_height(subject.projection(), 1000);
  const EyeArrangement eyes = arrangement_of(layout);
  const bool squeezed = eyes.how == EyePacking::kStacked ? aspect > 1.5 * natural : aspect < 0.75 * natural;
  return std::string(layout_name(layout_with({eyes.how, eyes.right_first, squeezed}).value_or(layout)));
}

// The layouts that the file may really have, other than the one it was read in.
std::vector<Cut> other_cuts(const Subject& subject) {
  std::vector<Cut> cuts;
  const std::optional<Layout> read = subject.format.layout.layout;
  const Extent size{subject.packed.width, subject.packed.height};
  for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
    if (subject.packed.pixels.empty() || !unpacked_size(layout, size)) continue;
    const bool same = read && arrangement_of(*read).how == arrangement_of(layout).how;
    if (!same) cuts.push_back(try_cut(subject, layout, unpack(layout, subject.packed)));
  }
  return cuts;
}

// The source of the layout determines the fault, and what the user has to change.
void add_misread(const Subject& subject, const Cut& cut, double certainty, const std::string& evidence,
                 LintReport& report) {
  const std::string truth = cut_name(subject, cut.layout);
  const auto [fault, remedy] = [&]() -> std::pair<Fault, std::string> {
    switch (subject.format.layout.source) {
      case FormatSource::kName:
        return {Fault::kMetadata, fmt::format("rename the file: it is {}", truth)};
      case FormatSource::kSidecar:
        return {Fault::kMetadata, fmt::format("correct the sidecar: it is {}", truth)};
      case FormatSource::kOwnMetadata:
      case FormatSource::kOtherMetadata:
        return {Fault::kMetadata, fmt::format("correct its metadata: it is {}", truth)};
      default:
        return {Fault::kLayoutMisread, fmt::format("read it as {} (`layout` {})", truth, truth)};
    }
  }();
  report.findings.push_back({fault, certainty, evidence + ", " + subject.format.layout.reason, remedy});
}

}  // namespace

static bool check_one_eye(const Subject& subject, LintReport& report) {
  judge(report, Check::kLayout);
  for (const Cut& cut : other_cuts(subject)) {
    // Scenes with two similar sides match too, but parallax of a single sign is not a coincidence.
    const double certainty = cut.matches.share() * cut.lopsided * std::min(1.0, cut.matches.tiles / 20.0);
    if (certainty < 0.3) continue;
    add_misread(subject, cut, certainty,
                fmt::format("read as one eye, but cut as {} {}, with parallax", layout_name(cut.layout), matching(cut)),
                report);
    return certainty < 0.5;
  }
  return true;
}

bool check_layout(const Subject& subject, LintReport& report) {
  if (subject.eyes.size() == 1) return check_one_eye(subject, report);
  const Layout layout = subject.layout();
  const Cut read = try_cut(subject, layout, subject.eyes, subject.correction);
  if (read.matches.tiles < kEnoughTiles) {
    skip(report, Check::kLayout, "not enough detail");
    return true;
  }
  judge(report, Check::kLayout);
  const double share = read.matches.share();
  const double enough = static_cast<double>(read.matches.tiles) / (read.matches.tiles + 5.0);
  const double alone = enough * std::max(0.0, 1.0 - share / 0.3);
  double misread = 0.0;
  for (const Cut& cut : other_cuts(subject)) {
    // Two sides of a scene may be similar, but their parallax does not have a single sign.
    const double better = cut.matches.share() - share;
    const double certainty =
        enough * cut.matches.share() * std::min(1.0, better / 0.4) * std::min(1.0, 2.0 * cut.lopsided);
    if (cut.matches.tiles < kEnoughTiles || certainty < 0.1) continue;
    misread = certainty;
    add_misread(subject, cut, certainty,
                fmt::format("read as {}, {}; cut as {}, {}", layout_name(layout), matching(read),
                            layout_name(cut.layout), matching(cut)),
                report);
  }
  if (misread < 0.5 && alone >= 0.1) {
    report.findings.push_back({Fault::kMonoAsStereo, alone,
                               fmt::format("it should show two eyes ({}), but shows two places: {}",
                                           subject.format.layout.reason, matching(read)),
                               "it is one picture: give it the shape of one eye (lat-long: twice as wide as high) and "
                               "show it as mono"});
  }
  return std::max(misread, alone) < 0.5;
}

}  // namespace ods
