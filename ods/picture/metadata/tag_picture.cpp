// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/tag_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/camera/camera_fields.h"
#include "ods/image/format/exr_header.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/stereo_jpeg.h"
#include "ods/image/format/tiff_directory.h"
#include "ods/image/format/xmp_file.h"
#include "ods/image/orientation.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/sidecar.h"

namespace ods {

static Error unusable(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot tag '{}': {}", path, why));
}

// The file's format, if it is one of the four that can be tagged.
static FileFormat format_of(const FileInput& file) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (!format || *format == FileFormat::kWebp || *format == FileFormat::kHdr || *format == FileFormat::kHeif) {
    throw unusable(
        file.path(),
        "it is neither a video (mp4, mov, mkv, webm) nor a picture with room for 360 metadata "
        "(jpg, png, tif, exr)" +
            (format ? "; ods convert makes one of it" : taken_by(file.read(0, std::min<uint64_t>(file.size(), 64)))));
  }
  return *format;
}

// --- the file's own metadata -----------------------------------------------------------------------------------------

static Extent stored_size(const FileInput& file, FileFormat format) {
  if (format == FileFormat::kJpeg) return jpeg_size(read_jpeg_headers(file)).value_or(Extent());
  if (format == FileFormat::kPng) return png_size(file);
  const TiffDirectory directory = read_tiff_directory(file);
  const auto side = [&](uint16_t tag) {
    return static_cast<int>(std::min<uint64_t>(tiff_number(file, directory, tag).value_or(0), 1u << 30u));
  };
  return {side(kTiffWidth), side(kTiffHeight)};
}

// The size of the picture as displayed.
static Extent size_of(const FileInput& file, FileFormat format) {
  const Extent stored = stored_size(file, format);
  return orientation_of(file) >= 5 ? Extent{stored.height, stored.width} : stored;
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
    if (format == FileFormat::kJpeg) add_stereo(info, read_stereo_jpeg(file));
  }
  if (info.width < 1 || info.height < 1) throw unusable(path, "it has no pixels");
  return info;
}

PictureTag complete_tag(const FormatHint& known, const std::string& path, std::vector<std::string>& guesses) {
  const FileInfo info = read_picture_header(path);
  const StereoFormat format = find_format(info, path, known);
  PictureTag tag{format.camera, format.layout.layout, format.eye, format.has_ipd};
  if (const auto own = known.camera || info.is_float ? std::nullopt : gpano_camera(read_xmp(path))) {
    if (!known.projection) tag.camera.projection = own->projection;  // the sidecar may contradict the file
    tag.camera.yaw = own->yaw, tag.camera.pitch = own->pitch, tag.camera.roll = own->roll;
  }
  const std::optional<Extent> eye = whole_eye(tag.layout.value_or(Layout::kSeparate), {info.width, info.height});
  if (!eye) {
    throw unusable(path, fmt::format("{}x{} pixels are not two eyes, {}: give another `layout`", info.width,
                                     info.height, layout_name(*tag.layout)));
  }
  const bool is_known = known.projection || known.seen || format.has_camera || read_name(path).projection != nullptr;
  if (!is_known && !is_told_by_shape(format.camera.projection, *eye)) {
    throw unusable(path, fmt::format("neither its name (_360, _360_TB ...) nor its shape ({}x{}) identifies "
                                     "its format: give `layout` and `projection`",
                                     info.width, info.height));
  }
  guesses = format.guesses;
  return tag;
}

// --- GPano -----------------------------------------------------------------------------------------------------------

static std::vector<Attribute> gpano_of(const FileInput& file, FileFormat format, const PictureTag& tag) {
  if (tag.layout && *tag.layout != Layout::kSeparate) {
    throw unusable(file.path(),
                   fmt::format("GPano has no stereo, and viewers would wrap both eyes ({}) around one "
                               "sphere. Players recognize it by its name (_360_TB, _180_LR ...); ods convert makes "
                               "a photo with both eyes: -o NAME.vr.jpg",
                               layout_name(*tag.layout)));
  }
  if (!fits_gpano(tag.camera.projection)) {
    throw unusable(file.path(), fmt::format("GPano has lat-long and parts of it that do not cross the seam, "
                                            "but not {}",
                                            projection_name(tag.camera.projection)));
  }
  std::vector<Attribute> properties;
  add_gpano(properties, tag.camera, size_of(file, format));
  return properties;
}

// Returns whether readers of GPano need a property, which is then added if a camera has left it out.
static bool is_needed(const std::string& name) {
  return name == "GPano:ProjectionType" || name.starts_with("GPano:CroppedArea") || name.starts_with("GPano:FullPano");
}

// The new packet. A packet with the same values is kept. Otherwise only the GPano properties that differ change; the
// others, such as the initial view, are kept.
static std::optional<std::string> tagged_packet(const FileInput& file, FileFormat format, const PictureTag& tag,
                                                const std::string& old) {
  std::vector<Attribute> wanted = gpano_of(file, format, tag);
  if (old.empty()) return make_xmp(wanted);
  const std::optional<StereoCamera> stereo = gpano_camera(old);
  std::vector<Attribute> before, kept = gpano_properties(old);
  if (stereo) add_gpano(before, *stereo, size_of(file, format));
  const auto named = [](std::vector<Attribute>& list, const std::string& name) {
    return std::find_if(list.begin(), list.end(), [&](const Attribute& each) { return each.name == name; });
  };
  bool has_changed = false;
  for (const Attribute& each : wanted) {
    const auto was = named(before, each.name), there = named(kept, each.name);
    const bool is_missing = there == kept.end() && is_needed(each.name);
    if (!is_missing && was != before.end() && was->value == each.value) continue;
    has_changed = true;
    if (there == kept.end()) {
      kept.push_back(each);
    } else {
      there->value = each.value;
    }
  }
  return has_changed ? replace_gpano(old, kept) : old;
}

static void tag_xmp(const FileInput& file, AtomicFile& to, FileFormat format, const std::optional<PictureTag>& tag) {
  const std::string old = read_xmp(file);
  if (!tag && old.empty()) return file.copy(0, file.size(), to);
  const std::optional<std::string> packet = tag ? tagged_packet(file, format, *tag, old) : replace_gpano(old, {});
  if (!packet) throw unusable(file.path(), "its XMP cannot be parsed; remove it first with another program");
  write_xmp(file, to, has_properties(*packet) ? *packet : "");
}

// --- EXR -------------------------------------------------------------------------------------------------------------

// The eye distance and depth type of other programs' pictures are unknown, so they are not written.
static bool needs_said_camera(const std::string& name) {
  return name == "ods:depthType" || name == "ods:ipd" || name == "ods:position" || name == "ods:headTilt" ||
         name.starts_with("ods:poleMerge");
}

static std::vector<ExrAttribute> exr_metadata(const PictureTag& tag) {
  std::vector<Attribute> words{{"ods:version", std::string(ODS_VERSION)},
                               {"ods:layout", std::string(tag.layout ? layout_name(*tag.layout) : eye_name(tag.eye))}};
  add_camera(words, tag.camera);
  if (tag.layout == Layout::kMultiview) words.push_back({"multiView", std::vector<std::string>{"left", "right"}});
  if (!tag.layout && tag.eye != kMono) words.push_back({"view", std::string(eye_name(tag.eye))});
  std::vector<ExrAttribute> attributes;
  for (const Attribute& word : words) {
    if (tag.has_camera || !needs_said_camera(word.name)) attributes.push_back(exr_attribute(word));
  }
  // 0: lat-long. Only for one eye, because a renderer cannot use a picture that contains two.
  if (!tag.layout && is_full_lat_long(tag.camera.projection)) {
    attributes.push_back({"envmap", "envmap", std::string(1, '\0')});
  }
  return attributes;
}

// Attributes outside the tag's scope are kept: the default view, the writer, maps (which only a sidecar contains), and,
// if the camera is unknown, all but projection and orientation.
static bool stays(const ExrAttribute& there, const PictureTag& tag) {
  if (there.name == "multiView" || there.name == "ods:version") return true;
  const bool may_be_map = there.name.starts_with("ods:poleMerge") || there.name == "ods:headTilt";
  if (may_be_map && there.value == "map") return true;
  return !tag.has_camera && needs_said_camera(there.name);
}

// Attributes that a tag sets or omits; without a tag, all attributes that we ever write.
static bool is_ours(const std::string& name, bool has_tag) {
  if (name == "envmap" || name == "view") return true;
  if (!name.starts_with("ods:")) return false;
  const auto is_of = [&](const auto& row) {
    return name.starts_with(row.attribute.substr(0, row.attribute.find('#')));
  };
  return !has_tag || name == "ods:mirrored" || name == "ods:headTilt" || std::ranges::any_of(camera_fields(), is_of) ||
         std::ranges::any_of(camera_modes(), is_of);
}

static void tag_exr(const FileInput& file, AtomicFile& to, const std::optional<PictureTag>& tag) {
  ExrHeader header = read_exr_header(file);
  std::vector<ExrAttribute> words = tag ? exr_metadata(*tag) : std::vector<ExrAttribute>();
  const auto word_of = [&](const std::string& name) {
    return std::find_if(words.begin(), words.end(), [&](const ExrAttribute& word) { return word.name == name; });
  };
  const bool is_envmap = word_of("envmap") != words.end();
  std::vector<ExrAttribute> attributes;
  for (const ExrAttribute& there : header.attributes) {
    const auto word = word_of(there.name);
    const bool is_old_envmap = there.name == "textureformat" && !is_envmap;  // OpenImageIO's name for it
    if (tag && stays(there, *tag)) {
      attributes.push_back(there);
    } else if (word != words.end()) {
      attributes.push_back(*word);
    } else if (!is_old_envmap && !is_ours(there.name, tag.has_value())) {
      attributes.push_back(there);
    }
    if (word != words.end()) words.erase(word);
  }
  header.attributes = std::move(attributes);
  header.attributes.insert(header.attributes.end(), words.begin(), words.end());
  write_exr_header(file, to, header);
}

// --- sidecar ---------------------------------------------------------------------------------------------------------

// Commands that open the picture give precedence to its sidecar, so it must not contradict the tag.
static void retag_sidecar(const std::string& picture, const PictureTag& tag) {
  const std::string path = sidecar_path(picture);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return;
  Sidecar sidecar;
  try {
    std::vector<std::string> unknown_keys;
    sidecar = load_sidecar(path, unknown_keys);
  } catch (const Error&) {
    return;  // reported by complete_tag()
  }
  if (!belongs_to(sidecar, read_picture_header(picture))) return;
  const std::string before = write_sidecar(sidecar);
  sidecar.camera.projection = tag.camera.projection;
  sidecar.camera.yaw = tag.camera.yaw, sidecar.camera.pitch = tag.camera.pitch, sidecar.camera.roll = tag.camera.roll;
  if (write_sidecar(sidecar) != before) save_sidecar(sidecar, path);
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
  if (tag) retag_sidecar(to, *tag);
}

}  // namespace ods
