// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/cycles/cycles_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cli/console/options.h"
#include "ods/camera/cycles_camera.h"
#include "ods/comfort/verdict.h"
#include "ods/convert/convert.h"
#include "ods/denoise/oidn.h"
#include "ods/files/private_folder.h"
#include "ods/kernel/random.h"
#include "ods/picture/cycles_passes.h"

namespace {

constexpr double kShareOfCycles = 0.97;  // of the time of a picture
constexpr int kMaxWidth = 65536;         // in Blender

// Two halves of the samples show the noise. A part of a picture has none to show alone.
size_t parts_of_eye(const CyclesPicture& picture) {
  const bool is_whole = picture.part.count == 1;
  return is_whole && (picture.denoiser == ods::Denoiser::kOwn || picture.statistics) ? 2 : 1;
}

// The lat-long that Cycles renders: the picture itself, or one as sharp, to be converted.
struct Rendered {
  ods::StereoCamera camera;
  ods::Extent eye;
  std::vector<ods::CyclesBand> bands{};
};

Rendered rendered_for(const CyclesPicture& picture) {
  if (ods::cycles_projects(picture.camera.projection)) {
    return {picture.camera, picture.eye, ods::cycles_bands(picture.camera, picture.eye.height)};
  }
  Rendered whole{ods::lat_long_of(picture.camera), {}};
  ods::StoredPicture source;
  source.size = {4096, 2048};
  source.camera = whole.camera;
  const ods::Extent fitting = fitting_extent(source, picture.camera.projection);
  const double width = 4096.0 * picture.eye.width / fitting.width;
  whole.eye.width = std::clamp(2 * static_cast<int>(std::ceil(0.5 * width)), 64, kMaxWidth);
  whole.eye.height = whole.eye.width / 2;
  whole.bands = ods::cycles_bands(whole.camera, whole.eye.height);
  return whole;
}

// Puts rows below others.
void append(ods::EyeImage& above, const ods::EyeImage& below) {
  using Layer = ods::Image ods::EyeImage::*;
  using ods::EyeImage;
  for (const Layer layer : {&EyeImage::radiance, &EyeImage::depth, &EyeImage::normal, &EyeImage::albedo,
                            &EyeImage::alpha, &EyeImage::variance, &EyeImage::samples}) {
    ods::Image& image = above.*layer;
    const ods::Image& more = below.*layer;
    image.pixels.insert(image.pixels.end(), more.pixels.begin(), more.pixels.end());
    image.height += more.height;
  }
}

// One eye's picture from the files of its parts, each of all bands. counts: gets the number of samples, if it is not
// null.
ods::EyeImage read_eye(const Rendered& rendered, const ods::FrameNames& names, int first, size_t parts,
                       ods::CyclesPasses passes, ods::Image* counts) {
  ods::EyeImage eye;
  for (size_t band = 0; band < rendered.bands.size(); band++) {
    std::vector<std::string> files;
    for (size_t part = 0; part < parts; part++) {
      files.push_back(names.path(first + static_cast<int>(part * rendered.bands.size() + band)));
    }
    const ods::vec3 position = passes.camera.position;
    const float yaw = passes.camera.yaw;
    passes.camera = rendered.bands[band].camera;
    passes.camera.position = position, passes.camera.yaw = yaw;
    ods::EyeImage rows = read_cycles(files, passes);
    if (counts) {
      const ods::Image more = ods::read_cycles_counts(files);
      counts->pixels.insert(counts->pixels.end(), more.pixels.begin(), more.pixels.end());
      counts->width = more.width, counts->height += more.height, counts->channels = 1;
    }
    if (band == 0) {
      eye = std::move(rows);
    } else {
      append(eye, rows);
    }
  }
  return eye;
}

void denoise_both(ods::Picture& picture, const CyclesPicture& wanted, const ods::StereoCamera& camera) {
  if (wanted.denoiser == ods::Denoiser::kNone) return;
  if (wanted.layers) {
    for (ods::EyeImage& eye : picture.eyes) eye.raw = eye.radiance;
  }
  ods::DenoiseOptions options;
  options.threads = wanted.shot.threads;
  options.keep_statistics = wanted.layers;
  if (wanted.denoiser == ods::Denoiser::kOwn && has_variance(picture)) denoise(picture, camera, options);
  if (wanted.denoiser == ods::Denoiser::kOidn) denoise_with_oidn(picture, camera, wanted.shot.threads);
}

std::string strain_of(const ods::Picture& picture, const ods::StereoCamera& camera) {
  if (picture.eyes.size() < 2) return "";
  ods::SeenDepth seen;
  seen.camera = camera;
  seen.eye = picture.eyes[0].eye;
  seen.depth = picture.eyes[0].depth;
  return strain_line(judge_comfort(seen), ods::ComfortLevel::kError);
}

// Saves the lat-long beside the final file, and converts it.
std::vector<std::string> save_converted(const ods::Picture& picture, const CyclesPicture& wanted,
                                        const ods::StereoCamera& lat_long, const ods::StereoCamera& camera,
                                        const std::string& path) {
  const ods::PrivateFolder folder;
  const std::string whole = folder.path() + "/whole.exr";
  ods::SaveOptions plain;
  save_picture(picture, lat_long, plain, whole);
  const ods::StoredPicture stored = ods::open_picture(whole);
  ods::ConvertTarget target;
  target.camera = camera;
  target.eye = wanted.eye;
  target.eyes = wanted.eyes;
  const std::string fault = conversion_fault(stored, target);
  if (!fault.empty()) throw ods::Error(ods::ErrorKind::kUsage, fault);
  const ods::Conversion conversion = convert(stored, target);
  return save_picture(conversion.rows, &camera, wanted.save, path);
}

}  // namespace

void check_cycles_picture(const CyclesPicture& picture) {
  const bool is_part = picture.part.count > 1;
  if (!is_part && !picture.statistics) return;
  const char* const option = is_part ? "--part" : "--statistics";
  if (!ods::cycles_projects(picture.camera.projection)) {
    throw UsageError(
        fmt::format("{} with --renderer cycles needs a lat-long: ods convert changes the finished .exr", option));
  }
  if (is_part && picture.has_alpha) {
    throw UsageError("--part with --renderer cycles cannot be transparent: frames are split without parts");
  }
}

std::vector<int> part_numbers(const CyclesPicture& picture) {
  std::vector<int> numbers(picture.eyes.size() * parts_of_eye(picture) * rendered_for(picture).bands.size());
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

CyclesRendered render_eyes(CyclesSession& session, const CyclesPicture& picture, const ods::FrameNames& parts,
                           const std::function<void(double)>& report) {
  const Rendered rendered = rendered_for(picture);
  const std::vector<int> numbers = part_numbers(picture);
  const size_t parts_each = parts_of_eye(picture), bands = rendered.bands.size();
  const auto shares = static_cast<size_t>(picture.part.count) * parts_each;
  CyclesShot shot = picture.shot;
  shot.camera = rendered.camera;
  shot.parts = static_cast<int>(shares);
  shot.time_limit /= static_cast<double>(bands);
  shot.statistics = picture.statistics;
  CyclesRendered result;
  result.pose = session.pose(shot);
  for (size_t i = 0; i < numbers.size(); i++) {
    const std::string file = parts.path(numbers[i]);
    const ods::CyclesBand& band = rendered.bands[i % bands];
    const size_t eye = i / bands / parts_each;
    const size_t share = (i / bands) % parts_each + static_cast<size_t>(picture.part.number) - 1;
    shot.eye = picture.eyes[eye];
    shot.camera = band.camera;
    shot.size = {rendered.eye.width, band.rows};
    shot.seed = ods::hash_pair(picture.shot.seed, static_cast<ods::uint>((eye * shares + share) * bands + i % bands));
    const auto of_part = [&](double done) {
      report(kShareOfCycles * (static_cast<double>(i) + done) / static_cast<double>(numbers.size()));
    };
    if (!ods::is_saved(file)) session.render(shot, file, of_part);
    of_part(1.0);
  }
  result.camera = rendered.camera;
  result.camera.position = result.pose.position;
  result.camera.yaw = result.pose.yaw;
  for (size_t eye = 0; eye < picture.eyes.size(); eye++) {
    const ods::CyclesPasses passes{result.camera, picture.eyes[eye], session.scene().foreign.unit, picture.has_alpha};
    const int first = numbers[eye * parts_each * bands];
    ods::Image* const counts = picture.statistics ? &result.samples.emplace_back() : nullptr;
    result.picture.eyes.push_back(read_eye(rendered, parts, first, parts_each, passes, counts));
  }
  return result;
}

CyclesSaved make_picture(CyclesSession& session, const CyclesPicture& picture, const ods::FrameNames& parts,
                         const std::string& path, const std::function<void(double)>& report) {
  CyclesRendered rendered = render_eyes(session, picture, parts, report);
  ods::StereoCamera camera = picture.camera;
  camera.position = rendered.pose.position;
  camera.yaw = rendered.pose.yaw;
  CyclesSaved saved;
  saved.pose = rendered.pose;
  saved.strain = strain_of(rendered.picture, rendered.camera);
  denoise_both(rendered.picture, picture, rendered.camera);
  for (size_t i = 0; i < rendered.picture.eyes.size(); i++) {
    ods::EyeImage& eye = rendered.picture.eyes[i];
    if (!picture.layers) eye.depth = eye.normal = eye.albedo = eye.variance = eye.samples = ods::Image();
    if (picture.statistics) eye.samples = std::move(rendered.samples[i]);
  }
  const bool is_converted = !ods::cycles_projects(picture.camera.projection);
  saved.files = is_converted ? save_converted(rendered.picture, picture, rendered.camera, camera, path)
                             : save_picture(rendered.picture, camera, picture.save, path);
  return saved;
}
