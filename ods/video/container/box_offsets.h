// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// File offsets in an mp4 file, and how they change when the header before the data changes size. Source: ISO/IEC
// 14496-12, 8.7.5 (stco, co64), 8.7.9 (saio), 8.8.7 (tfhd), 8.8.10 (tfra), 8.11.3 (iloc), 8.16.3 (sidx).
#pragma once
#include <cstdint>

#include "ods/image/format/boxes.h"

namespace ods {

// Bytes [begin, end) of the old file are replaced, and everything after them moves by `growth` bytes.
struct Move {
  uint64_t begin = 0;
  uint64_t end = 0;
  int64_t growth = 0;
  uint64_t file_size = 0;  // size of the old file

  // The new offset of a byte of the old file. Throws MalformedFile if that byte is replaced or beyond the
  // end of the file.
  uint64_t operator()(uint64_t offset) const;
};

// The offsets of a track: stco, co64 and saio in an opened stbl. widen_offsets() converts a stco that is too narrow for
// the new offsets to a co64 with the old ones and returns true: the header has grown, so recompute `move` and call it
// again. Throws MalformedFile.
bool widen_offsets(Box& sample_table, const Move& move);
void move_offsets(Box& sample_table, const Move& move);

// A top-level box other than moov that may contain offsets: moof, sidx, mfra, meta. `place` is its position in the old
// file. Throws MalformedFile.
bool may_have_offsets(BoxType type);
void move_offsets(Box& box, const FileBox& place, const Move& move);

// Updates the offsets of iloc in this meta box.
void move_item_offsets(Box& meta, const Move& move);

}  // namespace ods
