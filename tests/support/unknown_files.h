// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files of every layout and projection without metadata, and the result of identifying them.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ods/identify/identify.h"
#include "ods/picture/save.h"
#include "tests/support/worlds.h"

namespace ods {

// The actual format of a file. Without metadata, fisheye-polynomial, whose numbers are those of one lens, cannot be
// distinguished from another lens, so it is not tested.
struct Truth {
  std::optional<Layout> layout;  // not set for one eye
  ProjectionSetting projection;
};

inline std::string truth_text(const Truth& truth) {
  return reading_text({truth.layout, truth.projection, 1.0});
}

inline std::vector<Truth> all_truths() {
  std::vector<Truth> truths;
  for (const NamedProjection& named : named_projections()) {
    if (named.name == "fisheye-polynomial") continue;
    truths.push_back({std::nullopt, named.setting});
    for (const Layout layout : kLayouts) {
      const EyePacking how = arrangement_of(layout).how;
      if (how == EyePacking::kAlone || how == EyePacking::kMixed) continue;
      truths.push_back({layout, named.setting});
    }
  }
  return truths;
}

// A size of about `pixels` by half as many for one eye, divisible into halves and faces.
inline Extent unknown_eye(const ProjectionSetting& projection, int pixels) {
  const double aspect = 1000.0 / natural_height(projection, 1000);
  const int width = static_cast<int>(std::sqrt(0.5 * pixels * pixels * aspect)) / 24 * 24;
  return {width, natural_height(projection, width) / 4 * 4};
}

using TwoEyes = std::function<Image(int eye, const ProjectionSetting& projection, Extent size)>;

// JPEG mixes eyes whose pixels alternate, so such files are PNG.
inline std::string unknown_name(const Truth& truth) {
  return truth.layout && arrangement_of(*truth.layout).is_interleaved() ? "file.png" : "file.jpg";
}

// A picture of one eye uses the left eye.
inline void write_unknown(const std::string& path, const Truth& truth, const TwoEyes& eyes, Extent size,
                          int quality = 90) {
  Picture picture;
  for (const int eye : {kLeft, kRight}) {
    if (!truth.layout && eye == kRight) continue;
    EyeImage image;
    image.eye = truth.layout ? eye : kMono;
    image.radiance = eyes(eye, truth.projection, size);
    picture.eyes.push_back(std::move(image));
  }
  SaveOptions options;
  options.layout = truth.layout.value_or(Layout::kSeparate);
  options.tone = ToneCurve::kLinear;
  options.jpeg_quality = quality;
  save_picture(picture, options, path);
}

inline StoredPicture open_unknown(const std::string& path) {
  OpenOptions open;
  open.format.layout = Layout::kSeparate;
  open.format.projection = ProjectionSetting();
  return open_picture(path, open);
}

inline bool is_right(const Reading& reading, const Truth& truth) {
  const bool same_window = reading.projection.kind == kPerspective && truth.projection.kind == kPerspective;
  return reading.layout == truth.layout &&
         (same_window || projection_name(reading.projection) == projection_name(truth.projection));
}

enum class Verdict {
  kSureAndRight,
  kRightUnsure,  // but not sure
  kNamed,        // not sure, but the actual format is among the named ones
  kWrong,        // not sure
  kSureAndWrong,
};

inline Verdict verdict_on(const Identity& identity, const Truth& truth) {
  if (identity.readings.empty()) return Verdict::kWrong;
  if (is_right(identity.best(), truth)) return identity.is_sure() ? Verdict::kSureAndRight : Verdict::kRightUnsure;
  if (identity.is_sure()) return Verdict::kSureAndWrong;
  const std::string named = doubt_text(identity);
  return named.find(truth_text(truth) + " (") != std::string::npos ? Verdict::kNamed : Verdict::kWrong;
}

}  // namespace ods
