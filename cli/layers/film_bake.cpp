// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/layers/film_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "ods/layers/film/kept_light.h"

namespace {

constexpr int kFewer = 4;  // times fewer samples: with and without what moves, noise is much the same
constexpr size_t kMaxChangeBytes = size_t{128} << 20;  // of the still layers' light, on graphics cards

size_t lit_texels(const ods::CoarseLayers& layers) {
  return static_cast<size_t>(std::ranges::count_if(layers.rays->owners, [](int owner) { return owner >= 0; }));
}

// The light for the still layers of a film, with files of its own. moment: seconds; none without what moves.
ods::LayerLight coarse_options(const ods::LayerLight& light, const std::string& moment, size_t file) {
  ods::LayerLight own = light;
  own.bake.keeps_unfinished = false;
  own.bake.render.samples = std::max(light.bake.render.samples / kFewer, 1);
  own.bake.render.noise *= std::sqrt(static_cast<float>(kFewer));
  own.bake.scene.push_back({"moment", moment, ""});
  if (!light.bake.unfinished.empty()) {
    own.bake.unfinished = ods::unfinished_light(ods::still_light_file(light.bake.unfinished), file);
  }
  return own;
}

std::string kept_file(const ods::LayerLight& light, size_t file) {
  const std::string& path = light.bake.unfinished;
  return path.empty() ? "" : ods::finished_light(ods::still_light_file(path), file);
}

ods::LightChange change_of_still(const FilmJob& film, const std::function<const ods::Renderer&(size_t)>& set,
                                 const ods::LayerLight& light, const ods::Progress& progress) {
  std::vector<std::vector<ods::ChangedPart>> parts;
  const double n = static_cast<double>(film.lights.size());
  for (size_t i = 0; i < film.lights.size(); i++) {
    const size_t frame = film.lights[i];
    const ods::LayerLight own = coarse_options(light, fmt::format("{}", film.frames[frame].time), frame + 1);
    const ods::Image now =
        ods::coarse_light(film.still, set(frame), own, kept_file(light, frame + 1),
                          ods::part_of(progress, static_cast<double>(i) / n, static_cast<double>(i + 1) / n));
    parts.push_back(ods::changed_parts(film.still, film.without, now));
  }
  return ods::light_change(film.still, parts, kMaxChangeBytes);
}

}  // namespace

double share_of_film(const FilmJob& film, size_t still_texels) {
  if (film.movers.empty()) return 0.0;
  const double each = static_cast<double>(film.geometry.texels.size() + lit_texels(film.still));
  const double all = each * static_cast<double>(film.lights.size());
  return all / (all + static_cast<double>(lit_texels(film.still) + still_texels) + 1.0);
}

void light_without(FilmJob& film, const ods::Renderer& renderer, const ods::LayerLight& light,
                   const ods::Progress& progress) {
  if (film.movers.empty()) return;
  film.without =
      ods::coarse_light(film.still, renderer, coarse_options(light, "without", 0), kept_file(light, 0), progress);
}

ods::LayerFilm light_of_film(FilmJob film, ods::Scene& scene, const ods::HeadBox& box, ods::SequenceOptions options,
                             const ods::LayerLight& light, const ods::Progress& progress) {
  if (film.movers.empty()) return {};
  ods::FrameRenderer renderer(std::move(options), scene);
  const auto set = [&](size_t frame) -> const ods::Renderer& {
    renderer.set(film.frames[frame]);
    return renderer.renderer();
  };
  const double moving = static_cast<double>(film.geometry.texels.size());
  const double share = moving / (moving + static_cast<double>(lit_texels(film.still)) + 1.0);
  ods::LayerFilm lit = ods::light_film(std::move(film.geometry), scene, box.center, film.lights, set, light,
                                       ods::part_of(progress, 0.0, share));
  lit.change = change_of_still(film, set, light, ods::part_of(progress, share, 1.0));
  return lit;
}

void remove_unfinished(const std::string& path, const std::vector<size_t>& lights) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  if (lights.empty()) return;
  const auto remove_light = [&](const std::string& of, size_t frame) {
    std::filesystem::remove(ods::unfinished_light(of, frame), ignored);
    std::filesystem::remove(ods::finished_light(of, frame), ignored);
  };
  remove_light(ods::still_light_file(path), 0);
  for (const size_t frame : lights) {
    remove_light(path, frame);
    remove_light(ods::still_light_file(path), frame + 1);
  }
}
