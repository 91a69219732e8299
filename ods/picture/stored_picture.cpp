// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/stored_picture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/camera/odd_halves.h"
#include "ods/files/read_file.h"
#include "ods/files/scratch.h"
#include "ods/picture/channel_layers.h"
#include "ods/picture/checkerboard.h"
#include "ods/picture/cryptomatte.h"
#include "ods/picture/picture_files.h"
#include "ods/picture/stored_lenses.h"

namespace ods {

// --- the files -------------------------------------------------------------------------------------------------------

namespace {

// A layer of one view of a file, and the destination of its pixels.
struct Plane : ChannelLayer {
  std::byte* to = nullptr;
  bool is_read = true;
  size_t pixel_size() const { return channels.size() * bytes_of(sample); }
};

// One view of one file.
struct FileShare {
  RowReader* reader = nullptr;
  std::vector<Plane> planes;  // the first is the colour
};

}  // namespace

static FileShare make_share(RowReader& reader, const std::string& path, ViewChannels channels, bool color_only) {
  const FileInfo& info = reader.info();
  FileShare share{&reader, {}};
  std::optional<ChannelLayer> light = take_color(channels);
  // Display-referred files have their colour first, under any name.
  if (!light && !info.is_float && info.channels.size() >= 3) {
    light = ChannelLayer{"", {"R", "G", "B"}, {0, 1, 2}, LayerRule::kLight, {}};
  }
  if (!light) throw cannot_read(path, "it has no colour: no channels R, G and B");
  light->sample = info.samples[light->from[0]];
  for (size_t c : light->from) {
    if (info.samples[c] != light->sample) throw cannot_read(path, "its colour channels have different number types");
  }
  share.planes.push_back({*light});
  if (color_only || !info.is_float) return share;
  for (ChannelLayer& layer : other_layers(channels, reader)) share.planes.push_back({std::move(layer)});
  return share;
}

static bool same_layer(const Plane& a, const Plane& b) {
  return a.channels == b.channels && a.sample == b.sample && a.rule == b.rule;
}

// Keeps only the layers that both eyes have.
static void keep_common(std::vector<FileShare>& shares, const std::string& path, std::vector<std::string>& guesses) {
  if (shares.size() < 2) return;
  if (!same_layer(shares[0].planes[0], shares[1].planes[0])) {
    for (FileShare& share : shares) {
      share.planes[0].channels.resize(3);
      share.planes[0].from.resize(3);
    }
    if (!same_layer(shares[0].planes[0], shares[1].planes[0])) {
      throw cannot_read(path, "its eyes have different number types; convert one of them first");
    }
  }
  std::string lost;
  for (int i : {0, 1}) {
    std::vector<Plane>& planes = shares[static_cast<size_t>(i)].planes;
    const std::vector<Plane>& others = shares[static_cast<size_t>(1 - i)].planes;
    const auto alone = [&](const Plane& plane) {
      const bool found =
          std::any_of(others.begin(), others.end(), [&](const Plane& other) { return same_layer(plane, other); });
      if (!found) lost += " " + plane.channels[0];
      return !found;
    };
    planes.erase(std::remove_if(planes.begin() + 1, planes.end(), alone), planes.end());
  }
  if (!lost.empty()) guesses.push_back("only one eye has" + lost + ": left out");
}

static std::vector<FileShare> shares_of(Readers& readers, const std::string& path, Layout layout, bool color_only) {
  std::vector<FileShare> shares;
  if (layout != Layout::kMultiview) {
    for (const auto& reader : readers) {
      shares.push_back(make_share(*reader, path, channels_of_view(reader->info(), "", true), color_only));
    }
    return shares;
  }
  const FileInfo& info = readers[0]->info();
  const ViewChannels left = channels_of_view(info, "left", false), right = channels_of_view(info, "right", false);
  const ViewChannels bare = channels_of_view(info, "left", true);
  const auto has_color = [](ViewChannels channels) { return take_color(channels).has_value(); };
  if (!has_color(bare)) throw cannot_read(path, "it has the colour of the right view only");
  if (has_color(left) || has_color(right)) {
    shares.push_back(make_share(*readers[0], path, channels_of_view(info, "left", !has_color(left)), color_only));
    shares.push_back(make_share(*readers[0], path, channels_of_view(info, "right", !has_color(right)), color_only));
    return shares;
  }
  throw cannot_read(path, "it does not hold two views");
}

static size_t plane_size(const Plane& plane, const FileInfo& info) {
  const size_t size = plane.pixel_size() * static_cast<size_t>(info.width) * static_cast<size_t>(info.height);
  return (size + 63) / 64 * 64;
}

// --- the pixels ------------------------------------------------------------------------------------------------------

template <typename T>
static void gather(const std::byte* in, size_t stride, const std::vector<size_t>& offsets, std::byte* out, int width) {
  for (int x = 0; x < width; x++, in += stride) {
    for (size_t offset : offsets) {
      std::memcpy(out, in + offset, sizeof(T));
      out += sizeof(T);
    }
  }
}

namespace {

// The channels that are read, packed in this order.
struct Packing {
  size_t count = 0;
  std::vector<size_t> offsets;
  size_t stride = 0;
};

}  // namespace

static Packing packing_of(const FileInfo& info, const std::vector<FileShare>& shares, const RowReader* reader) {
  Packing packing;
  for (const FileShare& share : shares) {
    if (share.reader != reader) continue;
    for (const Plane& plane : share.planes) {
      if (!plane.is_read) continue;
      packing.count = std::max(packing.count, 1 + *std::max_element(plane.from.begin(), plane.from.end()));
    }
  }
  for (size_t c = 0; c < packing.count; c++) {
    packing.offsets.push_back(packing.stride);
    packing.stride += bytes_of(info.samples[c]);
  }
  return packing;
}

static void put_rows(const Plane& plane, const Packing& packing, const std::byte* band, int begin, int end, int width) {
  std::vector<size_t> offsets;
  for (size_t c : plane.from) offsets.push_back(packing.offsets[c]);
  const size_t columns = static_cast<size_t>(width);
  tbb::parallel_for(begin, end, [&](int y) {
    const std::byte* in = band + static_cast<size_t>(y - begin) * columns * packing.stride;
    std::byte* out = plane.to + static_cast<size_t>(y) * columns * plane.pixel_size();
    const size_t size = bytes_of(plane.sample);
    const auto copy = size == 1 ? gather<uint8_t> : size == 2 ? gather<uint16_t> : gather<uint32_t>;
    copy(in, packing.stride, offsets, out, width);
  });
}

// R, G and B come first, possibly in a named layer: albedo.R, ...
static bool is_color(const Plane& plane) {
  if (plane.rule == LayerRule::kNearest || plane.channels.size() < 3 || bytes_of(plane.sample) == 1) return false;
  constexpr const char* kNames[] = {"R", "G", "B"};
  for (size_t c = 0; c < 3; c++) {
    if (split_name(plane.channels[c]).second != kNames[c]) return false;
  }
  return true;
}

// Converts light of the file's primaries to Rec. 709, in place.
static void convert_rows(const Plane& plane, const ColorSpace& color, int begin, int end, int width) {
  const size_t pixel = plane.pixel_size(), size = bytes_of(plane.sample), columns = static_cast<size_t>(width);
  tbb::parallel_for(begin, end, [&](int y) {
    std::byte* const row = plane.to + static_cast<size_t>(y) * columns * pixel;
    std::vector<float> light(3 * columns);
    for (size_t x = 0; x < columns; x++) {
      vec3 rgb;
      for (size_t c = 0; c < 3; c++) rgb[static_cast<int>(c)] = sample_value(plane.sample, row + x * pixel + c * size);
      rgb = light_of_floats(color, rgb);
      std::copy_n(&rgb.x, 3, &light[3 * x]);
    }
    std::vector<std::byte> packed(light.size() * size);
    const SampleType samples[] = {plane.sample, plane.sample, plane.sample};
    pack_floats(samples, light, packed.data());
    for (size_t x = 0; x < columns; x++) std::memcpy(row + x * pixel, &packed[3 * x * size], 3 * size);
  });
}

// Reads directly into place if the file is a single layer, else band by band.
static void read_file(RowReader& reader, const std::vector<FileShare>& shares, const Scratch& memory) {
  const size_t kOften = size_t{64} << 20;  // bytes between calls of release()
  const FileInfo& info = reader.info();
  const Packing packing = packing_of(info, shares, &reader);
  std::vector<const Plane*> planes;
  for (const FileShare& share : shares) {
    if (share.reader != &reader) continue;
    for (const Plane& plane : share.planes) {
      if (plane.is_read) planes.push_back(&plane);
    }
  }
  std::vector<size_t> all(packing.count);
  std::iota(all.begin(), all.end(), size_t{0});
  const bool straight = planes.size() == 1 && planes[0]->from == all;
  const size_t row = static_cast<size_t>(info.width) * packing.stride;
  std::vector<std::byte> band(straight ? 0 : row * static_cast<size_t>(std::min(reader.band_rows(), info.height)));
  size_t held = 0;
  for (int begin = 0; begin < info.height; begin += reader.band_rows()) {
    const int end = std::min(begin + reader.band_rows(), info.height);
    reader.read(begin, end, packing.count, straight ? planes[0]->to + static_cast<size_t>(begin) * row : band.data());
    for (const Plane* plane : planes) {
      if (!straight) put_rows(*plane, packing, band.data(), begin, end, info.width);
      const bool foreign = info.is_float && !reader.color_space().has_our_primaries;
      if (foreign && is_color(*plane)) convert_rows(*plane, reader.color_space(), begin, end, info.width);
    }
    held += row * static_cast<size_t>(end - begin);
    if (held > kOften) memory.release(), held = 0;
  }
}

// --- the eyes --------------------------------------------------------------------------------------------------------

namespace {

// The first row and column of each eye in a packed image.
struct EyeView {
  int x = 0;
  int y = 0;
  int row_step = 1;
  int pixel_step = 1;
};

}  // namespace

static std::vector<EyeView> views_of(Layout layout, Extent eye, Extent whole) {
  std::vector<EyeView> views(2);
  const Extent file = packed_size(layout, eye, 2);
  for (int y = 0; y < file.height; y++) {
    for (const EyeRow& part : packed_row(layout, eye, 2, y)) {
      EyeView& view = views[static_cast<size_t>(part.index)];
      if (part.y == 0) view.x = part.x, view.y = y, view.pixel_step = part.step;
      if (part.y == 1) view.row_step = y - view.y;
    }
  }
  if (!arrangement_of(layout).is_halves()) return views;
  for (EyeView& view : views) {  // the second eye starts after the middle line, which an odd side leaves out
    view.x += view.x > 0 ? whole.width - file.width : 0;
    view.y += view.y > 0 ? whole.height - file.height : 0;
  }
  return views;
}

static StoredEye make_eye(int which, const FileShare& share, const EyeView& view) {
  StoredEye eye;
  eye.eye = which;
  const ptrdiff_t width = share.reader->info().width;
  for (const Plane& plane : share.planes) {
    const ptrdiff_t pixel = static_cast<ptrdiff_t>(plane.pixel_size()), row = width * pixel;
    const std::byte* first = plane.to != nullptr ? plane.to + view.y * row + view.x * pixel : nullptr;
    eye.layers.push_back(
        {plane.channels, plane.rule, plane.sample, first, view.pixel_step * pixel, view.row_step * row});
  }
  return eye;
}

static Extent eye_size(const StoredPicture& picture, const FileInfo& info, const std::string& path) {
  const std::optional<Extent> size =
      unpacked_size(picture.layout, without_middle(picture.layout, Extent{info.width, info.height}));
  if (!size) {
    throw cannot_read(
        path, fmt::format("{}x{} pixels are not two eyes, {}", info.width, info.height, layout_name(picture.layout)));
  }
  // A face of an equi-angular cube may begin within a pixel: video sites store it in 16:9.
  const bool is_eac = picture.camera.projection.kind == kEac;
  const int columns = is_eac ? 1 : width_step(picture.camera.projection);
  if (size->width * squeeze_of(picture.layout, 2).width % columns != 0) {
    throw cannot_read(path, fmt::format("{} has {} faces in a row, and {} pixels do not divide by that",
                                        projection_name(picture.camera.projection), columns, size->width));
  }
  return *size;
}

static std::shared_ptr<Scratch> make_room(std::vector<FileShare>& shares, const FileInfo& info,
                                          const OpenOptions& options) {
  std::vector<Plane*> planes;
  std::vector<size_t> starts{0};
  for (FileShare& share : shares) {
    for (Plane& plane : share.planes) {
      if (!plane.is_read) continue;
      planes.push_back(&plane);
      starts.push_back(starts.back() + plane_size(plane, info));
    }
  }
  auto memory = std::make_shared<Scratch>(starts.back(), options.scratch_folder, options.max_in_memory);
  for (size_t i = 0; i < planes.size(); i++) planes[i]->to = memory->data() + starts[i];
  return memory;
}

static std::vector<StoredEye> make_eyes(const std::vector<FileShare>& shares, Layout layout, Extent size, int eye) {
  if (shares.size() == 2) return {make_eye(kLeft, shares[0], {}), make_eye(kRight, shares[1], {})};
  const EyePacking how = arrangement_of(layout).how;
  if (how == EyePacking::kAlone) return {make_eye(eye, shares[0], {})};
  if (how == EyePacking::kCheckerboard) return {make_eye(kLeft, shares[0], {}), make_eye(kRight, shares[0], {})};
  const FileInfo& info = shares[0].reader->info();
  const std::vector<EyeView> views = views_of(layout, size, {info.width, info.height});
  return {make_eye(kLeft, shares[0], views[0]), make_eye(kRight, shares[0], views[1])};
}

static void leave_out_unreadable(std::vector<FileShare>& shares, const std::string& path,
                                 std::vector<std::string>& guesses) {
  std::vector<std::vector<std::string>> lost;
  for (const FileShare& share : shares) {
    for (const auto& [channel, number] : share.reader->beyond_floats()) {
      for (const Plane& plane : share.planes) {
        if (std::find(plane.from.begin(), plane.from.end(), channel) == plane.from.end()) continue;
        if (std::find(lost.begin(), lost.end(), plane.channels) != lost.end()) continue;
        if (&plane == &share.planes[0]) throw cannot_read(path, "its colours are integers too large for a float");
        lost.push_back(plane.channels);
        guesses.push_back(fmt::format("its channel {} has the integer {}, too large for a float: left out",
                                      share.reader->info().channels[channel], number));
      }
    }
  }
  for (FileShare& share : shares) {
    std::erase_if(share.planes, [&](const Plane& plane) {
      return std::find(lost.begin(), lost.end(), plane.channels) != lost.end();
    });
  }
}

// The metadata of the file, without the eyes.
static StoredPicture describe(const Readers& readers, StereoFormat format, const std::string& path) {
  const FileInfo& info = readers[0]->info();
  StoredPicture picture;
  picture.is_float = info.is_float;
  picture.layout = format.layout.layout.value_or(Layout::kSeparate);
  picture.layout_reason = format.layout.reason;
  picture.camera = format.camera;
  picture.has_ipd = format.has_ipd;
  picture.guesses = std::move(format.guesses);
  if (const auto mark = info.text.find("ods:rig"); mark != info.text.end()) picture.rig_mark = mark->second;
  picture.mattes = matte_attributes(info, path);
  for (const auto& reader : readers) {
    if (picture.color_fault.empty()) picture.color_fault = reader->info().color_fault;
  }
  if (!picture.color_fault.empty()) picture.guesses.push_back(picture.color_fault);
  if (info.unread_parts > 0)
    picture.guesses.push_back(fmt::format("it has {} more parts, which are not read", info.unread_parts));
  picture.size = eye_size(picture, info, path);
  return picture;
}

// --- the reader ------------------------------------------------------------------------------------------------------

struct PictureReader::State {
  std::string path;
  OpenOptions options;
  Readers readers;
  int eye = kMono;                  // for a picture of one eye
  std::vector<FileShare> shares{};  // point to the readers
  StoredPicture header{};
  std::shared_ptr<Scratch> memory{};  // of the pixels, once they are decoded
  std::vector<std::string> faults{};  // of the pixels

  void decode();
};

void PictureReader::State::decode() {
  if (memory) return;
  memory = make_room(shares, readers[0]->info(), options);
  for (const auto& reader : readers) read_file(*reader, shares, *memory);
  leave_out_unreadable(shares, path, faults);
  memory->release();
}

PictureReader::PictureReader(const std::string& path, const OpenOptions& options)
    : state_(new State{path, options, open_files(path)}) {
  set_format(options.format);
}

PictureReader::PictureReader(std::unique_ptr<State> state) : state_(std::move(state)) {}

PictureReader PictureReader::without_format(const std::string& path, const OpenOptions& options) {
  return PictureReader(std::unique_ptr<State>(new State{path, options, open_files(path)}));
}

PictureReader::~PictureReader() = default;
PictureReader::PictureReader(PictureReader&& other) noexcept = default;
PictureReader& PictureReader::operator=(PictureReader&& other) noexcept = default;

const FileInfo& PictureReader::info() const {
  return state_->readers[0]->info();
}

const StoredPicture& PictureReader::header() const {
  return state_->header;
}

void PictureReader::set_format(const FormatHint& known) {
  auto& [path, options, readers, eye, shares, header, memory, faults] = *state_;
  StereoFormat format = find_format(info(), path, known);
  if (format.is_photo && readers.size() == 1) {
    if (memory) readers = open_files(path), memory = nullptr;  // a reader reads its file once
    open_second_eye(readers, path, format.guesses);
  }
  StoredPicture found = describe(readers, format, path);
  const Extent shown = names_faces(path) ? found.size : shown_eye(info(), found.layout);
  if (known.projection && !known.camera) found.camera.projection = with_shape(found.camera.projection, shown);
  if (!memory) {
    shares = shares_of(readers, path, found.layout, options.color_only);
    keep_common(shares, path, found.guesses);
  }
  found.eyes = make_eyes(shares, found.layout, found.size, format.eye);
  for (StoredEye& stored : found.eyes) {
    for (LayerPixels& layer : stored.layers) layer.first = nullptr;
  }
  take_lenses(found, known, shown, path);
  header = std::move(found), eye = format.eye;
}

static void leave_out_unwanted(std::vector<FileShare>& shares, const PictureReader::Wants& wants) {
  for (FileShare& share : shares) {
    for (Plane& plane : share.planes) {
      std::vector<std::string> channels;
      std::vector<size_t> from;
      for (size_t c = 0; c < plane.channels.size(); c++) {
        if (wants(plane.channels[c])) channels.push_back(plane.channels[c]), from.push_back(plane.from[c]);
      }
      plane.is_read = !channels.empty();
      if (plane.is_read) plane.channels = std::move(channels), plane.from = std::move(from);
    }
  }
}

bool PictureReader::is_decoded() const {
  return state_->memory != nullptr;
}

StoredPicture PictureReader::whole() {
  State& state = *state_;
  if (state.shares.empty())
    state.shares = shares_of(state.readers, state.path, Layout::kSeparate, state.options.color_only);
  state.decode();
  StoredPicture picture;
  picture.is_float = info().is_float;
  picture.size = {info().width, info().height};
  picture.eyes = {make_eye(kMono, state.shares[0], {})};
  picture.eyes[0].layers.resize(1);
  picture.memory = state.memory;
  return picture;
}

StoredPicture PictureReader::read(const std::string& scratch_folder, const Wants& wants) {
  if (!state_->memory) leave_out_unwanted(state_->shares, wants);
  return read(scratch_folder);
}

StoredPicture PictureReader::read(const std::string& scratch_folder) {
  State& state = *state_;
  state.options.scratch_folder = scratch_folder;
  state.decode();
  StoredPicture picture = state.header;
  picture.memory = state.memory;
  picture.guesses.insert(picture.guesses.end(), state.faults.begin(), state.faults.end());
  picture.eyes = make_eyes(state.shares, picture.layout, picture.size, state.eye);
  for (size_t i = 0; i < picture.eyes.size(); i++) picture.eyes[i].eye = state.header.eyes[i].eye;
  const bool is_checkerboard = arrangement_of(picture.layout).how == EyePacking::kCheckerboard;
  if (is_checkerboard) take_checkerboard_apart(picture, state.options);
  return picture;
}

StoredPicture open_picture(const std::string& path, const OpenOptions& options) {
  return PictureReader(path, options).read(options.scratch_folder);
}

}  // namespace ods
