// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture of a frame, rendered by Cycles: each eye in parts of its samples, whose differences are the noise that the
// denoiser reads; both eyes denoised together, converted to the projection, and saved.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cli/bridge/cycles_session.h"
#include "ods/denoise/denoise.h"
#include "ods/files/frames.h"
#include "ods/picture/save.h"
#include "ods/render/render_options.h"

struct CyclesPicture {
  ods::StereoCamera camera;  // its place and yaw are those of the shot
  ods::Extent eye;
  std::vector<int> eyes;  // as in EyeImage
  CyclesShot shot;        // what is the same in all eyes and parts: quality, place; its samples are not 0
  ods::Denoiser denoiser = ods::Denoiser::kNone;
  bool layers = false;      // the file gets depth, normals, albedo
  bool statistics = false;  // and the variance and the number of samples
  ods::Part part;           // of the samples; {1, 1} is the picture
  ods::SaveOptions save;
  bool has_alpha = false;
};

// Throws UsageError if Cycles cannot give the picture's files what was asked for.
void check_cycles_picture(const CyclesPicture& picture);

// Returns the numbers of the files of a picture: each eye's parts.
std::vector<int> part_numbers(const CyclesPicture& picture);

// The eyes as rendered: with the layers of Cycles, before the conversion to a projection that it does not have.
struct CyclesRendered {
  ods::Picture picture;
  std::vector<ods::Image> samples;  // with CyclesPicture::statistics: of each eye
  ods::StereoCamera camera;
  CyclesPose pose;
};

// parts: the names of the files of its parts; those that exist are not rendered. report: gets the fraction done. Throws
// as CyclesSession::render().
CyclesRendered render_eyes(CyclesSession& session, const CyclesPicture& picture, const ods::FrameNames& parts,
                           const std::function<void(double)>& report);

struct CyclesSaved {
  std::vector<std::string> files;
  CyclesPose pose;
  std::string strain;  // a line about what strains the viewer's eyes; empty: nothing
};

// Renders the eyes, denoises and saves them. Throws as render_eyes() and ods::save_picture().
CyclesSaved make_picture(CyclesSession& session, const CyclesPicture& picture, const ods::FrameNames& parts,
                         const std::string& path, const std::function<void(double)>& report);
