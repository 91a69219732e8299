// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A film to be read picture by picture: what it says of itself as pictures say it.
#pragma once
#include <optional>
#include <string>

#include "ods/picture/stored_picture.h"
#include "ods/video/container/film.h"
#include "ods/video/decode.h"

namespace ods {

struct FilmInput {
  std::string path;
  uint64_t track = 0;
  FilmForm form;  // complete
  bool has_sound = false;
  std::optional<Ambisonics> ambisonics;  // what its sound says
  StoredPicture like;                    // every picture but for its pixels: eyes without layers
};

// What the film does not say is found as inject finds it; `known` goes before all. Its eyes' distance is what
// it says itself (vexu), else what its sidecar says, which tells the rest of its camera, too. Throws Error(kInput): a
// film that is damaged, that is flat or of another projection than lat-long and parts of it, or whose form nothing
// tells.
FilmInput open_film(const std::string& path, const KnownForm& known = {});

// Where an eye of a film's picture begins. Precondition: a layout that open_film() finds.
struct EyeCorner {
  int x = 0;
  int y = 0;
};
EyeCorner eye_corner(Layout layout, Extent eye, int index);

// Its colours as code values of 16 bits, whatever the film's are.
StoredPicture picture_of(const FilmInput& film, const FilmStream& stream, const DecodedFrame& frame);

}  // namespace ods
