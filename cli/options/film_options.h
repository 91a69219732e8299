// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that say how a film is packed. Shared by the commands that make one.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/video/make_film.h"

struct FilmWishes {
  std::string output;
  ods::FilmTarget target = ods::FilmTarget::kVrPlayers;
  std::optional<ods::FilmCodec> codec;
  std::optional<int> bits, crf;
  std::optional<ods::Chroma> chroma;
  std::optional<float> bitrate;
  std::string encoder, preset, sound;
  bool copies_sound = false;
  bool for_apple = false;
  ods::SoundCut sound_cut;
  ods::FrameRate rate;
};

// 30, 12.5, 30000/1001; 29.97 and its like mean 30000/1001 and its like, as everybody means. Throws UsageError.
ods::FrameRate parse_rate(const std::string& text);

// -o and what follows, in groups of their own; not the rate.
void add_film_options(Options& options, FilmWishes& wishes);
// The same without -o, in a group that is open already.
void add_packing_options(Options& options, FilmWishes& wishes);

// Of a film's name. Throws UsageError.
ods::Container container_for(const std::string& path);

// How a film of that size is encoded. Throws UsageError where the wishes do not fit together, ods::Error where this
// machine cannot. Nothing is written, but that the file could be is found out.
ods::EncodeOptions encode_options(const FilmWishes& wishes, ods::Extent size, int threads);

// What a film of eyes of this size will be like; warns of what players do not expect. Throws UsageError for a layout
// that films do not have.
ods::FilmPlan expect_film(ods::Layout layout, size_t eyes, ods::Extent eye, const ods::ProjectionSetting& projection);

// What people should know before a film is made: levels, names; then, of so many frames, its sound.
void say_what_players_need(const FilmWishes& wishes, const ods::FilmPlan& plan, const ods::EncodeOptions& options);
void say_length_of_sound(const ods::EncodeOptions& options, size_t frames);

// "h264 by libx264, 8 bits, 420, level 5.2, 4096x4096, 100 frames at 30 a second".
std::string film_text(const ods::FilmPlan& plan, const ods::EncodeOptions& options, size_t frames);
