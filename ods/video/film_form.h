// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Which form a film has that says nothing of it: what the caller knows, else what its sidecar, its name or its shape
// tells, as picture_form.h has it for pictures.
#pragma once
#include <string>
#include <vector>

#include "ods/image/picture_form.h"
#include "ods/video/film.h"

namespace ods {

// A layout as films have it; squeezed eyes are laid out as whole ones. Throws Error(kUsage) for those that films have
// no word for.
FilmStereo film_stereo(Layout layout);
// A lat-long that does not cross the seam, or a flat window; throws Error(kUsage) for all others. (The cubemap of films
// has another order of faces than any that projection.h knows.)
void set_projection(FilmForm& form, const ProjectionSetting& projection);

// Fills in what `known` leaves open. `guesses` gets what was not said: "top-bottom: its name ends in _TB". Throws
// Error(kInput) where neither its name nor its shape tells.
FilmForm complete_form(FilmForm known, const VideoTrack& track, const std::string& path,
                       std::vector<std::string>& guesses);

}  // namespace ods
