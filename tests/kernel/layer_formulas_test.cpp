// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of each layer against its extension's formula, written here again in double precision and integrated
// numerically under a lat-long light.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "ods/render/cpu/render.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"

namespace ods {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double kPiExact = std::numbers::pi;

// --- the light

constexpr int kLightWidth = 16, kLightHeight = 8;

Environment make_light() {
  Environment light{vec3(1.0f), kLightWidth, kLightHeight, {}};
  Dice dice(1);
  for (int i = 0; i < kLightWidth * kLightHeight; i++) {
    const float red = dice.next(), green = dice.next();
    light.texels.push_back(vec3(0.3f) + 2.0f * vec3(red, green, dice.next()));
  }
  return light;
}

// Interpolated between the texels' centres; the picture's centre looks along -Z.
dvec3 light_at(const Environment& light, dvec3 d) {
  const double x = (std::atan2(d.x, -d.z) / (2.0 * kPiExact) + 0.5) * kLightWidth - 0.5;
  const double y = (0.5 - std::asin(std::clamp(d.y, -1.0, 1.0)) / kPiExact) * kLightHeight - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto texel = [&](double column, double row) {
    const int c = (static_cast<int>(column) + kLightWidth) % kLightWidth;
    const int r = std::clamp(static_cast<int>(row), 0, kLightHeight - 1);
    return dvec3(light.texels[static_cast<size_t>(r * kLightWidth + c)]);
  };
  return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), x - x0),
                  glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), x - x0), y - y0);
}

// --- formulas. Directions are in a frame whose z axis is the normal and whose x axis is the tangent.

using Bsdf64 = std::function<dvec3(dvec3 wi)>;  // of one viewer; without the cosine

// The integral of a function over the hemisphere above (side 1) or below (side -1).
dvec3 integrate(double side, const std::function<dvec3(dvec3)>& function) {
  constexpr int kHeights = 120, kTurns = 120;
  dvec3 sum(0.0);
  for (int i = 0; i < kHeights; i++) {
    const double t = (i + 0.5) / kHeights, z = t * t, r = std::sqrt(1.0 - z * z);  // denser where light grazes
    for (int k = 0; k < kTurns; k++) {
      const double turn = 2.0 * kPiExact * (k + 0.5) / kTurns;
      sum += function(dvec3(r * std::cos(turn), r * std::sin(turn), side * z)) * (2.0 * t);
    }
  }
  return sum * (2.0 * kPiExact / (kHeights * kTurns));
}

double squared(double x) {
  return x * x;
}

double largest_of(dvec3 c) {
  return std::max({c.x, c.y, c.z});
}

// glTF's specular_brdf with two alphas, as KHR_materials_anisotropy writes it: V * D.
double microfacets(dvec3 v, dvec3 l, dvec2 alpha) {
  const dvec3 h = glm::normalize(v + l);
  const double a2 = alpha.x * alpha.y;
  const dvec3 f(alpha.y * h.x, alpha.x * h.y, a2 * h.z);
  const double w2 = a2 / glm::dot(f, f), d = a2 * w2 * w2 / kPiExact;
  const double towards_viewer = l.z * glm::length(dvec3(alpha.x * v.x, alpha.y * v.y, v.z));
  const double towards_light = v.z * glm::length(dvec3(alpha.x * l.x, alpha.y * l.y, l.z));
  return d * 0.5 / (towards_viewer + towards_light);
}

using Fresnel64 = std::function<dvec3(double cosine)>;

Fresnel64 schlick64(dvec3 f0, dvec3 f90) {
  return [=](double c) { return f0 + (f90 - f0) * std::pow(1.0 - c, 5.0); };
}

// Microfacets with a Fresnel term, and their albedo towards the viewer. Light that single scattering loses comes back
// (Turquin 2019): f * (1 + F * (1 / E - 1)), where E is what perfect mirrors would return, and F the colour of what
// returns: f0 of Schlick's term, the film's mean reflectance.
struct Specular {
  Bsdf64 value;
  dvec3 albedo;
};

Specular specular64(dvec3 v, dvec2 alpha, const Fresnel64& fresnel, const dvec3* f0) {
  const double kept = integrate(1.0, [&](dvec3 l) { return dvec3(microfacets(v, l, alpha) * l.z); }).x;
  const dvec3 single = integrate(
      1.0, [&](dvec3 l) { return fresnel(glm::dot(v, glm::normalize(v + l))) * microfacets(v, l, alpha) * l.z; });
  const dvec3 gain = 1.0 + (f0 ? *f0 : single / kept) * (1.0 / kept - 1.0);
  const Bsdf64 value = [=](dvec3 l) {
    return l.z <= 0.0 ? dvec3(0.0) : fresnel(glm::dot(v, glm::normalize(v + l))) * microfacets(v, l, alpha) * gain;
  };
  return {value, single * gain};
}

double charlie(dvec3 v, dvec3 l, double roughness) {
  const double a = roughness * roughness;
  const double cosine = glm::normalize(v + l).z;
  const double d = (2.0 + 1.0 / a) * std::pow(1.0 - cosine * cosine, 0.5 / a) / (2.0 * kPiExact);
  const auto exponent = [&](double x) {
    const double m = squared(1.0 - a);
    return std::lerp(21.5473, 25.3245, m) /
               (1.0 + std::lerp(3.82987, 3.32435, m) * std::pow(x, std::lerp(0.19823, 0.16801, m))) +
           std::lerp(-1.97760, -1.27393, m) * x + std::lerp(-4.32054, -4.85967, m);
  };
  const auto lambda = [&](double x) {
    return x < 0.5 ? std::exp(exponent(x)) : std::exp(2.0 * exponent(0.5) - exponent(1.0 - x));
  };
  return d / ((1.0 + lambda(v.z) + lambda(l.z)) * 4.0 * v.z * l.z);
}

// The listing of KHR_materials_iridescence.
dvec3 film64(double ior, double thickness, double c1, dvec3 base_f0) {
  const double c2 = std::sqrt(1.0 - (1.0 - c1 * c1) / (ior * ior));
  const double r0 = squared((ior - 1.0) / (ior + 1.0)), r12 = r0 + (1.0 - r0) * std::pow(1.0 - c1, 5.0);
  const double t121 = 1.0 - r12;
  constexpr double kVal[] = {5.4856e-13, 4.4201e-13, 5.2481e-13}, kPos[] = {1.6810e+06, 1.7953e+06, 2.2084e+06};
  constexpr double kVar[] = {4.3278e+09, 9.3046e+09, 6.6121e+09};
  const glm::dmat3 to_rgb(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560,
                          1.0572252);
  dvec3 result, phi, r23;
  for (int i = 0; i < 3; i++) {
    const double root = std::sqrt(std::min(base_f0[i], 0.9999)), base = (1.0 + root) / (1.0 - root);
    const double r1 = squared((base - ior) / (base + ior));
    r23[i] = r1 + (1.0 - r1) * std::pow(1.0 - c2, 5.0);
    phi[i] = kPiExact + (base < ior ? kPiExact : 0.0);
  }
  const dvec3 r123 = glm::clamp(r12 * r23, 1e-5, 0.9999), rs = squared(t121) * r23 / (1.0 - r123);
  result = r12 + rs;
  dvec3 cm = rs - t121;
  for (int m = 1; m <= 2; m++) {
    cm *= glm::sqrt(r123);
    const double phase = 2.0 * kPiExact * m * (2.0 * ior * thickness * c2) * 1e-9;
    dvec3 xyz;
    for (int i = 0; i < 3; i++) {
      xyz[i] = kVal[i] * std::sqrt(2.0 * kPiExact * kVar[i]) * std::cos(kPos[i] * phase + m * phi[i]) *
               std::exp(-phase * phase * kVar[i]);
    }
    xyz.x += 9.7470e-14 * std::sqrt(2.0 * kPiExact * 4.5282e+09) * std::cos(2.2399e+06 * phase + m * phi[0]) *
             std::exp(-4.5282e+09 * phase * phase);
    result += cm * 2.0 * (to_rgb * (xyz / 1.0685e-7));
  }
  return glm::clamp(result, 0.0, 1.0);
}

// --- pictures

constexpr float kPitches[] = {-65.0f, -40.0f, -20.0f};

// The mean of a narrow picture of a floor, and what the formula gives. formula: the BSDF of a viewer, with tangent +X
// and bitangent -Z of the world.
void expect_formula(Material material, const MaterialLayers& layers, const std::function<Bsdf64(dvec3 v)>& formula,
                    bool both_sides = false) {
  Scene scene;
  scene.environment = make_light();
  material.double_sided = 1;
  const int floor = add_rectangle(scene, vec3(-500, -1, 500), vec3(1000, 0, 0), vec3(0, 0, -1000),
                                  add_layered(scene, material, layers));
  const Mesh& mesh = scene.meshes[static_cast<size_t>(floor)];
  for (uint i = 0; i < mesh.vertex_count; i++) scene.vertices[mesh.first_vertex + i].tangent = vec4(1, 0, 0, 1);
  RenderOptions options = small_render(32, 128);
  options.height = 32;
  options.bounces = 1;
  StereoCamera camera;
  camera.projection = find_projection("perspective")->setting;
  camera.projection.fov = 1.0f;
  for (const float pitch : kPitches) {
    camera.pitch = pitch;
    const Image image = render_cpu(scene, camera, options).eyes[0].radiance;
    dvec3 mean(0.0);
    for (size_t i = 0; i < image.pixels.size(); i++) mean[static_cast<int>(i % 3)] += double{image.pixels[i]} / 1024.0;
    const double down = static_cast<double>(-pitch) * kPiExact / 180.0;
    const dvec3 v(0.0, -std::cos(down), std::sin(down));
    const Bsdf64 bsdf = formula(v);
    const auto arriving = [&](dvec3 l) {
      return bsdf(l) * light_at(scene.environment, {l.x, l.z, -l.y}) * std::abs(l.z);
    };
    dvec3 expected = integrate(1.0, arriving);
    if (both_sides) expected += integrate(-1.0, arriving);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(mean[c], expected[c], 5e-3 * expected[c]) << "pitch " << pitch << ", " << c;
  }
}

Material base_material(float roughness, float metallic) {
  Material material = default_material();
  material.base_color = vec4(0.7f, 0.4f, 0.2f, 1.0f);
  material.roughness = roughness;
  material.metallic = metallic;
  return material;
}

const dvec3 kBase(vec3(0.7f, 0.4f, 0.2f));
const dvec3 kWhite(1.0);
const dvec3 kPlainF0(0.04);

// glTF's own dielectric under layers: fresnel_mix by the albedo of the specular lobe.
Bsdf64 dielectric64(dvec3 v, double alpha, dvec3 f0, dvec3 f90, dvec3 base) {
  const Specular specular = specular64(v, dvec2(alpha), schlick64(f0, f90), &f0);
  const double left_over = 1.0 - largest_of(specular.albedo);
  return [=](dvec3 l) { return l.z > 0.0 ? specular.value(l) + base * (left_over / kPiExact) : dvec3(0.0); };
}

TEST(LayerFormulas, Specular) {
  Material material = base_material(0.5f, 0.0f);
  material.ior = 1.8f;
  MaterialLayers layers = default_layers();
  layers.specular = 0.7f;
  layers.specular_color = vec3(1.0f, 0.5f, 2.5f);
  expect_formula(material, layers, [](dvec3 v) {
    const dvec3 f0 = glm::min(squared(0.8 / 2.8) * dvec3(1.0, 0.5, 2.5), 1.0) * 0.7;
    return dielectric64(v, 0.25, f0, dvec3(0.7), kBase);
  });
}

// The conversion of KHR_materials_pbrSpecularGlossiness.
TEST(LayerFormulas, SpecularWithoutAnIndex) {
  Material material = base_material(0.4f, 0.0f);
  material.ior = 1e8f;
  MaterialLayers layers = default_layers();
  layers.specular_color = vec3(0.6f, 0.4f, 0.1f);
  expect_formula(material, layers,
                 [](dvec3 v) { return dielectric64(v, 0.16, dvec3(vec3(0.6f, 0.4f, 0.1f)), kWhite, kBase); });
}

TEST(LayerFormulas, Clearcoat) {
  for (const float metallic : {0.0f, 1.0f}) {
    MaterialLayers layers = default_layers();
    layers.clearcoat = 0.8f;
    layers.clearcoat_roughness = 0.4f;
    expect_formula(base_material(0.7f, metallic), layers, [=](dvec3 v) {
      const dvec3 f0 = metallic > 0.0f ? kBase : kPlainF0;
      const Bsdf64 base = dielectric64(v, 0.49, f0, kWhite, metallic > 0.0f ? dvec3(0.0) : kBase);
      const Specular coat = specular64(v, dvec2(0.16), schlick64(kWhite, kWhite), &kWhite);
      const double weight = 0.8 * (0.04 + 0.96 * std::pow(1.0 - v.z, 5.0));
      return [=](dvec3 l) { return glm::mix(base(l), coat.value(l), weight); };
    });
  }
}

TEST(LayerFormulas, ClearcoatOverEmission) {
  Scene scene;
  Material lamp = default_material();
  lamp.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  lamp.emission = vec3(1.0f, 2.0f, 3.0f);
  MaterialLayers layers = default_layers();
  layers.clearcoat = 0.8f;
  add_rectangle(scene, vec3(-500, -1, 500), vec3(1000, 0, 0), vec3(0, 0, -1000), add_layered(scene, lamp, layers));
  RenderOptions options = small_render(16, 4);
  options.height = 16;
  StereoCamera camera;
  camera.projection = find_projection("perspective")->setting;
  camera.projection.fov = 0.1f;
  for (const float pitch : {-90.0f, -30.0f, -10.0f}) {
    camera.pitch = pitch;
    const Picture picture = render_cpu(scene, camera, options);
    const float* const seen = picture.eyes[0].radiance.at(8, 8);
    const double cosine = std::sin(static_cast<double>(-pitch) * kPiExact / 180.0);
    const double left = 1.0 - 0.8 * (0.04 + 0.96 * std::pow(1.0 - cosine, 5.0));
    for (int c = 0; c < 3; c++) EXPECT_NEAR(double{seen[c]}, (c + 1) * left, 2e-3 * (c + 1)) << pitch;
  }
}

TEST(LayerFormulas, Sheen) {
  MaterialLayers layers = default_layers();
  layers.sheen_color = vec3(0.9f, 0.3f, 0.5f);
  layers.sheen_roughness = 0.5f;
  expect_formula(base_material(0.6f, 0.0f), layers, [](dvec3 v) {
    const Bsdf64 base = dielectric64(v, 0.36, kPlainF0, kWhite, kBase);
    const double albedo = integrate(1.0, [&](dvec3 l) { return dvec3(charlie(v, l, 0.5) * l.z); }).x;
    return [=](dvec3 l) { return dvec3(vec3(0.9f, 0.3f, 0.5f)) * charlie(v, l, 0.5) + base(l) * (1.0 - 0.9 * albedo); };
  });
}

TEST(LayerFormulas, Anisotropy) {
  for (const float rotation : {0.0f, 0.9f}) {
    MaterialLayers layers = default_layers();
    layers.anisotropy = 0.6f;
    layers.anisotropy_rotation = rotation;
    expect_formula(base_material(0.45f, 1.0f), layers, [=](dvec3 v) {
      const double c = std::cos(double{rotation}), s = std::sin(double{rotation});
      const auto turned = [=](dvec3 w) { return dvec3(c * w.x + s * w.y, c * w.y - s * w.x, w.z); };
      const double alpha = squared(0.45);
      const dvec2 alphas(std::lerp(alpha, 1.0, 0.36), alpha);
      const Specular specular = specular64(turned(v), alphas, schlick64(kBase, kWhite), &kBase);
      return [=](dvec3 l) { return specular.value(turned(l)); };
    });
  }
}

TEST(LayerFormulas, Iridescence) {
  for (const float metallic : {0.0f, 1.0f}) {
    MaterialLayers layers = default_layers();
    layers.iridescence = 0.8f;
    layers.iridescence_ior = 1.4f;
    layers.iridescence_thickest = 420.0f;
    expect_formula(base_material(0.5f, metallic), layers, [=](dvec3 v) {
      const dvec3 f0 = metallic > 0.0f ? kBase : kPlainF0;
      const dvec3 base = metallic > 0.0f ? dvec3(0.0) : kBase;
      const Bsdf64 plain = dielectric64(v, 0.25, f0, kWhite, base);
      const Specular film = specular64(
          v, dvec2(0.25), [=](double cosine) { return film64(1.4, 420.0, cosine, f0); }, nullptr);
      const double left_over = 1.0 - largest_of(film.albedo);
      return [=](dvec3 l) { return glm::mix(plain(l), film.value(l) + base * (left_over / kPiExact), 0.8); };
    });
  }
}

TEST(LayerFormulas, DiffuseTransmission) {
  MaterialLayers layers = default_layers();
  layers.diffuse_transmission = 0.6f;
  layers.diffuse_transmission_color = vec3(0.3f, 0.9f, 0.5f);
  const auto formula = [](dvec3 v) {
    const Specular specular = specular64(v, dvec2(0.25), schlick64(kPlainF0, kWhite), &kPlainF0);
    const double left_over = 1.0 - largest_of(specular.albedo);
    return [=](dvec3 l) {
      if (l.z < 0.0) return dvec3(vec3(0.3f, 0.9f, 0.5f)) * (0.6 * left_over / kPiExact);
      return specular.value(l) + kBase * (0.4 * left_over / kPiExact);
    };
  };
  expect_formula(base_material(0.5f, 0.0f), layers, formula, true);
}

}  // namespace
}  // namespace ods
