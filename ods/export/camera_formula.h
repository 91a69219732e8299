// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera as formulas: the origin and direction of the ray for an image position, over the whole picture with its
// layout.
// One description serves every renderer that accepts formulas; ods/export/formula.h prints them. It computes the same
// ray as camera_ray() of ods/kernel/camera/camera.h, without lens blur.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/export/formula.h"
#include "ods/picture/metadata/sidecar.h"

namespace ods {

// The renderer's conventions. x and y of the formulas are its own image coordinates.
struct FormulaView {
  Formula u;                 // position in the whole picture, 0..1 from left to right, in terms of x and y
  Formula v;                 // position in the whole picture, 0..1 from top to bottom
  bool left_handed = false;  // the renderer's world z points ahead; ours points back
  // The renderer places its camera by other means: location and direction are in the camera's frame.
  bool camera_frame = false;
};

struct NamedFormula {
  std::string name;
  Formula value;
  std::string meaning;  // meaning of a parameter
};

struct CameraFormula {
  std::vector<NamedFormula> parameters;  // numbers: ipd, location_x, merge_start, ...
  std::vector<NamedFormula> steps;       // each in terms of x, y, parameters and previous steps
  std::array<Formula, 3> location{0.0, 0.0, 0.0};
  std::array<Formula, 3> direction{0.0, 0.0, 0.0};  // unit length; 0 where the picture is empty
};

// The reason why a camera cannot be written as a formula, for messages. Empty if it can.
std::string formula_fault(const Sidecar& file);

// Writes a camera as formulas. A single eye, or two eyes that do not share a picture, have the parameter `eye`: -1 is
// the left, 1 the right.
// Precondition: formula_fault() is empty.
CameraFormula camera_formula(const Sidecar& file, const FormulaView& view);

}  // namespace ods
