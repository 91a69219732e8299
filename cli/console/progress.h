// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reports the progress of a long job to people, logs and render farms.
#pragma once
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "cli/console/interrupt.h"
#include "ods/base/names.h"

enum class ProgressMode {
  kAuto,      // the bar on a terminal, plain lines elsewhere
  kBar,       // one line that redraws itself
  kPlain,     // a line after 1, 10 and 30 seconds, then every 30, and at every tenth, at most one per second
  kJson,      // an object at every hundredth, and with every line of kPlain; docs/console.md has its keys
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

// Farms read stdout; all other modes use stderr.
bool progress_is_for_farm(ProgressMode mode);

// The last line on stderr after a signal; clears the bar first.
FinalMessage interrupted_line(ProgressMode mode);

// "45 s", "3:07 min", "1:02:03 h".
std::string duration_text(double seconds);

// The step that a job is working on. A job that makes one picture has no frames.
struct ProgressStep {
  std::string_view kind;  // render, stitch, encode, ...; must outlive the call
  int frame = 0;          // counted from 1
  int frames = 0;         // in all; 0: not a video
  std::string file;       // the file being made
};

// Receives the fraction done of the whole job, 0..1, and the current step.
using StepReport = std::function<void(double done, const ProgressStep& step)>;

// The step of a job that has completed this fraction of a video's frames.
ProgressStep video_step(std::string_view kind, double done, size_t frames, const std::string& file);

// Writes one job's progress. The caller must resolve kAuto.
class ProgressLines {
 public:
  ProgressLines(ProgressMode mode, std::ostream& out) : mode_(mode), out_(out) {}
  ~ProgressLines() { clear(); }
  ProgressLines(const ProgressLines&) = delete;
  ProgressLines& operator=(const ProgressLines&) = delete;

  // The fraction done, 0..1, after this many seconds.
  void report(double done, double seconds, const ProgressStep& step = {});

  // Reports the failure to the farm, if it has a way to.
  void fail(const std::string& why);

  // Clears the bar.
  void clear();

 private:
  std::optional<double> seconds_left(double done, double seconds) const;
  std::string time_left(double done, double seconds) const;
  std::string json_line(double done, double seconds, const ProgressStep& step) const;
  void draw_bar(double done, double seconds, const ProgressStep& step);
  bool is_due(double seconds);

  ProgressMode mode_;
  std::ostream& out_;
  int last_step_ = -1;
  double first_done_ = 0.0;  // of the first report of any work
  double first_seconds_ = 0.0;
  double due_ = 1.0;         // seconds: when the next line is due, regardless of the fraction
  double last_drawn_ = 0.0;  // seconds
  bool drawn_ = false;       // the bar is on the screen
};
