// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks the seam of a full turn. A step from one column to the next counts by how much it exceeds the steps on both
// sides of it, so that neither slopes nor soft edges count; the step at the seam is compared with many others. Missing
// columns cause such a step; repeated columns are found by matching them.
//
// In pictures the steps are those between pixels: a seam is sharper than edges of the scene, which cover parts of
// pixels. Codecs that smooth the borders of their blocks leave the picture's edges as the only sharp ones, so for them
// the steps are those between means of several columns, which are less affected by a narrow cut.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ods/base/median.h"
#include "ods/image/format/file_format.h"
#include "ods/image/tone.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr int kBlocks = 128;          // blocks of rows, each averaged
constexpr double kNoise = 0.003;      // as displayed: breaks below are not structure
constexpr double kSharpest = 8.0;     // maximum weight of a break
constexpr double kFewBits = 0.033;    // bits per pixel of a video: below this, codecs break the picture at its edges
constexpr size_t kWidths[] = {2, 6};  // columns averaged on either side, against noise and texture
constexpr double kUnseen = 0.004, kSeen = 0.008;  // steps at the seam, as displayed
constexpr double kStructure = 0.1;                // minimum sharpness of columns with structure that could break
constexpr size_t kNear = 8;                       // columns on either side that give the usual variation of a row
constexpr double kGrain = 0.015;                  // as displayed: the usual variation of a row
constexpr double kMaxExcess = 3.0;                // maximum weight of a step
constexpr double kHalfPixel = 2.5;  // times the adjacent steps: the step if a picture was resized without its seam

using Columns = std::vector<double>;

// Averages blocks of rows of an eye, as displayed; all columns are kept.
Image squeezed(const Image& eye) {
  Image rows(eye.width, kBlocks, 1);
  tbb::parallel_for(0, kBlocks, [&](int i) {
    const int from = eye.height * i / kBlocks, to = eye.height * (i + 1) / kBlocks;
    for (int y = from; y < to; y++) {
      for (int x = 0; x < eye.width; x++) {
        const float light = *eye.at(x, y);
        const float shown = std::isnan(light) ? 0.0f : srgb_encode(std::clamp(light, 0.0f, 1.0f));
        *rows.at(x, i) += shown / static_cast<float>(to - from);
      }
    }
  });
  return rows;
}

Columns row_of(const Image& rows, int y) {
  return {rows.at(0, y), rows.at(0, y) + rows.width};
}

// For each column, the step from it to the next columns, minus half the sum of the steps before and after. Steps are
// between means of `wide` columns.
Columns breaks_of(const Columns& row, size_t wide) {
  const size_t n = row.size();
  Columns mean(n), breaks(n);
  for (size_t x = 0; x < n; x++) {
    for (size_t i = 0; i < wide; i++) mean[x] += row[(x + i) % n] / static_cast<double>(wide);
  }
  for (size_t x = 0; x < n; x++) {
    const auto at = [&](size_t forward, size_t back) { return mean[(x + 1 + forward + n - back) % n]; };
    const double before = at(0, 2 * wide), here = at(0, wide), next = at(0, 0), after = at(wide, 0);
    breaks[x] = std::abs((next - here) - 0.5 * ((here - before) + (after - next)));
  }
  return breaks;
}

// The columns that the seam is compared with, at the ends of JPEG's blocks, as the seam is. The last of them is the
// seam.
constexpr size_t kSeamBlock = 8;

Columns compared_columns(const Columns& columns) {
  Columns some;
  for (size_t x = kSeamBlock - 1; x + 1 < columns.size(); x += kSeamBlock) some.push_back(columns[x]);
  some.push_back(columns.back());
  return some;
}

// The breaks after these columns, relative to the usual break in their row.
Columns sharpness_of(const Columns& row, size_t wide) {
  Columns some = compared_columns(breaks_of(row, wide));
  const double usual = median(some);
  for (double& each : some) each = std::min(each / (usual + kNoise), kSharpest);
  return some;
}

// The excess of the steps after these columns over the adjacent steps, relative to the steps farther away.
Columns excess_of(const Columns& row) {
  const size_t n = row.size();
  Columns step(n), excess(n);
  for (size_t x = 0; x < n; x++) step[x] = std::abs(row[(x + 1) % n] - row[x]);
  for (size_t x = 0; x < n; x++) {
    double near = 0.0;
    for (size_t i = 2; i < 2 + kNear; i++) near += (step[(x + i) % n] + step[(x + n - i) % n]) / (2.0 * kNear);
    const double beside = std::max(step[(x + 1) % n], step[(x + n - 1) % n]);
    excess[x] = std::min(std::max(step[x] - kHalfPixel * beside, 0.0) / (near + kGrain), kMaxExcess);
  }
  return compared_columns(excess);
}

// The sharpness of the break after each of these columns in all rows and in both eyes: a vertical edge of the scene is
// sharp in some rows only, and at another column in each eye. sharpness: of a row's columns.
Columns measure(const std::vector<Image>& eyes, const std::function<Columns(const Columns&)>& sharpness) {
  Columns score;
  for (int i = 0; i < kBlocks; i++) {
    Columns both = sharpness(row_of(eyes[0], i));
    for (const Image& eye : eyes) {
      const Columns one = sharpness(row_of(eye, i));
      for (size_t x = 0; x < both.size(); x++) both[x] = std::min(both[x], one[x]);
    }
    score.resize(both.size());
    for (size_t x = 0; x < both.size(); x++) score[x] += both[x] / kBlocks;
  }
  return score;
}

// The seam's score and the maximum of the others.
struct Break {
  double seam = 0.0, others = 1.0;
  double ratio() const { return seam / others; }
};

Break break_of(const Columns& score, double minimum) {
  return {score.back(), std::max(minimum, *std::max_element(score.begin(), score.end() - 1))};
}

double ramp(double value, double from, double to) {
  return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

// Sharpness of the breaks between means of columns, for each of kWidths.
std::vector<Columns> coarse_scores(const std::vector<Image>& eyes) {
  std::vector<Columns> scores;
  for (const size_t wide : kWidths) {
    scores.push_back(measure(eyes, [&](const Columns& row) { return sharpness_of(row, wide); }));
  }
  return scores;
}

// Returns whether there is structure beside the seam that could break.
bool has_structure(const std::vector<Columns>& scores) {
  return std::any_of(scores.begin(), scores.end(), [](const Columns& score) {
    const size_t n = score.size();
    return std::max({score[0], score[1], score[n - 3], score[n - 2]}) > kStructure;
  });
}

// The difference of the seam's columns beyond that of adjacent columns, as displayed: the mean of all rows. Differences
// below a code value or two are invisible.
double step_at_seam(const std::vector<Image>& eyes, size_t wide) {
  double step = 0.0;
  for (int i = 0; i < kBlocks; i++) {
    double both = 1.0;
    for (const Image& eye : eyes) both = std::min(both, breaks_of(row_of(eye, i), wide).back());
    step += both / kBlocks;
  }
  return step;
}

// The break whose seam exceeds the others most.
Break coarse_break(const std::vector<Columns>& scores) {
  Break found;
  for (const Columns& score : scores) {
    const Break here = break_of(score, 1.0);
    if (here.ratio() > found.ratio()) found = here;
  }
  return found;
}

// Returns false if there is no structure near the seam that could break.
bool check_break(const std::vector<Image>& eyes, bool is_smoothed, LintReport& report) {
  const std::vector<Columns> coarse = coarse_scores(eyes);
  const Break found = is_smoothed ? coarse_break(coarse) : break_of(measure(eyes, excess_of), 0.02);
  const double certainty = is_smoothed ? ramp(found.ratio(), 1.05, 1.35) * ramp(found.seam, 0.0, 0.8) *
                                             ramp(step_at_seam(eyes, kWidths[0]), kUnseen, kSeen)
                                       : ramp(found.ratio(), 2.5, 3.5) * ramp(found.seam, 0.1, 0.2);
  if (certainty >= 0.1) {
    report.findings.push_back(
        {Fault::kRaggedSeam, certainty,
         fmt::format(
             "from the last column to the first, {} break by {:.2g} of what rows vary there, at the worst of {} "
             "other columns by {:.2g}",
             is_smoothed ? "means of columns" : "pixels", found.seam, eyes[0].width / static_cast<int>(kSeamBlock) - 1,
             found.others),
         "make it cover exactly 360 degrees, in one light and level: nothing cropped, doubled or blended there"});
  }
  return has_structure(coarse) || certainty >= 0.5;
}

// Codecs of videos, and WebP, smooth the borders of their blocks.
bool has_smoothed_blocks(const Subject& subject) {
  return subject.is_video || format_of_path(subject.path) == FileFormat::kWebp;
}

// The edges at 0 and at 360 degrees are the same direction; if both are rendered, the column appears twice.
void check_doubled(const std::vector<Image>& eyes, LintReport& report) {
  std::vector<double> steps(static_cast<size_t>(eyes[0].width));
  for (int i = 0; i < kBlocks; i++) {
    const Columns row = row_of(eyes[0], i);
    for (size_t x = 0; x < row.size(); x++) steps[x] += std::abs(row[(x + 1) % row.size()] - row[x]) / kBlocks;
  }
  const double seam = steps.back(), minimum = *std::min_element(steps.begin(), steps.end() - 1);
  const double certainty = minimum > 5e-4 ? 1.0 - 4.0 * seam / minimum : 0.0;
  if (certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kRaggedSeam, certainty,
       fmt::format("the last column repeats the first: they differ by {:.2g}, all neighbours by at least {:.2g}", seam,
                   minimum),
       "leave out the last column, and render the directions of the pixels' middles"});
}

// --- a repeated strip ------------------------------------------------------------------------------------------------

// The similarity of the strips of `width` columns that begin at two columns: their normalised cross-correlation, each
// row without its mean. 0 without detail.
double likeness(const std::vector<Image>& eyes, int one, int other, int width) {
  double product = 0.0, square = 0.0, square_other = 0.0;
  for (int k = 0; k < kBlocks * static_cast<int>(eyes.size()); k++) {
    const Image& rows = eyes[static_cast<size_t>(k / kBlocks)];
    const int y = k % kBlocks;
    double mean = 0.0, mean_other = 0.0;
    for (int i = 0; i < width; i++) {
      mean += static_cast<double>(*rows.at((one + i) % rows.width, y)) / width;
      mean_other += static_cast<double>(*rows.at((other + i) % rows.width, y)) / width;
    }
    for (int i = 0; i < width; i++) {
      const double a = static_cast<double>(*rows.at((one + i) % rows.width, y)) - mean;
      const double b = static_cast<double>(*rows.at((other + i) % rows.width, y)) - mean_other;
      product += a * b, square += a * a, square_other += b * b;
    }
  }
  const double minimum = 1e-5 * kBlocks * width;
  return square > minimum && square_other > minimum ? product / std::sqrt(square * square_other) : 0.0;
}

// Finds last columns that repeat the first ones, for example because a stitcher's overlap was left in. The similarity
// at the same distance elsewhere in the picture is the reference.
void check_overlap(const std::vector<Image>& eyes, LintReport& report) {
  const int width = eyes[0].width, minimum = std::max(4, width / 200), maximum = width * 15 / 100;
  int overlap = 0;
  double best = 0.0;
  for (int s = minimum; s <= maximum; s++) {
    const double alike = likeness(eyes, width - s, 0, std::min(s, width / 16));
    if (alike > best) best = alike, overlap = s;
  }
  if (best < 0.5) return;
  double elsewhere = 0.0;
  for (int i = 1; i < kBlocks; i++) {
    const int column = width * i / kBlocks;
    elsewhere =
        std::max(elsewhere, likeness(eyes, (column + width - overlap) % width, column, std::min(overlap, width / 16)));
  }
  const double certainty = std::clamp((best - 0.7) / 0.15, 0.0, 1.0) * std::clamp((best - elsewhere) / 0.2, 0.0, 1.0);
  if (certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kRaggedSeam, certainty,
       fmt::format("the last {} columns ({:.1f} %) show what the first ones do: they correlate by {:.2f}, as far apart "
                   "elsewhere by at most {:.2f}",
                   overlap, 100.0 * overlap / width, best, elsewhere),
       fmt::format("cut {} columns off every eye's right side and stretch it to its old width", overlap)});
}

}  // namespace

void check_seam(const Subject& subject, LintReport& report) {
  const bool closes = has_range(subject.projection().kind) &&
                      subject.projection().longitude.y - subject.projection().longitude.x > 359.9f;
  if (!closes) {
    skip(report, Check::kSeam, "this projection has none");
    return;
  }
  if (subject.bits_per_pixel.value_or(kFewBits) < kFewBits) {
    skip(report, Check::kSeam, "with so few bits for a pixel, the codec itself breaks the seam");
    return;
  }
  std::vector<Image> eyes;
  for (const Image& eye : subject.eyes) eyes.push_back(squeezed(eye));
  if (check_break(eyes, has_smoothed_blocks(subject), report)) {
    judge(report, Check::kSeam);
  } else {
    skip(report, Check::kSeam, "there is nothing at the seam that could break");
  }
  check_doubled(eyes, report);
  check_overlap(eyes, report);
}

}  // namespace ods
