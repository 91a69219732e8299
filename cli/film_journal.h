// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of a film in the making: a folder beside it, with a note of the options that they were rendered with. What
// was killed goes on from there; frames of another job are never mixed in.
#pragma once
#include <string>
#include <vector>

class FilmJournal {
 public:
  // Of the film of that name; `words` are the arguments of the command, of which those count that change a frame, and
  // the files that they name. Opens what is there or begins it anew. Throws UsageError where the folder holds frames of
  // another job, ods::Error(kOutput).
  FilmJournal(const std::string& film, const std::vector<std::string>& words, bool restart);

  FilmJournal(const FilmJournal&) = delete;
  FilmJournal& operator=(const FilmJournal&) = delete;
  // A folder in which there is no frame goes.
  ~FilmJournal();

  const std::string& folder() const { return folder_; }
  std::string pattern() const;  // of the frames' names (ods/base/frames.h)

  // Removes what is its own, and the folder if nothing else is in it.
  void remove() const;

 private:
  bool has_frames() const;

  std::string folder_;
};
