// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Names of pictures that are several files: one for each eye, or one for each face of a cube. Such a name has the
// differing words in braces: trip_{L|R}.jpg, sky/{px|nx|py|ny|pz|nz}.png, {left|right}/{px|nx|py|ny|pz|nz}.png. For
// eyes, %V and %v are short forms (layout.h: names_eye(), path_for_eye()).
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ods {

inline constexpr size_t kFaceCount = 6;

// The words for the eyes in names of files, folders and tracks, in any letter case, between separators or at an end; l
// and r also after a number.
struct EyeWords {
  std::string_view left, right;
};
inline constexpr EyeWords kEyeWordsTable[] = {
    {"left", "right"}, {"lefteye", "righteye"}, {"links", "rechts"}, {"l", "r"}};

// The eye that a name tells, kLeft or kRight; nullopt if it has words for none or for both.
std::optional<int> eye_of_words(std::string_view name);

// The first braces in a name that have this many words.
struct WordsInBraces {
  size_t begin = 0, end = 0;  // the position of the braces, and of what follows them
  std::vector<std::string> words;
};
std::optional<WordsInBraces> words_in_braces(const std::string& path, size_t count);

// Returns whether the name stands for six faces.
bool names_faces(const std::string& path);

// Returns whether the name stands for more than one file.
bool names_files(const std::string& path);

// The files that a name stands for: 1, 2 (left, right), 6, or 12 (those of the left eye first).
std::vector<std::string> files_of(const std::string& path);

// The name that stands for these files, in this order: the whole words in which they differ are in braces. Returns
// nullopt if a file's own name has braces or bars.
std::optional<std::string> joined_name(const std::vector<std::string>& files);

// The same path without what stands for eyes or faces: trip_{L|R}_360.jpg becomes trip_360.jpg.
std::string without_words(const std::string& path);

}  // namespace ods
