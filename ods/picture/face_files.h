// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the six faces of a cube, a file each, as one picture: our cube-3x2.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "ods/camera/file_names.h"
#include "ods/image/image_file.h"

namespace ods {

// The words for the faces in the names of their files: to the right, to the left, up, down, ahead and back of a viewer
// in the middle. Sides are upright; the lower edge of the upper face and the upper edge of the lower face adjoin the
// face ahead. That is the cube map of OpenGL and Direct3D with +Z ahead, and the faces of FFmpeg's v360=e:c6x1.
struct FaceWords {
  std::array<std::string_view, kFaceCount> words;
  std::string_view doubt;  // for messages: why faces with these names are not read; empty if they are
};
inline constexpr FaceWords kFaceWordsTable[] = {
    {{"px", "nx", "py", "ny", "pz", "nz"}, ""},
    {{"posx", "negx", "posy", "negy", "posz", "negz"}, ""},
    {{"right", "left", "up", "down", "front", "back"}, ""},
    {{"right", "left", "top", "bottom", "front", "back"}, ""},
    {{"r", "l", "u", "d", "f", "b"}, ""},
    {{"rt", "lf", "up", "dn", "ft", "bk"}, "engines with these names turn the upper and the lower face"},
    {{"0", "1", "2", "3", "4", "5"}, "programs number the faces in different orders"},
    {{"1", "2", "3", "4", "5", "6"}, "programs number the faces in different orders"},
};

// Opens the files of a name with names_faces(). Throws Error(kInput), also if they are not squares of one size and
// kind.
std::unique_ptr<RowReader> open_faces(const std::string& path);

}  // namespace ods
