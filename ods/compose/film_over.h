// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Titles and computer graphics over a film: the film is decoded, changed where something stands before it, and encoded
// again. Where nothing does, its numbers reach the encoder as they are, if it is of BT.709 of limited range and the new
// film of as many bits and as much colour; else they become that. Light is mixed as over.h does it, and a colour that
// several pixels share is the mean of theirs, those that are not covered counting with what they had.
#pragma once
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/compose/over.h"
#include "ods/video/footage.h"

namespace ods {

// What of a picture is covered, in the form of the film's eyes.
struct CoverRow {
  int first = 0;            // column of the first pixel
  std::vector<float> rgba;  // light multiplied by alpha
};
struct Cover {
  std::vector<std::vector<CoverRow>> eyes;  // of each its rows; empty ones where there is nothing
};

// Precondition: no over_fault().
Cover make_cover(const StoredPicture& foreground, const StoredPicture& film, const OverOptions& options);

// All numbers of a picture as they are. Precondition: of the same bits and chroma.
void copy_planes(const Planes& from, Extent size, const Planes& to);

// A film's picture as a frame of the new one, of the same size.
std::shared_ptr<FilmFrame> copied_frame(const DecodedFrame& frame, const FilmStream& stream, const FilmInput& film,
                                        const Packing& packing);

// Changes what the cover covers in `to`, which shows the same as `from`; both are whole pictures of the film's layout.
void lay_cover(const Cover& cover, const StoredPicture& film, const ColorCode& color, const Planes& from,
               const Planes& to);

// How a film is encoded that is to be as this one is; nothing where that cannot be.
std::optional<Packing> packing_like(const FilmStream& stream, Container container);

// Lays `front` over frames first..last of `back`, a film, which become a film of the same form; where there is no such
// frame in front, it stays as it is. Its sound is what `options` say. Throws Error as FilmEncoder and FilmDecoder do;
// kUsage for a foreground that cannot be laid over. Returns how many frames there were.
int over_film(Footage& back, Footage& front, int first, int last, const OverOptions& over, const EncodeOptions& options,
              const std::string& path, const Progress& progress = {});

}  // namespace ods
