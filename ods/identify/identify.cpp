// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tries every layout with every projection that fits the shape of its eyes. The evidence from the pixels is added up as
// logarithms of odds for or against each reading.
#include "ods/identify/identify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ods/camera/odd_halves.h"
#include "ods/identify/cuts.h"
#include "ods/identify/others.h"
#include "ods/identify/pairs.h"
#include "ods/identify/thumbnail.h"

namespace ods {

namespace {

constexpr double kSure = 0.9, kLikely = 0.5, kDoubtful = 0.2;
constexpr int kMinSide = 128;         // pixels of the file
constexpr double kMinDetail = 0.001;  // mean difference of adjacent pixels

struct Candidate {
  Reading reading;
  double odds = 0.0;  // logarithm of the odds
  std::string reason;
};

// --- the projection --------------------------------------------------------------------------------------------------

// Maximum weight of each kind of evidence, for a reading or against it.
constexpr double kEyes = 6.0, kCircle = 5.0, kBall = 2.5, kDome = 1.6, kPoles = 2.5, kSeam = 2.5, kFaces = 4.0;
constexpr double kTurnedCube = 12.0, kBroken = 4.0;
constexpr double kUnknownUp = 0.15;  // against our cubes, if the direction of up is undecided
constexpr double kLevel = 0.25;      // weight of the likelihood of parallax: its pairs are not independent
constexpr double kMaxLevel = 12.0;
constexpr int kManyPairs = 120;
constexpr double kLeftFirst = 2.0;  // nearly all files have the left eye first
constexpr double kOrder = 7.0;
constexpr double kOther = -3.0;                           // an unsupported projection
constexpr double kElse = 20.0;                            // known formats that are none of these
constexpr double kSqueezed = 0.84, kSqueezedLess = 0.94;  // aspect ratios of an eye beside another in 16:9

// Video sites store an equi-angular cube in 16:9, so its faces are not square.
bool is_wide_eac(const ProjectionSetting& setting, Extent eye) {
  return setting.kind == kEac && std::abs(9 * eye.width - 16 * eye.height) <= 18;
}

bool fits_shape(const ProjectionSetting& setting, Extent eye) {
  if (is_wide_eac(setting, eye)) return true;
  const int natural = natural_height(setting, eye.width);
  return std::abs(eye.height - natural) <= std::max(1.0, 0.012 * natural);
}

void add_reason(Candidate& candidate, double mark, double weight, const char* reason) {
  candidate.odds += mark * weight;
  if (mark * weight < 1.0) return;
  candidate.reason += (candidate.reason.empty() ? "" : ", ") + std::string(reason);
}

void judge_circle(const Cut& cut, Candidate& candidate) {
  const Marks& marks = cut.marks;
  const ProjectionSetting& setting = candidate.reading.projection;
  const bool is_ball = setting.fov > 300.0f && setting.kind == kFisheyeEquisolid, is_dome = setting.tilt > 45.0f;
  add_reason(candidate, marks.circle, kCircle, "it is a circle with empty corners");
  if (is_ball) {
    add_reason(candidate, marks.ball, kBall, "all of its rim is one point");
  } else {
    candidate.odds -= marks.ball * kBall;
    add_reason(candidate, is_dome ? marks.dome : -marks.dome, kDome,
               is_dome ? "it is bright in the middle" : "it is bright above");
  }
}

// Evidence for one kind of cube that fits the eye's shape.
struct CubeMarks {
  int kind = kCube3x2;
  double joins = 0.0;   // as faces_join()
  double breaks = 0.0;  // as breaks_at_grid()
  double y_up = 0.0;    // as y_up_mark()
};

std::vector<CubeMarks> marks_of_cubes(const Cut& cut, Extent whole) {
  std::vector<CubeMarks> cubes;
  for (const NamedProjection& named : named_projections()) {
    if (!is_cube(named.setting.kind) || !fits_shape(named.setting, whole)) continue;
    const int columns = width_step(named.setting);
    cubes.push_back(
        {named.setting.kind, faces_join(cut.shown, named.setting), breaks_at_grid(cut.shown, columns, 6 / columns)});
    const bool is_strip = named.setting.kind == kCube6x1 || named.setting.kind == kCube1x6;
    if (is_strip) cubes.back().y_up = y_up_mark(cut.shown, named.setting);
  }
  return cubes;
}

// Adds the evidence of an eye about the projection: each mark counts for the readings that have the feature and against
// all others.
void judge_projection(const Cut& cut, const std::vector<CubeMarks>& cubes, Candidate& candidate) {
  const Marks& marks = cut.marks;
  const ProjectionSetting& setting = candidate.reading.projection;
  const int kind = setting.kind;
  if (is_fisheye(kind)) return judge_circle(cut, candidate);
  candidate.odds -= std::max(0.0, marks.circle) * kCircle;
  for (const CubeMarks& cube : cubes) {
    if (cube.kind == kind) {
      add_reason(candidate, cube.joins, kFaces, "its faces join as a cube's");
      candidate.odds -= std::max(cube.y_up + kUnknownUp, 0.0) * kTurnedCube;
    } else {  // cubes with the faces in another order, too
      candidate.odds -= std::max({0.0, cube.joins, is_cube(kind) ? 0.0 : cube.breaks}) * kFaces;
    }
  }
  const bool is_half = is_vr180(setting);
  if (is_half || is_full_lat_long(setting)) {
    add_reason(candidate, marks.poles, kPoles, "its top and bottom rows are each one point");
  } else {
    candidate.odds -= marks.poles * kPoles;
  }
  if (has_range(kind) && !is_half) {
    add_reason(candidate, marks.closes, kSeam, "its right edge continues at its left one");
  } else {
    add_reason(candidate, -marks.closes, kSeam, "its right edge does not continue at its left one");
  }
}

// --- all readings ----------------------------------------------------------------------------------------------------

// kSeparate stands for one eye.
bool allows(const FormatHint& known, Layout layout) {
  if (known.one_eye) return layout == Layout::kSeparate;
  return !known.layout || arrangement_of(*known.layout) == arrangement_of(layout);
}

std::vector<ProjectionSetting> settings_for(const FormatHint& known, double aspect) {
  if (known.projection) return {*known.projection};
  if (known.camera) return {known.camera->projection};
  std::vector<ProjectionSetting> settings;
  for (const NamedProjection& named : named_projections()) settings.push_back(named.setting);
  if (aspect > 2.05 && aspect < 6.0) {  // a full turn, but not up to the poles
    settings.emplace_back().latitude = vec2(-1.0f, 1.0f) * static_cast<float>(180.0 / aspect);
  }
  return settings;
}

// The layouts that cut a file in this way; kSeparate stands for one eye.
std::vector<Layout> layouts_of(EyePacking how) {
  if (how == EyePacking::kAlone) return {Layout::kSeparate};
  std::vector<Layout> layouts;
  for (const Layout layout : kLayouts) {
    if (arrangement_of(layout).how == how) layouts.push_back(layout);
  }
  return layouts;
}

// Perspective pictures usually are square or somewhat wider.
double window_odds(double aspect) {
  constexpr double kNarrow = 0.9, kWide = 1.9;
  const double beyond = std::max({0.0, std::log(kNarrow / aspect), std::log(aspect / kWide)});
  return beyond > 0.0 ? -1.5 - 2.0 * beyond : 0.0;
}

// Evidence that the picture is cut into faces that none of our cubes joins.
double other_faces_in(const std::vector<CubeMarks>& cubes) {
  double joins = 0.0, breaks = 0.0;
  double turned = 0.0;
  for (const CubeMarks& cube : cubes) {
    joins = std::max(joins, cube.joins), breaks = std::max(breaks, cube.breaks);
    turned = std::max(turned, std::min(cube.joins, 2.0 * cube.y_up));
  }
  return std::max({0.0, breaks - joins, turned});
}

// Returns whether this is vr180 side by side, or two spheres above each other, squeezed into a 16:9 file, as many
// programs export them.
bool is_squeezed(const Cut& cut, const ProjectionSetting& setting, double aspect) {
  const bool is_half = is_vr180(setting) && cut.how == EyePacking::kBeside;
  const bool is_sphere = is_full_lat_long(setting) && cut.how == EyePacking::kStacked;
  const double beside = is_sphere ? aspect / 4.0 : aspect;
  return (is_half || is_sphere) && cut.two_eyes > 0.3 && !cut.has_bars && beside > kSqueezed && beside < kSqueezedLess;
}

void add_candidates(Cut& cut, Layout layout, const FormatHint& known, Extent file, std::vector<Candidate>& candidates) {
  const std::optional<Extent> eye = whole_eye(layout, without_middle(layout, file));
  if (!eye || !allows(known, layout)) return;
  const double aspect = static_cast<double>(eye->width) / eye->height;
  const std::vector<CubeMarks> cubes = marks_of_cubes(cut, *eye);
  cut.other_faces = std::max(cut.other_faces, other_faces_in(cubes));
  for (ProjectionSetting setting : settings_for(known, aspect)) {
    const std::string_view name = projection_name(setting);
    Candidate candidate;
    if (setting.kind == kPerspective) {
      setting.aspect = static_cast<float>(aspect);
      candidate.odds += window_odds(aspect);
    } else if (is_squeezed(cut, setting, aspect)) {
      candidate.odds -= 1.0;
    } else if (!known.projection && !fits_shape(setting, *eye)) {
      continue;
    }
    const bool has_room = cut.marks.circle > 0.0 && cut.marks.radius < 0.97;  // the circle does not touch the edges
    if (setting.kind == kFisheye && has_room && !known.projection) {
      setting.fov = std::min(360.0f, setting.fov / static_cast<float>(cut.marks.radius));
    }
    candidate.reading.projection = setting;
    if (layout != Layout::kSeparate) candidate.reading.layout = layout;
    const bool is_part = setting.kind == kLatLong && !is_full_lat_long(setting) && !is_vr180(setting);
    candidate.odds += (is_part ? -4.0 : find_projection(name)->usual) + kEyes * cut.two_eyes;
    if (layout == Layout::kSeparate && is_vr180(setting)) candidate.odds -= 2.0;  // square photographs are common
    if (layout == Layout::kSeparate && !is_cube(setting.kind)) candidate.odds -= kBroken * std::max(0.0, cut.broken);
    if (cut.how == EyePacking::kBeside) candidate.odds += 0.5 * kBroken * std::max(0.0, cut.broken);
    if (arrangement_of(layout).squeezed) candidate.odds -= 1.0;
    if (cut.two_eyes > 0.3 || layout == Layout::kSeparate) candidate.reason = cut.reason;
    judge_projection(cut, cubes, candidate);
    candidates.push_back(candidate);
  }
}

// Eyes in the wrong order have negative parallax.
double order_odds(const Parallax& parallax, bool right_first) {
  const double left = kLeftFirst + kOrder * parallax.order;
  return -std::log1p(std::exp(right_first ? left : -left));
}

// In the right projection, parallax is horizontal. If it is in none of them, as for cameras that are not level, the
// least wrong one is no better than the others.
void judge_parallax(const std::vector<Cut>& cuts, std::vector<Candidate>& candidates) {
  constexpr double kNone = -3.0, kExplained = -1.5;  // as Parallax::level
  for (const Cut& cut : cuts) {
    std::vector<std::pair<Candidate*, double>> judged;
    double best = -1e9, explained = 0.0;
    for (Candidate& each : candidates) {
      const EyeArrangement eyes = each.reading.layout ? arrangement_of(*each.reading.layout) : EyeArrangement();
      if (eyes.how != cut.how || eyes.how == EyePacking::kAlone) continue;
      const Parallax parallax = parallax_in(cut.pairs, each.reading.projection);
      if (eyes.is_halves()) each.odds += order_odds(parallax, eyes.right_first);
      judged.emplace_back(&each, parallax.level * std::min(parallax.count, kManyPairs));
      best = std::max(best, judged.back().second);
      explained = std::max(explained, std::clamp((parallax.level - kNone) / (kExplained - kNone), 0.0, 1.0));
    }
    for (const auto& [candidate, level] : judged)
      candidate->odds += explained * std::max(kLevel * (level - best), -kMaxLevel);
  }
}

// Evidence for two circles that show nothing in common.
double front_and_back_mark(const std::vector<Cut>& cuts) {
  double maximum = 0.0;
  for (const Cut& cut : cuts) {
    const bool is_halves = cut.how == EyePacking::kStacked || cut.how == EyePacking::kBeside;
    if (!is_halves || cut.two_eyes >= 0.0 || cut.eyes.size() != 2) continue;
    maximum = std::max(maximum, std::min(cut.marks.circle, marks_of(shown(cut.eyes[1])).circle) * -cut.two_eyes);
  }
  return maximum;
}

// Converts odds to certainties. An unknown projection always remains possible. seen: evidence that it is a known
// format, but none of the readings.
void share_certainty(const std::vector<Cut>& cuts, double seen, std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.odds > b.odds; });
  double sum = seen > 0.0 ? std::exp(kOther + kElse * seen - candidates[0].odds) : 0.0;
  for (const Cut& cut : cuts) {
    sum += std::exp(kOther + kEyes * cut.two_eyes + kFaces * cut.other_faces - candidates[0].odds);
  }
  for (const Candidate& each : candidates) sum += std::exp(each.odds - candidates[0].odds);
  for (Candidate& each : candidates) each.reading.certainty = std::exp(each.odds - candidates[0].odds) / sum;
}

}  // namespace

bool Identity::is_sure() const {
  return !readings.empty() && best().certainty >= kSure;
}

bool Identity::is_likely() const {
  return !readings.empty() && best().certainty >= kLikely;
}

std::string reading_text(const Reading& reading) {
  return fmt::format("{}, {}", reading.layout ? layout_name(*reading.layout) : "one eye",
                     projection_name(reading.projection));
}

// Two equal halves do not show the projection of a stereo picture: nothing in them has parallax.
static void doubt_copies(const std::vector<Cut>& cuts, std::vector<Candidate>& candidates) {
  constexpr double kAtMost = 0.85;
  for (Candidate& each : candidates) {
    const EyeArrangement eyes = each.reading.layout ? arrangement_of(*each.reading.layout) : EyeArrangement();
    if (std::ranges::any_of(cuts, [&](const Cut& cut) { return cut.is_copy && cut.how == eyes.how; }))
      each.reading.certainty *= kAtMost;
  }
}

// A drawing on a transparent ground looks like a circle with empty corners, a ball like a mirror ball; the margins of a
// page look like poles.
static void doubt_drawings(const StoredPicture& whole, std::vector<Candidate>& candidates) {
  constexpr double kBlackGround = 0.2;  // less than the black corners around a circle that touches all edges
  const bool is_clear = has_clear_corners(whole), is_page = !is_clear && has_one_ground(whole);
  const bool is_framed = is_page || (!is_clear && has_one_ground(whole, kBlackGround));
  for (Candidate& each : candidates) {
    const int kind = each.reading.projection.kind;
    const bool is_drawn = is_fisheye(kind) ? is_page : is_framed && kind != kPerspective;
    if (is_clear || is_drawn) each.reading.certainty *= kLikely;
  }
  std::ranges::stable_sort(candidates, std::greater<>(), [](const Candidate& each) { return each.reading.certainty; });
}

static Identity identify_all(const StoredPicture& whole, const FormatHint& known, bool has_bars) {
  if (std::min(whole.size.width, whole.size.height) < kMinSide) return {};
  const Thumbnail thumbnail = make_thumbnail(whole);
  std::vector<Candidate> candidates;
  std::vector<Cut> cuts = all_cuts(whole, thumbnail);
  Identity identity;
  if (cuts[0].marks.detail < kMinDetail) return identity;
  for (Cut& cut : cuts) {
    cut.has_bars = has_bars;
    for (const Layout layout : layouts_of(cut.how)) add_candidates(cut, layout, known, thumbnail.file, candidates);
  }
  if (candidates.empty()) return identity;
  judge_parallax(cuts, candidates);
  const double anaglyph = anaglyph_mark(whole, {thumbnail.light.width, thumbnail.light.height});
  const double front_and_back = known.layout ? 0.0 : front_and_back_mark(cuts);
  identity.is_anaglyph = anaglyph > kDoubtful, identity.is_front_and_back = front_and_back > kLikely;
  share_certainty(cuts, std::max(anaglyph, front_and_back), candidates);
  doubt_copies(cuts, candidates);
  doubt_drawings(whole, candidates);
  identity.reason = candidates[0].reason;
  identity.has_other_faces = std::any_of(
      cuts.begin(), cuts.end(), [](const Cut& cut) { return cut.other_faces > kLikely && cut.two_eyes >= 0.0; });
  for (const Candidate& each : candidates) identity.readings.push_back(each.reading);
  return identity;
}

// Bars around a perspective picture belong to it: nothing depends on where its edges are.
static Identity with_bars_in_windows(Identity identity, Extent file) {
  identity.bars = {};
  for (Reading& reading : identity.readings) {
    const std::optional<Extent> eye = whole_eye(reading.layout.value_or(Layout::kSeparate), file);
    if (eye && reading.projection.kind == kPerspective)
      reading.projection.aspect = static_cast<float>(eye->width) / static_cast<float>(eye->height);
  }
  return identity;
}

// Returns whether the projection fixes the directions at the picture's edges.
static bool is_whole(const Reading& reading) {
  const ProjectionSetting& projection = reading.projection;
  const EyeArrangement eyes = reading.layout ? arrangement_of(*reading.layout) : EyeArrangement();
  return !is_cube(projection.kind) && (!has_lens(projection.kind) || has_image_circle(projection.kind)) &&
         (projection.kind != kLatLong || is_full_lat_long(projection) || is_vr180(projection)) &&
         (!reading.layout || eyes.is_halves());
}

Identity identify(const StoredPicture& whole, const FormatHint& known) {
  if (std::min(whole.size.width, whole.size.height) < kMinSide) return {};
  const Bars bars = bars_of(whole);
  if (bars.any()) {
    Identity inner = identify_all(without_bars(whole, bars), known, false);
    inner.bars = bars;
    if (inner.is_likely() && is_whole(inner.best())) return inner;
    if (inner.is_likely() && inner.best().projection.kind == kPerspective)
      return with_bars_in_windows(inner, whole.size);
  }
  return identify_all(whole, known, bars.any());
}

std::string doubt_text(const Identity& identity) {
  constexpr double kNamed = 0.05;
  constexpr size_t kMaxNamed = 3;
  if (identity.readings.empty() || identity.is_sure()) return {};
  const size_t at_least = identity.is_anaglyph ? 0 : 2;
  std::vector<std::string> texts;
  for (const Reading& reading : identity.readings) {
    if ((reading.certainty < kNamed && texts.size() >= at_least) || texts.size() == kMaxNamed) break;
    texts.push_back(fmt::format("{} ({:.2f})", reading_text(reading), reading.certainty));
  }
  if (identity.has_other_faces)
    texts.emplace_back("faces of a cube in another order than ods has, to be reordered first");
  if (identity.is_anaglyph) texts.emplace_back("an anaglyph, whose eyes cannot be taken apart again");
  if (identity.is_front_and_back) texts.emplace_back("a front and a back fisheye, to be stitched first");
  return fmt::format("{}: specify it with `layout` and `projection`", fmt::join(texts, " or "));
}

}  // namespace ods
