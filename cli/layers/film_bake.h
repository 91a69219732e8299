// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods layers --frames: the light of what moves, and of the still layers while it moves.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "cli/layers/film_job.h"
#include "ods/layers/light/light_layers.h"

// The part of the light's time that the film takes after that of the still layers, 0..1. still_texels: of those.
double share_of_film(const FilmJob& film, size_t still_texels);

// Finds the light of the still layers without what moves, in a film. renderer: of the scene as it is then.
void light_without(FilmJob& film, const ods::Renderer& renderer, const ods::LayerLight& light,
                   const ods::Progress& progress);

// The light of what moves, and the change of the still layers' light. options: of the frames' renderer.
ods::LayerFilm light_of_film(FilmJob film, ods::Scene& scene, const ods::HeadBox& box, ods::SequenceOptions options,
                             const ods::LayerLight& light, const ods::Progress& progress);

// Removes the light that is kept in case of an interruption.
void remove_unfinished(const std::string& path, const std::vector<size_t>& lights);
