// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens the files of a picture's eyes: one file, a file for each eye, six for the faces of each, or two pictures in one
// file.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "ods/image/image_file.h"

namespace ods {

using Readers = std::vector<std::unique_ptr<RowReader>>;

// Opens a file, or all files of a name that stands for several (ods/camera/file_names.h). Throws Error(kInput), also if the two do not fit together.
Readers open_files(const std::string& path);

// Adds the reader of the second picture in the file: the right eye of a VR photo or of a stereo pair. Appends what is
// doubtful to `warnings`. Throws Error(kInput) if it is damaged or does not fit the first one.
void open_second_eye(Readers& readers, const std::string& path, std::vector<std::string>& warnings);

}  // namespace ods
