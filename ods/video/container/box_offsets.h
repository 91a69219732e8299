// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The places in an mp4 file that say where in the file other things lie, and what becomes of them when the header in
// front of those things grows. Source: ISO/IEC 14496-12, 8.7.5 (stco, co64), 8.7.9 (saio), 8.8.7 (tfhd), 8.8.10 (tfra),
// 8.11.3 (iloc), 8.16.3 (sidx).
#pragma once
#include <cstdint>

#include "ods/video/container/boxes.h"

namespace ods {

// Bytes begin .. end of the old file are replaced by `growth` more of them, or fewer.
struct Move {
  uint64_t begin = 0;
  uint64_t end = 0;
  int64_t growth = 0;
  uint64_t file_size = 0;  // of the old file

  // Where a byte of the old file lies in the new one. Throws MalformedFile where it is one of those replaced or beyond
  // the file's end.
  uint64_t operator()(uint64_t offset) const;
};

// A track's offsets: stco, co64 and saio in an opened stbl. A stco that cannot hold them becomes a co64 with the old
// offsets and the result is true: the header has become longer than `move` knows, so come again. Throws MalformedFile.
bool widen_offsets(Box& sample_table, const Move& move);
void move_offsets(Box& sample_table, const Move& move);

// A box of the file itself other than moov: moof, sidx, mfra and meta have offsets in them, or may. `place` is where it
// lies in the old file. Throws MalformedFile.
bool may_have_offsets(BoxType type);
void move_offsets(Box& box, const FileBox& place, const Move& move);

// iloc, in the meta box that this is.
void move_item_offsets(Box& meta, const Move& move);

}  // namespace ods
