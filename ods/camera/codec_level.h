// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The limits that video decoders must support. A file outside every level plays only on devices that happen to support
// more. Only the size of a picture and the pixels per second are considered, not the bit rate.
// Sources: ITU-T H.264 table A-1, ITU-T H.265 tables A.8 and A.9, AV1 Bitstream & Decoding Process annex A.3, WebM
// Project, "VP9 Levels and Decoder Testing".
#pragma once
#include <string_view>

#include "ods/base/names.h"
#include "ods/camera/layout.h"

namespace ods {

enum class Codec { kH264, kHevc, kAv1, kVp9 };

inline constexpr NameRow<Codec> kCodecTable[] = {
    {Codec::kH264, "H.264"}, {Codec::kHevc, "HEVC"}, {Codec::kAv1, "AV1"}, {Codec::kVp9, "VP9"}};
static_assert(has_every_member(kCodecTable));
inline constexpr auto kCodecs = members_of(kCodecTable);
constexpr std::string_view codec_name(Codec codec) {
  return name_in(kCodecTable, codec);
}

// The smallest level that allows such a video, as its standard writes it ("5.1"). Empty if no level does. Precondition:
// sides above 0, fps >= 0.
std::string_view smallest_level(Codec codec, Extent size, double fps);

}  // namespace ods
