// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sample entry of a track of sound in mp4 and mov. Sources: ISO/IEC 14496-12, 12.2; 14496-1, 7.2.6 (esds); 14496-3,
// 1.6.2 (what AAC says of itself); Apple, "QuickTime File Format", sound sample descriptions.
#pragma once
#include "ods/video/container/boxes.h"

namespace ods {

// Its boxes stand behind a description of three lengths, in QuickTime's reading. Throws MalformedFile.
void open_sound_entry(Box& entry);

// Of an opened entry: of AAC in mp4 what its esds says, as the entry's own number is always 2 there. 0: it cannot be
// told.
int count_channels(const Box& entry);

}  // namespace ods
