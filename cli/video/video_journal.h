// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of a video in the making: a folder beside it, VIDEO.frames, with a note (job.txt) of the settings that
// made them and of their numbers. A job that was killed goes on from there; frames of other settings are never mixed
// in. The job holds the claim on the video (ods/files/claim.h) from its start to its end.
//
// The folder is a real one, no link. Only files that the note lists are ever used or removed.
#pragma once
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "cli/video/frame_settings.h"
#include "ods/files/claim.h"

class VideoJournal {
 public:
  // Opens the frames of the video of that name, or begins anew. `restart` removes those that are there. Throws
  // UsageError where the folder holds frames of other settings, or is not ours; ods::Error(kOutput), also where another
  // process is at work on the video.
  VideoJournal(const std::string& video, const std::vector<Setting>& settings, bool restart);

  VideoJournal(const VideoJournal&) = delete;
  VideoJournal& operator=(const VideoJournal&) = delete;
  // A folder in which there is no frame goes.
  ~VideoJournal();

  const std::string& folder() const { return folder_; }
  std::string pattern() const;  // of the frames' names (ods/files/frames.h)

  // Notes which frames the job makes, before it makes the first. Throws UsageError where one of them is there that no
  // job of ours made, ods::Error(kOutput).
  void plan(const std::vector<int>& frames);

  // Throws ods::Error(kOutput) where another machine took the video over. To be called now and then.
  void check() const { claim_->check(); }

  // Removes what is its own, and the folder if nothing else is in it.
  void remove() const;

 private:
  std::set<std::string> frame_files() const;  // their names in the folder
  bool has_frames() const;
  bool read_note(std::vector<Setting>& settings);
  void write_note() const;
  std::string note_path() const;
  void begin(bool restart);

  std::unique_ptr<ods::Claim> claim_;  // given back last
  std::string folder_;
  std::vector<Setting> settings_;
  std::set<int> frames_;  // that this job and those before it made, or were to make
};
