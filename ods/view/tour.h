// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A tour: panoramas whose hotspots lead from one to another, and a plan of the floor. docs/view.md describes tour.json.
// The page finds the directions of the hotspots from the places (web/tour-ways.js).
//
// Places are metres in a world as glTF's: x to the right, y up, z back. A heading is in degrees, to the right of -Z,
// which the page calls north.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/base/json_reader.h"
#include "ods/kernel/math.h"
#include "ods/view/beside.h"

namespace ods {

struct TourLink {
  size_t to = 0;                              // the number of a panorama
  std::optional<float> yaw, pitch, distance;  // as the page shows them, and metres; else from the places, on the floor
};

struct TourStop {
  std::string file;  // its path
  std::string name;  // for links
  std::string title, text;
  std::optional<vec3> place;
  std::optional<vec2> on_plan;                 // instead of a place: pixels of the plan, from its upper left corner
  std::optional<float> heading;                // of the picture's middle
  float floor = 0.0f;                          // y of the floor
  std::optional<std::vector<TourLink>> links;  // else to the neighbours
  std::vector<Hotspot> hotspots;
};

struct TourPlan {
  std::string image;  // its path
  float metres_per_pixel = 0.0f;
  vec2 origin{0.0f};     // the pixel of x = z = 0
  float heading = 0.0f;  // of its upper edge
};

struct Tour {
  std::vector<TourStop> panoramas;
  std::optional<TourPlan> plan;
  float height = 1.6f;  // metres of a camera above the floor, where no place has its y
};

// Returns whether ods view reads a file as a tour: JSON that does not lie beside a picture.
bool names_tour(const std::string& path);

// Reads tour.json. A place or a heading that it does not have comes from the picture's camera: its sidecar, or the
// header of an .exr. Throws Error(kInput) if it is not such JSON, a file is absent, a place is missing that a link
// needs, two panoramas have the same name, a link leads nowhere, or browsers do not show the plan's image.
Tour read_tour(const std::string& path);

// Returns what the page needs of a tour, for view.json. Its plan is plan_file().
Json tour_json(const Tour& tour);
std::string plan_file(const TourPlan& plan);

}  // namespace ods
