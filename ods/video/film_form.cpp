// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/film_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/base/error.h"

namespace ods {

FilmStereo film_stereo(Layout layout) {
  switch (layout) {
    case Layout::kTopBottom:
    case Layout::kTopBottomHalf:
      return FilmStereo::kTopBottom;
    case Layout::kSideBySide:
    case Layout::kSideBySideHalf:
      return FilmStereo::kSideBySide;
    case Layout::kBottomTop:
      return FilmStereo::kBottomTop;
    case Layout::kCrossEyed:
      return FilmStereo::kRightLeft;
    default:
      throw Error(ErrorKind::kUsage, fmt::format("films have no word for eyes that are {}", layout_name(layout)));
  }
}

void set_projection(FilmForm& form, const ProjectionSetting& projection) {
  form.bounds = {};
  if (projection.kind == kPerspective) {
    form.projection = FilmProjection::kFlat;
    return;
  }
  if (projection.kind != kLatLong || projection.longitude.x < -180.0f || projection.longitude.y > 180.0f) {
    throw Error(ErrorKind::kUsage,
                fmt::format("films have no word for the projection {}: they know lat-long, parts of it such as vr180, "
                            "cubemap and flat",
                            projection_name(projection)));
  }
  form.projection = FilmProjection::kEquirect;
  const auto part = [](float degrees, double whole) {
    return static_cast<uint32_t>(std::llround(static_cast<double>(degrees) / whole * 4294967296.0));
  };
  form.bounds = {part(90.0f - projection.latitude.y, 180.0), part(90.0f + projection.latitude.x, 180.0),
                 part(180.0f + projection.longitude.x, 360.0), part(180.0f - projection.longitude.y, 360.0)};
}

static KnownForm as_picture(const FilmForm& known) {
  KnownForm form;
  if (known.stereo == FilmStereo::kOneView) form.layout = Layout::kSeparate;  // one eye
  for (Layout layout : {Layout::kTopBottom, Layout::kBottomTop, Layout::kSideBySide, Layout::kCrossEyed}) {
    if (known.stereo == film_stereo(layout)) form.layout = layout;
  }
  if (known.projection) form.projection = ProjectionSetting();  // which does not matter: it is not asked for
  return form;
}

// An eye as it was before it was squeezed.
static Extent whole_eye(Layout layout, Extent file) {
  const Extent eye = unpacked_size(layout, file).value_or(file);
  const Extent squeeze = squeeze_of(layout, 2);
  return {eye.width * squeeze.width, eye.height * squeeze.height};
}

FilmForm complete_form(FilmForm known, const VideoTrack& track, const std::string& path,
                       std::vector<std::string>& guesses) {
  FileInfo info;
  info.width = track.size.width;
  info.height = track.size.height;
  info.is_float = true;  // no XMP of pictures is looked for in it
  if (info.width == 0 || info.height == 0) {
    throw Error(ErrorKind::kInput, fmt::format("cannot use '{}': its pictures have no size", path));
  }
  const PictureForm form = find_form(info, path, as_picture(known));
  const Layout layout = form.layout.layout.value_or(Layout::kSeparate);
  if (!known.stereo) known.stereo = layout == Layout::kSeparate ? FilmStereo::kOneView : film_stereo(layout);
  if (!known.projection) {
    // Anything is taken as lat-long where nothing tells; a film of an ordinary camera must not be.
    const Extent eye = whole_eye(layout, track.size);
    const bool is_named = read_name(path).projection != nullptr;
    if (!is_named && natural_height(form.camera.projection, eye.width) != eye.height) {
      throw Error(ErrorKind::kInput,
                  fmt::format("cannot tell what '{}' shows, from its name (_360_TB, _180_LR ...) or its shape "
                              "({}x{}): say it with --layout and --projection",
                              path, info.width, info.height));
    }
    set_projection(known, form.camera.projection);
  }
  if (known.stereo != FilmStereo::kOneView && known.ipd == 0.0) {
    known.ipd = form.ipd_is_said ? static_cast<double>(form.camera.ipd) : track.vexu ? track.vexu->ipd : 0.0;
  }
  known.for_apple = known.for_apple || track.vexu.has_value();
  guesses = form.guesses;
  return known;
}

}  // namespace ods
