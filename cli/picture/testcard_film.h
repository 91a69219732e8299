// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods testcard as a film.
#pragma once
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/options/film_options.h"
#include "ods/testcard/testcard.h"

struct TestcardFilmWishes {
  bool is_film = false;
  FilmWishes film;
  float duration = 10.0f;  // seconds
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

// In groups of their own; --progress and its like in one that is open already.
void add_testcard_film_options(Options& options, TestcardFilmWishes& wishes);

// Where the card goes that is drawn for eyes of this layout. Throws UsageError and ods::Error.
void make_film_of_card(const ods::CameraRig& rig, ods::Extent eye, const std::vector<int>& eyes, ods::Layout layout,
                       const std::vector<std::string>& lines, const TestcardFilmWishes& wishes,
                       ProgressLines& progress_lines);
