// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/convert/unwrap.h"
#include "ods/identify/open_media.h"
#include "ods/lint/checks.h"
#include "ods/picture/load_eyes.h"

namespace ods {

std::vector<Image> small_colors(const StoredPicture& picture, Layout layout) {
  const bool is_packed = picture.eyes.size() == 1;
  const Extent eye = is_packed ? *unpacked_size(layout, picture.size) : picture.size;
  const int count = is_packed && layout == Layout::kSeparate ? 1 : 2;
  const int width = std::min(eye.width, kSmallWidth);
  const int height = std::max(1, static_cast<int>(int64_t{eye.height} * width / eye.width));
  std::vector<Image> small(static_cast<size_t>(count), Image(width, height, 3));
  std::vector<Image> counts(small.size(), Image(width, height, 1));
  const auto add = [&](const EyeRow& part, const std::vector<float>& row) {
    const size_t index = static_cast<size_t>(part.index);
    const int y = static_cast<int>(int64_t{part.y} * height / eye.height);
    for (int from = part.x, to = part.first; to < eye.width && from < picture.size.width;
         from += part.step, to += part.every) {
      const int x = static_cast<int>(int64_t{to} * width / eye.width);
      for (int c = 0; c < 3; c++) small[index].at(x, y)[c] += row[static_cast<size_t>(3 * from + c)];
      *counts[index].at(x, y) += 1.0f;
    }
  };
  for (size_t stored = 0; stored < picture.eyes.size(); stored++) {
    read_colors(picture, stored, [&](int y, const std::vector<float>& row) {
      if (!is_packed) return add({static_cast<int>(stored), y}, row);
      for (const EyeRow& part : packed_row(layout, eye, count, y)) add(part, row);
    });
  }
  for (size_t i = 0; i < small.size(); i++) {
    for (size_t k = 0; k < small[i].pixels.size(); k++) small[i].pixels[k] /= counts[i].pixels[k / 3];
  }
  return small;
}

// Players go by the aspect ratio, and lint looks for its contradictions. So the pixels decide only if they show
// something that no picture of this aspect ratio has: circles, faces of a cube, halves of the sphere, or surely a
// window.
static bool shows_itself(const Identity& identity, const StereoFormat& without_pixels) {
  if (identity.readings.empty()) return false;
  const bool has_shape = without_pixels.layout.source == FormatSource::kShape;
  const ProjectionSetting& seen = identity.best().projection;
  if (seen.kind == kPerspective) return has_shape ? identity.is_sure() : identity.is_likely();
  return has_image_circle(seen.kind) || is_cube(seen.kind) || (!has_shape && is_vr180(seen));
}

// The format by which the file is judged.
static StereoFormat judged_format(const MediaFile& media, const FormatHint& known) {
  if (!media.hint.lenses.empty()) return media.format;
  StereoFormat format = find_format(media.reader->info(), media.path, known);
  if (!media.identity) return format;
  if (shows_itself(*media.identity, format)) return media.format;
  if (media.identity->is_anaglyph) {
    format.layout = {{}, FormatSource::kPixels, "it is an anaglyph, whose eyes cannot be taken apart"};
    format.camera.projection = find_projection("perspective")->setting;
    format.camera.projection.aspect =
        static_cast<float>(media.reader->info().width) / static_cast<float>(media.reader->info().height);
  }
  return format;
}

// Packed eyes are cut here, so that the file can be cut in other ways too.
static void load(Subject& subject, const LintOptions& options) {
  const std::string& path = subject.path;
  MediaOptions open;
  open.known.layout = options.layout;
  open.known.projection = options.projection;
  open.known.lenses = options.lenses;
  open.color_only = open.left_first = true;
  MediaFile media = open_media(path, open);
  expect_picture(media);
  subject.info = media.reader->info();
  subject.format = judged_format(media, open.known);
  const bool has_lenses = !media.hint.lenses.empty();
  if (has_lenses || names_eye(path) || subject.format.is_photo || subject.layout() == Layout::kMultiview) {
    StoredPicture picture = reader_of(std::move(media)).read("");
    if (has_lenses) picture = unwrapped(picture);
    subject.format.camera.projection = picture.camera.projection;
    subject.eyes = grey_eyes(picture);
    subject.small = small_colors(picture, Layout::kSeparate);
    return;
  }
  const StoredPicture picture = media.reader->whole();
  const Extent size{subject.info.width, subject.info.height};
  if (!unpacked_size(subject.layout(), size)) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}x{} pixels are not two eyes, {}; specify `layout`",
                                               path, size.width, size.height, layout_name(subject.layout())));
  }
  subject.packed = grey_eyes(picture)[0];
  subject.eyes = unpack(subject.layout(), subject.packed);
  subject.small = small_colors(picture, subject.layout());
}

Subject load_subject(const std::string& path, const LintOptions& options) {
  Subject subject;
  subject.path = path;
  load(subject, options);
  const std::string sidecar = sidecar_path(subject.path);
  std::vector<std::string> warnings;
  std::error_code ignored;
  if (std::filesystem::exists(sidecar, ignored)) subject.sidecar = load_sidecar(sidecar, warnings);
  if (subject.format.has_camera) subject.camera = make_camera(subject.format.camera);
  return subject;
}

void make_views(Subject& subject) {
  for (const int width : {256, 512, 1024}) {
    subject.scales.push_back(make_gray_views(subject.eyes, subject.projection(), subject.info.is_float, width));
    if (subject.scales.back()[0].width < width) break;
  }
}

void align(Subject& subject) {
  const bool two_cameras = seen_around(subject.scales[0][0]) < 0.8;
  subject.alignment = find_alignment(subject.scales, two_cameras);
  subject.correction = significant_correction(subject.alignment);
  for (std::vector<GrayView>& views : subject.scales) {
    if (moves_pixels(subject.correction)) views[1] = corrected_view(views[1], subject.correction);
    subject.matches.push_back(match_tiles(views[0], views[1], {}));
  }
}

// --- corrections -----------------------------------------------------------------------------------------------------

// Quotes a path as one word for the shell.
static std::string quoted(const std::string& path) {
  const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("._/%+-", c); };
  if (!path.empty() && std::all_of(path.begin(), path.end(), is_plain)) return path;
  std::string word = "'";
  for (const char c : path) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

static std::string output_name(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string lower = small_letters(name);
  const size_t dot = lower.ends_with(".vr.jpg") ? name.size() - 7 : name.rfind('.');
  return (names_eye(path) ? "corrected_%V" : "corrected") + (dot == std::string::npos ? "" : name.substr(dot));
}

std::string convert_command(const Subject& subject, const std::string& options) {
  std::string from;
  if (subject.format.layout.source == FormatSource::kOptions) {
    from += fmt::format(" `layout` {}", layout_name(subject.layout()));
  }
  if (subject.format.camera.projection != ProjectionSetting()) {
    from += fmt::format(" `projection` {}", projection_name(subject.projection()));
  }
  return fmt::format("ods convert {} -o {}{} {}", quoted(subject.path), output_name(subject.path), from, options);
}

}  // namespace ods
