// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The checks of lint(), each in its own file. Each adds to the report its findings, and what it could not judge.
#pragma once
#include "ods/image/image_file.h"
#include "ods/lint/lint.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/metadata/stereo_format.h"

namespace ods {

struct Subject {
  std::string path;
  FileInfo info;  // of the left file of a pair
  StereoFormat format;
  std::vector<Image> eyes;  // luminance, scene-linear, 1 channel, as stored
  Image packed;             // the whole file, if it can be cut in other ways
  std::optional<Sidecar> sidecar;
  std::optional<Camera> camera;  // if the file or its sidecar states how the eyes converge

  Layout layout() const { return format.layout.layout.value_or(Layout::kSeparate); }
  const ProjectionSetting& projection() const { return format.camera.projection; }
};

// Every check calls one of them for each Check that it is responsible for.
void judge(LintReport& report, Check check);
void skip(LintReport& report, Check check, const std::string& reason);

// The amount to add to the difference of headings at this elevation so that it is that of a parallel pair; 0 if the
// convergence is unknown. Radians.
double convergence_at(const Subject& subject, double phi);

// Returns false if these are not two eyes at one place; then no other check of stereo makes sense.
bool check_layout(const Subject& subject, LintReport& report);
void check_parallax(const Subject& subject, LintReport& report);
void check_poles(const Subject& subject, LintReport& report);
void check_seam(const Subject& subject, LintReport& report);
void check_shape(const Subject& subject, LintReport& report);     // aspect, video levels
void check_metadata(const Subject& subject, LintReport& report);  // except the layout, which check_layout() measures

}  // namespace ods
