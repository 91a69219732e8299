// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/tag_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/image/exr_attributes.h"
#include "ods/image/jpeg_segments.h"
#include "ods/image/metadata.h"
#include "ods/image/png_chunks.h"
#include "ods/image/tiff_directory.h"
#include "ods/image/xmp_file.h"

namespace ods {

static Error unusable(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot tag '{}': {}", path, why));
}

// Of the four that can be tagged.
static FileFormat format_of(const FileInput& file) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (!format || *format == FileFormat::kWebp || *format == FileFormat::kHdr) {
    throw unusable(file.path(),
                   "it is neither a film (mp4, mov, mkv, webm) nor a picture that can say what it is "
                   "(jpg, png, tif, exr)");
  }
  return *format;
}

// --- what is there ---------------------------------------------------------------------------------------------------

static Extent size_of(const FileInput& file, FileFormat format) {
  if (format == FileFormat::kJpeg) return jpeg_size(read_jpeg_headers(file)).value_or(Extent());
  if (format == FileFormat::kPng) return png_size(file);
  const TiffDirectory directory = read_tiff_directory(file);
  const auto side = [&](uint16_t tag) {
    return static_cast<int>(std::min<uint64_t>(tiff_number(file, directory, tag).value_or(0), 1u << 30u));
  };
  return {side(kTiffWidth), side(kTiffHeight)};
}

FileInfo read_picture_header(const std::string& path) {
  const FileInput file(path);
  const FileFormat format = format_of(file);
  FileInfo info;
  if (format == FileFormat::kExr) {
    info = exr_info(read_exr_header(file));
  } else {
    const Extent size = size_of(file, format);
    info.width = size.width;
    info.height = size.height;
    info.channels = {"R", "G", "B"};
  }
  if (info.width < 1 || info.height < 1) throw unusable(path, "it has no pixels");
  return info;
}

PictureTag complete_tag(const KnownForm& known, const std::string& path, std::vector<std::string>& guesses) {
  const FileInfo info = read_picture_header(path);
  const PictureForm form = find_form(info, path, known);
  PictureTag tag{form.camera, form.layout.layout, form.eye, form.ipd_is_said};
  if (!known.projection && !form.camera_is_said && read_name(path).projection == nullptr) {
    const Layout layout = tag.layout.value_or(Layout::kSeparate);
    const Extent eye = unpacked_size(layout, {info.width, info.height}).value_or(Extent{1, 1});
    const Extent squeeze = squeeze_of(layout, 2);
    if (natural_height(form.camera.projection, eye.width * squeeze.width) != eye.height * squeeze.height) {
      throw unusable(path, fmt::format("neither its name (_360, _360_TB ...) nor its shape ({}x{}) tells what it "
                                       "shows: say it with --layout and --projection",
                                       info.width, info.height));
    }
  }
  guesses = form.guesses;
  return tag;
}

// --- GPano -----------------------------------------------------------------------------------------------------------

static std::vector<Attribute> gpano_of(const FileInput& file, FileFormat format, const PictureTag& tag) {
  if (tag.layout && *tag.layout != Layout::kSeparate) {
    throw unusable(file.path(), fmt::format("GPano knows no stereo, and viewers would wrap both eyes ({}) around one "
                                            "sphere. Its name tells players (_360_TB, _180_LR ...); ods convert makes "
                                            "a photo of both eyes of it: -o NAME.vr.jpg",
                                            layout_name(*tag.layout)));
  }
  if (!fits_gpano(tag.rig.projection)) {
    throw unusable(file.path(), fmt::format("GPano knows lat-long and parts of it that do not cross the seam, and has "
                                            "no word for {}",
                                            projection_name(tag.rig.projection)));
  }
  std::vector<Attribute> properties;
  add_gpano(properties, tag.rig, size_of(file, format));
  return properties;
}

static void tag_xmp(const FileInput& file, AtomicFile& to, FileFormat format, const std::optional<PictureTag>& tag) {
  const std::string old = read_xmp(file);
  if (!tag && old.empty()) return file.copy(0, file.size(), to);
  const std::vector<Attribute> properties = tag ? gpano_of(file, format, *tag) : std::vector<Attribute>();
  const std::optional<std::string> packet = old.empty() ? make_xmp(properties) : replace_gpano(old, properties);
  if (!packet) throw unusable(file.path(), "its XMP cannot be understood; remove it first with another program");
  write_xmp(file, to, says_something(*packet) ? *packet : "");
}

// --- EXR -------------------------------------------------------------------------------------------------------------

// Other programs' pictures are not said to have a distance of eyes or a depth that nobody knows of.
static bool needs_said_camera(const std::string& name) {
  return name == "ods:depthType" || name == "ods:ipd" || name == "ods:position" || name.starts_with("ods:poleMerge");
}

static std::vector<ExrAttribute> exr_words(const PictureTag& tag) {
  std::vector<Attribute> words{{"ods:version", std::string(ODS_VERSION)},
                               {"ods:layout", std::string(tag.layout ? layout_name(*tag.layout) : eye_name(tag.eye))}};
  add_camera(words, tag.rig);
  if (tag.layout == Layout::kMultiview) words.push_back({"multiView", std::vector<std::string>{"left", "right"}});
  if (!tag.layout && tag.eye != kMono) words.push_back({"view", std::string(eye_name(tag.eye))});
  std::vector<ExrAttribute> attributes;
  for (const Attribute& word : words) {
    if (tag.camera_is_said || !needs_said_camera(word.name)) attributes.push_back(exr_attribute(word));
  }
  // 0: lat-long. It is of one eye: two in one picture are none that a renderer could look up.
  if (!tag.layout && is_full_lat_long(tag.rig.projection)) {
    attributes.push_back({"envmap", "envmap", std::string(1, '\0')});
  }
  return attributes;
}

static void tag_exr(const FileInput& file, AtomicFile& to, const std::optional<PictureTag>& tag) {
  ExrHeader header = read_exr_header(file);
  std::erase_if(header.attributes, [](const ExrAttribute& each) {
    return each.name.starts_with("ods:") || each.name == "envmap" || each.name == "view" ||
           each.name == "textureformat";
  });
  for (const ExrAttribute& word : tag ? exr_words(*tag) : std::vector<ExrAttribute>()) {
    const auto is_same = [&](const ExrAttribute& each) { return each.name == word.name; };
    // Which view has the bare names is for the file to say, where it does.
    if (std::any_of(header.attributes.begin(), header.attributes.end(), is_same)) continue;
    header.attributes.push_back(word);
  }
  write_exr_header(file, to, header);
}

void tag_picture(const std::string& path, const std::string& to, const std::optional<PictureTag>& tag) {
  const FileInput file(path);
  const FileFormat format = format_of(file);
  AtomicFile output(to);
  if (format == FileFormat::kExr) {
    tag_exr(file, output, tag);
  } else {
    tag_xmp(file, output, format, tag);
  }
  file.give_mode(output);
  output.commit();
}

}  // namespace ods
