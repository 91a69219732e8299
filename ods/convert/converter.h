// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Fills the rows of a conversion.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ods/convert/reproject.h"
#include "ods/convert/resample.h"
#include "ods/convert/row_plan.h"
#include "ods/convert/row_warp.h"

namespace ods {

// The source positions of a conversion, for pictures of one format.
struct SourcePlan {
  Mapping mapping;
  bool is_same = false;       // is_same_picture()
  std::vector<RowPlan> rows;  // for all eyes, from top to bottom; if empty, rows are planned when they are filled
};

// `format`: a picture or its header; it must outlive the plan and must not move.
SourcePlan make_plan(const StoredPicture& format, const ConvertTarget& target);

// Plans all rows at once, for many pictures. Takes about 2 bytes per pixel of the target, and more for slanted views of
// the picture.
void remember_rows(SourcePlan& plan);

// Pixels without a source pixel.
struct RowHoles {
  int empty = 0;
  int filled = 0;  // filled from the background
};

class Converter {
 public:
  // moves_eyes: the target's eyes are at other positions than the picture's. `plan` and `source` must outlive the
  // converter.
  Converter(const SourcePlan& plan, const Source& source, bool moves_eyes, bool adds_alpha, Holes holes);
  // For a picture whose texels are computed when read; the plan's eyes do not move.
  Converter(const SourcePlan& plan, const TexelReader& reader);
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;

  int64_t no_depth() const { return reprojection_ ? reprojection_->no_depth : 0; }

  RowHoles fill(int index, int y, std::span<float> row) const;

  // Fills rows y, y + 1, ... with the same result, but reads the texels that they share once. Preconditions:
  // constructed with a TexelReader; the plan has rows.
  void fill_band(int index, int y, int count, std::span<float> rows) const;

 private:
  // A row of the target.
  struct Row {
    int index;  // index of the eye
    int y;
    std::span<float> pixels;
  };

  void set_up_rows(const StoredPicture& picture, bool adds_alpha);
  void clear(std::span<float> row) const;
  void fill_planned(const Row& row, const RowPlan& plan) const;
  void fill_stretch(const Row& row, const Stretch& stretch, const TexelBlock* block) const;
  void fill_alone(PixelRun& run, const Row& row, const Stretch& stretch, int i) const;
  void fill_single(const Row& row, const RowPlan& plan, const SinglePixel& single) const;
  RowHoles fill_moved(const Row& row) const;
  RowHoles fill_warped(const Row& row, const std::vector<SurfaceHit>& hits) const;
  std::optional<RowHoles> fill_by_rows(const Row& row) const;
  std::optional<RowHoles> fill_by_finer_rows(const Row& row) const;
  void fill_hits(PixelRun& run, const Row& row, int x, std::span<const SurfaceHit> hits) const;
  SurfaceHit fill_moved_pixel(const Row& row, int x) const;
  SurfaceHit meet(int index, vec2 home, vec2 uv) const;
  float* pixel_of(const Row& row, int x) const {
    return row.pixels.data() + static_cast<size_t>(x) * static_cast<size_t>(channels_);
  }

  const SourcePlan& plan_;
  const Mapping& mapping_;
  Resampler resampler_;
  std::optional<Reprojection> reprojection_;
  Mapping fine_;  // mapping of a target that is `finer_` times as large, which is then averaged
  int finer_ = 1;
  std::optional<RowWarp> warp_;  // from reprojection_ to fine_
  std::vector<bool> averaged_;   // per channel: whether it may be averaged
  Holes holes_ = Holes::kEmpty;
  int channels_;
  int depth_channel_ = -1;  // in a pixel of a row; negative if there is no depth
};

}  // namespace ods
