// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/spherical.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "ods/base/quote.h"
#include "ods/image/format/xmp.h"

namespace ods {

std::optional<VideoStereo> stereo_with(EyeArrangement eyes) {
  if (eyes.how == EyePacking::kMixed) return std::nullopt;
  eyes.squeezed = false;
  for (const VideoStereo stereo : kVideoStereos) {
    if (arrangement_of(stereo) == eyes) return stereo;
  }
  return std::nullopt;
}

constexpr double kWhole = 4294967296.0;  // 2^32

std::string metadata_text(const SphericalMetadata& metadata) {
  std::string text(metadata.stereo ? stereo_name(*metadata.stereo) : "");
  if (metadata.projection) text += fmt::format("{}{}", text.empty() ? "" : ", ", projection_name(*metadata.projection));
  if (metadata.is_partial()) {
    const auto& [top, bottom, left, right] = metadata.bounds;
    text += fmt::format(" {:.4g}x{:.4g}", 360.0 * (1.0 - (left + 1.0 * right) / kWhole),
                        180.0 * (1.0 - (top + 1.0 * bottom) / kWhole));
  }
  if (metadata.yaw != 0.0 || metadata.pitch != 0.0 || metadata.roll != 0.0) {
    text += fmt::format(", turned by {:.6g},{:.6g},{:.6g}", metadata.yaw, metadata.pitch, metadata.roll);
  }
  return text;
}

VideoStereo stereo_of(const SphericalMetadata& metadata) {
  return metadata.stereo.value_or(VideoStereo::kOneView);
}

bool same_stereo(const SphericalMetadata& a, const SphericalMetadata& b) {
  return stereo_of(a) == stereo_of(b);
}

bool same_sphere(const SphericalMetadata& a, const SphericalMetadata& b) {
  const VideoProjection projection = a.projection.value_or(VideoProjection::kFlat);
  if (projection != b.projection.value_or(VideoProjection::kFlat)) return false;
  if (projection != VideoProjection::kEquirect) return true;
  const auto near = [](uint32_t one, uint32_t other) { return std::abs(1.0 * one - 1.0 * other) < kWhole / 1000.0; };
  return std::equal(a.bounds.begin(), a.bounds.end(), b.bounds.begin(), near);
}

// --- V1 --------------------------------------------------------------------------------------------------------------

static bool has_v1_stereo(const SphericalMetadata& metadata) {
  const VideoStereo stereo = stereo_of(metadata);
  return stereo == VideoStereo::kOneView || stereo == VideoStereo::kTopBottom || stereo == VideoStereo::kSideBySide;
}

bool fits_v1(const SphericalMetadata& metadata) {
  return metadata.projection == VideoProjection::kEquirect && !metadata.is_partial() && has_v1_stereo(metadata);
}

static const char* v1_stereo(VideoStereo stereo) {
  if (stereo == VideoStereo::kOneView) return "mono";
  return stereo == VideoStereo::kTopBottom ? "top-bottom" : "left-right";
}

namespace {

struct V1Angle {
  const char* name;
  double SphericalMetadata::*value;
};

}  // namespace

constexpr V1Angle kV1Angles[] = {{"InitialViewHeadingDegrees", &SphericalMetadata::yaw},
                                 {"InitialViewPitchDegrees", &SphericalMetadata::pitch},
                                 {"InitialViewRollDegrees", &SphericalMetadata::roll}};

// No whitespace inside elements: some players search for the literal `<GSpherical:Spherical>true<`.
std::string v1_xml(const SphericalMetadata& metadata) {
  assert(fits_v1(metadata));
  std::string xml =
      "<?xml version=\"1.0\"?><rdf:SphericalVideo xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" "
      "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">";
  const auto element = [&](const char* name, const auto& value) {
    xml += fmt::format("<GSpherical:{0}>{1}</GSpherical:{0}>", name, value);
  };
  element("Spherical", "true");
  element("Stitched", "true");
  element("StitchingSoftware", xml_text(metadata.source));
  element("ProjectionType", "equirectangular");
  element("StereoMode", v1_stereo(stereo_of(metadata)));
  for (const V1Angle& angle : kV1Angles) {
    const long degrees = std::lround(metadata.*angle.value);
    if (degrees != 0) element(angle.name, degrees);
  }
  return xml + "</rdf:SphericalVideo>";
}

static std::string v1_element(const std::string& xml, const std::string& name) {
  const std::string text(xmp_property(xml, "GSpherical:" + name));
  const size_t from = text.find_first_not_of(" \t\r\n");
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t\r\n") - from + 1);
}

static std::optional<double> v1_number(const std::string& xml, const std::string& name) {
  const std::string text = v1_element(xml, name);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && std::abs(value) <= 1e6 ? std::optional(value) : std::nullopt;
}

static bool is_true(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](char c) { return static_cast<char>(c | 0x20); });
  return word == "true";
}

static std::array<uint32_t, 4> v1_bounds(const std::string& xml) {
  std::array<uint32_t, 4> bounds{};
  const auto side = [&](const char* full, const char* part, const char* from, uint32_t& low, uint32_t& high) {
    const auto all = v1_number(xml, full), size = v1_number(xml, part), start = v1_number(xml, from);
    if (!all || !size || !start || *start < 0.0 || *size <= 0.0 || *start + *size > *all) return;
    low = static_cast<uint32_t>(*start / *all * kWhole);
    high = static_cast<uint32_t>((*all - *start - *size) / *all * kWhole);
  };
  side("FullPanoHeightPixels", "CroppedAreaImageHeightPixels", "CroppedAreaTopPixels", bounds[0], bounds[1]);
  side("FullPanoWidthPixels", "CroppedAreaImageWidthPixels", "CroppedAreaLeftPixels", bounds[2], bounds[3]);
  return bounds;
}

std::optional<SphericalMetadata> parse_v1(const std::string& xml) {
  if (xml.find("GSpherical:") == std::string::npos) return std::nullopt;
  SphericalMetadata metadata;
  const bool is_sphere = is_true(v1_element(xml, "Spherical")) && is_true(v1_element(xml, "Stitched")) &&
                         v1_element(xml, "ProjectionType") == "equirectangular";
  metadata.projection = is_sphere ? VideoProjection::kEquirect : VideoProjection::kOther;
  const std::string stereo = v1_element(xml, "StereoMode");
  if (stereo == "mono") metadata.stereo = VideoStereo::kOneView;
  if (stereo == "top-bottom") metadata.stereo = VideoStereo::kTopBottom;
  if (stereo == "left-right") metadata.stereo = VideoStereo::kSideBySide;
  metadata.bounds = v1_bounds(xml);
  for (const V1Angle& angle : kV1Angles) metadata.*angle.value = v1_number(xml, angle.name).value_or(0.0);
  metadata.source = xml_unescaped(v1_element(xml, "StitchingSoftware"));
  return metadata;
}

bool can_update_v1(const SphericalMetadata& v1, const SphericalMetadata& metadata) {
  return v1.projection == VideoProjection::kEquirect && same_sphere(v1, metadata) && has_v1_stereo(metadata);
}

// Sets an element, adding it if missing. Returns false if the XML cannot be parsed.
static bool set_v1_element(std::string& xml, const std::string& name, const std::string& value) {
  const std::string open = "<GSpherical:" + name + ">", close = "</GSpherical:" + name + ">";
  if (const size_t from = xml.find(open); from != std::string::npos) {
    const size_t begin = from + open.size(), end = xml.find(close, begin);
    if (end == std::string::npos) return false;
    xml.replace(begin, end - begin, value);
    return true;
  }
  const size_t end = xml.rfind("</");
  if (end == std::string::npos || xml.find("GSpherical:" + name) != std::string::npos) return false;
  xml.insert(end, open + value + close);
  return true;
}

std::optional<std::string> updated_v1(const std::string& xml, const SphericalMetadata& metadata, bool has_new_source) {
  const std::optional<SphericalMetadata> old = parse_v1(xml);
  if (!old || !can_update_v1(*old, metadata)) return std::nullopt;
  std::string updated = xml;
  bool is_understood = true;
  const auto set = [&](const char* name, const std::string& value) {
    is_understood = is_understood && set_v1_element(updated, name, value);
  };
  if (!same_stereo(*old, metadata)) set("StereoMode", v1_stereo(stereo_of(metadata)));
  for (const V1Angle& angle : kV1Angles) {
    const double value = metadata.*angle.value;
    if (std::abs(std::remainder(value - (*old).*angle.value, 360.0)) >= 1.0)
      set(angle.name, std::to_string(std::lround(value)));
  }
  if (has_new_source && old->source != metadata.source) set("StitchingSoftware", xml_text(metadata.source));
  return is_understood ? std::optional(updated) : std::nullopt;
}

// --- V2 --------------------------------------------------------------------------------------------------------------

constexpr VideoStereo kV2Stereo[] = {VideoStereo::kOneView, VideoStereo::kTopBottom, VideoStereo::kSideBySide,
                                     VideoStereo::kCustom, VideoStereo::kRightLeft};

static bool has_v2_stereo(const SphericalMetadata& metadata) {
  return std::find(std::begin(kV2Stereo), std::end(kV2Stereo), stereo_of(metadata)) != std::end(kV2Stereo);
}

static bool has_v2_projection(const SphericalMetadata& metadata) {
  return metadata.projection != VideoProjection::kMesh && metadata.projection != VideoProjection::kOther;
}

bool fits_v2(const SphericalMetadata& metadata) {
  return has_v2_stereo(metadata) && has_v2_projection(metadata);
}

static Box full_box(BoxType type) {
  Box box;
  box.type = type;
  append_number(box.body, 0, 4);  // version and flags
  return box;
}

Box st3d_box(const SphericalMetadata& metadata) {
  assert(has_v2_stereo(metadata));
  Box box = full_box(box_type("st3d"));
  const auto found = std::find(std::begin(kV2Stereo), std::end(kV2Stereo), stereo_of(metadata));
  append_number(box.body, static_cast<uint64_t>(found - std::begin(kV2Stereo)), 1);
  return box;
}

static uint64_t fixed_point(double degrees) {
  return static_cast<uint32_t>(static_cast<int32_t>(std::lround(degrees * 65536.0)));
}

static Box header_box(const SphericalMetadata& metadata) {
  Box header = full_box(box_type("svhd"));
  header.body += metadata.source + '\0';
  return header;
}

static Box pose_box(const SphericalMetadata& metadata) {
  Box pose = full_box(box_type("prhd"));
  for (double angle : {metadata.yaw, metadata.pitch, metadata.roll}) append_number(pose.body, fixed_point(angle), 4);
  return pose;
}

std::string projection_body(const SphericalMetadata& metadata) {
  std::string body(4, '\0');                                                                 // version and flags
  if (metadata.projection == VideoProjection::kCubemap) return body + std::string(8, '\0');  // the layout, no padding
  for (uint32_t bound : metadata.bounds) append_number(body, bound, 4);
  return body;
}

Box sv3d_box(const SphericalMetadata& metadata) {
  assert(has_v2_projection(metadata) && metadata.projection && metadata.projection != VideoProjection::kFlat);
  const Box header = header_box(metadata), pose = pose_box(metadata);
  Box data;
  data.type = metadata.projection == VideoProjection::kCubemap ? box_type("cbmp") : box_type("equi");
  data.body = projection_body(metadata);
  Box projection;
  projection.type = box_type("proj");
  projection.children = {pose, data};
  Box sphere;
  sphere.type = box_type("sv3d");
  sphere.children = {header, projection};
  return sphere;
}

void parse_projection_body(const std::string& body, SphericalMetadata& metadata) {
  if (metadata.projection == VideoProjection::kEquirect && body.size() >= 20) {
    for (size_t i = 0; i < 4; i++) metadata.bounds[i] = static_cast<uint32_t>(get_number(body, 4 + 4 * i, 4));
  }
  if (metadata.projection == VideoProjection::kCubemap && get_number(body, 4, 4) != 0) {
    metadata.projection = VideoProjection::kOther;  // a face layout that is not specified yet
  }
}

static void parse_sphere(Box sphere, SphericalMetadata& metadata) {
  open_box(sphere, 0);
  if (const Box* header = find_child(sphere, box_type("svhd")); header != nullptr && header->body.size() > 4) {
    metadata.source = header->body.substr(4, header->body.find('\0', 4) - 4);
  }
  Box& projection = open_child(sphere, box_type("proj"));
  if (const Box* pose = find_child(projection, box_type("prhd"))) {
    const auto angle = [&](size_t at) {
      return static_cast<int32_t>(static_cast<uint32_t>(get_number(pose->body, at, 4))) / 65536.0;
    };
    metadata.yaw = angle(4), metadata.pitch = angle(8), metadata.roll = angle(12);
  }
  metadata.projection = VideoProjection::kOther;
  for (const Box& data : projection.children) {
    if (data.type == box_type("equi")) metadata.projection = VideoProjection::kEquirect;
    if (data.type == box_type("cbmp")) metadata.projection = VideoProjection::kCubemap;
    if (data.type == box_type("mshp")) metadata.projection = VideoProjection::kMesh;
    if (data.type != box_type("prhd")) parse_projection_body(data.body, metadata);
  }
}

void update_sv3d(Box& sphere, const SphericalMetadata& metadata) {
  SphericalMetadata old;
  parse_sphere(sphere, old);
  open_box(sphere, 0);
  const auto put = [](Box& holder, const Box& box) {
    if (Box* there = find_child(holder, box.type)) {
      *there = box;
    } else {
      holder.children.insert(holder.children.begin(), box);
    }
  };
  if (old.source != metadata.source) put(sphere, header_box(metadata));
  const auto is_same = [](double a, double b) { return fixed_point(a) == fixed_point(b); };
  if (is_same(old.yaw, metadata.yaw) && is_same(old.pitch, metadata.pitch) && is_same(old.roll, metadata.roll)) return;
  put(open_child(sphere, box_type("proj")), pose_box(metadata));
}

std::optional<SphericalMetadata> parse_v2(const Box& sample_entry) {
  const Box* stereo = find_child(sample_entry, box_type("st3d"));
  const Box* sphere = find_child(sample_entry, box_type("sv3d"));
  if (stereo == nullptr && sphere == nullptr) return std::nullopt;
  SphericalMetadata metadata;
  if (stereo != nullptr) {
    const uint64_t mode = get_number(stereo->body, 4, 1);
    metadata.stereo = mode < std::size(kV2Stereo) ? kV2Stereo[mode] : VideoStereo::kOther;
  }
  if (sphere != nullptr) parse_sphere(*sphere, metadata);
  return metadata;
}

std::string find_mesh(const Box& sample_entry) {
  const Box* found = find_child(sample_entry, box_type("sv3d"));
  if (found == nullptr) return {};
  Box sphere = *found;
  open_box(sphere, 0);
  const Box* mesh = find_child(open_child(sphere, box_type("proj")), box_type("mshp"));
  return mesh == nullptr ? "" : mesh->body;
}

// --- sound -----------------------------------------------------------------------------------------------------------

std::optional<Ambisonics> parse_sa3d(const std::string& body) {
  if (body.size() < 12 || body[0] != 0) return std::nullopt;
  Ambisonics sound;
  sound.has_head_locked = (body[1] & 0x80) != 0;
  sound.order = static_cast<uint32_t>(get_number(body, 2, 4));
  sound.channels = static_cast<uint32_t>(get_number(body, 8, 4));
  return sound;
}

Box sa3d_box(const Ambisonics& sound) {
  Box box;
  box.type = box_type("SA3D");
  append_number(box.body, 0, 1);                                 // version
  append_number(box.body, sound.has_head_locked ? 0x80 : 0, 1);  // zero: periphonic
  append_number(box.body, sound.order, 4);
  append_number(box.body, 0, 2);  // ACN, SN3D
  append_number(box.body, sound.channels, 4);
  for (uint32_t channel = 0; channel < sound.channels; channel++) append_number(box.body, channel, 4);
  return box;
}

}  // namespace ods
