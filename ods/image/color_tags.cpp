// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/color_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/format/inflate.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/tiff_directory.h"
#include "ods/image/heif_items.h"
#include "ods/image/icc_profile.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"

namespace ods {

constexpr uint64_t kLongestProfile = uint64_t{16} << 20;

static double srgb_curve(double code) {
  return static_cast<double>(srgb_decode(static_cast<float>(code)));
}

static ColorSpace ignored(const std::string& name, const std::string& why) {
  ColorSpace color;
  color.name = name;
  color.fault = fmt::format("its {} {}", name, why);
  return color;
}

static ColorSpace of_curve(const std::string& name, const ColorCurve& curve, const Chromaticities& primaries) {
  const auto matrix = to_rec709(primaries);
  if (!matrix) return ignored(name, "has primaries that span no triangle");
  return make_color_space(name, {curve, curve, curve}, *matrix);
}

// --- PNG -------------------------------------------------------------------------------------------------------------

// The colour chunks before the pixels, by name.
static std::map<std::string, std::string> color_chunks(const FileInput& file) {
  std::map<std::string, std::string> chunks;
  for (uint64_t at = 8; at + 12 <= file.size();) {
    const PngChunk chunk = read_png_chunk(file, at);
    if (chunk.type == "IDAT" || chunk.type == "IEND") break;
    const bool wanted = chunk.type == "cICP" || chunk.type == "iCCP" || chunk.type == "sRGB" || chunk.type == "gAMA" ||
                        chunk.type == "cHRM";
    if (wanted && chunk.length <= kLongestProfile) chunks[chunk.type] = file.read(at + 8, chunk.length);
    at += chunk.length + 12;
  }
  return chunks;
}

// ITU-T H.273. Television curves count as sRGB, because their code values are displayed as sRGB, here and in videos.
static ColorSpace of_cicp(const std::string& data) {
  if (data.size() != 4) return ignored("cICP", "is damaged");
  const uint64_t primaries = get_number(data, 0, 1), transfer = get_number(data, 1, 1);
  const std::string name = fmt::format("cICP {}, {}", primaries, transfer);
  if (get_number(data, 2, 1) != 0 || get_number(data, 3, 1) != 1) return ignored(name, "is not full-range RGB");
  static const std::map<uint64_t, Chromaticities> kPrimaries = {
      {1, kRec709},
      {9, {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kRec709.white}},
      {12, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kRec709.white}}};
  static const std::map<uint64_t, ColorCurve> kCurves = {
      {1, srgb_curve},  {4, [](double code) { return std::pow(code, 2.2); }},
      {6, srgb_curve},  {5, [](double code) { return std::pow(code, 2.8); }},
      {13, srgb_curve}, {8, [](double code) { return code; }},
      {14, srgb_curve}, {15, srgb_curve}};
  if (!kPrimaries.contains(primaries)) return ignored(name, "has primaries that ods does not support");
  if (!kCurves.contains(transfer)) return ignored(name, "has a transfer curve that ods does not support");
  return of_curve(name, kCurves.at(transfer), kPrimaries.at(primaries));
}

// A name with a terminating zero, the compression method (0), the profile.
static ColorSpace of_iccp(const std::string& data) {
  const size_t end = data.find('\0');
  if (end == std::string::npos || end + 2 > data.size()) return ignored("ICC profile", "is damaged");
  return read_icc_profile(inflated(std::string_view(data).substr(end + 2), kLongestProfile).value_or(""));
}

static ColorSpace of_gama_and_chrm(const std::string& gama, const std::string& chrm) {
  const double kTolerance = 0.05, kUnit = 100000.0;
  std::string name;
  ColorCurve curve = srgb_curve;
  if (!gama.empty()) {
    const double gamma = gama.size() == 4 ? static_cast<double>(get_number(gama, 0, 4)) / kUnit : 0.0;
    name = fmt::format("gAMA {}", gamma);
    if (!(gamma >= 0.01 && gamma <= 100.0)) return ignored(name, "makes no sense");
    if (std::abs(gamma * 2.2 - 1.0) > kTolerance) {
      curve = [gamma](double code) { return std::pow(code, 1.0 / gamma); };
    }
  }
  if (chrm.empty()) return of_curve(name, curve, kRec709);
  name += name.empty() ? "cHRM" : " with cHRM";
  if (chrm.size() != 32) return ignored(name, "is damaged");
  const auto xy = [&](size_t i) {
    return glm::dvec2(get_number(chrm, 8 * i, 4), get_number(chrm, 8 * i + 4, 4)) / kUnit;
  };
  return of_curve(name, curve, {xy(1), xy(2), xy(3), xy(0)});
}

// If a tag cannot be used, the next one in rank is tried; if there is none, the error is reported.
static ColorSpace read_png(const FileInput& file) {
  std::map<std::string, std::string> chunks = color_chunks(file);
  ColorSpace color;
  if (chunks.contains("cICP")) color = of_cicp(chunks["cICP"]);
  const auto is_unknown = [&] { return color.name.empty() || !color.fault.empty(); };
  if (is_unknown() && chunks.contains("iCCP")) color = of_iccp(chunks["iCCP"]);
  if (is_unknown() && chunks.contains("sRGB")) {
    color = {};
    color.name = "sRGB";
    color.curve = ColorSpace::Curve::kSrgb;
  }
  if (is_unknown() && (chunks.contains("gAMA") || chunks.contains("cHRM"))) {
    color = of_gama_and_chrm(chunks["gAMA"], chunks["cHRM"]);
  }
  return color;
}

// --- JPEG ------------------------------------------------------------------------------------------------------------

// A profile may be split: its marker is followed by the piece's number, from 1, and the number of pieces.
static ColorSpace read_jpeg(const FileInput& file) {
  constexpr unsigned char kApp2 = 0xE2;
  constexpr std::string_view kMarker{"ICC_PROFILE\0", 12};
  std::map<uint64_t, std::string> pieces;
  uint64_t count = 0;
  for (const JpegSegment& segment : read_jpeg_headers(file)) {
    if (segment.marker != kApp2 || !segment.data.starts_with(kMarker)) continue;
    if (segment.data.size() < kMarker.size() + 2) return ignored("ICC profile", "is damaged");
    count = get_number(segment.data, kMarker.size() + 1, 1);
    pieces[get_number(segment.data, kMarker.size(), 1)] = segment.data.substr(kMarker.size() + 2);
  }
  if (pieces.empty()) return {};
  if (pieces.size() != count || pieces.begin()->first != 1) return ignored("ICC profile", "is damaged");
  std::string profile;
  for (const auto& [number, piece] : pieces) profile += piece;
  return read_icc_profile(profile);
}

// --- TIFF ------------------------------------------------------------------------------------------------------------

static std::vector<uint64_t> numbers_of(const std::string& bytes, size_t size, bool is_little) {
  std::vector<uint64_t> numbers;
  const std::endian order = is_little ? std::endian::little : std::endian::big;
  for (size_t at = 0; at + size <= bytes.size(); at += size) numbers.push_back(get_number(bytes, at, size, order));
  return numbers;
}

// The light of each code value 0..65535: one curve for all channels, or one each.
static std::array<ColorCurve, 3> tiff_curves(const std::vector<uint64_t>& values) {
  if (values.empty()) return {srgb_curve, srgb_curve, srgb_curve};
  const bool is_one = (values.size() & (values.size() - 1)) == 0;
  const size_t length = is_one ? values.size() : values.size() / 3;
  std::array<ColorCurve, 3> curves;
  for (size_t c = 0; c < 3; c++) {
    curves[c] = [values, length, first = is_one ? 0 : c * length](double code) {
      const double at = std::clamp(code, 0.0, 1.0) * static_cast<double>(length - 1);
      const size_t low = std::min(static_cast<size_t>(at), length - 2);
      const double a = static_cast<double>(values[first + low]), b = static_cast<double>(values[first + low + 1]);
      return (a + (b - a) * (at - static_cast<double>(low))) / 65535.0;
    };
  }
  return curves;
}

// Adobe, "TIFF Revision 6.0", section 20.
static ColorSpace read_tiff(const FileInput& file) {
  constexpr uint16_t kTransfer = 301, kWhite = 318, kPrimaries = 319, kProfile = 34675;
  const TiffDirectory directory = read_tiff_directory(file);
  const auto value = [&](uint16_t tag) { return tiff_value(file, directory, tag, kLongestProfile).value_or(""); };
  if (const std::string profile = value(kProfile); !profile.empty()) return read_icc_profile(profile);
  const std::vector<uint64_t> transfer = numbers_of(value(kTransfer), 2, directory.is_little);
  const auto ratios = [&](uint16_t tag) {
    const std::vector<uint64_t> numbers = numbers_of(value(tag), 4, directory.is_little);
    std::vector<double> quotients;
    for (size_t i = 0; i + 1 < numbers.size(); i += 2) {
      quotients.push_back(static_cast<double>(numbers[i]) / static_cast<double>(numbers[i + 1]));
    }
    return quotients;
  };
  const std::vector<double> white = ratios(kWhite), primaries = ratios(kPrimaries);
  if (transfer.empty() && primaries.size() != 6) return {};
  const std::string name = transfer.empty() ? "PrimaryChromaticities" : "TransferFunction";
  const size_t length = transfer.size() % 3 == 0 ? transfer.size() / 3 : transfer.size();
  if (!transfer.empty() && (length < 2 || (length & (length - 1)) != 0)) return ignored(name, "is damaged");
  Chromaticities own = kRec709;
  if (primaries.size() == 6) {
    own.red = {primaries[0], primaries[1]}, own.green = {primaries[2], primaries[3]};
    own.blue = {primaries[4], primaries[5]};
    if (white.size() == 2) own.white = {white[0], white[1]};
  }
  const auto matrix = to_rec709(own);
  if (!matrix) return ignored(name, "has primaries that span no triangle");
  return make_color_space(name, tiff_curves(transfer), *matrix);
}

// --- the others ------------------------------------------------------------------------------------------------------

// Google, "WebP Container Specification": chunks of RIFF.
static ColorSpace read_webp(const FileInput& file) {
  for (uint64_t at = 12; at + 8 <= file.size();) {
    const std::string start = file.read(at, 8);
    const uint64_t size = numbers_of(start.substr(4), 4, true)[0];
    if (size > file.size() - at - 8) break;
    if (start.starts_with("ICCP") && size <= kLongestProfile) return read_icc_profile(file.read(at + 8, size));
    at += 8 + size + size % 2;
  }
  return {};
}

// 2 is unspecified. libheif has converted the pixels to full-range RGB.
static ColorSpace read_heif(const FileInput& file) {
  const HeifItems items = read_heif_items(file);
  if (!items.icc.empty()) return read_icc_profile(items.icc);
  if (!items.color || (*items.color)[0] == 2 || (*items.color)[1] == 2) return {};
  const auto [primaries, transfer] = *items.color;
  return of_cicp(std::string{static_cast<char>(primaries), static_cast<char>(transfer), 0, 1});
}

// Eight numbers: x and y of red, green, blue and white.
static ColorSpace read_exr(const FileInfo& info) {
  const auto found = info.numbers.find("chromaticities");
  if (found == info.numbers.end() || found->second.size() != 8) return {};
  const auto xy = [&](size_t i) { return glm::dvec2(found->second[2 * i], found->second[2 * i + 1]); };
  return of_curve("chromaticities", [](double code) { return code; }, {xy(0), xy(1), xy(2), xy(3)});
}

static ColorSpace read_declared(const std::string& path, FileFormat format, const FileInfo& info) {
  switch (format) {
    case FileFormat::kPng:
      return read_png(FileInput(path));
    case FileFormat::kJpeg:
      return read_jpeg(FileInput(path));
    case FileFormat::kTiff:
      return read_tiff(FileInput(path));
    case FileFormat::kWebp:
      return read_webp(FileInput(path));
    case FileFormat::kExr:
      return read_exr(info);
    case FileFormat::kHeif:
      return read_heif(FileInput(path));
    case FileFormat::kHdr:
      break;
  }
  return {};
}

ColorSpace read_color_space(const std::string& path, FileFormat format, const FileInfo& info) {
  ColorSpace color;
  try {
    color = read_declared(path, format, info);
  } catch (const Error&) {
    return {};  // reading the pixels reports the error
  } catch (const MalformedFile&) {
    return {};
  }
  const bool is_linear = color.curve == ColorSpace::Curve::kDefault || color.curve == ColorSpace::Curve::kLinear;
  if (info.is_float && !is_linear) {
    color.fault = fmt::format("its {} has a transfer curve, but its numbers are floats: taken as linear", color.name);
  } else if (!color.fault.empty()) {
    color.fault += info.is_float ? ": taken as linear Rec. 709" : ": taken as sRGB";
  }
  return color;
}

}  // namespace ods
