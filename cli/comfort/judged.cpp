// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/comfort/judged.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "cli/comfort/first_look.h"
#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "cli/options/projection_options.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/areas.h"
#include "ods/comfort/measured_eyes.h"
#include "ods/convert/reproject.h"
#include "ods/convert/unwrap.h"
#include "ods/depth/floor.h"
#include "ods/files/atomic_file.h"
#include "ods/files/scratch.h"
#include "ods/image/tone.h"
#include "ods/picture/cryptomatte.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/stored_picture.h"
#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "ods/stage/comfortable_merge.h"

namespace {

constexpr int kMostWidth = 2048;   // of what is judged
constexpr int kHiddenWidth = 512;  // of the look from the middle: a thing of a millimetre in the circle is three pixels

// What rays from the circle's middle meet before they leave it.
std::vector<std::string> hidden_in_circle(const ods::CpuRenderer& renderer, const ods::StereoCamera& camera,
                                          const ods::RenderOptions& options, const Things& things) {
  ods::RenderOptions middle = options;
  middle.eyes = ods::Eyes::kMonoEye;
  middle.width = std::min(options.width, kHiddenWidth), middle.height = 0;
  middle = ods::with_height(middle, camera);
  const ods::Camera kernel = ods::make_camera(camera);
  const std::vector<ods::Hit> hits = std::move(renderer.center_hits(camera, middle)[0]);
  const ods::Extent size{middle.width, middle.height};
  const auto width = static_cast<size_t>(size.width);
  std::set<std::string> names;
  for (size_t i = 0; i < hits.size(); i++) {
    if (hits[i].t < 0.0f || hits[i].t > 0.5f * camera.ipd) continue;
    const ods::vec2 uv = ods::pixel_middle(static_cast<int>(i % width), static_cast<int>(i / width), size);
    const ods::ViewDirection look = ods::look_of(kernel.projection, uv, uv);
    const float radius = 0.5f * camera.ipd * ods::merge_at(kernel, look.direction, look.elevation);
    if (hits[i].t * std::cos(look.elevation) >= radius) continue;
    names.insert(things.names[static_cast<size_t>(things.of_instance[static_cast<size_t>(hits[i].instance)])]);
  }
  return {names.begin(), names.end()};
}

// An eye's colours, the nearest pixels of it.
ods::Image colors_of(const ods::StoredPicture& picture, size_t eye, int width, int height) {
  ods::Image light(width, height, 3);
  const int eye_width = picture.size.width, eye_height = picture.size.height;
  ods::read_colors(picture, eye, [&](int from, const std::vector<float>& row) {
    const int y = static_cast<int>(int64_t{from} * height / eye_height);
    for (int x = 0; x < width; x++) {
      std::copy_n(&row[3 * static_cast<size_t>(int64_t{x} * eye_width / width)], 3, light.at(x, y));
    }
  });
  return light;
}

ods::FileInfo info_of(const std::string& path) {
  return ods::read_info(ods::names_eye(path) ? ods::path_for_eye(path, ods::kLeft) : path);
}

// numbers: of what each pixel shows; chosen: the pixels that are judged.
void name_things(ods::SeenDepth& seen, const ods::Image& numbers, const std::vector<size_t>& chosen,
                 const ods::Cryptomatte& matte) {
  if (numbers.pixels.empty() || matte.names.empty()) return;
  std::map<float, int> places;
  for (const auto& [number, name] : matte.names) {
    if (name.empty()) continue;
    places[number] = static_cast<int>(seen.names.size());
    seen.names.push_back(name);
  }
  for (const size_t pixel : chosen) {
    const auto found = places.find(numbers.pixels[pixel]);
    seen.things.push_back(found == places.end() ? -1 : found->second);
  }
}

Looked match_picture(const ods::StoredPicture& picture, const std::string& name) {
  if (picture.eyes.size() != 2) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("'{}' has one eye and no depth (a layer Z, metres along the ray): nothing in it tells "
                                 "how far things are. If it has two eyes, say --layout",
                                 name));
  }
  ods::check_matchable(picture.camera.projection, picture.size.width, name);
  if (!picture.has_ipd) note("no word says how far apart its eyes are: distances are for 65 mm");
  ods::MatchedEyes matched = ods::match_eyes_for_depth(ods::grey_eyes(picture), picture.camera, picture.is_float);
  Looked looked{matched.seen[0].camera, {}, MatchQuality{matched.share, matched.precision, matched.apart}, {}, {}};
  if (matched.share < ods::kLeastMatched) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("'{}' has no depth, and only {:.1f} % of its eyes could be matched: see what ods lint "
                                 "says of it, or say --layout",
                                 name, 100.0 * matched.share));
  }
  for (size_t i = 0; i < 2; i++) looked.eyes.push_back({std::move(matched.seen[i]), light_of(matched.grey[i])});
  return looked;
}

// A picture, of which as little as is wanted is read.
struct Opened {
  ods::StoredPicture picture;
  std::optional<ods::Cryptomatte> matte;
  bool shows = false;       // its colours are there
  bool lacks_map = false;   // without which depth does not tell what its eyes show
  bool is_foreign = false;  // it has two eyes and depth, but no word of how the eyes were placed
};

Opened open_to_judge(const ComfortJob& job) {
  const std::string& name = job.scene.name;
  ods::OpenOptions open;
  Opened opened;
  open.format = identified_input(name, job.format);
  ods::PictureReader reader(name, open);
  const ods::StoredPicture& header = reader.header();
  const std::optional<size_t> layer = ods::depth_layer(header);
  if (layer) {
    const ods::FileInfo info = info_of(name);
    opened.matte = ods::find_cryptomatte(info, name);
    const bool has_two = header.eyes.size() == 2;
    opened.lacks_map = has_two && ods::lacks_merge_map(info, header.camera);
    opened.is_foreign = has_two && !header.has_ipd;
  }
  opened.shows = !layer || opened.lacks_map || opened.is_foreign || !job.heat.empty() || !job.html.empty();
  const std::string depth = layer ? header.eyes[0].layers[*layer].channels[0] : "";
  const std::string matte = opened.matte ? ods::matte_channel(header, *opened.matte) : "";
  const std::vector<std::string> colors = header.eyes[0].layers[0].channels;
  const auto wants = [&](const std::string& channel) {
    if (channel == depth || channel == matte) return true;
    return opened.shows && std::ranges::find(colors, channel) != colors.end();
  };
  const std::string beside = job.heat.empty() ? job.html : job.heat;
  const std::string scratch = beside.empty() ? "" : ods::existing_folder_of(beside);
  const bool has_maps = !header.maps.empty();
  opened.picture = has_maps ? reader.read(scratch) : reader.read(scratch, wants);
  for (const std::string& guess : opened.picture.guesses) note(guess);
  if (has_maps) opened.picture = ods::unwrapped(opened.picture);
  return opened;
}

// Says what is wrong with the depth of an eye; `name`: of its file.
void check_depth(const ods::SeenDepth& seen, const std::string& name) {
  ods::Image nearness = seen.depth;
  bool has_any = false, has_surface = false;
  for (float& depth : nearness.pixels) {
    has_any = has_any || depth > 0.0f, has_surface = has_surface || ods::is_surface(depth);
    depth = ods::inverse_depth(depth);
  }
  if (!has_any) {
    throw ods::Error(
        ods::ErrorKind::kInput,
        fmt::format("'{}': its layer of depth (Z) is 0, negative or NaN everywhere: render it again, or judge "
                    "its eyes, saved without it",
                    name));
  }
  if (!has_surface)
    warn(fmt::format("'{}': its layer of depth (Z) is infinite everywhere: there is nothing to judge", name));
  if (ods::looks_inverted(nearness, ods::make_camera(seen.camera), seen.eye)) {
    warn(fmt::format("'{}': its depth (Z) looks inverted, near sky and far floor: Z is metres along the line of sight",
                     name));
  }
}

}  // namespace

Looked look_at_scene(const ComfortJob& job) {
  const ods::Scene scene = open_scene(job.scene);
  ods::StereoCamera camera = place_camera(job.camera, scene);
  ods::RenderOptions options;
  options.width = job.width;
  options = ods::with_height(options, camera);
  const ods::CpuRenderer renderer(scene);
  if (job.camera.changes.merge_limit) {
    ods::use_merge_map(camera, ods::merge_map_of(ods::shares_seen(renderer, camera, *job.camera.changes.merge_limit)));
  }
  const Things things = things_of(scene);
  Looked looked{camera, {}, {}, {}, hidden_in_circle(renderer, camera, options, things)};
  for (ods::SeenDepth& seen : look_from(renderer, things, camera, options)) {
    ods::Image light(options.width, options.height, 3);
    for (size_t k = 0; k < seen.depth.pixels.size(); k++) {
      const float depth = seen.depth.pixels[k];
      std::fill_n(&light.pixels[3 * k], 3, ods::is_surface(depth) ? 0.5f / (1.0f + depth) : 0.8f);
    }
    looked.eyes.push_back({std::move(seen), std::move(light)});
  }
  return looked;
}

// Where the pixels tell how the eyes were placed.
void measure_camera(Looked& looked, const ods::StoredPicture& picture, const std::string& name) {
  const std::optional<ods::MeasuredEyes> found =
      ods::measure_eyes(ods::grey_eyes(picture), looked.eyes[0].seen, picture.is_float);
  if (!found || !found->is_known) {
    note(fmt::format(
        "'{}': no word says whether it has a pole merge, and its pixels do not tell: judged as if it had none", name));
  }
  if (!found) return;
  looked.camera = found->camera;
  for (Judged& judged : looked.eyes) judged.seen.camera = found->camera;
  looked.measured = found;
}

Looked look_at_picture(const ComfortJob& job) {
  const std::string& name = job.scene.name;
  const Opened opened = open_to_judge(job);
  const ods::StoredPicture& picture = opened.picture;
  if (!ods::depth_layer(picture)) return match_picture(picture, name);
  if (opened.lacks_map) {
    try {
      Looked looked = match_picture(picture, name);
      looked.why_matched = "Its merge map is missing, so its depth does not tell what the eyes see";
      return looked;
    } catch (const ods::Error&) {
      warn(fmt::format("'{}': its merge map is missing, and its eyes cannot be matched: judged as if it had no merge",
                       name));
    }
  }
  Looked looked{picture.camera, {}, {}, {}, {}};
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    Judged& judged = looked.eyes.emplace_back();
    std::vector<size_t> chosen;
    judged.seen = {picture.camera, picture.eyes[i].eye, {}, {}, {}};
    judged.seen.depth = ods::nearest_of_blocks(ods::depth_of_eye(picture, i), kMostWidth, &chosen);
    if (i == 0) check_depth(judged.seen, name);
    if (opened.matte) name_things(judged.seen, ods::matte_of_eye(picture, i, *opened.matte), chosen, *opened.matte);
    const ods::Image& depth = judged.seen.depth;
    if (opened.shows) judged.light = colors_of(picture, i, depth.width, depth.height);
    if (picture.memory) picture.memory->release();
  }
  if (opened.matte && opened.matte->names.empty()) {
    note(fmt::format("'{}': its Cryptomatte has no list of names, so what strains is an area", name));
  }
  if (opened.is_foreign) measure_camera(looked, picture, name);
  return looked;
}

ods::Image light_of(const ods::Image& grey) {
  ods::Image light(grey.width, grey.height, 3);
  for (size_t i = 0; i < light.pixels.size(); i++) {
    const float shown = grey.pixels[i / 3];
    light.pixels[i] = shown > 0.0f ? ods::srgb_decode(shown) : 0.0f;
  }
  return light;
}
