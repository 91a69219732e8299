// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera as formulas: where the ray of an image position starts and looks, over the whole picture with its layout.
// One description for every renderer that can be told formulas; ods/export/formula.h prints them. It says what
// camera_ray() of ods/kernel/camera/camera.h computes, without the blur of a lens.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/export/formula.h"
#include "ods/picture/metadata/sidecar.h"

namespace ods {

// How the renderer sees it. x and y of the formulas are its own image coordinates.
struct FormulaView {
  Formula u;                  // of the whole picture, 0..1 from left to right, made of x and y
  Formula v;                  // 0..1 from top to bottom
  bool left_handed = false;   // its world's z points ahead, where ours points back
  bool camera_frame = false;  // its camera is placed by other means: location and direction are in the camera's frame
};

struct NamedFormula {
  std::string name;
  Formula value;
  std::string meaning;  // of parameters
};

struct CameraFormula {
  std::vector<NamedFormula> parameters;  // numbers: ipd, location_x, merge_start, ...
  std::vector<NamedFormula> steps;       // each made of x, y, parameters and the steps before it
  std::array<Formula, 3> location{0.0, 0.0, 0.0};
  std::array<Formula, 3> direction{0.0, 0.0, 0.0};  // unit length; 0 where the picture is empty
};

// Why a camera is no formula, in words for a message; empty: it is one.
std::string formula_fault(const Sidecar& file);

// A single eye, and two that do not share a picture, have the parameter `eye`: -1 is the left, 1 the right.
// Precondition: formula_fault() is empty.
CameraFormula camera_formula(const Sidecar& file, const FormulaView& view);

}  // namespace ods
