// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The pictures that lint_bench judges: pairs of scenes, faults planted into them, and the variations of correct
// pictures.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/lint_plant.h"
#include "ods/convert/convert.h"
#include "ods/lint/lint.h"

// Both eyes of a scene, as made by a correct renderer.
struct Pair {
  std::string name;
  ods::StoredPicture picture;
};

// Pairs 2048 pixels wide. Renders those that the folder does not contain from an earlier call.
std::vector<Pair> scene_pairs(const std::string& folder);

// A picture to be saved to a file: `target` converts the pair, then `edits` change the eyes' linear light.
struct Made {
  const Pair* pair = nullptr;
  ods::ConvertTarget target;
  std::vector<std::function<void(std::vector<ods::Image>& eyes)>> edits;
  ods::SaveOptions save;
  std::string suffix;  // suffix of the file's name: "_TB"
  std::string extension = ".jpg";
  ods::LintOptions lint;
  uint32_t seed = 0;
};
Made make_pair(const Pair& pair, int width, int quality);

// Saves it and returns its path.
std::string save(const Made& made, const std::string& stem);

using PicturePlant = Plant<Made>;
const std::vector<PicturePlant>& planted_faults();
const std::vector<PicturePlant>& correct_kinds();

// Converts it to the front half, side by side.
void become_vr180(Made& made);
// Eyes that diverge: the right one is turned so that a quarter of the places has this parallax outwards.
void add_divergence(std::vector<PicturePlant>& plants);
