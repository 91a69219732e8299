// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/save.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "ods/base/atomic_file.h"
#include "ods/base/error.h"
#include "ods/image/anaglyph.h"
#include "ods/image/camera_file.h"
#include "ods/image/image_file.h"

namespace ods {

using EyeList = std::vector<const EyeImage*>;

// --- what will be written ------------------------------------------------------------------------------------------

static Layout layout_for(const std::string& path, const SaveOptions& options) {
  return names_eye(path) ? Layout::kSeparate : options.layout;
}

static Error unfit(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kOutput, fmt::format("cannot write '{}': {}", path, why));
}

static void check_layout(const std::string& path, FileFormat format, const SaveOptions& options,
                         const std::vector<int>& eyes, Extent eye) {
  const Layout layout = layout_for(path, options);
  const bool stereo = eyes.size() == 2;
  if (layout == Layout::kMultiview && format != FileFormat::kExr) throw unfit(path, "only .exr holds multi-view");
  if (layout == Layout::kMultiview && !stereo) throw unfit(path, "multi-view needs both eyes");
  if (is_anaglyph(layout) && !stereo) throw unfit(path, "an anaglyph needs both eyes");
  if (is_anaglyph(layout) && is_scene_referred(format)) {
    throw unfit(path, "an anaglyph is what a display shows, and this format holds the scene's light; use .png");
  }
  if (layout == Layout::kSeparate && stereo && !names_eye(path)) {
    throw unfit(path, "separate eyes need %V (left, right) or %v (l, r) in the file name");
  }
  if (names_eye(path) && eyes[0] == kMono) throw unfit(path, "%V and %v name an eye, and a mono picture has none");

  const int count = static_cast<int>(eyes.size());
  const Extent squeeze = squeeze_of(layout, count);
  if (eye.width % squeeze.width != 0 || eye.height % squeeze.height != 0) {
    throw unfit(path, fmt::format("eyes of {}x{} pixels cannot be halved for {}; make their sides even", eye.width,
                                  eye.height, layout_name(layout)));
  }
  const Extent size = packed_size(layout, squeezed_eye(layout, eye, count), count);
  if (std::max(size.width, size.height) > longest_side(format)) {
    throw unfit(path, fmt::format("{}x{} pixels are too many for this format; use .exr, .tif or .png", size.width,
                                  size.height));
  }
}

static FileFormat format_for(const std::string& path) {
  const std::optional<FileFormat> format = format_of_path(path);
  if (!format) throw unfit(path, fmt::format("unknown extension; known are {}", known_extensions()));
  return *format;
}

bool keeps_layers(const std::string& path) {
  return format_of_path(path) == FileFormat::kExr;
}

void check_output(const std::string& path, const SaveOptions& options, const std::vector<int>& eyes, Extent eye) {
  assert(eyes.size() == 1 || eyes.size() == 2);
  check_layout(path, format_for(path), options, eyes, eye);
  for (int each : eyes) check_writable(names_eye(path) ? path_for_eye(path, each) : path);
}

// --- what stands in the header -------------------------------------------------------------------------------------

static void add_merge(std::vector<Attribute>& attributes, const std::string& name, const PoleMergeSetting& merge) {
  attributes.push_back({name, std::string(merge_name(merge.mode))});
  if (merge.mode == kMergeNone) return;
  attributes.push_back({name + "Start", merge.start});
  attributes.push_back({name + "End", merge.end});
  attributes.push_back({name + "Exponent", merge.exponent});
}

static void add_projection(std::vector<Attribute>& attributes, const ProjectionSetting& projection) {
  const auto pair = [&](const char* name, float a, float b) { attributes.push_back({name, std::vector<float>{a, b}}); };
  attributes.push_back({"ods:projection", std::string(projection_name(projection))});
  if (has_range(projection.kind) && !is_full_lat_long(projection)) {
    pair("ods:longitude", projection.longitude.x, projection.longitude.y);
    pair("ods:latitude", projection.latitude.x, projection.latitude.y);
  }
  if (has_lens(projection.kind)) {
    attributes.push_back({"ods:fov", projection.fov});
    pair("ods:look", projection.pan, projection.tilt);
  }
}

// What few cameras have is named only where it is.
static void add_extras(std::vector<Attribute>& attributes, const CameraRig& rig) {
  if (rig.convergence != kParallel) {
    attributes.push_back({"ods:convergence", std::string(convergence_name(rig.convergence))});
    attributes.push_back({"ods:convergenceDistance", rig.convergence_distance});
  }
  if (rig.neck != 0.0f) attributes.push_back({"ods:neck", rig.neck});
  if (rig.axis) attributes.push_back({"ods:axis", std::vector<float>{rig.axis->x, rig.axis->y, rig.axis->z}});
  if (rig.lens_radius > 0.0f) {
    attributes.push_back({"ods:lens", std::vector<float>{rig.lens_radius, rig.focus_distance}});
  }
  if (rig.mirrored) attributes.push_back({"ods:mirrored", 1});
}

static void add_camera(std::vector<Attribute>& attributes, const CameraRig& rig) {
  add_projection(attributes, rig.projection);
  attributes.push_back({"ods:depthType", std::string("ray")});
  attributes.push_back({"ods:ipd", rig.ipd});
  attributes.push_back({"ods:position", std::vector<float>{rig.position.x, rig.position.y, rig.position.z}});
  attributes.push_back({"ods:yaw", rig.yaw});
  attributes.push_back({"ods:pitch", rig.pitch});
  attributes.push_back({"ods:roll", rig.roll});
  add_merge(attributes, "ods:poleMergeTop", rig.top);
  add_merge(attributes, "ods:poleMergeBottom", rig.bottom);
  add_extras(attributes, rig);
}

static void add_exr(std::vector<Attribute>& attributes, const CameraRig* rig, Layout layout, const EyeList& eyes) {
  const auto text = [&](const char* name, std::string_view value) { attributes.push_back({name, std::string(value)}); };
  text("compression", "zip");
  // OpenImageIO would write the time of day, and the same picture would not be the same bytes.
  text("DateTime", "");
  // Rec. 709 primaries and D65: red, green, blue, white.
  attributes.push_back({"chromaticities", std::vector<float>{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f}});
  text("colorInteropID", "lin_rec709_scene");
  if (layout == Layout::kMultiview) {
    attributes.push_back({"multiView", std::vector<std::string>{"left", "right"}});
  }
  if (eyes.size() == 1 && rig != nullptr && is_full_lat_long(rig->projection)) {
    // OpenImageIO writes envmap for textures only, and would keep the file open for their smaller levels.
    text("textureformat", "LatLong Environment");
    attributes.push_back({"openexr:levelmode", 0});
  }
  if (eyes.size() == 1 && eyes[0]->eye != kMono) text("view", eye_name(eyes[0]->eye));
  text("ods:version", ODS_VERSION);
  text("ods:layout", eyes.size() == 2 ? layout_name(layout) : eye_name(eyes[0]->eye));
  if (rig != nullptr) add_camera(attributes, *rig);
}

// Google, "Photo Sphere XMP Metadata". Heading 0..360, pitch -90..90, roll -180..180; our -Z is its north.
static void add_gpano(std::vector<Attribute>& attributes, const CameraRig& rig, Extent size) {
  float yaw = rig.yaw, pitch = std::remainder(rig.pitch, 360.0f), roll = rig.roll;
  if (std::abs(pitch) > 90.0f) {  // looking over the pole: the same pose from the other side
    pitch = std::copysign(180.0f, pitch) - pitch;
    yaw += 180.0f;
    roll += 180.0f;
  }
  const float heading = std::remainder(yaw, 360.0f);
  attributes.push_back({"GPano:ProjectionType", std::string("equirectangular")});
  attributes.push_back({"GPano:UsePanoramaViewer", std::string("True")});
  const vec2 longitude = rig.projection.longitude, latitude = rig.projection.latitude;
  const float per_degree_x = static_cast<float>(size.width) / (longitude.y - longitude.x);
  const float per_degree_y = static_cast<float>(size.height) / (latitude.y - latitude.x);
  const auto pixels = [](float count) { return static_cast<int>(std::lround(count)); };
  attributes.push_back({"GPano:CroppedAreaImageWidthPixels", size.width});
  attributes.push_back({"GPano:CroppedAreaImageHeightPixels", size.height});
  attributes.push_back({"GPano:FullPanoWidthPixels", pixels(360.0f * per_degree_x)});
  attributes.push_back({"GPano:FullPanoHeightPixels", pixels(180.0f * per_degree_y)});
  attributes.push_back({"GPano:CroppedAreaLeftPixels", pixels((longitude.x + 180.0f) * per_degree_x)});
  attributes.push_back({"GPano:CroppedAreaTopPixels", pixels((90.0f - latitude.y) * per_degree_y)});
  attributes.push_back({"GPano:PoseHeadingDegrees", heading < 0.0f ? heading + 360.0f : heading});
  attributes.push_back({"GPano:PosePitchDegrees", pitch});
  attributes.push_back({"GPano:PoseRollDegrees", std::remainder(roll, 360.0f)});
  attributes.push_back({"GPano:StitchingSoftware", std::string("Omnistereo " ODS_VERSION)});
}

// GPano knows lat-long, whole or a part that does not cross the seam.
static bool fits_gpano(const ProjectionSetting& projection) {
  return projection.kind == kLatLong && projection.longitude.x >= -180.0f && projection.longitude.y <= 180.0f;
}

static bool carries_gpano(FileFormat format) {
  return format == FileFormat::kPng || format == FileFormat::kJpeg || format == FileFormat::kTiff;
}

// --- the pixels ----------------------------------------------------------------------------------------------------

struct Layer {
  const Image EyeImage::*image;
  std::string_view name;
  std::string_view channels;
  bool wide;  // always 32 bits
};
static const Layer kLayers[] = {{&EyeImage::radiance, "", "RGB", false},
                                {&EyeImage::depth, "", "Z", true},
                                {&EyeImage::normal, "N", "XYZ", false},
                                {&EyeImage::albedo, "albedo", "RGB", false}};

static std::string channel_name(const Layer& layer, char channel, std::string_view view, bool default_view) {
  std::string name;
  if (!layer.name.empty()) name += fmt::format("{}.", layer.name);
  if (!view.empty() && !(default_view && layer.name.empty())) name += fmt::format("{}.", view);
  return name + channel;
}

static void add_exr_channels(std::vector<Channel>& channels, const EyeImage& eye, std::string_view view,
                             bool default_view) {
  for (const Layer& layer : kLayers) {
    if ((eye.*layer.image).pixels.empty()) continue;
    for (char channel : layer.channels) {
      const Sample sample = layer.wide ? Sample::kFloat : Sample::kHalf;
      channels.push_back({channel_name(layer, channel, view, default_view), sample});
    }
  }
}

static float finite(float value, float lowest, float highest) {
  return std::isnan(value) ? 0.0f : std::clamp(value, lowest, highest);
}

// Where the rows of a file come from: every fill function below writes one row of one eye, squeezed, from its first
// row y on.
struct Rows {
  Extent squeeze;
  std::vector<float> scratch;

  // The mean of the pixels that become one; of depth, the one layer of one channel, the nearest: no mean is anywhere.
  const float* read(const Image& image, int y) {
    if (squeeze.width * squeeze.height == 1) return image.at(0, y);
    const float share = 1.0f / static_cast<float>(squeeze.width * squeeze.height);
    scratch.clear();
    for (int x = 0; x < image.width; x += squeeze.width) {
      for (int c = 0; c < image.channels; c++) {
        float sum = 0.0f, nearest = std::numeric_limits<float>::max();
        for (int i = 0; i < squeeze.width * squeeze.height; i++) {
          const float value = image.at(x + i % squeeze.width, y + i / squeeze.width)[c];
          sum += value * share;
          nearest = std::min(nearest, value);
        }
        scratch.push_back(image.channels == 1 ? nearest : sum);
      }
    }
    return scratch.data();
  }
};

// All layers; `stride` floats from pixel to pixel.
static void fill_exr_row(const EyeImage& eye, int y, Rows& rows, float* out, size_t stride) {
  for (const Layer& layer : kLayers) {
    const Image& image = eye.*layer.image;
    if (image.pixels.empty()) continue;
    const float limit = layer.wide ? std::numeric_limits<float>::max() : 65504.0f;
    const float* in = rows.read(image, y);
    for (int x = 0; x < image.width / rows.squeeze.width; x++) {
      for (int c = 0; c < image.channels; c++)
        out[static_cast<size_t>(x) * stride + static_cast<size_t>(c)] = finite(*in++, -limit, limit);
    }
    out += image.channels;
  }
}

static void fill_hdr_row(const EyeImage& eye, int y, Rows& rows, float* out) {
  const float kLimit = 1e38f;  // the shared exponent of RGBE ends before that of a float
  const float* in = rows.read(eye.radiance, y);
  for (int i = 0; i < 3 * eye.radiance.width / rows.squeeze.width; i++) out[i] = finite(in[i], 0.0f, kLimit);
}

static float* put_encoded(vec3 shown, float* out) {
  for (int c = 0; c < 3; c++) *out++ = srgb_encode(shown[c]);
  return out;
}

static void fill_display_row(const EyeImage& eye, int y, Rows& rows, const SaveOptions& options, float* out) {
  const float* in = rows.read(eye.radiance, y);
  for (int x = 0; x < eye.radiance.width / rows.squeeze.width; x++, in += 3) {
    out = put_encoded(tone_map(vec3(in[0], in[1], in[2]), options.exposure, options.tone), out);
  }
}

static void fill_anaglyph_row(const EyeList& eyes, int y, const SaveOptions& options, float* out) {
  const auto shown = [&](const EyeImage* eye, int x) {
    const float* in = eye->radiance.at(x, y);
    return tone_map(vec3(in[0], in[1], in[2]), options.exposure, options.tone);
  };
  for (int x = 0; x < eyes[0]->radiance.width; x++) {
    out = put_encoded(anaglyph_color(options.layout, shown(eyes[0], x), shown(eyes[1], x)), out);
  }
}

// --- one file ------------------------------------------------------------------------------------------------------

static Extent size_of(const EyeImage& eye) {
  return {eye.radiance.width, eye.radiance.height};
}

static FileHeader make_header(FileFormat format, Layout layout, const EyeList& eyes, const CameraRig* rig,
                              const SaveOptions& options) {
  const int count = static_cast<int>(eyes.size());
  const Extent size = packed_size(layout, squeezed_eye(layout, size_of(*eyes[0]), count), count);
  FileHeader header;
  header.format = format;
  header.width = size.width;
  header.height = size.height;
  header.attributes.push_back({"Software", std::string("Omnistereo " ODS_VERSION)});
  header.attributes.push_back({"oiio:ColorSpace", std::string(is_scene_referred(format) ? "Linear" : "sRGB")});
  if (carries_gpano(format) && count == 1 && rig != nullptr && fits_gpano(rig->projection)) {
    add_gpano(header.attributes, *rig, size);
  }

  Sample sample = Sample::kUint8;
  switch (format) {
    case FileFormat::kExr:
      add_exr(header.attributes, rig, layout, eyes);
      if (layout != Layout::kMultiview) add_exr_channels(header.channels, *eyes[0], "", true);
      if (layout == Layout::kMultiview) {
        for (const EyeImage* eye : eyes) {
          add_exr_channels(header.channels, *eye, eye_name(eye->eye), eye == eyes[0]);
        }
      }
      return header;
    case FileFormat::kHdr:
      sample = Sample::kFloat;
      break;
    case FileFormat::kJpeg:
      header.attributes.push_back({"jpeg:subsampling", std::string("4:4:4")});
      [[fallthrough]];
    case FileFormat::kWebp:
      header.attributes.push_back({"CompressionQuality", options.jpeg_quality});
      break;
    case FileFormat::kTiff:
      header.attributes.push_back({"compression", std::string("zip")});
      break;
    case FileFormat::kPng:
      break;
  }
  header.channels = {{"R", sample}, {"G", sample}, {"B", sample}};
  return header;
}

static void write_file(AtomicFile& file, FileFormat format, Layout layout, const EyeList& eyes, const CameraRig* rig,
                       const SaveOptions& options) {
  const FileHeader header = make_header(format, layout, eyes, rig, options);
  const int count = static_cast<int>(eyes.size());
  Rows rows{squeeze_of(layout, count), {}};
  const Extent eye_size = squeezed_eye(layout, size_of(*eyes[0]), count);
  const size_t stride = header.channels.size();
  const size_t step =
      layout == Layout::kMultiview ? stride / eyes.size() : static_cast<size_t>(eye_size.width) * stride;
  write_image(file, header, [&](int y, std::span<float> row) {
    if (is_anaglyph(layout)) return fill_anaglyph_row(eyes, y, options, row.data());
    float* out = row.data();
    for (const EyeRow& part : packed_row(layout, eye_size, count, y)) {
      const EyeImage& eye = *eyes[static_cast<size_t>(part.index)];
      const int first = part.y * rows.squeeze.height;
      if (format == FileFormat::kExr) {
        fill_exr_row(eye, first, rows, out, stride);
      } else if (format == FileFormat::kHdr) {
        fill_hdr_row(eye, first, rows, out);
      } else {
        fill_display_row(eye, first, rows, options, out);
      }
      out += step;
    }
  });
}

static std::vector<std::string> save_all(const Picture& picture, const CameraRig* rig, const SaveOptions& options,
                                         const std::string& path) {
  assert(picture.eyes.size() == 1 || picture.eyes.size() == 2);
  const FileFormat format = format_for(path);
  EyeList eyes;
  std::vector<int> which;
  for (const EyeImage& eye : picture.eyes) {
    eyes.push_back(&eye);
    which.push_back(eye.eye);
  }
  check_layout(path, format, options, which, size_of(picture.eyes[0]));

  const Layout layout = layout_for(path, options);
  std::list<AtomicFile> files;
  std::vector<std::string> names;
  const auto write = [&](const std::string& name, const EyeList& some) {
    write_file(files.emplace_back(name), format, layout, some, rig, options);
    names.push_back(name);
  };
  if (names_eye(path)) {
    for (const EyeImage* eye : eyes) write(path_for_eye(path, eye->eye), {eye});
  } else {
    write(path, eyes);
  }
  if (options.sidecar && rig) {
    names.push_back(sidecar_path(path));
    const std::string text = write_camera({*rig, size_of(picture.eyes[0]), layout, which});
    std::fwrite(text.data(), 1, text.size(), files.emplace_back(names.back()).stream());
  }
  commit_all(files);
  return names;
}

std::vector<std::string> save_picture(const Picture& picture, const CameraRig& rig, const SaveOptions& options,
                                      const std::string& path) {
  return save_all(picture, &rig, options, path);
}

std::vector<std::string> save_picture(const Picture& picture, const SaveOptions& options, const std::string& path) {
  return save_all(picture, nullptr, options, path);
}

}  // namespace ods
