// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the files that belong to an input: the other eye's beside one eye's (_L and _R, left/ and right/), the other
// faces of a cube beside one (kFaceWordsTable).
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace ods {

struct FoundInput {
  std::string path;                // one file, or a name that stands for several (ods/camera/file_names.h)
  std::vector<std::string> notes;  // for users: what was found beside it
};

// paths: one file, folder or name with placeholders; two of them, for the left eye and the right one, unless their
// names tell the opposite; the files of six faces, or of twelve, in any order. A folder stands for the six faces in it,
// or for the folders left and right in it.
//
// The other eye beside one file belongs to it if the pixels of both match; otherwise a note names it. alone: one file
// is only itself, because the caller knows its format. Throws Error(kUsage) for files that do not belong together, and
// Error(kInput) if it is unknown how they do.
FoundInput find_input(const std::vector<std::string>& paths, bool alone = false);

// The name of the other eye's file or frames, if there is one; first: the left one of both.
struct EyePair {
  std::string left, right;
};
std::optional<EyePair> find_eye_beside(const std::string& path);

}  // namespace ods
