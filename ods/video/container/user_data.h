// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The user data of an mp4 or mov besides its tracks: titles, places, makers' notes, XMP. It is copied from one file to
// another box by box, without interpretation. Sources: ISO/IEC 14496-12, 8.10.1 (udta), 8.11.1 (meta); Apple,
// "QuickTime File Format", user data atoms and metadata atoms.
#pragma once
#include <string>
#include <vector>

#include "ods/image/format/boxes.h"

namespace ods {

struct UserData {
  std::vector<Box> movie;     // children of moov: udta, opened; meta; uuid
  std::vector<Box> pictures;  // boxes of the picture track: udta, opened; meta
  std::vector<Box> file;      // meta and uuid beside moov
  bool empty() const { return movie.empty() && pictures.empty() && file.empty(); }
};

// Reads user data. Empty for other files. Boxes with offsets (meta with iloc), and boxes of more than 16 MiB, are left
// out. A Nero list of chapters (chpl) does not count as user data. Throws Error(kInput).
UserData read_user_data(const std::string& path, uint64_t track);
// Returns whether the file is an mp4 or mov.
bool has_user_data(const std::string& path);

// Puts the boxes into a box, moov or trak, replacing those that libavformat wrote there. The children of udta are
// merged.
void add_user_data(const std::vector<Box>& boxes, Box& to);

}  // namespace ods
