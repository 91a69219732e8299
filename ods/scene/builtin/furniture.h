// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Furniture for built-in scenes. Each piece has its origin on the floor and its front towards +Z; `place` puts it into
// the room.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// Unit-size books standing on y = 0, spines towards +Z, in several bindings; the pages are a separate mesh.
struct BookMeshes {
  std::vector<int> covers;
  int pages;
};

BookMeshes add_book_meshes(Scene& scene, int pages_material);

// Materials shared by several pieces, as indices into the scene's materials.
struct Finishes {
  int oak, walnut, black_wood, white_paint;
  int sofa, leather, linen, mustard, terracotta, cream, sage;
  int brass, iron, ceramic, dark_ceramic, glass;
  int pages, leaf, soil, stem;
  int shade, lantern;  // emissive: both sides of an open shade, the outside of a closed one
  BookMeshes books;
};

Finishes add_finishes(Scene& scene);

void add_sofa(Scene& scene, const Finishes& finishes, const glm::mat4& place);  // 2.2 x 0.95, 0.8 high
void add_armchair(Scene& scene, const Finishes& finishes, int cover, int cushion, const glm::mat4& place);  // 0.9 high
void add_coffee_table(Scene& scene, const Finishes& finishes, const glm::mat4& place);         // 1.2 x 0.6, 0.4 high
void add_side_table(Scene& scene, const Finishes& finishes, const glm::mat4& place);           // 0.45 round, 0.55 high
void add_dining_table(Scene& scene, const Finishes& finishes, const glm::mat4& place);         // 1.1 round, 0.74 high
void add_chair(Scene& scene, const Finishes& finishes, const glm::mat4& place);                // 0.45 x 0.45, 0.85 high
void add_sideboard(Scene& scene, const Finishes& finishes, const glm::mat4& place);            // 1.8 x 0.45, 0.75 high
void add_bookcase(Scene& scene, const Finishes& finishes, const glm::mat4& place, uint seed);  // 0.95 x 0.32, 2.2 high

}  // namespace ods
