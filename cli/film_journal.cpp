// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/film_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

#include "cli/console.h"
#include "ods/base/atomic_file.h"
#include "ods/base/frames.h"
#include "ods/base/read_file.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* kNote = "/job.txt";

// Options that change the film, or what is said of it, but no frame.
constexpr std::array kOptions = {"-o",         "--output", "--target",  "--codec",    "--encoder", "--preset",
                                 "--crf",      "--bits",   "--bitrate", "--chroma",   "--audio",   "--tone",
                                 "--exposure", "--frames", "--threads", "--progress", "--confine"};
constexpr std::array kFlags = {"-q", "--quiet", "--no-color", "--keep-frames", "--restart", "--skip-existing"};

std::string note_of(const std::vector<std::string>& words) {
  std::string note = "ods " ODS_VERSION "\n";
  for (size_t i = 0; i < words.size(); i++) {
    const std::string name = words[i].substr(0, words[i].find('='));
    if (std::find(kFlags.begin(), kFlags.end(), name) != kFlags.end()) continue;
    if (std::find(kOptions.begin(), kOptions.end(), name) != kOptions.end()) {
      if (name == words[i]) i++;  // its value
      continue;
    }
    const std::string file = ods::file_identity(words[i]);
    note += words[i] + (file.empty() ? "" : fmt::format(" ({})", file)) + "\n";
  }
  return note;
}

std::string read_note(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return "";
  const std::vector<unsigned char> bytes = ods::read_file(path, 1 << 20);
  return {bytes.begin(), bytes.end()};
}

// The first line in which two notes differ.
std::string difference(const std::string& then, const std::string& now) {
  std::istringstream before(then), after(now);
  std::string one, other;
  do {
    one.clear(), other.clear();
    std::getline(before, one);
    std::getline(after, other);
  } while (one == other && (before || after));
  const auto said = [](const std::string& line) { return line.empty() ? "nothing" : "'" + line + "'"; };
  return fmt::format("{} then, {} now", said(one), said(other));
}

}  // namespace

FilmJournal::FilmJournal(const std::string& film, const std::vector<std::string>& words, bool restart)
    : folder_(film + ".frames") {
  const std::string path = folder_ + kNote, now = note_of(words), then = read_note(path);
  std::error_code ignored;
  if (then == now && !restart) return;
  if (restart || (!then.empty() && !has_frames())) {
    remove();
  } else if (!then.empty()) {
    throw UsageError(fmt::format("'{}' has frames of other options ({}); --restart renders them anew", folder_,
                                 difference(then, now)));
  } else if (fs::exists(folder_, ignored) && !fs::is_empty(folder_, ignored)) {
    throw UsageError(fmt::format("'{}' is where the frames would lie, and it is not empty", folder_));
  }
  ods::write_file(path, now);
}

FilmJournal::~FilmJournal() {
  if (!has_frames()) remove();
}

bool FilmJournal::has_frames() const {
  std::error_code ignored;
  return fs::is_directory(folder_, ignored) && !ods::frames_on_disk(*ods::frame_names(pattern())).empty();
}

std::string FilmJournal::pattern() const {
  return folder_ + "/frame.######.exr";
}

void FilmJournal::remove() const {
  std::error_code ignored;
  if (!fs::is_directory(folder_, ignored)) return;
  const ods::FrameNames names = *ods::frame_names(pattern());
  for (int frame : ods::frames_on_disk(names)) fs::remove(names.path(frame), ignored);
  std::vector<fs::path> halves;  // of runs that were killed
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().native();
    if (name.starts_with(".frame.") || name.starts_with(".job.txt.tmp.")) halves.push_back(entry.path());
  }
  for (const fs::path& half : halves) fs::remove(half, ignored);
  fs::remove(folder_ + kNote, ignored);
  fs::remove(folder_, ignored);
}
