// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of an unfinished video: a folder beside it, VIDEO.frames, with a note (job.txt) that lists the settings
// that they were made with and their numbers. After an interruption the next job resumes from them; frames made with
// other settings are never mixed in. A setting that a first look at the frames finds (kByFirstLook) is found once, and
// applies to all frames that are added later. The job holds the claim on the video (ods/files/claim.h) from start to
// end. Several processes may also share the frames: each claims a frame before it makes it, and none makes the video.
//
// The folder must be a real one, not a link. Only files listed in the note are ever used or removed.
#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/settings.h"
#include "ods/files/claim.h"

namespace ods {

// The names of a video's frames (ods/files/frames.h).
std::string frame_pattern(const std::string& video);

enum class JournalUse { kAlone, kShared };

class VideoJournal {
 public:
  // Opens the frames of this video, or an empty journal. `restart` removes existing frames. Throws Error(kUsage) if the
  // folder holds frames made with other settings or is not ours; Error(kInput) if the note is damaged; Error(kOutput),
  // also if another process is working on the video, and does not end within `patience`.
  VideoJournal(const std::string& video, const Settings& settings, bool restart, JournalUse use = JournalUse::kAlone,
               std::chrono::seconds patience = std::chrono::seconds(0));

  VideoJournal(const VideoJournal&) = delete;
  VideoJournal& operator=(const VideoJournal&) = delete;
  // Removes the folder if it has no frames. If the frames are shared, removes it only if another process has finished
  // the video meanwhile, and then together with frames that were made too late.
  ~VideoJournal();

  const std::string& video() const { return video_; }
  const std::string& folder() const { return folder_; }
  std::string pattern() const;  // frame_pattern()

  // Records the frames that the job will make, before it makes the first. own: the frames of this process. Throws
  // Error(kUsage) if a file for one of them exists that was not made by such a job; Error(kOutput). Of frames that are
  // already recorded, only the own ones are checked.
  void plan(const std::vector<int>& frames, const std::vector<int>& own);

  // Returns the recorded value of a setting that was given as kByFirstLook; nullopt if none is recorded. record()
  // stores it for later frames, unless another process that shares them has stored one: then that one remains.
  std::optional<std::string> found(std::string_view setting) const;
  void record(std::string_view setting, const std::string& value);

  // Throws Error(kOutput) if another machine has taken the video over. Call it regularly.
  void check() const {
    if (claim_) claim_->check();
  }

  // Removes its own files, and the folder if nothing else is in it.
  void remove() const;

 private:
  std::set<std::string> frame_files() const;  // file names in the folder
  bool has_frames() const;
  bool read_note(Settings& settings);
  void take_found(const Settings& then);
  void read_again();  // what other processes that share the frames have recorded since
  void write_note() const;
  std::string note_path() const;
  bool begin(bool restart);

  std::unique_ptr<Claim> claim_;  // released last; null if the frames are shared
  std::string video_, folder_;
  Settings given_, settings_;  // as given by the caller, and with the values found
  std::set<int> frames_;       // frames that this job and earlier jobs made or planned
};

}  // namespace ods
