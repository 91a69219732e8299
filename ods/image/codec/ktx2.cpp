// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Source: the KTX File Format Specification, version 2.0, and the Khronos Data Format Specification, version 1.3.
#include "ods/image/codec/ktx2.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>

#include "ods/files/read_file.h"
#include "ods/image/codec/blocks.h"
#include "ods/image/codec/little_endian.h"
#include "ods/image/format/image_limits.h"

namespace ods {

namespace {

using Bytes = std::span<const std::byte>;

constexpr unsigned char kMark[] = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};

enum Packing : uint32_t { kUnpacked, kBasisLz, kZstandard };  // the specification's supercompression scheme
enum ColorModel : uint32_t { kEtc1s = 163, kUastc = 166 };    // values in the data format

// The values of the data format descriptor for files with two channels.
constexpr uint32_t kGreenInSecondSlice = 4, kGreenInAlpha = 5;

struct Ktx2 {
  uint32_t vulkan_format, depth, layers, faces, levels, packing;
  int width, height;
  Bytes descriptor;  // descriptor of the data format
  Bytes global;      // global data of BasisLZ
  Bytes level;       // the largest
};

int side_of(uint32_t value) {
  return static_cast<int>(std::min(value, 1u << 30));
}

Ktx2 open(Bytes file) {
  Ktx2 ktx{};
  ktx.vulkan_format = get_u32(file, 12);
  ktx.width = side_of(get_u32(file, 20)), ktx.height = side_of(get_u32(file, 24));
  ktx.depth = get_u32(file, 28), ktx.layers = get_u32(file, 32), ktx.faces = get_u32(file, 36);
  ktx.levels = std::max(get_u32(file, 40), 1u), ktx.packing = get_u32(file, 44);
  ktx.descriptor = part_of(file, get_u32(file, 48), get_u32(file, 52));
  ktx.global = part_of(file, get_u64(file, 64), get_u64(file, 72));
  ktx.level = part_of(file, get_u64(file, 80), get_u64(file, 88));
  return ktx;
}

// Throws unless the file is one picture of a possible size.
void check_picture(const Ktx2& ktx, size_t file_size) {
  const std::string fault = image_size_fault(ktx.width, ktx.height, std::max(ktx.width, ktx.height), file_size);
  if (!fault.empty()) throw MalformedFile(fault);
  const char* kind = nullptr;
  if (ktx.faces != 1) kind = "a cube map";
  if (ktx.layers > 1) kind = "an array of pictures or a video";
  if (ktx.depth > 0) kind = "a volume";
  if (kind) throw MalformedFile(fmt::format("it is {}; a texture of glTF is one picture", kind));
}

uint32_t byte_at(Bytes bytes, size_t at) {
  return static_cast<uint32_t>(part_of(bytes, at, 1)[0]);
}

// --- pixels

// The bytes of the level, which must be `size`.
std::vector<std::byte> unpack(const Ktx2& ktx, size_t size) {
  if (ktx.packing == kUnpacked) {
    if (ktx.level.size() != size) throw MalformedFile("its picture has another size than it states");
    return {ktx.level.begin(), ktx.level.end()};
  }
  std::vector<std::byte> bytes(size);
  const size_t filled = ZSTD_decompress(bytes.data(), size, ktx.level.data(), ktx.level.size());
  if (filled != size) throw MalformedFile("its Zstandard data is damaged");  // errors are large numbers
  return bytes;
}

size_t pixels_of(const CodeImage& image) {
  return static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
}

void read_uastc(const Ktx2& ktx, CodeImage& image) {
  const size_t width = blocks_along(image.width), height = blocks_along(image.height);
  const std::vector<std::byte> bytes = unpack(ktx, width * height * kUastcBlockBytes);
  for (size_t i = 0; i < width * height; i++) {
    put_block(image, i % width, i / width, decode_uastc(Bytes(bytes).subspan(i * kUastcBlockBytes, kUastcBlockBytes)));
  }
}

// The number of channels of Vulkan's R8G8B8A8 and similar formats, VkFormat in vulkan_core.h; 0 for another format.
size_t channels_of(uint32_t format) {
  constexpr uint32_t kUnorm[] = {0, 9, 16, 23, 37}, kSrgb[] = {0, 15, 22, 29, 43};
  for (size_t channels = 1; channels <= 4; channels++) {
    if (format == kUnorm[channels] || format == kSrgb[channels]) return channels;
  }
  return 0;
}

// Missing channels have Vulkan's defaults: 0, and opaque.
void read_plain(const Ktx2& ktx, size_t channels, CodeImage& image) {
  const std::vector<std::byte> bytes = unpack(ktx, channels * pixels_of(image));
  for (size_t i = 0; i < image.pixels.size(); i++) {
    uint32_t c[4] = {0, 0, 0, 255};
    for (size_t k = 0; k < channels; k++) c[k] = static_cast<uint32_t>(bytes[i * channels + k]);
    image.pixels[i] = pack_texel(c[0], c[1], c[2], c[3]);
  }
}

// Two channels are stored as a grey picture and its alpha.
void move_green(CodeImage& image) {
  for (uint32_t& texel : image.pixels) texel = pack_texel(texel & 255, texel >> 24, 0, 255);
}

CodeImage decode(Bytes file) {
  const Ktx2 ktx = open(file);
  check_picture(ktx, file.size());
  const uint32_t model = byte_at(ktx.descriptor, 12);
  const size_t channels = channels_of(ktx.vulkan_format);
  const bool is_etc1s = ktx.packing == kBasisLz && model == kEtc1s && ktx.vulkan_format == 0;
  const bool may_be_packed = ktx.packing == kUnpacked || ktx.packing == kZstandard;
  const bool is_uastc = may_be_packed && model == kUastc && ktx.vulkan_format == 0;
  if (!is_etc1s && !is_uastc && !(may_be_packed && channels > 0)) {
    throw MalformedFile(
        fmt::format("its format (Vulkan's number {}, colour model {}, packing {}) is not one of glTF: ETC1S or UASTC "
                    "(LDR), or 8-bit "
                    "R, RG, RGB or RGBA",
                    ktx.vulkan_format, model, ktx.packing));
  }
  CodeImage image{ktx.width, ktx.height, {}, {}};
  image.pixels.resize(pixels_of(image));
  if (is_etc1s) {
    decode_basis_lz(ktx.global, ktx.levels, ktx.level, image);
    if (ktx.descriptor.size() > 47 && (byte_at(ktx.descriptor, 47) & 15) == kGreenInSecondSlice) move_green(image);
  } else if (is_uastc) {
    read_uastc(ktx, image);
    if ((byte_at(ktx.descriptor, 31) & 15) == kGreenInAlpha) move_green(image);
  } else {
    read_plain(ktx, channels, image);
  }
  return image;
}

}  // namespace

void put_block(CodeImage& image, size_t x, size_t y, const TexelBlock& texels) {
  const auto width = static_cast<size_t>(image.width), height = static_cast<size_t>(image.height);
  const size_t columns = std::min<size_t>(4, width - 4 * x), rows = std::min<size_t>(4, height - 4 * y);
  for (size_t row = 0; row < rows; row++) {
    std::copy_n(&texels[4 * row], columns, &image.pixels[(4 * y + row) * width + 4 * x]);
  }
}

bool is_ktx2(Bytes file) {
  return file.size() >= sizeof(kMark) && std::memcmp(file.data(), kMark, sizeof(kMark)) == 0;
}

CodeImage decode_ktx2(Bytes file, const std::string& name) {
  try {
    return decode(file);
  } catch (const MalformedFile& fault) {
    throw cannot_read(name, fmt::format("as a KTX2 texture: {}", fault.what()));
  }
}

}  // namespace ods
