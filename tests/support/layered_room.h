// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A layered scene whose every pixel has a closed form: a room without a ceiling under a sky, a pillar in front of a wall,
// a lattice with holes, a pane of coloured glass, and the back of a curtain that is not to be seen.
#pragma once
#include <string>
#include <vector>

#include "ods/kernel/math.h"
#include "tests/support/gltf_builder.h"

namespace ods::layered_room {

inline constexpr vec3 kCenter(0.3f, 1.4f, 0.2f);  // of the box
inline constexpr vec3 kBox(0.3f, 0.24f, 0.36f);
inline constexpr float kYaw = 25.0f;    // degrees
inline constexpr float kEye = 0.0315f;  // metres from the middle of the head

// How the numbers are stored.
enum class Storage { kFloats, kCompressed, kQuantized };  // kQuantized: compressed, too

// The file. fallback: the name in it.
Binary room_glb(Storage storage, const std::string& fallback = "");

struct Seen {
  int surface = -1;  // and the square of its pattern: what is not mixed with others
  vec3 color{0.0f};  // code values, 0..1
};

// The surface that a ray in the file's world meets.
Seen look(vec3 from, vec3 direction);

// A position or a direction turned to the right by degrees.
vec3 turned(vec3 v, float degrees);

}  // namespace ods::layered_room
