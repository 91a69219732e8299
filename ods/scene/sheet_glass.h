// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Glass without a volume. glTF's transmission alone describes a thin sheet, which does not refract; only a volume
// (KHR_materials_volume) makes a mesh solid. Many exporters, including Blender's, write the first and mean the second.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// A transmissive material without a volume, and the meshes with it.
struct SheetGlass {
  int material = 0;
  std::string name;  // "material 3" if it has none
  size_t closed_meshes = 0;
  size_t open_meshes = 0;
};

// The sheet glass of visible instances.
std::vector<SheetGlass> find_sheet_glass(const Scene& scene);

// Returns whether a material is smooth glass. A texture of its roughness is not taken into account.
bool is_smooth_glass(const Material& material);

// The names of smooth transmissive materials with a volume that visible instances show.
std::vector<std::string> smooth_solids(const Scene& scene);

// For each vertex of a mesh, the index of one vertex at the same position, common to all of them.
std::vector<uint> merge_positions(const Scene& scene, const Mesh& mesh);

// Returns whether a mesh encloses a volume at the current time: at every edge, as many of its triangles run in one
// direction as in the other, and their normals point outwards on the whole. Vertices at the same position count as one.
bool is_closed(const Scene& scene, const Mesh& mesh);

// Gives closed meshes of sheet glass a volume, so that they refract; open ones stay sheets. Returns how many changed.
// Animations of their materials are kept.
size_t make_glass_solid(Scene& scene);

// Returns whether a mesh is a sheet, or several: most of its area belongs to connected pieces that enclose nothing.
// Their faces look to one side more than to the others, as those of a bottle with a hole do not, or they have no
// volume, as two sides of a sheet in one place.
bool is_sheet(const Scene& scene, const Mesh& mesh);

// Makes sheets of a material with a volume, which they cannot enclose, thin glass. It has the tint of glass as thick as
// the file says (thicknessFactor of KHR_materials_volume). Returns how many meshes changed.
size_t make_sheets_thin(Scene& scene);

}  // namespace ods
