// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ods/base/angles.h"
#include "ods/base/error.h"
#include "ods/base/median.h"
#include "ods/comfort/matched.h"
#include "ods/comfort/motion.h"
#include "ods/convert/unwrap.h"
#include "ods/disparity/match.h"
#include "ods/identify/open_media.h"
#include "ods/picture/load_eyes.h"
#include "ods/video/container/video_file.h"
#include "ods/video/video_input.h"

namespace ods {

namespace {

constexpr int kWidth = 512;        // of the views that are matched
constexpr int kMinMoments = 8;     // of a short video
constexpr int kGlance = 256;       // the width of the views that show a cut
constexpr double kSameShot = 0.3;  // the least share of their tiles that two frames of a shot have in common
constexpr int kMaxCuts = 12;       // that are looked for
constexpr double kHorizonBand = 30.0 * kDegree;

// A frame as it is looked at.
struct Frame {
  double seconds = 0.0;
  std::vector<Image> eyes;
  GrayView glance;  // of the left eye
};

// The share of places that both views show, displaced by no more than a moving camera would.
double alike(const GrayView& a, const GrayView& b) {
  Search search;
  search.rows = 10;
  search.columns = 12;
  search.step = 10;
  search.around = 0.35f;
  search.down = 0.12f;
  search.lowest = -0.9f;
  search.highest = 0.9f;
  return match_tiles(a, b, search).share();
}

double median_vergence(const SeenDepth& seen) {
  const Camera camera = make_camera(seen.camera);
  const double ipd = double{camera.ipd};
  std::vector<double> all;
  for (int y = 0; y < seen.depth.height; y++) {
    const double phi = std::numbers::pi * (0.5 - (y + 0.5) / seen.depth.height);
    if (std::abs(phi) > kHorizonBand) continue;
    for (int x = 0; x < seen.depth.width; x++) {
      const double depth = double{*seen.depth.at(x, y)};
      if (depth > 0.0) all.push_back(2.0 * std::atan(0.5 * ipd / depth) / kDegree);
    }
  }
  return all.empty() ? 0.0 : median(std::move(all));
}

std::pair<ComfortLevel, double> rank_of(const ComfortVerdict& verdict) {
  const StrainedPlace* const worst = verdict.worst();
  return worst ? std::pair{worst->level, worst->value} : std::pair{ComfortLevel::kOk, 0.0};
}

class VideoJudge {
 public:
  VideoJudge(const std::string& path, const VideoComfortOptions& options)
      : options_(options), video_(open_video(path, options.format)), decoder_(path, video_.track, video_.views) {
    if (video_.prototype.eyes.size() != 2) {
      throw Error(ErrorKind::kInput, fmt::format("'{}' has one eye: its distances are unknown", path));
    }
    check_matchable(video_.prototype.camera.projection, video_.prototype.size.width, path);
  }

  VideoComfort run(const Progress& progress);

 private:
  // The first frame at or after that time, and the next one; nullopt after the last.
  std::optional<Frame> frame_at(double seconds);
  std::optional<Frame> next_frame();
  std::optional<VideoMoment> look_at(double seconds);
  void add_motion(VideoMoment& moment, const Frame& frame, const MatchedEyes& matched);
  void find_cut(const VideoMoment& before, VideoMoment& after, GrayView low_view, GrayView high_view);
  void add_strains();
  void add(const VideoStrain& strain);

  const VideoComfortOptions& options_;
  VideoInput video_;
  VideoDecoder decoder_;
  StereoCamera camera_;
  VideoComfort result_;
  std::vector<StrainedPlace> places_;  // the worst of each moment, if it is not ok
  std::vector<double> apart_;
  GrayView glance_;  // of the last moment
  int cuts_ = 0;
  glm::dvec3 velocity_{0.0};
};

std::optional<Frame> VideoJudge::next_frame() {
  const std::optional<DecodedFrame> decoded = decoder_.next();
  if (!decoded) return {};
  StoredPicture picture = picture_of(video_, decoder_.stream(), *decoded);
  if (!picture.maps.empty()) picture = unwrapped(picture);
  camera_ = picture.camera;
  Frame frame{decoder_.stream().seconds_at(decoded->time), grey_eyes(picture), {}};
  frame.glance = make_gray_views({frame.eyes[0]}, camera_.projection, false, kGlance)[0];
  return frame;
}

std::optional<Frame> VideoJudge::frame_at(double seconds) {
  decoder_.skip_to(seconds + decoder_.stream().start);
  return next_frame();
}

void VideoJudge::add_motion(VideoMoment& moment, const Frame& frame, const MatchedEyes& matched) {
  const std::optional<Frame> next = next_frame();
  if (!next || !(next->seconds > frame.seconds) || alike(frame.glance, next->glance) < kSameShot) return;
  const GrayView after = make_gray_views({next->eyes[0]}, camera_.projection, false, kWidth)[0];
  const ViewerMotion motion =
      motion_between(matched.grey[0], after, matched.seen[0].depth, next->seconds - frame.seconds);
  moment.is_carried = motion.places >= kMinPlaces;
  if (!moment.is_carried) return;
  moment.turn = std::abs(motion.turn.y) / kDegree;
  moment.tilt = std::hypot(motion.turn.x, motion.turn.z) / kDegree;
  moment.speed = glm::length(motion.velocity);
  if (!result_.moments.empty() && result_.moments.back().is_carried) {
    const double passed = moment.seconds - result_.moments.back().seconds;
    moment.acceleration = glm::length(motion.velocity - velocity_) / passed;
  }
  velocity_ = motion.velocity;
}

std::optional<VideoMoment> VideoJudge::look_at(double seconds) {
  const std::optional<Frame> frame = frame_at(seconds);
  if (!frame) return {};
  MatchedEyes matched = match_eyes_for_depth(frame->eyes, camera_, false, kWidth);
  VideoMoment moment;
  moment.seconds = frame->seconds;
  moment.matched = matched.share;
  moment.nearest = std::numeric_limits<double>::infinity();
  StrainedPlace worst;
  if (matched.share >= kMinMatched) {
    ComfortVerdict verdict = judge_comfort(matched.seen, options_.comfort, matched);
    moment.nearest = verdict.nearest;
    if (options_.comfort.rules == ComfortRules::kStrain) {
      moment.vertical = verdict.max[Strain::kVertical];
      const double dioptres = verdict.max[Strain::kNear];
      moment.vergence = 2.0 * std::atan(0.5 * dioptres * double{options_.comfort.viewer.ipd}) / kDegree;
    }
    moment.middle = median_vergence(matched.seen[0]);
    moment.level = verdict.level;
    result_.precision = std::max(result_.precision, matched.precision);
    add_motion(moment, *frame, matched);
    if (verdict.worst()) worst = *verdict.worst();
    if (result_.worst.light.empty() || rank_of(verdict) > rank_of(result_.worst.verdict)) {
      result_.worst.verdict = std::move(verdict);
      result_.worst.camera = matched.seen[0].camera;
      result_.worst.light = {light_of(matched.grey[0]), light_of(matched.grey[1])};
    }
  }
  if (!result_.moments.empty() && cuts_ < kMaxCuts && alike(glance_, frame->glance) < kSameShot) {
    find_cut(result_.moments.back(), moment, glance_, frame->glance);
  }
  glance_ = frame->glance;
  places_.push_back(worst);
  apart_.push_back(matched.share >= kMinMatched ? matched.apart : 0.0);
  return moment;
}

// Bisects the time between two moments that have little in common down to two successive frames. If these have little
// in common, too, it is a cut: measures the jump of vergence across it.
void VideoJudge::find_cut(const VideoMoment& before, VideoMoment& after, GrayView low_view, GrayView high_view) {
  double low = before.seconds, high = after.seconds;
  const double step = video_.fps > 0.0 ? 1.0 / video_.fps : 0.04;
  std::vector<Image> low_eyes, high_eyes;
  while (high - low > 1.5 * step) {
    std::optional<Frame> middle = frame_at(0.5 * (low + high - step));
    if (!middle || middle->seconds >= high || middle->seconds <= low) break;
    const bool is_before = alike(low_view, middle->glance) >= alike(middle->glance, high_view);
    (is_before ? low : high) = middle->seconds;
    (is_before ? low_eyes : high_eyes) = std::move(middle->eyes);
    (is_before ? low_view : high_view) = std::move(middle->glance);
  }
  if (alike(low_view, high_view) >= kSameShot) return;
  cuts_++;
  const auto vergence = [&](const std::vector<Image>& eyes, double known) {
    return eyes.empty() ? known : median_vergence(match_eyes_for_depth(eyes, camera_, false, kWidth).seen[0]);
  };
  after.cut = std::abs(vergence(high_eyes, after.middle) - vergence(low_eyes, before.middle));
  after.cut_at = high;
  after.acceleration = 0.0;
}

// Strains of successive moments are one.
void VideoJudge::add(const VideoStrain& strain) {
  if (strain.level == ComfortLevel::kOk) return;
  for (VideoStrain& known : result_.strains) {
    if (known.name != strain.name || strain.from - known.to > 1.5 * result_.every) continue;
    known.to = strain.to;
    if (strain.level > known.level || (strain.level == known.level && strain.value > known.value)) {
      known.worst = strain.worst;
      known.value = strain.value;
      known.level = strain.level;
      known.place = strain.place;
    }
    return;
  }
  result_.strains.push_back(strain);
}

void VideoJudge::add_strains() {
  for (size_t i = 0; i < result_.moments.size(); i++) {
    VideoMoment& moment = result_.moments[i];
    const double at = moment.seconds;
    if (const StrainedPlace& place = places_[i]; place.level > ComfortLevel::kOk) {
      const StrainRow& row = strain_row(place.strain);
      add({at, at, at, row.name, row.title, row.unit, place.value, place.level, place});
    }
    const std::pair<Ride, double> rides[] = {{Ride::kApart, apart_[i]},
                                             {Ride::kTurn, moment.turn},
                                             {Ride::kTilt, moment.tilt},
                                             {Ride::kSpeed, moment.speed},
                                             {Ride::kAcceleration, moment.acceleration},
                                             {Ride::kCut, moment.cut.value_or(0.0)}};
    for (const auto& [ride, value] : rides) {
      const RideRow& row = ride_row(ride);
      const ComfortLevel level = level_of(value, row.limits);
      moment.level = std::max(moment.level, level);
      const double when = ride == Ride::kCut ? moment.cut_at : at;
      add({when, when, when, row.name, row.title, row.unit, value, level, {}});
    }
  }
  std::ranges::stable_sort(result_.strains,
                           [](const VideoStrain& a, const VideoStrain& b) { return a.level > b.level; });
  if (result_.strains.size() > 10) result_.strains.resize(10);
}

VideoComfort VideoJudge::run(const Progress& progress) {
  result_.frames = decoder_.stream().count;
  const double fps = video_.fps > 0.0 ? video_.fps : 25.0;
  result_.seconds = result_.frames / fps;
  const int max = options_.max_moments, seconds = static_cast<int>(std::ceil(result_.seconds));
  const int requested = std::clamp(seconds, std::min(kMinMoments, max), max);
  const int count = result_.frames > 0 ? std::min(requested, result_.frames) : requested;
  result_.every = result_.seconds > 0.0 ? result_.seconds / count : 1.0;
  for (int i = 0; i < count; i++) {
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "interrupted");
    const std::optional<VideoMoment> moment = look_at(i * result_.every);
    if (!moment) break;
    result_.moments.push_back(*moment);
    if (progress.report) progress.report((i + 1.0) / count);
  }
  if (result_.worst.light.empty()) {
    throw Error(ErrorKind::kInput,
                fmt::format("the eyes of '{}' could not be matched: see what ods lint reports", video_.path));
  }
  add_strains();
  for (const VideoMoment& moment : result_.moments) result_.level = std::max(result_.level, moment.level);
  return std::move(result_);
}

}  // namespace

VideoComfort judge_video(const std::string& path, const VideoComfortOptions& options, const Progress& progress) {
  VideoComfortOptions found = options;
  const MediaFile media = open_media(path, {.known = options.format});
  refuse_unlikely(media);
  found.format = media.hint;
  VideoComfort video = VideoJudge(path, found).run(progress);
  for (const std::string& doubt : media.notes) video.notes.push_back(fmt::format("'{}' is {}", path, doubt));
  return video;
}

}  // namespace ods
