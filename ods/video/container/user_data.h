// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What people and cameras wrote into an mp4 or mov beside its tracks: titles, places, makers' notes, XMP. It goes from
// one file into another box by box, whatever it is. Sources: ISO/IEC 14496-12, 8.10.1 (udta), 8.11.1 (meta); Apple,
// "QuickTime File Format", user data atoms and metadata atoms.
#pragma once
#include <string>
#include <vector>

#include "ods/image/format/boxes.h"

namespace ods {

struct UserData {
  std::vector<Box> movie;     // children of moov: udta, opened; meta; uuid
  std::vector<Box> pictures;  // of the picture track: udta, opened; meta
  std::vector<Box> file;      // meta and uuid beside moov
  bool empty() const { return movie.empty() && pictures.empty() && file.empty(); }
};

// Empty for other files. What has offsets in it (meta with iloc), and boxes of more than 16 MiB, are left out. A Nero
// list of chapters (chpl) is no user data. Throws Error(kInput).
UserData read_user_data(const std::string& path, uint64_t track);
// Whether the file is an mp4 or mov.
bool has_user_data(const std::string& path);

// Puts them into a box, moov or trak, in place of what libavformat wrote there. Of udta, the children are joined.
void add_user_data(const std::vector<Box>& boxes, Box& to);

}  // namespace ods
