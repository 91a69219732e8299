// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The checks of lint(), each in its own file. Each adds its findings to the report, and the checks that it could not
// judge.
#pragma once
#include "ods/disparity/alignment.h"
#include "ods/image/image_file.h"
#include "ods/lint/lint.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct Subject {
  std::string path;
  bool is_video = false;                 // a frame of a video
  std::optional<double> bits_per_pixel;  // only for video files
  FileInfo info;                         // for a pair, of the left file
  StereoFormat format;
  std::vector<Image> eyes;   // luminance, scene-linear, 1 channel, as stored
  std::vector<Image> small;  // scene-linear colour, 3 channels, averaged to at most kSmallWidth columns
  Image packed;              // luminance of the whole file, if it can be cut in other ways
  std::optional<Sidecar> sidecar;
  std::optional<Camera> camera;  // set if the file or its sidecar specifies how the eyes converge

  // Set for eyes that are large enough; else empty. Views are at most 256, 512 and 1024 wide, coarse to fine.
  std::vector<std::vector<GrayView>> scales;  // per eye
  // Set for two eyes that can be compared.
  Alignment alignment;
  EyeCorrection correction;      // the significant part of the alignment; the right views are already corrected by it
  std::vector<Matches> matches;  // per scale

  Layout layout() const { return format.layout.layout.value_or(Layout::kSeparate); }
  const ProjectionSetting& projection() const { return format.camera.projection; }
};

constexpr int kSmallWidth = 1024;

// Opens a file. Throws the same errors as lint().
Subject load_subject(const std::string& path, const LintOptions& options);

// The colours of Subject::small. The eyes are packed in this layout; for kSeparate, each is a file or an image of its
// own.
std::vector<Image> small_colors(const StoredPicture& picture, Layout layout);

// Judges a picture whose eyes are loaded.
LintReport lint_subject(Subject subject);

// Sorts the findings by decreasing certainty, and the checks into the order of kChecks.
void sort_report(LintReport& report);

// Computes the views. align() then computes the alignment of two eyes and the members that depend on it.
void make_views(Subject& subject);
void align(Subject& subject);

// The significant terms, without noise. Returns no correction if one of them is unsure.
EyeCorrection significant_correction(const Alignment& alignment);

// A command that corrects the file: "ods convert IN -o corrected.png --right-pitch 3.5", ready to be run.
std::string convert_command(const Subject& subject, const std::string& options);

// A difference between the eyes: its size, its standard error, and the number of places where it was measured.
struct Difference {
  double size = 0.0;  // >= 0
  double error = 0.0;
  size_t places = 0;
};

// The certainty that the difference matters: below `harmless` it is not noticed, above `painful` every viewer notices
// it.
double certainty_of(const Difference& difference, double harmless, double painful);

// Every check calls one of these two for each Check that it is responsible for.
void judge(LintReport& report, Check check);
void skip(LintReport& report, Check check, const std::string& reason);

// The correction to add to the difference of headings at this elevation, to get the difference for a parallel pair; 0
// if the convergence is unknown. Radians.
double convergence_at(const Subject& subject, double phi);

// Returns false if these are not two eyes at one place; then the other checks of stereo do not apply.
bool check_layout(const Subject& subject, LintReport& report);
void check_parallax(const Subject& subject, LintReport& report);
void check_poles(const Subject& subject, LintReport& report);
void check_seam(const Subject& subject, LintReport& report);
void check_alignment(const Subject& subject, LintReport& report);  // height, pitch, roll and size of one eye
// swapped: certainty of swapped eyes, for which all parallax is outwards.
void check_divergence(const Subject& subject, double swapped, LintReport& report);
void check_colors(const Subject& subject, LintReport& report);     // one eye against the other
void check_sharpness(const Subject& subject, LintReport& report);  // one eye against the other
void check_horizon(const Subject& subject, LintReport& report);
void check_dead_poles(const Subject& subject, LintReport& report);
void check_black(const Subject& subject, LintReport& report);
void check_codes(const Subject& subject, LintReport& report);     // highlights, banding
void check_shape(const Subject& subject, LintReport& report);     // aspect, video levels
void note_nearest(const Subject& subject, LintReport& report);    // adds a note, not a check
void check_metadata(const Subject& subject, LintReport& report);  // except the layout, which check_layout() measures

}  // namespace ods
