// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sample entry of a sound track in mp4 and mov. Sources: ISO/IEC 14496-12, 12.2; 14496-1, 7.2.6 (esds); 14496-3,
// 1.6.2 (AAC configuration); Apple, "QuickTime File Format", sound sample descriptions.
#pragma once
#include "ods/image/format/boxes.h"

namespace ods {

// Opens the boxes of the entry, after QuickTime's description of one of three lengths. Throws MalformedFile.
void open_sound_entry(Box& entry);

// The number of channels of an opened entry; 0 if unknown. For AAC in mp4 from the esds, because the entry's own number
// is always 2.
int count_channels(const Box& entry);

}  // namespace ods
