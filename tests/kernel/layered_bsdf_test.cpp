// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/kernel/layered_bsdf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/kernel/bsdf.h"
#include "ods/kernel/random.h"
#include "ods/render/lights.h"
#include "ods/render/tables.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods::layered_bsdf_test {

BsdfEvaluator make_kernel() {
  BsdfEvaluator kernel;
  kernel.tables = kernel_tables({.glass = true, .sheen = true, .anisotropy = true}).data();
  return kernel;
}

const vec3 kUp(0.0f, 0.0f, 1.0f);

// A surface and its layers. By default a white rough dielectric whose layers change nothing.
struct Layered {
  Surface surface{};
  SurfaceLayers layers{};
  float eta = 1.5f;

  Layered() {
    surface.geometric = surface.normal = kUp;
    surface.front = true;
    surface.base_color = vec3(1.0f);
    surface.roughness = 0.5f;
    surface.ior = 1.5f;
    surface.layered = true;
    layers.specular_color = vec3(1.0f);
    layers.specular = 1.0f;
    layers.clearcoat_normal = kUp;
    layers.anisotropy_direction = vec3(1.0f, 0.0f, 0.0f);
    layers.film = {1.3f, 400.0f};
    layers.diffuse_transmission_color = vec3(1.0f);
  }
};

Bsdf make(BsdfEvaluator& kernel, const Layered& material, vec3 wo) {
  kernel.surface_layers = material.layers;
  return kernel.make_bsdf(material.surface, -wo, material.eta);
}

vec3 viewer(float cosine, float turn = 0.0f) {
  const float sine = std::sqrt(1.0f - cosine * cosine);
  return vec3(sine * std::cos(turn), sine * std::sin(turn), cosine);
}

vec3 random_direction(Dice& dice, float lowest, float highest) {
  return viewer(dice.between(lowest, highest), dice.between(0.0f, 2.0f * kPi));
}

struct NamedMaterial {
  const char* name;
  Layered material;
};

template <typename Change>
NamedMaterial named(const char* name, Change change) {
  NamedMaterial result{name, {}};
  change(result.material);
  return result;
}

// Each lobe on its own and mixtures of them, all white.
std::vector<NamedMaterial> white_materials(float roughness) {
  std::vector<NamedMaterial> all = {
      named("plain", [](Layered&) {}),
      named("no specular", [](Layered& m) { m.layers.specular = 0.0f; }),
      named("half specular", [](Layered& m) { m.layers.specular = 0.5f; }),
      named("bright specular", [](Layered& m) { m.layers.specular_color = vec3(8.0f); }),
      named("specular without index", [](Layered& m) { m.surface.ior = 1e8f, m.layers.specular_color = vec3(0.3f); }),
      named("coat", [](Layered& m) { m.layers.clearcoat = 1.0f, m.layers.clearcoat_roughness = 0.3f; }),
      named("smooth coat", [](Layered& m) { m.layers.clearcoat = 0.7f; }),
      named("coat over metal",
            [](Layered& m) {
              m.layers.clearcoat = 1.0f, m.layers.clearcoat_roughness = 0.1f, m.surface.metallic = 1.0f;
            }),
      named("sheen", [](Layered& m) { m.layers.sheen_color = vec3(1.0f), m.layers.sheen_roughness = 0.5f; }),
      named("fine sheen", [](Layered& m) { m.layers.sheen_color = vec3(0.8f), m.layers.sheen_roughness = 0.1f; }),
      named("sheen over metal",
            [](Layered& m) {
              m.layers.sheen_color = vec3(1.0f), m.layers.sheen_roughness = 1.0f, m.surface.metallic = 1.0f;
            }),
      named("anisotropic", [](Layered& m) { m.layers.anisotropy = 0.6f; }),
      named("anisotropic metal", [](Layered& m) { m.layers.anisotropy = 0.8f, m.surface.metallic = 1.0f; }),
      named("anisotropic sheet", [](Layered& m) { m.layers.anisotropy = 0.8f, m.surface.transmission = 1.0f; }),
      named("film over metal", [](Layered& m) { m.layers.iridescence = 1.0f, m.surface.metallic = 1.0f; }),
      named("through", [](Layered& m) { m.layers.diffuse_transmission = 0.4f; }),
      named("all through", [](Layered& m) { m.layers.diffuse_transmission = 1.0f; }),
      named("tinted sheet", [](Layered& m) { m.layers.specular = 0.6f, m.surface.transmission = 1.0f; }),
      named("coated sheet", [](Layered& m) { m.layers.clearcoat = 1.0f, m.surface.transmission = 0.7f; }),
      named("everything", [](Layered& m) {
        m.layers.clearcoat = 0.6f, m.layers.clearcoat_roughness = 0.4f;
        m.layers.sheen_color = vec3(0.5f), m.layers.sheen_roughness = 0.4f;
        m.layers.anisotropy = 0.5f, m.layers.diffuse_transmission = 0.3f;
        m.surface.metallic = 0.2f, m.surface.transmission = 0.3f;
      })};
  for (NamedMaterial& each : all) each.material.surface.roughness = roughness;
  return all;
}

// Multiples of it fill the cube evenly: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.
const glm::dvec3 kR3(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);

// The share of uniform light that a surface reflects.
glm::dvec3 whiteness(BsdfEvaluator& kernel, const Layered& material, vec3 wo, int samples = 1 << 13) {
  const Bsdf bsdf = make(kernel, material, wo);
  glm::dvec3 sum(0.0);
  for (int i = 0; i < samples; i++) {
    const glm::vec3 at(glm::fract(static_cast<double>(i) * kR3));
    const BsdfSample found = kernel.sample_bsdf(bsdf, at.x, vec2(at.y, at.z));
    for (int c = 0; c < 3; c++) EXPECT_TRUE(found.weight[c] >= 0.0f && std::isfinite(found.weight[c]));
    sum += glm::dvec3(found.weight);
  }
  return sum / static_cast<double>(samples);
}

const float kRoughness[] = {0.0f, 0.05f, 0.2f, 0.4f, 0.7f, 1.0f};
const float kCosines[] = {1.0f, 0.85f, 0.6f, 0.4f, 0.2f, 0.1f};

// White stays white, whatever the mixture.
TEST(LayersFurnace, WhiteStaysWhite) {
  BsdfEvaluator kernel = make_kernel();
  for (float roughness : kRoughness) {
    for (const NamedMaterial& each : white_materials(roughness)) {
      for (float cosine : kCosines) {
        const double white = whiteness(kernel, each.material, viewer(cosine, 0.6f), 1 << 14).x;
        EXPECT_NEAR(white, 1.0, 1e-2) << each.name << ", roughness " << roughness << ", cosine " << cosine;
      }
    }
  }
}

// Glass that encloses a volume, from either side; its tables are coarser (bsdf_test.cpp).
TEST(LayersFurnace, Volumes) {
  BsdfEvaluator kernel = make_kernel();
  for (float roughness : {0.0f, 0.2f, 0.6f}) {
    for (float eta : {1.5f, 1.0f / 1.5f}) {
      for (NamedMaterial each : white_materials(roughness)) {
        Layered& m = each.material;
        if (m.layers.anisotropy > 0.0f) continue;
        m.surface.transmission = 1.0f;
        m.surface.volume = true;
        m.surface.front = eta > 1.0f;
        m.eta = eta;
        for (float cosine : {1.0f, 0.8f, 0.5f, 0.2f}) {
          const double white = whiteness(kernel, m, viewer(cosine)).x;
          EXPECT_LT(white, 1.04) << each.name << ' ' << roughness << ' ' << eta << ' ' << cosine;
          EXPECT_GT(white, 0.96) << each.name << ' ' << roughness << ' ' << eta << ' ' << cosine;
        }
      }
    }
  }
}

// A film divides colours between reflection and what is below it. The colour that it reflects most stays whole, and no
// colour gains.
TEST(LayersFurnace, FilmsCreateNothing) {
  BsdfEvaluator kernel = make_kernel();
  for (float roughness : {0.0f, 0.3f, 0.7f}) {
    for (float thickness : {80.0f, 250.0f, 400.0f, 700.0f}) {
      for (float cosine : {1.0f, 0.7f, 0.4f, 0.2f}) {
        for (float transmission : {0.0f, 1.0f}) {
          Layered m;
          m.surface.roughness = roughness;
          m.surface.transmission = transmission;
          m.layers.iridescence = 1.0f;
          m.layers.film = {1.33f, thickness};
          const glm::dvec3 white = whiteness(kernel, m, viewer(cosine));
          const double maximum = std::max({white.x, white.y, white.z});
          EXPECT_LT(maximum, 1.01) << roughness << " " << thickness << " " << cosine << " " << transmission;
          EXPECT_GT(maximum, 0.975) << roughness << " " << thickness << " " << cosine << " " << transmission;
          EXPECT_GT(std::min({white.x, white.y, white.z}), 0.2);
        }
      }
    }
  }
}

// Layers that change nothing give the BSDF of a surface without layers.
TEST(Layers, DefaultsAreThePlainMaterial) {
  BsdfEvaluator kernel = make_kernel();
  Dice dice(1);
  int lit = 0;
  for (int i = 0; i < 20000; i++) {
    Layered m;
    m.surface.roughness = dice.between(0.05f, 1.0f);
    m.surface.metallic = dice.next() < 0.5f ? 0.0f : dice.next();
    m.surface.transmission = dice.next() < 0.5f ? 0.0f : dice.next();
    m.surface.volume = dice.next() < 0.5f;
    m.surface.base_color = vec3(dice.next(), dice.next(), dice.next());
    m.surface.ior = m.eta = dice.between(1.05f, 2.5f);
    const vec3 wo = random_direction(dice, 0.02f, 1.0f), wi = random_direction(dice, -1.0f, 1.0f);
    const BsdfValue ours = kernel.bsdf_value(make(kernel, m, wo), wi);
    m.surface.layered = false;
    const BsdfValue plain = kernel.bsdf_value(make(kernel, m, wo), wi);
    for (int c = 0; c < 3; c++) {
      ASSERT_NEAR(ours.value[c], plain.value[c], 2e-3f * plain.value[c] + 1e-6f) << i;
    }
    lit += plain.value.x > 1e-3f;
  }
  EXPECT_GT(lit, 5000);
}

// Swapping light and viewer changes nothing, but for what looks at the viewer only: energy compensation, and what a
// coat or a sheen leaves of the base. So: a black metal, sheen over black, Lambert without a specular lobe.
TEST(LayersReciprocity, LobesThatHaveIt) {
  BsdfEvaluator kernel = make_kernel();
  Dice dice(2);
  std::vector<NamedMaterial> materials = {
      named("anisotropic", [](Layered& m) { m.layers.anisotropy = 0.7f, m.surface.metallic = 1.0f; }),
      named("sheen",
            [](Layered& m) {
              m.layers.sheen_color = vec3(1.0f), m.layers.sheen_roughness = 0.4f, m.layers.specular = 0.0f;
            }),
  };
  for (NamedMaterial& each : materials) {
    each.material.surface.base_color = vec3(0.0f);
    for (int i = 0; i < 2000; i++) {
      const vec3 a = random_direction(dice, 0.05f, 1.0f), b = random_direction(dice, 0.05f, 1.0f);
      const float forward = kernel.bsdf_value(make(kernel, each.material, a), b).value.x / b.z;
      const float back = kernel.bsdf_value(make(kernel, each.material, b), a).value.x / a.z;
      ASSERT_NEAR(forward, back, 1e-3f * std::max(forward, back) + 1e-9f) << each.name;
    }
  }
}

TEST(LayersReciprocity, DiffuseTransmission) {
  BsdfEvaluator kernel = make_kernel();
  Layered front;
  front.layers.specular = 0.0f;
  front.layers.diffuse_transmission = 0.6f;
  front.layers.diffuse_transmission_color = vec3(0.2f, 0.5f, 0.9f);
  Layered back = front;
  back.surface.normal = back.surface.geometric = back.layers.clearcoat_normal = -kUp;
  back.surface.front = false;
  Dice dice(3);
  for (int i = 0; i < 1000; i++) {
    const vec3 above = random_direction(dice, 0.05f, 1.0f), below = random_direction(dice, -1.0f, -0.05f);
    const vec3 in = kernel.bsdf_value(make(kernel, front, above), below).value / -below.z;
    const vec3 out = kernel.bsdf_value(make(kernel, back, below), above).value / above.z;
    ASSERT_LT(length(in - out), 1e-6f);
    ASSERT_LT(length(in - 0.6f * front.layers.diffuse_transmission_color / kPi), 1e-6f);
  }
}

// Directions are sampled as often as by the pdf. Cells of the sphere: by height and turn.
const int kHeights = 24, kTurns = 24;

size_t cell_of(vec3 w) {
  const int z = std::min(static_cast<int>((w.z + 1.0f) * 0.5f * kHeights), kHeights - 1);
  const int turn = std::min(static_cast<int>((std::atan2(w.y, w.x) / (2.0f * kPi) + 0.5f) * kTurns), kTurns - 1);
  return static_cast<size_t>(z * kTurns + turn);
}

double sampling_p(BsdfEvaluator& kernel, const Layered& material, vec3 wo, uint seed) {
  constexpr int kCount = 100000, kFine = 16;
  const Bsdf bsdf = make(kernel, material, wo);
  std::vector<double> counts(kHeights * kTurns + 1), expected(counts.size());
  Dice dice(seed);
  for (int i = 0; i < kCount; i++) {
    const float pick = dice.next();
    const BsdfSample found = kernel.sample_bsdf(bsdf, pick, dice.pair());
    counts[found.pdf > 0.0f ? cell_of(found.direction) : counts.size() - 1]++;
  }
  const double area = 4.0 * double{kPi} / (kHeights * kTurns * kFine * kFine);
  for (int z = 0; z < kHeights * kFine; z++) {
    for (int turn = 0; turn < kTurns * kFine; turn++) {
      const float height = 2.0f * (static_cast<float>(z) + 0.5f) / (kHeights * kFine) - 1.0f;
      const vec3 wi = viewer(height, (2.0f * (static_cast<float>(turn) + 0.5f) / (kTurns * kFine) - 1.0f) * kPi);
      expected[cell_of(wi)] += double{kernel.bsdf_value(bsdf, wi).pdf} * area * kCount;
    }
  }
  expected.back() = kCount;
  for (size_t i = 0; i + 1 < expected.size(); i++) expected.back() -= expected[i];
  // The share that the surface absorbs, and for mirrors the rest.
  EXPECT_GT(expected.back(), -0.002 * kCount);
  expected.back() = std::max(expected.back(), 0.0);
  return chi_square_p(counts, expected);
}

TEST(LayersSampling, DirectionsFollowThePdf) {
  BsdfEvaluator kernel = make_kernel();
  std::vector<NamedMaterial> materials = white_materials(0.6f);
  materials.push_back(named("film", [](Layered& m) { m.layers.iridescence = 1.0f; }));
  materials.push_back(named("bumpy coat", [](Layered& m) {
    m.layers.clearcoat = 1.0f, m.layers.clearcoat_roughness = 0.5f, m.layers.clearcoat_normal = viewer(0.9f, 2.0f);
  }));
  materials.push_back(named(
      "volume", [](Layered& m) { m.layers.specular = 0.5f, m.surface.transmission = 1.0f, m.surface.volume = true; }));
  const float cosines[] = {0.95f, 0.5f};
  const double limit = significance(static_cast<int>(materials.size()) * 2);
  uint seed = 1;
  for (const NamedMaterial& each : materials) {
    for (float cosine : cosines) {
      EXPECT_GT(sampling_p(kernel, each.material, viewer(cosine, 0.4f), seed++), limit) << each.name << ' ' << cosine;
    }
  }
}

// Whatever the numbers, nothing but finite, not negative weights and unit directions come out.
TEST(Layers, NeverBreak) {
  BsdfEvaluator kernel = make_kernel();
  Dice dice(4);
  const auto extreme = [&](float low, float high) {
    const float u = dice.next();
    return u < 0.3f ? low : u < 0.5f ? high : dice.between(low, high);
  };
  const auto color = [&] { return vec3(extreme(0.0f, 1.0f), extreme(0.0f, 1.0f), extreme(0.0f, 1.0f)); };
  for (int i = 0; i < 30000; i++) {
    Layered m;
    m.surface.roughness = extreme(0.0f, 1.0f);
    m.surface.metallic = extreme(0.0f, 1.0f);
    m.surface.transmission = extreme(0.0f, 1.0f);
    m.surface.volume = dice.next() < 0.5f;
    m.surface.front = dice.next() < 0.5f;
    m.surface.base_color = color();
    m.surface.ior = dice.next() < 0.1f ? 1e8f : extreme(1.0f, 3.0f);
    m.eta = dice.next() < 0.5f ? m.surface.ior : 1.0f / m.surface.ior;
    m.layers.specular = extreme(0.0f, 1.0f);
    m.layers.specular_color = color() * extreme(0.0f, 30.0f);
    m.layers.clearcoat = extreme(0.0f, 1.0f);
    m.layers.clearcoat_roughness = extreme(0.0f, 1.0f);
    m.layers.clearcoat_normal = random_direction(dice, 0.2f, 1.0f);
    m.layers.sheen_color = color();
    m.layers.sheen_roughness = extreme(0.0f, 1.0f);
    m.layers.anisotropy = extreme(0.0f, 1.0f);
    m.layers.anisotropy_direction = dice.next() < 0.2f ? kUp : random_direction(dice, -0.5f, 0.5f);
    m.layers.iridescence = extreme(0.0f, 1.0f);
    m.layers.film = {extreme(1.0f, 4.0f), extreme(0.0f, 2000.0f)};
    m.layers.diffuse_transmission = extreme(0.0f, 1.0f);
    m.layers.diffuse_transmission_color = color();
    if (dice.next() < 0.3f) m.layers.wave_eta = vec3(m.eta * 0.97f, m.eta, m.eta * 1.03f);
    const float z = dice.next() < 0.3f ? std::exp(dice.between(-14.0f, -2.0f)) : extreme(1e-7f, 1.0f);
    const Bsdf bsdf = make(kernel, m, viewer(z, dice.next()));
    for (float pick : {0.0f, dice.next(), dice.next(), dice.next(), 0.9999999f}) {
      const vec2 uv(extreme(0.0f, 0.9999999f), extreme(0.0f, 0.9999999f));
      const BsdfSample found = kernel.sample_bsdf(bsdf, pick, uv);
      for (int c = 0; c < 3; c++) ASSERT_TRUE(found.weight[c] >= 0.0f && found.weight[c] < 1e4f) << found.weight[c];
      ASSERT_TRUE(found.pdf >= 0.0f && std::isfinite(found.pdf));
      ASSERT_TRUE(found.weight == vec3(0.0f) || std::abs(length(found.direction) - 1.0f) < 1e-4f);
      const BsdfValue value = kernel.bsdf_value(bsdf, random_direction(dice, -1.0f, 1.0f));
      ASSERT_TRUE(value.pdf >= 0.0f && std::isfinite(value.pdf));
      for (int c = 0; c < 3; c++) ASSERT_TRUE(value.value[c] >= 0.0f && std::isfinite(value.value[c]));
    }
  }
}

// The denoiser's albedo of the surface: with specular and glossiness it is not the base colour alone.
TEST(Layers, AlbedoHasTheReflectionsColour) {
  BsdfEvaluator kernel = make_kernel();
  Layered metal;
  metal.surface.base_color = vec3(0.0f);
  metal.surface.ior = 1e8f;
  metal.layers.specular_color = vec3(0.9f, 0.6f, 0.2f);
  kernel.surface_layers = metal.layers;
  EXPECT_LT(length(kernel.albedo_of_layers(metal.surface, -kUp) - metal.layers.specular_color), 1e-6f);
  for (const NamedMaterial& each : white_materials(0.5f)) {
    if (each.material.surface.ior > 2.0f) continue;
    kernel.surface_layers = each.material.layers;
    const vec3 white = kernel.albedo_of_layers(each.material.surface, -viewer(0.6f));
    EXPECT_LT(length(white - vec3(1.0f)), 1e-5f) << each.name;
  }
}

// Each slot's channel, and what its factor does.
TEST(Layers, TexturesMultiplyTheFactors) {
  Scene scene;
  scene.textures.push_back({});
  scene.textures[0].width = scene.textures[0].height = 1;
  scene.texels.push_back(51u | 102u << 8 | 153u << 16 | 204u << 24);  // 0.2, 0.4, 0.6, 0.8
  MaterialLayers layers = default_layers();
  layers.clearcoat = layers.clearcoat_roughness = layers.sheen_roughness = layers.anisotropy = 0.5f;
  layers.iridescence = layers.diffuse_transmission = layers.specular = 0.5f;
  layers.sheen_color = vec3(0.5f);
  layers.iridescence_thinnest = 100.0f;
  layers.iridescence_thickest = 200.0f;
  layers.clearcoat_normal_scale = 0.5f;
  for (TextureSlot* slot :
       {&layers.specular_slot, &layers.specular_color_slot, &layers.clearcoat_slot, &layers.clearcoat_roughness_slot,
        &layers.clearcoat_normal_slot, &layers.sheen_color_slot, &layers.sheen_roughness_slot, &layers.anisotropy_slot,
        &layers.iridescence_slot, &layers.iridescence_thickness_slot, &layers.diffuse_transmission_slot,
        &layers.diffuse_transmission_color_slot}) {
    slot->texture = 0;
  }
  add_rectangle(scene, vec3(0.0f), vec3(1, 0, 0), vec3(0, 1, 0), add_layered(scene, default_material(), layers));
  for (Vertex& vertex : scene.vertices) vertex.tangent = vec4(1, 0, 0, 1);
  const LightTable lights = make_lights(scene);
  BsdfEvaluator kernel;
  set_scene(kernel, scene, lights);
  const Hit hit{1.0f, 0.3f, 0.3f, 0, 0};
  const vec3 direction(0.0f, 0.0f, -1.0f), color(0.2f, 0.4f, 0.6f);
  const Surface surface = kernel.surface_at(hit, direction, false);
  ASSERT_TRUE(surface.layered);
  kernel.read_layers(hit, surface, direction, false);
  const SurfaceLayers& found = kernel.surface_layers;
  EXPECT_NEAR(found.specular, 0.4f, 1e-6f);
  EXPECT_LT(length(found.specular_color - color), 1e-6f);
  EXPECT_NEAR(found.clearcoat, 0.1f, 1e-6f);
  EXPECT_NEAR(found.clearcoat_roughness, 0.2f, 1e-6f);
  EXPECT_LT(length(found.clearcoat_normal - normalize(vec3(-0.3f, -0.1f, 0.2f))), 1e-5f);
  EXPECT_LT(length(found.sheen_color - 0.5f * color), 1e-6f);
  EXPECT_NEAR(found.sheen_roughness, 0.4f, 1e-6f);
  EXPECT_NEAR(found.anisotropy, 0.3f, 1e-6f);
  EXPECT_LT(length(found.anisotropy_direction - vec3(-0.6f, -0.2f, 0.0f)), 1e-5f);
  EXPECT_NEAR(found.iridescence, 0.1f, 1e-6f);
  EXPECT_NEAR(found.film.thickness, 140.0f, 1e-3f);
  EXPECT_NEAR(found.diffuse_transmission, 0.4f, 1e-6f);
  EXPECT_LT(length(found.diffuse_transmission_color - color), 1e-6f);
}

// Smooth glass that splits colours: each colour is reflected by its own reflectance and refracted by its own index.
TEST(LayersDispersion, EachColourByItsOwnIndex) {
  BsdfEvaluator kernel = make_kernel();
  for (float inside : {0.0f, 1.0f}) {
    for (float cosine : kCosines) {
      Layered m;
      m.surface.roughness = 0.0f;
      m.surface.transmission = 1.0f;
      m.surface.volume = true;
      const vec3 index(1.4f, 1.5f, 1.6f);
      m.layers.wave_eta = inside > 0.0f ? 1.0f / index : index;
      glm::dvec3 reflected(0.0), passed(0.0);
      const int count = 20000;
      for (int wave = 0; wave < 3; wave++) {
        m.eta = m.layers.wave_eta[wave];
        const Bsdf bsdf = make(kernel, m, viewer(cosine));
        for (int i = 0; i < count; i++) {
          const float pick = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
          const BsdfSample found = kernel.sample_bsdf(bsdf, pick, vec2(0.5f));
          if (found.through) passed[wave] += double{found.weight[wave]} / count;
          if (!found.through) reflected += glm::dvec3(found.weight) / (3.0 * count);
        }
      }
      for (int wave = 0; wave < 3; wave++) {
        const double expected = double{fresnel_dielectric(cosine, m.layers.wave_eta[wave])};
        EXPECT_NEAR(reflected[wave], expected, 2e-3) << inside << ' ' << cosine;
        EXPECT_NEAR(passed[wave], 1.0 - expected, 2e-3) << inside << ' ' << cosine;
      }
    }
  }
}

}  // namespace ods::layered_bsdf_test
