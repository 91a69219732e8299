// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/film_light.h"

#include "ods/render/cpu/render.h"
#include "tests/layers/film/film_scene.h"

namespace ods::film_light_test {

using namespace film_scene;

vec3 texel_of(const Image& image, vec2 uv) {
  const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(image.width)), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(image.height)), 0, image.height - 1);
  const float* texel = image.at(x, y);
  return {texel[0], texel[1], texel[2]};
}

LayerLight exact_light() {
  LayerLight light;
  light.bake.render.samples = 1;
  light.bake.is_denoised = false;
  light.tone = ToneCurve::kLinear;
  return light;
}

TEST(FilmLight, IsEveryStepAndTheLastFrame) {
  EXPECT_EQ(light_frames(9, 4), (std::vector<size_t>{0, 4, 8}));
  EXPECT_EQ(light_frames(8, 4), (std::vector<size_t>{0, 4, 7}));
  EXPECT_EQ(light_frames(2, 100), (std::vector<size_t>{0, 1}));
}

// A triangle of vertex colours, which turns while its factor grows from 0.2 to 0.8: its texels show both.
TEST(FilmLight, IsThatOfEachMomentOnThePointsOfTheSurface) {
  GltfBuilder file = turning(true);
  file.primitive()["attributes"]["COLOR_0"] = file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, kFloat, "VEC3");
  animate(file, pointer("/materials/0/pbrMetallicRoughness/baseColorFactor"), {0, 2},
          {0.2f, 0.2f, 0.2f, 1, 0.8f, 0.8f, 0.8f, 1}, "VEC4");
  Scene scene = playing(file.load());
  const HeadBox box = small_box();
  FilmGeometry geometry = build_film(scene, find_movers(scene, kTimes), kTimes, box, 1024);
  const std::vector<size_t> frames = light_frames(kTimes.size(), 4);
  std::unique_ptr<CpuRenderer> renderer;
  const auto set = [&](size_t frame) -> const Renderer& {
    set_time(scene, kTimes[frame]);
    renderer = std::make_unique<CpuRenderer>(scene);
    return *renderer;
  };
  const LayerFilm film = light_film(std::move(geometry), scene, box.center, frames, set, exact_light());
  EXPECT_EQ(film.light_times, (std::vector<float>{0.0f, 1.0f, 2.0f}));
  int compared = 0;
  for_each_look(scene, kTimes, box, [&](size_t frame, vec3 point, vec3 eye, bool) {
    const auto light = std::ranges::find(frames, frame);
    const FilmSpot spot = spot_at(film, frame, point, eye);
    if (light == frames.end() || !spot.found) return;
    const vec3 a = triangle_point(scene, {0, 0}), b = triangle_point(scene, {1, 0}), c = triangle_point(scene, {0, 1});
    const float v = dot(c - a, point - a), u = dot(b - a, point - a);  // unit axes at right angles
    const float factor = 0.2f + 0.3f * static_cast<float>(light - frames.begin());
    const Image& texture = film.lights[spot.texture][static_cast<size_t>(light - frames.begin())];
    const vec3 shown = texel_of(texture, spot.uv);
    for (int i = 0; i < 3; i++) {
      EXPECT_NEAR(srgb_decode(shown[i]), factor * vec3(1 - u - v, u, v)[i], 0.02f) << frame << " " << u << " " << v;
    }
    compared++;
  });
  EXPECT_GT(compared, 800);
}

}  // namespace ods::film_light_test
