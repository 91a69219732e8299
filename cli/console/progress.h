// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a long job is, for people, logs and render farms.
#pragma once
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

#include "cli/console/interrupt.h"
#include "ods/base/names.h"

enum class ProgressMode {
  kAuto,      // the bar on a terminal, plain lines elsewhere
  kBar,       // one line that redraws itself
  kPlain,     // a line after 1, 10 and 30 seconds, then every 30, and for every tenth, at most one a second
  kJson,      // an object for every hundredth, and whenever kPlain has a line; docs/console.md has its keys
  kNone,      //
  kDeadline,  // "Progress: 42%"           AWS Thinkbox Deadline
  kOpenJd,    // "openjd_progress: 42"     Open Job Description
  kTractor,   // "ALF_PROGRESS 42%"        Pixar Tractor
};

inline constexpr ods::NameRow<ProgressMode> kProgressModeTable[] = {
    {ProgressMode::kAuto, "auto"},     {ProgressMode::kBar, "bar"},         {ProgressMode::kPlain, "plain"},
    {ProgressMode::kJson, "json"},     {ProgressMode::kNone, "none"},       {ProgressMode::kDeadline, "deadline"},
    {ProgressMode::kOpenJd, "openjd"}, {ProgressMode::kTractor, "tractor"},
};
static_assert(ods::has_every_member(kProgressModeTable));
inline constexpr auto kProgressModes = ods::members_of(kProgressModeTable);
constexpr std::string_view progress_mode_name(ProgressMode mode) {
  return ods::name_in(kProgressModeTable, mode);
}

// A farm reads stdout; everything else is for stderr.
bool progress_is_for_farm(ProgressMode mode);

// The last line on stderr of a job that a signal ends; a bar is taken off the screen.
LastWords interrupted_line(ProgressMode mode);

// "45 s", "3:07 min", "1:02:03 h".
std::string duration_text(double seconds);

// What a job is at. A job that makes one picture has no frames.
struct ProgressStep {
  std::string_view kind;  // render, stitch, encode, ...: a word that outlives the call
  int frame = 0;          // counted from 1
  int frames = 0;         // in all; 0: not a video
  std::string file;       // that is being made
};

// The share done of all, 0..1, and what it is at.
using StepReport = std::function<void(double done, const ProgressStep& step)>;

// The step of a job that has done this share of a video's frames.
ProgressStep video_step(std::string_view kind, double done, size_t frames, const std::string& file);

// Writes one job's progress; kAuto is the caller's to resolve.
class ProgressLines {
 public:
  ProgressLines(ProgressMode mode, std::ostream& out) : mode_(mode), out_(out) {}
  ~ProgressLines() { clear(); }
  ProgressLines(const ProgressLines&) = delete;
  ProgressLines& operator=(const ProgressLines&) = delete;

  // The share done, 0..1, after so many seconds.
  void report(double done, double seconds, const ProgressStep& step = {});

  // Tells the farm why the job failed, where there is a way to.
  void fail(const std::string& why);

  // Takes the bar off the screen.
  void clear();

 private:
  void draw_bar(double done, double seconds, const ProgressStep& step);
  bool is_due(double seconds);

  ProgressMode mode_;
  std::ostream& out_;
  int last_step_ = -1;
  double due_ = 1.0;         // seconds: when the next line comes, whatever is done
  double last_drawn_ = 0.0;  // seconds
  bool drawn_ = false;       // the bar is on the screen
};
