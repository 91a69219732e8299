// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/exr_files.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <algorithm>

namespace ods {

const std::vector<std::string>& names_of_packings() {
  static const std::vector<std::string> names = {"none",  "rle", "zips", "zip",  "piz",
                                                 "pxr24", "b44", "b44a", "dwaa", "dwab"};  // in the order of Imf's
  return names;
}

static Imf::PixelType type_of(const ExrForm& form, size_t channel) {
  return form.types.empty() ? Imf::HALF : form.types[channel];
}

static size_t bytes_of(Imf::PixelType type) {
  return type == Imf::HALF ? 2 : 4;
}

static size_t bytes_of_pixel(const ExrForm& form) {
  size_t bytes = 0;
  for (size_t c = 0; c < form.channels.size(); c++) bytes += bytes_of(type_of(form, c));
  return bytes;
}

size_t bytes_of_pixels(const ExrForm& form) {
  return bytes_of_pixel(form) * static_cast<size_t>(form.width) * static_cast<size_t>(form.height);
}

static Imf::Header header_of(const ExrForm& form, size_t part) {
  const Imath::Box2i window({form.left, form.top}, {form.left + form.width - 1, form.top + form.height - 1});
  Imf::Header header(window, window);
  const auto& names = names_of_packings();
  header.compression() = static_cast<Imf::Compression>(std::ranges::find(names, form.packing) - names.begin());
  header.lineOrder() = form.order;
  for (size_t c = 0; c < form.channels.size(); c++) {
    header.channels().insert(form.channels[c], Imf::Channel(type_of(form, c)));
  }
  if (form.tile > 0) {
    const auto side = static_cast<unsigned>(form.tile);
    header.setTileDescription(Imf::TileDescription(side, side));
  }
  header.setType(form.tile > 0 ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  header.setName("part " + std::to_string(part));
  if (form.prepare) form.prepare(header);
  return header;
}

static Imf::FrameBuffer buffer_of(const ExrForm& form, const std::byte* pixels) {
  Imf::FrameBuffer buffer;
  const size_t pixel = bytes_of_pixel(form), row = pixel * static_cast<size_t>(form.width);
  // OpenEXR only reads the pixels that it writes.
  char* at = reinterpret_cast<char*>(const_cast<std::byte*>(pixels)) - static_cast<ptrdiff_t>(pixel) * form.left -
             static_cast<ptrdiff_t>(row) * form.top;
  for (size_t c = 0; c < form.channels.size(); c++) {
    buffer.insert(form.channels[c], Imf::Slice(type_of(form, c), at, pixel, row));
    at += bytes_of(type_of(form, c));
  }
  return buffer;
}

void write_exr(const std::string& path, const std::vector<ExrForm>& parts,
               const std::vector<std::vector<std::byte>>& pixels) {
  std::vector<Imf::Header> headers;
  for (size_t i = 0; i < parts.size(); i++) headers.push_back(header_of(parts[i], i));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (size_t i = 0; i < parts.size(); i++) {
    const Imf::FrameBuffer buffer = buffer_of(parts[i], pixels[i].data());
    if (parts[i].tile > 0) {
      Imf::TiledOutputPart part(file, static_cast<int>(i));
      part.setFrameBuffer(buffer);
      part.writeTiles(0, part.numXTiles() - 1, 0, part.numYTiles() - 1);
    } else {
      Imf::OutputPart part(file, static_cast<int>(i));
      part.setFrameBuffer(buffer);
      part.writePixels(parts[i].height);
    }
  }
}

void write_exr_of(const std::string& path, const ExrForm& form, const std::vector<float>& values) {
  std::vector<std::byte> pixels;
  for (size_t i = 0; i < values.size(); i++) {
    uint16_t half = 0;
    floats_to_halves({&values[i], 1}, &half);
    const bool is_half = type_of(form, i % form.channels.size()) == Imf::HALF;
    const auto* from =
        is_half ? reinterpret_cast<const std::byte*>(&half) : reinterpret_cast<const std::byte*>(&values[i]);
    pixels.insert(pixels.end(), from, from + (is_half ? 2 : 4));
  }
  write_exr(path, form, pixels);
}

Imf::Header exr_header(const std::string& path) {
  return Imf::MultiPartInputFile(path.c_str()).header(0);
}

std::vector<std::byte> read_exr(const std::string& path, const ExrForm& form) {
  std::vector<std::byte> pixels(bytes_of_pixels(form));
  Imf::MultiPartInputFile file(path.c_str());
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(buffer_of(form, pixels.data()));
  part.readPixels(form.top, form.top + form.height - 1);
  return pixels;
}

}  // namespace ods
