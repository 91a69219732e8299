// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

std::string_view progress_mode_name(ProgressMode mode) {
  switch (mode) {
    case ProgressMode::kAuto:
      return "auto";
    case ProgressMode::kBar:
      return "bar";
    case ProgressMode::kPlain:
      return "plain";
    case ProgressMode::kJson:
      return "json";
    case ProgressMode::kNone:
      return "none";
    case ProgressMode::kDeadline:
      return "deadline";
    case ProgressMode::kOpenJd:
      return "openjd";
    case ProgressMode::kTractor:
      return "tractor";
  }
  return "";
}

bool progress_is_for_farm(ProgressMode mode) {
  return mode == ProgressMode::kDeadline || mode == ProgressMode::kOpenJd || mode == ProgressMode::kTractor;
}

const char* interrupted_line(ProgressMode mode) {
  if (mode == ProgressMode::kJson) return "{\"error\":\"interrupted\"}\n";
  return mode == ProgressMode::kBar ? "\r\x1b[Kods: interrupted\n" : "ods: interrupted\n";
}

std::string duration_text(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  long whole = static_cast<long>(std::min(seconds, 1e9) + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

namespace {

double seconds_left(double done, double seconds) {
  return done > 0.0 ? seconds * (1.0 - done) / done : 0.0;
}

std::string time_left(double done, double seconds) {
  return done > 0.0 && done < 1.0 ? ", " + duration_text(seconds_left(done, seconds)) + " left" : "";
}

}  // namespace

void ProgressLines::draw_bar(double done, double seconds) {
  const double kRedrawSeconds = 0.1;
  if (drawn_ && seconds < last_drawn_ + kRedrawSeconds) return;
  drawn_ = true;
  last_drawn_ = seconds;
  const size_t kWidth = 32;
  size_t filled = static_cast<size_t>(done * static_cast<double>(kWidth));
  out_ << fmt::format("\r[{}{}] {:3.0f} %{}\x1b[K", std::string(filled, '#'), std::string(kWidth - filled, '.'),
                      100.0 * done, time_left(done, seconds))
       << std::flush;
}

void ProgressLines::report(double done, double seconds) {
  done = std::clamp(done, 0.0, 1.0);
  if (mode_ == ProgressMode::kBar) return draw_bar(done, seconds);
  int percent = static_cast<int>(100.0 * done + 1e-9);
  int step = mode_ == ProgressMode::kPlain ? percent / 10 : percent;
  if (step == last_step_) return;
  if (mode_ == ProgressMode::kPlain && (step == 0 || seconds < last_drawn_ + 1.0)) return;  // no flood for a short job
  last_step_ = step;
  last_drawn_ = seconds;
  switch (mode_) {
    case ProgressMode::kAuto:
    case ProgressMode::kBar:
    case ProgressMode::kNone:
      return;
    case ProgressMode::kPlain:
      out_ << fmt::format("ods: {} %{}\n", percent, time_left(done, seconds));
      break;
    case ProgressMode::kJson:
      out_ << fmt::format("{{\"progress\":{:.2f},\"seconds\":{:.1f},\"seconds_left\":{:.1f}}}\n", percent / 100.0,
                          seconds, seconds_left(done, seconds));
      break;
    case ProgressMode::kDeadline:
      out_ << fmt::format("Progress: {}%\n", percent);
      break;
    case ProgressMode::kOpenJd:
      out_ << fmt::format("openjd_progress: {}\n", percent);
      break;
    case ProgressMode::kTractor:
      out_ << fmt::format("ALF_PROGRESS {}%\n", percent);
      break;
  }
  out_ << std::flush;
}

void ProgressLines::fail(const std::string& why) {
  clear();
  if (mode_ == ProgressMode::kOpenJd) out_ << "openjd_fail: " << why << '\n' << std::flush;
}

void ProgressLines::clear() {
  if (!drawn_) return;
  out_ << "\r\x1b[K" << std::flush;
  drawn_ = false;
}
