// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/save.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/files/byte_sink.h"
#include "ods/image/exif.h"
#include "ods/image/format/image_limits.h"
#include "ods/image/format/stereo_jpeg.h"
#include "ods/image/format/xmp.h"
#include "ods/image/image_file.h"
#include "ods/image/spatial_photo.h"
#include "ods/picture/anaglyph.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/metadata/vr_photo.h"
#include "ods/picture/stereo_file.h"

namespace ods {

// --- checks ----------------------------------------------------------------------------------------------------------

// The kind of file if its name asks for one that is made for two eyes.
static std::optional<StereoFile> stereo_file_of(const std::string& path, size_t eye_count) {
  return eye_count == 2 && !names_eye(path) ? stereo_file(path) : std::nullopt;
}

static Layout layout_for(const std::string& path, const SaveOptions& options, size_t eye_count) {
  const std::optional<StereoFile> kind = stereo_file_of(path, eye_count);
  return names_eye(path) || (kind && *kind != StereoFile::kJps) ? Layout::kSeparate : options.layout;
}

static Error unfit(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kUsage, fmt::format("cannot write '{}': {}", path, why));
}

static void check_layout(const std::string& path, FileFormat format, const SaveOptions& options,
                         const std::vector<int>& eyes, Extent eye) {
  const Layout layout = layout_for(path, options, eyes.size());
  const bool stereo = eyes.size() == 2;
  if (layout == Layout::kMultiview && format != FileFormat::kExr) throw unfit(path, "only .exr holds multi-view");
  if (layout == Layout::kMultiview && !stereo) throw unfit(path, "multi-view needs both eyes");
  if (is_anaglyph(layout) && !stereo) throw unfit(path, "an anaglyph needs both eyes");
  if (is_anaglyph(layout) && is_scene_referred(format)) {
    throw unfit(path, "an anaglyph is display-referred, but this format is scene-linear; use .png");
  }
  if (layout == Layout::kSeparate && stereo && !names_eye(path) && !stereo_file(path)) {
    throw unfit(path, "separate eyes need %V (left, right) or %v (l, r) in the file name");
  }
  if (stereo_file_of(path, eyes.size()) == StereoFile::kJps && !make_jps("\xff\xd8", layout_name(layout))) {
    throw unfit(path, fmt::format(".jps files cannot be {}: give another `layout`", layout_name(layout)));
  }
  if (format == FileFormat::kHeif) {
    if (!stereo_file_of(path, eyes.size())) throw unfit(path, "a .heic is a spatial photo, of two eyes; write .jpg");
    if (const std::string why = lacks_encoder(format); !why.empty()) throw unfit(path, why);
  }
  if (names_eye(path) && eyes[0] == kMono) throw unfit(path, "%V and %v stand for an eye, but the picture is mono");

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
  const std::string fault = image_size_fault(size.width, size.height);
  if (!fault.empty()) throw unfit(path, fault + ", beyond which ods could not read it; give a smaller width");
}

static FileFormat format_for(const std::string& path) {
  const std::optional<FileFormat> format = format_of_path(path);
  std::error_code ignored;
  if (path.ends_with('/') || (!format && std::filesystem::is_directory(path, ignored))) {
    throw unfit(path, fmt::format("it is a folder: add the name of a file, as in '{}'",
                                  (std::filesystem::path(path) / "picture.png").string()));
  }
  if (!format) throw unfit(path, fmt::format("unknown extension; known are {}", known_extensions()));
  return *format;
}

bool keeps_layers(const std::string& path) {
  return format_of_path(path) == FileFormat::kExr;
}

// A VR photo has GPano, an MPO none or GPano: readers take it for a window or for what GPano says. The cameras of a
// spatial photo have a field of view and no other projection.
static void check_stereo_file(const std::string& path, StereoFile kind, const ProjectionSetting& projection) {
  if (kind == StereoFile::kSpatial) {
    if (projection.kind == kPerspective) return;
    throw unfit(path, fmt::format("a .heic is a spatial photo, a flat window, and this is {}; write .jpg, or make it a "
                                  "`perspective` picture first",
                                  projection_name(projection)));
  }
  const bool is_window = projection.kind == kPerspective && kind != StereoFile::kVrPhoto;
  if (fits_gpano(projection) || is_window || kind == StereoFile::kJps) return;
  throw unfit(path, fmt::format("{} files hold {}lat-long or a part of it, and this is {}", stereo_file_extension(kind),
                                kind == StereoFile::kMpo ? "a window, " : "", projection_name(projection)));
}

void check_output(const std::string& path, const SaveOptions& options, const std::vector<int>& eyes, Extent eye,
                  const ProjectionSetting* projection) {
  assert(eyes.size() == 1 || eyes.size() == 2);
  check_layout(path, format_for(path), options, eyes, eye);
  const std::optional<StereoFile> kind = stereo_file_of(path, eyes.size());
  if (kind && projection != nullptr) check_stereo_file(path, *kind, *projection);
  for (int each : eyes) check_writable(names_eye(path) ? path_for_eye(path, each) : path);
}

// --- the header ----------------------------------------------------------------------------------------------------

static void add_exr(std::vector<Attribute>& attributes, const StereoCamera* camera, Layout layout,
                    const std::vector<int>& eyes) {
  const auto text = [&](const char* name, std::string_view value) { attributes.push_back({name, std::string(value)}); };
  // Rec. 709 primaries and D65: red, green, blue, white.
  attributes.push_back({"chromaticities", std::vector<float>{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f}});
  text("colorInteropID", "lin_rec709_scene");
  if (layout == Layout::kMultiview) {
    attributes.push_back({"multiView", std::vector<std::string>{"left", "right"}});
  }
  if (eyes.size() == 1 && eyes[0] != kMono) text("view", eye_name(eyes[0]));
  text("ods:version", ODS_VERSION);
  text("ods:layout", eyes.size() == 2 ? layout_name(layout) : eye_name(eyes[0]));
  if (camera != nullptr) add_camera(attributes, *camera);
}

static bool carries_gpano(FileFormat format) {
  return format == FileFormat::kPng || format == FileFormat::kJpeg || format == FileFormat::kTiff;
}

// The view comes before the last component, except in bare names of the default view.
static std::string channel_name(const std::string& channel, std::string_view view, bool is_default) {
  const size_t point = channel.rfind('.');
  const size_t last = point == std::string::npos ? 0 : point + 1;
  if (view.empty() || (is_default && last == 0)) return channel;
  return fmt::format("{}{}.{}", channel.substr(0, last), view, channel.substr(last));
}

static void add_exr_channels(std::vector<Channel>& channels, const std::vector<RowLayer>& layers, std::string_view view,
                             bool is_default) {
  for (const RowLayer& layer : layers) {
    for (const std::string& channel : layer.channels) {
      channels.push_back({channel_name(channel, view, is_default), layer.sample});
    }
  }
}

static bool has_alpha(const PictureRows& picture) {
  return picture.layers[0].channels.size() == 4;
}

static bool keeps_alpha(FileFormat format) {
  return format != FileFormat::kJpeg && format != FileFormat::kHdr && format != FileFormat::kHeif;
}

static bool keeps_alpha(FileFormat format, Layout layout) {
  return keeps_alpha(format) && !is_anaglyph(layout);
}

bool is_saved(const std::string& path) {
  std::error_code error;
  for (const int eye : {kLeft, kRight}) {
    const auto size = std::filesystem::file_size(path_for_eye(path, eye), error);
    if (error || size == 0) return false;
  }
  return true;
}

bool has_alpha(const std::string& path) {
  return keeps_alpha(format_for(path));
}

// --- the pixels ----------------------------------------------------------------------------------------------------

namespace {

// One output file, with some eyes of a picture.
struct File {
  const PictureRows& picture;
  std::vector<int> indices;  // indices of the eyes in this file
  FileFormat format;
  Layout layout;
  const SaveOptions& options;
  size_t channels;  // over all layers
  Extent squeeze;   // eye pixels per stored pixel

  std::vector<int> eyes() const {
    std::vector<int> which;
    for (int index : indices) which.push_back(picture.eyes[static_cast<size_t>(index)]);
    return which;
  }
};

}  // namespace

size_t count_channels(const std::vector<RowLayer>& layers) {
  size_t count = 0;
  for (const RowLayer& layer : layers) count += layer.channels.size();
  return count;
}

// Combines rows of pixels of an eye into one; `first` is the layer's first channel.
static void squeeze_layer(const RowLayer& layer, const std::vector<const float*>& pixels, size_t first, float* out) {
  const size_t count = layer.channels.size();
  if (layer.rule == LayerRule::kNearest) {
    const float* nearest = pixels[0] + first;
    for (const float* pixel : pixels) {
      if (pixel[first] < *nearest) nearest = pixel + first;
    }
    std::copy(nearest, nearest + count, out);
    return;
  }
  const float share = 1.0f / static_cast<float>(pixels.size());
  for (size_t c = 0; c < count; c++) {
    float sum = 0.0f;
    for (const float* pixel : pixels) sum += pixel[first + c] * share;
    out[c] = sum;
  }
}

// Row y of an eye as stored, that is, squeezed.
static std::vector<float> read_row(const File& file, int index, int y) {
  const Extent eye = file.picture.eye, squeeze = file.squeeze;
  const size_t length = static_cast<size_t>(eye.width) * file.channels;
  std::vector<float> rows(length * static_cast<size_t>(squeeze.height));
  for (int i = 0; i < squeeze.height; i++) {
    file.picture.fill(index, y * squeeze.height + i, {&rows[static_cast<size_t>(i) * length], length});
  }
  if (squeeze.width * squeeze.height == 1) return rows;
  std::vector<float> squeezed(length / static_cast<size_t>(squeeze.width));
  std::vector<const float*> pixels(static_cast<size_t>(squeeze.width * squeeze.height));
  for (size_t x = 0; x < squeezed.size() / file.channels; x++) {
    for (size_t i = 0; i < pixels.size(); i++) {
      const size_t column = x * static_cast<size_t>(squeeze.width) + i % static_cast<size_t>(squeeze.width);
      pixels[i] = &rows[i / static_cast<size_t>(squeeze.width) * length + column * file.channels];
    }
    size_t first = x * file.channels, channel = 0;
    for (const RowLayer& layer : file.picture.layers) {
      squeeze_layer(layer, pixels, channel, &squeezed[first + channel]);
      channel += layer.channels.size();
    }
  }
  return squeezed;
}

// Writes all layers, `stride` floats per pixel. Halves are clamped later, on conversion.
static void put_exr_row(const File& file, const std::vector<float>& row, float* out, size_t stride) {
  const float kLimit = std::numeric_limits<float>::max();
  for (size_t at = 0; at < row.size(); at += file.channels, out += stride) {
    for (size_t c = 0; c < file.channels; c++) out[c] = finite(row[at + c], -kLimit, kLimit);
  }
}

static void put_hdr_row(const File& file, const std::vector<float>& row, float* out) {
  const float kLimit = 1e38f;  // RGBE's shared exponent has a smaller range than a float's
  for (size_t at = 0; at < row.size(); at += file.channels) {
    for (size_t c = 0; c < 3; c++) *out++ = finite(row[at + c], 0.0f, kLimit);
  }
}

static vec3 shown(const File& file, const float* light, float alpha) {
  return tone_map(vec3(light[0], light[1], light[2]) / alpha, file.options.exposure, file.options.tone);
}

static float* put_encoded(vec3 color, float* out) {
  for (int c = 0; c < 3; c++) *out++ = srgb_encode(color[c]);
  return out;
}

static void put_display_row(const File& file, const std::vector<float>& row, float* out) {
  const bool keeps = has_alpha(file.picture) && keeps_alpha(file.format, file.layout);
  for (size_t at = 0; at < row.size(); at += file.channels) {
    const float alpha = keeps ? finite(row[at + 3], 0.0f, 1.0f) : 1.0f;
    out = put_encoded(shown(file, &row[at], alpha > 0.0f ? alpha : 1.0f), out);
    if (keeps) *out++ = alpha;
  }
}

static void put_anaglyph_row(const File& file, int y, float* out) {
  const std::vector<float> left = read_row(file, file.indices[0], y), right = read_row(file, file.indices[1], y);
  for (size_t at = 0; at < left.size(); at += file.channels) {
    const vec3 color = anaglyph_color(file.layout, shown(file, &left[at], 1.0f), shown(file, &right[at], 1.0f));
    out = put_encoded(color, out);
  }
}

// --- one file ------------------------------------------------------------------------------------------------------

static Extent stored_eye(const File& file) {
  return squeezed_eye(file.layout, file.picture.eye, static_cast<int>(file.indices.size()));
}

static FileHeader make_header(const File& file, const StereoCamera* camera) {
  const FileFormat format = file.format;
  const std::vector<int> eyes = file.eyes();
  const int count = static_cast<int>(eyes.size());
  const Extent size = packed_size(file.layout, stored_eye(file), count);
  FileHeader header;
  header.format = format;
  header.width = size.width;
  header.height = size.height;
  header.attributes.push_back({"Software", std::string("Omnistereo " ODS_VERSION)});
  header.writes_srgb = !is_scene_referred(format);
  header.quality = file.options.jpeg_quality;
  header.rows_alone = file.options.rows_alone;
  header.has_checksum = file.options.has_checksum;
  if (carries_gpano(format) && count == 1 && camera != nullptr && fits_gpano(camera->projection)) {
    add_gpano(header.attributes, *camera, size);
    std::ranges::copy_if(file.options.attributes, std::back_inserter(header.attributes), is_gpano);
  }
  if (format == FileFormat::kExr || format == FileFormat::kPng) {
    std::ranges::copy_if(file.options.attributes, std::back_inserter(header.attributes), std::not_fn(is_gpano));
  }
  if (!file.options.exif.empty()) header.exif = exif_for(file.options.exif, size);
  if (format == FileFormat::kExr) {
    add_exr(header.attributes, camera, file.layout, eyes);
    header.is_environment = count == 1 && camera != nullptr && is_full_lat_long(camera->projection);
    if (file.layout != Layout::kMultiview) add_exr_channels(header.channels, file.picture.layers, "", true);
    if (file.layout == Layout::kMultiview) {
      for (int eye : eyes) add_exr_channels(header.channels, file.picture.layers, eye_name(eye), eye == eyes[0]);
    }
    return header;
  }
  const SampleType sample = format == FileFormat::kHdr ? SampleType::kFloat : SampleType::kUint8;
  header.channels = {{"R", sample}, {"G", sample}, {"B", sample}};
  if (has_alpha(file.picture) && keeps_alpha(format, file.layout)) header.channels.push_back({"A", sample});
  return header;
}

// Copies the pixels of an eye's row that an interleaved row contains to their positions in it.
static void scatter_row(const std::vector<float>& eye, const EyeRow& part, size_t stride, std::span<float> row) {
  const auto first = static_cast<size_t>(part.first), every = static_cast<size_t>(part.every);
  size_t to = static_cast<size_t>(part.x);
  for (size_t x = first; x < eye.size() / stride; x += every, to += static_cast<size_t>(part.step)) {
    std::copy_n(&eye[x * stride], stride, &row[to * stride]);
  }
}

static void write_picture(ByteSink& out, const File& file, const StereoCamera* camera) {
  const FileHeader header = make_header(file, camera);
  const int count = static_cast<int>(file.indices.size());
  const Extent eye = stored_eye(file);
  const size_t stride = header.channels.size();
  const auto fill = [&](int y, std::span<float> row) {
    if (is_anaglyph(file.layout)) return put_anaglyph_row(file, y, row.data());
    for (const EyeRow& part : packed_row(file.layout, eye, count, y)) {
      const std::vector<float> made = read_row(file, file.indices[static_cast<size_t>(part.index)], part.y);
      const size_t start = file.layout == Layout::kMultiview ? static_cast<size_t>(part.index) * file.channels
                                                             : static_cast<size_t>(part.x) * stride;
      const bool scatters = part.step > 1;
      std::vector<float> whole(scatters ? static_cast<size_t>(eye.width) * stride : 0);
      float* to = scatters ? whole.data() : row.data() + start;
      if (file.format == FileFormat::kExr) {
        put_exr_row(file, made, to, stride);
      } else if (file.format == FileFormat::kHdr) {
        put_hdr_row(file, made, to);
      } else {
        put_display_row(file, made, to);
      }
      if (scatters) scatter_row(whole, part, stride, row);
    }
  };
  write_image(out, header, fill, file.picture.band_done);
}

// Writes both eyes as temporary JPEGs, then combines them.
static void write_vr_photo(AtomicFile& out, const PictureRows& picture, const StereoCamera* camera,
                           const SaveOptions& options) {
  if (camera == nullptr)
    throw unfit(out.path(), "a .vr.jpg needs camera metadata, but this picture's camera is unknown");
  std::list<AtomicFile> eyes;
  for (const int index : {0, 1}) {
    const File file{picture, {index}, FileFormat::kJpeg, Layout::kSeparate, options, count_channels(picture.layers),
                    {1, 1}};
    write_picture(eyes.emplace_back(out.path()), file, nullptr);
    eyes.back().finish();
  }
  const FileInput left(eyes.front().temporary()), right(eyes.back().temporary());
  write_photo(left, right.read(0, right.size()), *camera, picture.eye, out);
}

// Both eyes of a window whose middle is straight ahead of each.
static SpatialCameras cameras_of(const std::string& path, const StereoCamera* camera) {
  if (camera == nullptr) throw unfit(path, "a .heic needs camera metadata, but this picture's camera is unknown");
  if (camera->convergence != kParallel) {
    throw unfit(path, "the cameras of a .heic are parallel, and these converge: set `convergence` to parallel");
  }
  if (!(camera->ipd > 0.0f)) throw unfit(path, "the cameras of a .heic are at two places, and the eye distance is 0");
  return {static_cast<double>(camera->projection.fov), static_cast<double>(camera->ipd)};
}

static void write_stereo_file(AtomicFile& out, StereoFile kind, const PictureRows& picture, const StereoCamera* camera,
                              const SaveOptions& options) {
  const auto file_of = [&](const std::vector<int>& indices, Layout layout, FileFormat format = FileFormat::kJpeg) {
    MemorySink memory(out.path());
    const Extent squeeze = squeeze_of(layout, static_cast<int>(indices.size()));
    write_picture(memory, {picture, indices, format, layout, options, count_channels(picture.layers), squeeze}, camera);
    return memory.take();
  };
  if (camera != nullptr) check_stereo_file(out.path(), kind, camera->projection);
  std::optional<std::string> bytes;
  switch (kind) {
    case StereoFile::kVrPhoto:
      return write_vr_photo(out, picture, camera, options);
    case StereoFile::kMpo:
      bytes = make_mpo(file_of({0}, Layout::kSeparate), file_of({1}, Layout::kSeparate));
      break;
    case StereoFile::kSpatial: {
      const SpatialCameras cameras = cameras_of(out.path(), camera);
      const auto eye = [&](int index) { return file_of({index}, Layout::kSeparate, FileFormat::kHeif); };
      const std::string exif = options.exif.empty() ? "" : exif_for(options.exif, picture.eye);
      bytes = make_spatial_photo(eye(0), eye(1), cameras, exif);
      break;
    }
    case StereoFile::kJps:
      bytes = make_jps(file_of({0, 1}, options.layout), layout_name(options.layout));
      break;
  }
  out.write(bytes->data(), bytes->size());
}

std::vector<std::string> save_picture(const PictureRows& picture, const StereoCamera* camera,
                                      const SaveOptions& options, const std::string& path) {
  assert(picture.eyes.size() == 1 || picture.eyes.size() == 2);
  const FileFormat format = format_for(path);
  check_layout(path, format, options, picture.eyes, picture.eye);
  const Layout layout = layout_for(path, options, picture.eyes.size());
  std::list<AtomicFile> files;
  std::vector<std::string> names;
  const auto write = [&](const std::string& name, const std::vector<int>& indices) {
    const Extent squeeze = squeeze_of(layout, static_cast<int>(indices.size()));
    const File file{picture, indices, format, layout, options, count_channels(picture.layers), squeeze};
    write_picture(files.emplace_back(name), file, camera);
    names.push_back(name);
  };
  std::vector<int> all;
  for (int i = 0; i < static_cast<int>(picture.eyes.size()); i++) all.push_back(i);
  if (names_eye(path)) {
    for (int i : all) write(path_for_eye(path, picture.eyes[static_cast<size_t>(i)]), {i});
  } else if (const auto kind = stereo_file_of(path, picture.eyes.size())) {
    write_stereo_file(files.emplace_back(path), *kind, picture, camera, options);
    names.push_back(path);
  } else {
    write(path, all);
  }
  // An existing sidecar is rewritten, too, because it describes the replaced picture.
  std::error_code ignored;
  if (camera && (options.sidecar || std::filesystem::exists(sidecar_path(path), ignored))) {
    names.push_back(sidecar_path(path));
    const std::string text = write_sidecar({*camera, picture.eye, layout, picture.eyes});
    std::fwrite(text.data(), 1, text.size(), files.emplace_back(names.back()).stream());
  }
  commit_all(files);
  return names;
}

std::string eye_bytes(const PictureRows& picture, int index, FileFormat format, const SaveOptions& options) {
  const std::string name = fmt::format("the {} eye", eye_name(picture.eyes[static_cast<size_t>(index)]));
  if (std::max(picture.eye.width, picture.eye.height) > longest_side(format)) {
    throw unfit(name, fmt::format("{}x{} pixels are too many for this format", picture.eye.width, picture.eye.height));
  }
  MemorySink memory(name);
  const File file{picture, {index}, format, Layout::kSeparate, options, count_channels(picture.layers), {1, 1}};
  write_picture(memory, file, nullptr);
  return memory.take();
}

}  // namespace ods
