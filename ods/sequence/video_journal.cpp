// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/video_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/files/frames.h"
#include "ods/files/read_file.h"
#include "ods/sequence/frame_renderer.h"
#include "ods/sequence/identity.h"

namespace fs = std::filesystem;

namespace ods {
namespace {

constexpr const char* kNote = "job.txt";
constexpr const char* kFrame = "frame.######.exr";
constexpr const char* kMark = "omnistereo video frames, 2";  // the number is the version of the note's format
constexpr const char* kFrames = "frames";

fs::file_type type_of(const std::string& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type();
}

// Returns whether a file in the folder is a partial copy of this one, left by a killed run.
bool is_half(const std::string& name, const std::string& of) {
  return name.starts_with("." + of + ".tmp.");
}

// settings: const or not, as the result.
template <typename Some>
auto* find_setting(Some& settings, std::string_view name) {
  const auto found = std::ranges::find(settings, name, &Setting::name);
  return found == settings.end() ? nullptr : &*found;
}

// Returns whether a folder contains at most the files of a process that was killed while writing the first note.
bool is_empty(const std::string& folder) {
  std::error_code ignored;
  return std::all_of(fs::directory_iterator(folder, ignored), fs::directory_iterator(),
                     [](const auto& entry) { return is_half(entry.path().filename().native(), kNote); });
}

}  // namespace

std::string frame_pattern(const std::string& video) {
  return video + ".frames/" + kFrame;
}

VideoJournal::VideoJournal(const std::string& video, const Settings& settings, bool restart, JournalUse use,
                           std::chrono::seconds patience)
    : claim_(use == JournalUse::kAlone ? claim(video, patience) : nullptr),
      video_(video),
      folder_(video + ".frames"),
      given_(settings),
      settings_(settings) {
  const fs::file_type type = type_of(folder_);
  if (type != fs::file_type::directory && type != fs::file_type::not_found) {
    throw Error(ErrorKind::kUsage,
                fmt::format("the frames belong in '{}', but it is {}; remove it, or choose another name", folder_,
                            type == fs::file_type::symlink ? "a link" : "no folder"));
  }
  if (begin(restart)) write_note();
}

// Returns whether the note must be written. Shared frames have one that another process may be changing.
bool VideoJournal::begin(bool restart) {
  Settings then;
  bool is_known = read_note(then);
  for (int i = 0; i < 20 && !is_known && !claim_ && type_of(folder_) == fs::file_type::directory; i++) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // another process is about to write it
    is_known = read_note(then);
  }
  if (!is_known) {
    if (type_of(note_path()) != fs::file_type::not_found) {
      throw Error(ErrorKind::kUsage,
                  fmt::format("'{}' was not written by this version of ods; remove '{}', or choose another name",
                              note_path(), folder_));
    }
    if (type_of(folder_) == fs::file_type::directory && !is_empty(folder_) && !restart) {
      throw Error(ErrorKind::kUsage, fmt::format("the frames belong in '{}', but it is not empty", folder_));
    }
    return true;
  }
  take_found(then);
  const bool is_removed = restart || (!has_frames() && !settings_difference(then, settings_).empty());
  if (is_removed) {
    remove();
    frames_.clear();
  } else {
    expect_same_settings(folder_, then, settings_);
  }
  if (restart || (claim_ && !has_frames())) settings_ = given_;  // shared frames may be at work already
  return is_removed || claim_;
}

void VideoJournal::take_found(const Settings& then) {
  for (Setting& setting : settings_) {
    const Setting* const was = setting.value == kByFirstLook ? find_setting(then, setting.name) : nullptr;
    if (was) setting.value = was->value;
  }
}

void VideoJournal::read_again() {
  if (Settings then; !claim_ && read_note(then)) take_found(then);
}

std::optional<std::string> VideoJournal::found(std::string_view setting) const {
  for (size_t i = 0; i < given_.size(); i++) {
    const bool is_found = given_[i].value == kByFirstLook && settings_[i].value != kByFirstLook;
    if (is_found && given_[i].name == setting) return settings_[i].value;
  }
  return std::nullopt;
}

void VideoJournal::record(std::string_view setting, const std::string& value) {
  read_again();
  Setting* now = find_setting(settings_, setting);
  if (!now || now->value != kByFirstLook) return;
  now->value = value;
  write_note();
}

VideoJournal::~VideoJournal() {
  const bool is_over = claim_ ? !has_frames() : type_of(note_path()) == fs::file_type::not_found;
  if (is_over) remove();
}

std::string VideoJournal::note_path() const {
  return folder_ + "/" + kNote;
}

std::string VideoJournal::pattern() const {
  return folder_ + "/" + kFrame;
}

// Returns false if there is no note of ours. Throws Error(kInput) if it is damaged.
bool VideoJournal::read_note(Settings& settings) {
  if (type_of(note_path()) != fs::file_type::regular) return false;
  const std::vector<unsigned char> bytes = read_file(note_path(), size_t{64} << 20);
  const std::string note(bytes.begin(), bytes.end());
  const std::string mark = kMark + std::string("\n");
  if (!note.starts_with(mark) && !mark.starts_with(note)) return false;
  const std::optional<Settings> all = parse_settings(note.substr(std::min(note.size(), mark.size())));
  if (!all) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' is damaged: remove '{}', and the frames are rendered again", note_path(), folder_));
  }
  for (const Setting& setting : *all) {
    if (setting.name != kFrames) {
      settings.push_back(setting);
    } else if (!setting.value.empty()) {
      for (const int frame : parse_frames(setting.value)) frames_.insert(frame);
    }
  }
  return true;
}

void VideoJournal::write_note() const {
  const std::string frames = frames_text({frames_.begin(), frames_.end()});
  Settings all = {{kFrames, frames, ""}};
  all.insert(all.end(), settings_.begin(), settings_.end());
  write_file(note_path(), fmt::format("{}\n{}", kMark, settings_text(all)));
}

void VideoJournal::plan(const std::vector<int>& frames, const std::vector<int>& own) {
  const FrameNames names = *frame_names(pattern());
  const auto refuse = [&](int frame) {
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' is not a frame of this video; remove it, or choose another name", names.path(frame)));
  };
  std::set<int> added;
  std::ranges::copy_if(frames, std::inserter(added, added.end()), [&](int f) { return !frames_.contains(f); });
  const std::vector<int> there = added.empty() ? std::vector<int>() : frames_on_disk(names);
  for (const int frame : there) {
    if (added.contains(frame)) refuse(frame);
  }
  for (const int frame : own) {
    const fs::file_type type = type_of(names.path(frame));
    if (type != fs::file_type::not_found && type != fs::file_type::regular) refuse(frame);
  }
  if (added.empty()) return;
  read_again();
  frames_.merge(added);
  write_note();
}

// The frame of a file: the frame itself, or its raw or partly stitched form.
static std::string frame_of(const std::string& name) {
  for (const std::string_view end : {kRawEnd, std::string_view(".stitching")}) {
    if (name.ends_with(end)) return name.substr(0, name.size() - end.size());
  }
  return name;
}

std::set<std::string> VideoJournal::frame_files() const {
  std::set<std::string> files;
  const FrameNames names = *frame_names(kFrame);
  for (const int frame : frames_) files.insert(names.path(frame));
  return files;
}

bool VideoJournal::has_frames() const {
  if (type_of(folder_) != fs::file_type::directory) return false;
  const std::set<std::string> own = frame_files();
  std::error_code ignored;
  const auto is_own = [&](const auto& entry) { return own.contains(frame_of(entry.path().filename().native())); };
  return std::any_of(fs::directory_iterator(folder_, ignored), fs::directory_iterator(), is_own);
}

void VideoJournal::remove() const {
  if (claim_ && claim_->is_lost()) return;  // it now belongs to another process
  const int folder = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  const std::set<std::string> own = frame_files();
  std::vector<std::string> gone;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().native();
    const std::string of = name.starts_with(".") ? name.substr(1, name.find(".tmp.") - 1) : "";
    const bool is_half_frame = own.contains(frame_of(of)) && is_half(name, of);
    if (own.contains(frame_of(name)) || is_half_frame || is_half(name, kNote)) gone.push_back(name);
  }
  gone.push_back(kNote);  // last: until then the note identifies the rest as ours
  for (const std::string& name : gone) unlinkat(folder, name.c_str(), 0);
  close(folder);
  rmdir(folder_.c_str());
}

}  // namespace ods
