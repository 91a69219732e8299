// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/progress.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "ods/base/quote.h"
#include "ods/base/text.h"

bool progress_is_for_farm(ProgressMode mode) {
  return mode == ProgressMode::kDeadline || mode == ProgressMode::kOpenJd || mode == ProgressMode::kTractor;
}

static const char* json_final_message(int signal) {
  if (signal == SIGHUP) return "{\"error\":\"interrupted\",\"exit_code\":129}\n";
  if (signal == SIGTERM) return "{\"error\":\"interrupted\",\"exit_code\":143}\n";
  return "{\"error\":\"interrupted\",\"exit_code\":130}\n";
}

static const char* bar_final_message(int) {
  return "\r\x1b[Kods: interrupted\n";
}

FinalMessage interrupted_line(ProgressMode mode) {
  if (mode == ProgressMode::kJson) return json_final_message;
  return mode == ProgressMode::kBar ? bar_final_message : plain_final_message;
}

std::string duration_text(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  long whole = static_cast<long>(std::min(seconds, 1e9) + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

ProgressStep video_step(std::string_view kind, double done, size_t frames, const std::string& file) {
  const int count = static_cast<int>(frames);
  return {kind, std::clamp(static_cast<int>(done * count) + 1, 1, std::max(count, 1)), count, file};
}

namespace {

std::string frame_text(const ProgressStep& step) {
  return step.frames > 1 ? fmt::format(", frame {} of {}", step.frame, step.frames) : "";
}

// With a decimal, because a long video is below one percent for a long time.
std::string percent_text(double done) {
  const double percent = std::floor(1000.0 * done + 1e-9) / 10.0;
  return percent < 10.0 && percent > 0.0 ? fmt::format("{:.1f}", percent)
                                         : fmt::format("{}", static_cast<int>(percent));
}

}  // namespace

// Empty until there is enough work to estimate it. Time before the first report of work, such as loading, does not
// count: 20 seconds of loading and a millionth of a frame would give years.
std::optional<double> ProgressLines::seconds_left(double done, double seconds) const {
  const double kEnoughWork = 0.01, kEnoughSeconds = 20.0;
  const double measured = seconds - first_seconds_;
  if (done <= 0.0 || (done < kEnoughWork && measured < kEnoughSeconds)) return std::nullopt;
  const bool has_rate = measured >= 1.0 && done > first_done_;
  const double rate = has_rate ? (done - first_done_) / measured : done / std::max(seconds, 1e-9);
  return (1.0 - done) / rate;
}

std::string ProgressLines::time_left(double done, double seconds) const {
  const std::optional<double> left = seconds_left(done, seconds);
  return left && done < 1.0 ? ", " + duration_text(*left) + " left" : "";
}

std::string ProgressLines::json_line(double done, double seconds, const ProgressStep& step) const {
  std::string line = fmt::format("{{\"progress\":{:.4f},\"seconds\":{:.1f}", done, seconds);
  if (const std::optional<double> left = seconds_left(done, seconds))
    line += fmt::format(",\"seconds_left\":{:.1f}", *left);
  if (!step.kind.empty()) line += fmt::format(",\"kind\":\"{}\"", step.kind);
  if (step.frames > 0) line += fmt::format(",\"frame\":{},\"frames\":{}", step.frame, step.frames);
  if (!step.file.empty()) line += ",\"file\":" + ods::json_document(step.file);
  return line + "}\n";
}

void ProgressLines::draw_bar(double done, double seconds, const ProgressStep& step) {
  const double kRedrawSeconds = 0.1;
  if (drawn_ && seconds < last_drawn_ + kRedrawSeconds) return;
  drawn_ = true;
  last_drawn_ = seconds;
  const size_t kWidth = 32;
  size_t filled = static_cast<size_t>(done * static_cast<double>(kWidth));
  out_ << fmt::format("\r[{}{}] {:>3} %{}{}\x1b[K", std::string(filled, '#'), std::string(kWidth - filled, '.'),
                      percent_text(done), frame_text(step), time_left(done, seconds))
       << std::flush;
}

// After 1, 10 and 30 seconds, and then every 30.
bool ProgressLines::is_due(double seconds) {
  if (seconds < due_) return false;
  while (due_ <= seconds) due_ = due_ < 10.0 ? 10.0 : due_ < 30.0 ? 30.0 : due_ + 30.0;
  return true;
}

void ProgressLines::report(double done, double seconds, const ProgressStep& step) {
  done = std::clamp(done, 0.0, 1.0);
  if (first_done_ == 0.0) first_done_ = done, first_seconds_ = seconds;
  if (mode_ == ProgressMode::kBar) return draw_bar(done, seconds, step);
  const int percent = static_cast<int>(100.0 * done + 1e-9);
  const int part = mode_ == ProgressMode::kPlain ? percent / 10 : percent;
  const bool is_due_now = !progress_is_for_farm(mode_) && is_due(seconds);
  if (part == last_step_ && !is_due_now) return;
  if (mode_ == ProgressMode::kPlain && !is_due_now && (part == 0 || seconds < last_drawn_ + 1.0)) return;  // no flood
  last_step_ = part;
  last_drawn_ = seconds;
  switch (mode_) {
    case ProgressMode::kAuto:
    case ProgressMode::kBar:
    case ProgressMode::kNone:
      return;
    case ProgressMode::kPlain:
      out_ << fmt::format("ods: {} %{}{}\n", percent_text(done), frame_text(step), time_left(done, seconds));
      break;
    case ProgressMode::kJson:
      out_ << json_line(done, seconds, step);
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
  if (mode_ == ProgressMode::kOpenJd)
    out_ << "openjd_fail: " << ods::terminal_text(ods::one_line(why)) << '\n' << std::flush;
}

void ProgressLines::clear() {
  if (!drawn_) return;
  out_ << "\r\x1b[K" << std::flush;
  drawn_ = false;
}
