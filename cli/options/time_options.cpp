// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/time_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <unordered_set>

#include "cli/console/console.h"
#include "cli/options/camera_options.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/files/frames.h"
#include "ods/render/render_options.h"
#include "ods/stage/turntable.h"

namespace {

void read_turntable(const std::string& word, ods::CameraMove& move) {
  const std::vector<float> numbers = parse_numbers(word);
  bool legal = numbers.size() == 1 || numbers.size() == 4;
  for (const float number : numbers) legal = legal && std::abs(number) <= 1e6f;
  if (!legal) throw UsageError(fmt::format("--turntable is TURNS or TURNS,X,Y,Z, not '{}'", word));
  move.turns = static_cast<double>(numbers[0]);
  if (numbers.size() == 4) move.pivot = ods::vec3(numbers[1], numbers[2], numbers[3]);
}

void read_flight(const std::string& word, ods::CameraMove& move) {
  move.fly_to.clear();
  for (size_t start = 0; start <= word.size();) {
    const size_t end = std::min(word.find(';', start), word.size());
    move.fly_to.push_back(parse_point("--fly-to", word.substr(start, end - start)));
    start = end + 1;
  }
}

bool names_frames(const TimeOptions& time) {
  return !time.frames.empty() && time.frames != "all";
}

}  // namespace

void add_animation_option(Options& options, TimeOptions& time) {
  options.text("--animation", "NAME", time.animation,
               "play only this animation (ods info lists them); by default all, but only the first of those that move "
               "the same objects");
}

void add_time_options(Options& options, TimeOptions& time) {
  options.group("Time");
  options.number("--time", time.time, -1e6f, 1e6f,
                 "render the animation at this time, seconds; by default the scene is in its rest pose");
  add_animation_option(options, time);
  options.text("--frames", "LIST|all", time.frames,
               "frames to render: 1-100, 1-100x2 (every other one), 1,5,10-20, or all. Frame N shows the scene at N / "
               "fps seconds; of a .blend, frame N of its timeline. "
               "ods render writes a file per frame: -o shot.####.exr or shot.%04d.exr");
  options.text("--only", "LIST|I/N", time.only,
               "make only these frames, or the I-th of N shares of them, as one of several processes; exposure and "
               "denoising still consider all frames");
  options.number("--fps", time.given_fps, 0.01f, 1000.0f, "frames per second", "30");
  options.number("--duration", time.duration, 0.01f, 1e6f,
                 "length of the video and of camera moves, seconds; by default the animation's length, or 10");
  options.custom(
      "--turntable", "TURNS|TURNS,X,Y,Z", "", [&](const std::string& word) { read_turntable(word, time.move); },
      "this many turns in the whole duration: an object on its own turns on the spot, clockwise from above, while "
      "light and ground stay; elsewhere the viewer turns to the right. With X,Y,Z the viewer circles the vertical "
      "axis through that point and keeps facing it");
  options.custom(
      "--fly-to", "X,Y,Z;X,Y,Z...", "", [&](const std::string& word) { read_flight(word, time.move); },
      "fly the camera from its position through these points, on a smooth curve, in the whole duration");
  options.number("--shutter", time.given_shutter, 0.0f, 360.0f,
                 "motion blur: shutter angle in degrees, centred on the frame's time; 360 is a whole frame, 180 is "
                 "usual, 0 turns it off",
                 "0");
  options.choice("--grain", time.grain, kGrainTable,
                 "noise pattern: the same in every frame, or different in each; by default changing if --turntable, "
                 "--fly-to or the file moves the camera, else fixed");
  options.flag("--skip-existing", time.skip_existing,
               "skip existing files; several processes with this option share the rest");
}

bool makes_video(const TimeOptions& time) {
  return time.is_video || !time.frames.empty() || time.duration || ods::moves(time.move);
}

void check_time_options(const TimeOptions& time) {
  if (time.time && makes_video(time)) throw UsageError("--time is for one picture, --frames for a video; give one");
  if (names_frames(time)) ods::parse_frames(time.frames);
  check_only(time.only);
}

void check_only(const std::string& only) {
  if (only.find('/') == std::string::npos) {
    if (!only.empty()) ods::parse_frames(only);
  } else if (!ods::parse_part(only)) {
    throw UsageError(fmt::format("--only is a list of frames or a share of them, such as 3/8, not '{}'", only));
  }
}

// The I-th of N shares.
static std::vector<int> share_of(const std::vector<int>& all, ods::Part share) {
  const auto border = [&](size_t i) {
    return all.begin() + static_cast<ptrdiff_t>(all.size() * i / static_cast<size_t>(share.count));
  };
  return {border(static_cast<size_t>(share.number) - 1), border(static_cast<size_t>(share.number))};
}

std::vector<int> own_frames(const std::string& only, const std::vector<int>& all) {
  if (only.empty()) return all;
  if (const auto share = ods::parse_part(only)) return share_of(all, *share);
  const std::vector<int> chosen = ods::parse_frames(only);
  const std::unordered_set<int> wanted(chosen.begin(), chosen.end());
  std::vector<int> own;
  std::ranges::copy_if(all, std::back_inserter(own), [&](int frame) { return wanted.contains(frame); });
  if (own.empty()) {
    throw UsageError(fmt::format("--only: none of {} is among {}", only, ods::frames_text(all)));
  }
  return own;
}

// An object on its own turns itself, before a viewer who stays where a file's or our own view point is.
static void turn_object(TimeOptions& time, ods::Scene& scene) {
  const ods::CameraMove& move = time.move;
  if (move.turns == 0.0 || move.pivot || !move.fly_to.empty()) return;
  if (!scene.viewing || !scene.viewing->is_object) return;
  const std::vector<int> frames = video_frames(time);
  const double end =
      (*std::max_element(frames.begin(), frames.end()) - time.file.first) / static_cast<double>(time.fps) + 1.0;
  if (std::abs(move.turns) / move.seconds * std::max(end, move.seconds) > ods::kMaxTurns) {
    throw UsageError(fmt::format("--turntable turns an object at most {:g} times", ods::kMaxTurns));
  }
  ods::turn_object(scene, scene.viewing->middle, move.turns, move.seconds, end);
  note("the object turns on the spot; --turntable TURNS,X,Y,Z moves the viewer around it instead");
  if (time.frames.empty()) time.frames = "all";  // still a video, although the camera stays
  time.move.turns = 0.0;
}

static Grain usual_grain(const TimeOptions& time, const CameraOptions& camera, const ods::Scene& scene) {
  return ods::moves(time.move) || is_moved_by_file(scene_camera(camera), scene) ? Grain::kChanging : Grain::kFixed;
}

void start_clock(TimeOptions& time, const CameraOptions& camera, ods::Scene& scene) {
  ods::Animation& animation = scene.animation;
  // A still shows the frame at which the file was saved.
  if (time.file.count > 0 && !time.time && !makes_video(time)) {
    time.time = static_cast<float>(time.file.saved - time.file.first) / time.fps;
    note(fmt::format("frame {} of {} to {}, at which the file was saved; --time SECONDS or --frames LIST chooses",
                     time.file.saved, time.file.first, time.file.first + time.file.count - 1));
  }
  const bool timed = time.time || makes_video(time);
  const std::vector<std::string> names = ods::names_of(animation.clips);
  if (!timed && time.animation.empty()) {
    if (!names.empty()) note("rendering the rest pose; --time SECONDS or --frames LIST plays the animation");
    return;
  }
  if (!time.animation.empty() && names.empty()) throw UsageError("--animation: the scene has none");
  if (!ods::play(animation, time.animation)) {
    throw UsageError(fmt::format("--animation: the scene has none called '{}'{} (ods info lists them)", time.animation,
                                 ods::did_you_mean(time.animation, names)));
  }
  // The time during which the file's frames are shown, the last one included.
  const double length =
      time.file.count > 0 ? time.file.count / static_cast<double>(time.fps) : ods::length_of(animation);
  if (!time.grain) time.grain = usual_grain(time, camera, scene);
  time.move.seconds = time.duration ? static_cast<double>(*time.duration) : length > 0.0 ? length : 10.0;
  turn_object(time, scene);
}

// The frames that the options list. If the file counts its frames, it must have some of them.
static std::vector<int> named_frames(const TimeOptions& time) {
  std::vector<int> frames = ods::parse_frames(time.frames);
  const int last = time.file.first + time.file.count - 1;
  const auto is_there = [&](int frame) { return frame >= time.file.first && frame <= last; };
  if (time.file.count > 0 && std::ranges::none_of(frames, is_there)) {
    throw UsageError(fmt::format("--frames: the file has frames {} to {}", time.file.first, last));
  }
  return frames;
}

std::vector<int> video_frames(const TimeOptions& time) {
  if (names_frames(time)) return named_frames(time);
  const double count = std::round(time.move.seconds * static_cast<double>(time.fps));
  if (count > 1e6)
    throw UsageError("the video would have more than a million frames; --frames selects which to render");
  std::vector<int> frames(static_cast<size_t>(std::max(count, 1.0)));
  std::iota(frames.begin(), frames.end(), time.file.first);
  return frames;
}
