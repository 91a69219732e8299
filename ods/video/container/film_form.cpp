// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/film_form.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ods/base/error.h"
#include "ods/video/container/apple.h"

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
  if (known.stereo) form.layout = Layout::kSeparate;  // one eye, or eyes in a way that pictures do not know
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

std::optional<FilmForm> said_form(const VideoTrack& track) {
  std::optional<FilmForm> said;
  for (const std::optional<FilmForm>* place : {&track.v2, &track.v1, &track.vexu}) {
    if (!*place) continue;
    const FilmForm& form = **place;
    if (!said) {
      said = form;
    } else {
      if (!said->stereo) said->stereo = form.stereo;
      if (!said->projection) {  // nor angles, then, nor a source
        const std::optional<FilmStereo> stereo = said->stereo;
        said = form;
        said->stereo = stereo;
      }
    }
  }
  if (!said) return said;
  said->stereo = said->stereo.value_or(FilmStereo::kOneView);
  said->projection = said->projection.value_or(FilmProjection::kFlat);
  said->yaw = std::remainder(said->yaw, 360.0);  // a heading of V1 may be 270
  said->ipd = track.vexu ? track.vexu->ipd : 0.0;
  return said;
}

// Anything is taken as lat-long where nothing tells; a film of an ordinary camera must not be.
static void guess_projection(FilmForm& known, const PictureForm& form, const VideoTrack& track,
                             const std::string& path) {
  const Extent eye = whole_eye(form.layout.layout.value_or(Layout::kSeparate), track.size);
  const bool is_told = form.camera_is_said || read_name(path).projection != nullptr;
  if (!is_told && natural_height(form.camera.projection, eye.width) != eye.height) {
    throw Error(ErrorKind::kInput,
                fmt::format("cannot tell what '{}' shows, from its name (_360_TB, _180_LR ...) or its shape "
                            "({}x{}): say it with --layout and --projection",
                            path, track.size.width, track.size.height));
  }
  set_projection(known, form.camera.projection);
}

static PictureForm found_form(const FilmForm& known, const VideoTrack& track, const std::string& path) {
  FileInfo info;
  info.width = track.size.width;
  info.height = track.size.height;
  info.is_float = true;  // no XMP of pictures is looked for in it
  if (info.width == 0 || info.height == 0) {
    throw Error(ErrorKind::kInput, fmt::format("cannot use '{}': its pictures have no size", path));
  }
  return find_form(info, path, as_picture(known));
}

static void take_words(FilmForm& known, const FilmForm& said) {
  if (!known.stereo) known.stereo = said.stereo;
  if (!known.projection) {
    known.projection = said.projection;
    known.bounds = said.bounds;
  }
  if (known.projection != FilmProjection::kFlat) {  // which has no place for angles
    known.yaw = said.yaw, known.pitch = said.pitch, known.roll = said.roll;
  }
  known.source = said.source;
}

FilmForm complete_form(FilmForm known, const VideoTrack& track, const std::string& path,
                       std::vector<std::string>& guesses) {
  const std::optional<FilmForm> said = said_form(track);
  if (said) take_words(known, *said);
  const PictureForm form = found_form(known, track, path);
  const Layout layout = form.layout.layout.value_or(Layout::kSeparate);
  if (!known.stereo) known.stereo = layout == Layout::kSeparate ? FilmStereo::kOneView : film_stereo(layout);
  if (!known.projection) guess_projection(known, form, track, path);
  if (known.stereo != FilmStereo::kOneView && known.ipd == 0.0) {
    known.ipd = track.vexu ? track.vexu->ipd : form.ipd_is_said ? static_cast<double>(form.camera.ipd) : 0.0;
  }
  known.for_apple = known.for_apple || track.vexu.has_value();
  if (!said) known.source = "Omnistereo";
  guesses = form.guesses;
  return known;
}

// --- contradictions --------------------------------------------------------------------------------------------------

static bool is_stacked(const FilmForm& form) {
  return form.stereo == FilmStereo::kTopBottom || form.stereo == FilmStereo::kBottomTop;
}

static bool is_beside(const FilmForm& form) {
  return form.stereo == FilmStereo::kSideBySide || form.stereo == FilmStereo::kRightLeft;
}

// Eyes that were squeezed are as wide as high.
std::string shape_fault(const FilmForm& form, Extent size) {
  if (form.projection != FilmProjection::kEquirect || form.is_partial() || size.height == 0) return {};
  const double aspect = static_cast<double>(size.width) / size.height;
  const bool is_packed = is_stacked(form) || is_beside(form);
  const double whole = is_stacked(form) ? 1.0 : is_beside(form) ? 4.0 : 2.0;
  if (std::abs(aspect / whole - 1.0) < 0.02 || (is_packed && std::abs(aspect / 2.0 - 1.0) < 0.02)) return {};
  return fmt::format("it says {}, and {}x{} is not the shape of that", form_text(form), size.width, size.height);
}

static std::optional<FilmStereo> stereo_of(std::optional<Layout> layout) {
  if (!layout || *layout == Layout::kSeparate) return FilmStereo::kOneView;
  try {
    return film_stereo(*layout);
  } catch (const Error&) {
    return std::nullopt;
  }
}

// Whether a film of that form may be called by that projection: a cubemap or most of a sphere is 360, a mesh anything.
static bool may_be_called(const FilmForm& form, const ProjectionSetting& called) {
  if (form.projection == FilmProjection::kMesh || form.projection == FilmProjection::kOther) return true;
  const double cut = (1.0 * form.bounds[2] + form.bounds[3]) / 4294967296.0;
  const bool is_wide = cut < 0.25;
  if (called.kind == kPerspective) return form.projection == FilmProjection::kFlat;
  if (form.projection == FilmProjection::kFlat) return false;
  const bool is_part = called.kind == kLatLong && called.longitude.y - called.longitude.x < 270.0f;
  if (form.projection == FilmProjection::kCubemap)
    return called.kind >= kCube3x2 || (called.kind == kLatLong && !is_part);
  return called.kind == kLatLong && is_wide != is_part;
}

static std::string word_of(const FilmForm& form) {
  if (form.projection != FilmProjection::kEquirect) return std::string(projection_name(*form.projection));
  FilmForm half;
  set_projection(half, find_projection("vr180")->setting);
  return form.is_partial() && same_sphere(form, half) ? "vr180" : "lat-long";
}

static FormConflict layout_conflict(const FilmForm& said, FilmStereo other, const std::string& because) {
  return {fmt::format("it says {}, but {}", stereo_name(*said.stereo), because),
          fmt::format("--layout {} or --layout {}", stereo_name(*said.stereo), stereo_name(other))};
}

static FormConflict projection_conflict(const FilmForm& said, const ProjectionSetting& other,
                                        const std::string& because) {
  FilmForm eye = said;
  eye.stereo.reset();
  eye.yaw = eye.pitch = eye.roll = 0.0;
  std::vector<std::string> options;
  const std::string word = word_of(said);
  if (!said.is_partial() || word == "vr180") options.push_back("--projection " + word);
  const std::string_view name = projection_name(other);
  if (name == "lat-long" || name == "vr180") options.push_back(fmt::format("--projection {}", name));
  if (options.size() < 2) options.emplace_back("another name for the file");
  return {fmt::format("it says {}, but {}", form_text(eye), because), fmt::format("{}", fmt::join(options, " or "))};
}

// What a sidecar says, or the name.
static void compare_with_names(const FilmForm& known, const FilmForm& said, const PictureForm& found,
                               const std::string& path, std::vector<FormConflict>& conflicts) {
  const NameWords words = read_name(path);
  const bool has_sidecar = found.layout.source == LayoutSource::kSidecar;
  const bool is_custom = said.stereo == FilmStereo::kCustom || said.stereo == FilmStereo::kOther;
  if (!known.stereo && !is_custom && (has_sidecar || found.layout.source == LayoutSource::kName)) {
    const std::optional<FilmStereo> other = stereo_of(found.layout.layout);
    if (other && *other != said.stereo) conflicts.push_back(layout_conflict(said, *other, found.layout.because));
  }
  if (known.projection) return;
  if (found.camera_is_said && !may_be_called(said, found.camera.projection)) {
    conflicts.push_back(projection_conflict(said, found.camera.projection, "its sidecar says otherwise"));
  } else if (!found.camera_is_said && words.projection != nullptr && !may_be_called(said, words.projection->setting)) {
    const std::string because = fmt::format("its name ends in {}", words.projection_word);
    conflicts.push_back(projection_conflict(said, words.projection->setting, because));
  }
}

std::vector<FormConflict> find_conflicts(const FilmForm& known, const VideoTrack& track, const std::string& path) {
  std::vector<FormConflict> conflicts;
  const std::optional<FilmForm> said = said_form(track);
  if (!said) return conflicts;
  try {
    compare_with_names(known, *said, found_form({}, track, path), path, conflicts);
  } catch (const Error&) {
    // a sidecar that cannot be read says nothing
  }
  const std::string fault = shape_fault(*said, track.size);
  if (known.stereo || known.projection || !conflicts.empty() || fault.empty()) return conflicts;
  const bool is_square = track.size.width == track.size.height;
  conflicts.push_back({fault, fmt::format("--layout {} or {}", stereo_name(*said->stereo),
                                          is_square ? "--layout top-bottom" : "--projection flat")});
  return conflicts;
}

// --- what will be written --------------------------------------------------------------------------------------------

bool can_say(Container container, const VideoTrack& track, const FilmForm& form) {
  const FilmForm usual{FilmStereo::kOneView, FilmProjection::kEquirect, {}, 0.0, 0.0, 0.0, 0.0, false, ""};
  FilmForm eyes = usual, sphere = usual;
  eyes.stereo = form.stereo;
  sphere.projection = form.projection;
  const bool is_mkv_word = !has_boxes(container) && form.stereo != FilmStereo::kOther;
  const bool has_eyes = is_mkv_word || fits_v2(eyes) || (track.v2 && same_stereo(*track.v2, form));
  return has_eyes && (fits_v2(sphere) || (track.v2 && same_sphere(*track.v2, form)));
}

static bool says(const std::optional<FilmForm>& place, const FilmForm& form) {
  return place && same_stereo(*place, form) && same_sphere(*place, form);
}

static std::string turn_of(const FilmForm& form) {
  return fmt::format("{:.6g},{:.6g},{:.6g}", form.yaw, form.pitch, form.roll);
}

static bool has_whole_angles(const FilmForm& form) {
  return form.yaw == std::round(form.yaw) && form.pitch == std::round(form.pitch) && form.roll == std::round(form.roll);
}

static void plan_v1(const VideoTrack& track, const FilmForm& form, bool may_be_new, TagPlan& plan) {
  const bool stays = track.v1 && can_update_v1(*track.v1, form) && (may_be_new || same_stereo(*track.v1, form));
  const bool will_be = stays || (may_be_new && fits_v1(form));
  if (track.v1 && !says(track.v1, form)) {
    plan.says_more = true;
    plan.notes.push_back(fmt::format("its V1 says {}: {}", form_text(*track.v1), will_be ? "changed" : "taken out"));
  }
  if (will_be && !track.v1) plan.says_more = true;
  if (!will_be && may_be_new && form.projection != FilmProjection::kFlat) {
    plan.notes.push_back("V1 cannot say that, and is left out: players that read only V1 show a flat film");
  }
  if (will_be && !has_whole_angles(form)) {
    plan.notes.push_back("V1 holds whole degrees: only V2 has the angles as they are");
  }
}

static void plan_vexu(const VideoTrack& track, const FilmForm& form, TagPlan& plan) {
  if (track.has_layers || !form.for_apple) return;
  if (!says(track.vexu, form)) plan.says_more = true;
  if (!says(track.vexu, form) && !fits_vexu(form)) {
    plan.notes.push_back(fmt::format("vexu has no words for {}, and {}: Apple's players show a flat film",
                                     form_text(form), track.vexu ? "is taken out" : "is left out"));
    return;
  }
  if (track.vexu && !says(track.vexu, form)) {
    plan.notes.push_back(fmt::format("its vexu says {}: changed", form_text(*track.vexu)));
  }
  if (form.yaw != 0.0 || form.pitch != 0.0 || form.roll != 0.0) {
    plan.notes.push_back(
        fmt::format("vexu has no place for angles: Apple's players do not turn it by {}", turn_of(form)));
  }
}

TagPlan plan_tag(Container container, const VideoTrack& track, const FilmForm& form) {
  TagPlan plan;
  plan.says_more = !says(track.v2, form);
  plan_v1(track, form, has_boxes(container), plan);
  if (has_boxes(container)) plan_vexu(track, form, plan);
  return plan;
}

}  // namespace ods
