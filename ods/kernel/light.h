// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Picks a light and a point on it, and gives the pdf (probability density) with which sampling would have found the
// light that a given ray hits.
// Suns, the environment, and all other lights together are picked in proportion to their power from Walker's alias
// table, which the host builds (ods/render/lights.h). The other lights are in a binary tree, also built by the host,
// whose nodes store bounds of position and direction, and the power. On the way down, a random number chooses between
// the two children of each node in proportion to their possible contribution to the surface.
// Source: Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/bsdf.h"
namespace ods {
#endif

// Probability that the environment is visible in a direction outside all portals, if there are portals.
const float kChanceBesidePortals = 0.05f;

const float kFarAway = 1e30f;  // distance of the environment and of directional lights

const int kTreeRoot = 0;
const int kTreeOfLights = -1;   // value of LightPick::light: a light picked by the tree
const float kMinFacing = 0.1f;  // minimum facing factor of a light at grazing angles: normals may be bent

// The receiving point, for light sampling.
struct Receiver {
  vec3 position;
  vec3 normal;  // 0 if it takes light from both sides
};

struct TreePick {
  int light;
  float probability;  // 0 if the tree's lights contribute nothing
};

// Estimated contribution of the node's lights to the receiver. A light shines within 90 degrees of the direction that
// it faces; `spread` and the angle under which the node is seen widen this. It is 0 only where no light of the node
// shines.
inline float node_importance(LightNode node, Receiver receiver) {
  vec3 to_node = node.center - receiver.position;
  float radius2 = node.radius * node.radius;
  float distance2 = max(dot(to_node, to_node), max(radius2, 1e-20f));
  float scale = 1.0f / sqrt(distance2);
  float seen = node.radius * scale;
  float along = dot(node.axis, to_node) * scale;
  float power = node.power * clamp(node.spread + seen - along, 0.0f, 1.0f) +
                node.back_power * clamp(node.spread + seen + along, 0.0f, 1.0f);
  bool one_sided = receiver.normal != vec3(0.0f);
  if (one_sided) power = power * clamp(dot(receiver.normal, to_node) * scale + seen, kMinFacing, 1.0f);
  return min(power / distance2, 1e30f);
}

struct LightSample {
  vec3 direction;  // towards the light, unit length
  float distance;
  vec3 end;       // end of a shadow ray, just in front of the light; unused at kFarAway
  vec3 radiance;  // arriving radiance; for lights without size (pdf 0) already divided by the probability of picking
                  // them
  float pdf;      // per solid angle, including the probability of picking the light
  float chance;   // an estimate of the probability that the light is unoccluded: it affects the noise, not the mean
  bool valid;
};

inline LightSample no_light() {
  LightSample light;
  light.direction = vec3(0.0f);
  light.distance = 0.0f;
  light.end = vec3(0.0f);
  light.radiance = vec3(0.0f);
  light.pdf = 0.0f;
  light.chance = 1.0f;
  light.valid = false;
  return light;
}

// Walker's alias method: slot was picked uniformly; draw in [0, 1) decides between it and its alias.
inline int alias_pick(AliasEntry entry, int slot, float draw) {
  return draw < entry.threshold ? slot : entry.alias;
}

// KHR_lights_punctual's attenuation: inverse square, faded out to zero at the range.
inline float punctual_falloff(float distance, float range) {
  float inverse_square = 1.0f / max(distance * distance, 1e-12f);
  if (range <= 0.0f) return inverse_square;
  float share = distance / range;
  float share2 = share * share;
  return inverse_square * clamp(1.0f - share2 * share2, 0.0f, 1.0f);
}

// Fraction of a spot's light that goes in a direction. cosine: of its angle from the axis.
inline float cone_falloff(Light light, float cosine) {
  float t = clamp(cosine * light.cone_scale + light.cone_offset, 0.0f, 1.0f);
  float share = light.cone == kConeSquare ? t * t : t * t * (3.0f - 2.0f * t);
  return light.cone == kConeSmoothCosine ? share * cosine : share;
}

// A direction in a cone around an axis, uniform in solid angle. cosine: of the cone's half angle.
inline vec3 direction_in_cone(vec3 axis, float cosine, vec2 uv) {
  float z = 1.0f - uv.x * (1.0f - cosine);
  float r = sqrt(max(1.0f - z * z, 0.0f));
  vec2 around = cos_sin(2.0f * kPi * uv.y);
  return from_frame(frame_around(axis), vec3(r * around.x, r * around.y, z));
}

#ifdef __cplusplus
struct LightSampler : BsdfEvaluator {
#endif

  // The probability of the first of two adjacent children. In proportion to their power if both have importance 0.
  inline float share_of_first(int first, Receiver receiver) {
    float one = node_importance(scene_light_node(first), receiver);
    float other = node_importance(scene_light_node(first + 1), receiver);
    if (one + other > 0.0f) return one / (one + other);
    one = scene_light_node(first).power + scene_light_node(first).back_power;
    other = scene_light_node(first + 1).power + scene_light_node(first + 1).back_power;
    return one / (one + other);
  }

  // draw: uniform in [0, 1). Precondition: the scene has a tree.
  inline TreePick pick_in_tree(Receiver receiver, float draw) {
    TreePick pick;
    pick.light = 0;
    pick.probability = 1.0f;
    int node = kTreeRoot;
    while (scene_light_node(node).child >= 0) {
      int first = scene_light_node(node).child;
      float share = share_of_first(first, receiver);
      bool is_first = draw < share;
      draw = min(is_first ? draw / share : (draw - share) / (1.0f - share), 0.9999999f);
      pick.probability = pick.probability * (is_first ? share : 1.0f - share);
      node = is_first ? first : first + 1;
    }
    pick.light = -1 - scene_light_node(node).child;
    return pick;
  }

  // The probability with which pick_in_tree() picks the light at the end of this path.
  inline float probability_in_tree(LightWay way, Receiver receiver) {
    uint bits = way.bits;
    float probability = 1.0f;
    int node = kTreeRoot;
    while (scene_light_node(node).child >= 0) {
      int first = scene_light_node(node).child;
      float share = share_of_first(first, receiver);
      bool is_first = (bits & 1u) == 0u;
      probability = probability * (is_first ? share : 1.0f - share);
      node = is_first ? first : first + 1;
      bits = bits >> 1u;
    }
    return probability;
  }

  inline vec3 environment_texel(EnvironmentInfo info, int x, int y) {
    int column = wrap_texel(x, info.width, kWrapRepeat);
    int row = clamp(y, 0, info.height - 1);
    return scene_environment_texel(info.first_texel + row * info.width + column).radiance;
  }

  inline vec3 radiance_of(EnvironmentInfo info, vec3 direction) {
    if (info.width == 0) return info.uniform_radiance;
    vec2 uv = direction_to_lat_long(direction);
    float x = uv.x * float(info.width) - 0.5f;
    float y = uv.y * float(info.height) - 0.5f;
    int x0 = floor_int(x);
    int y0 = floor_int(y);
    float fx = x - float(x0);
    vec3 top = mix(environment_texel(info, x0, y0), environment_texel(info, x0 + 1, y0), fx);
    vec3 bottom = mix(environment_texel(info, x0, y0 + 1), environment_texel(info, x0 + 1, y0 + 1), fx);
    return mix(top, bottom, y - float(y0));
  }

  inline vec3 environment_radiance(vec3 direction) {
    return radiance_of(scene_environment(), direction);
  }

  // The radiance that the camera sees behind the scene: the environment, unless the scene has a background of its own.
  inline vec3 background_radiance(vec3 direction) {
    return radiance_of(scene_background(), direction);
  }

  // Solid angle of a texel in row y.
  inline float environment_texel_angle(EnvironmentInfo info, int y) {
    // cos a - cos b in a form that keeps its precision at the poles.
    float step = 0.5f * kPi / float(info.height);
    return 4.0f * kPi / float(info.width) * sin_of(float(2 * y + 1) * step) * sin_of(step);
  }

  // Pdf per solid angle of the points of a triangle light, seen from a distance along a direction.
  // area: the triangle's normal; its length is the triangle's area.
  inline float triangle_pdf(float pick, vec3 area, vec3 direction, float distance) {
    float projected = abs(dot(area, direction));
    return projected > 0.0f ? pick * distance * distance / projected : 0.0f;
  }

  // --- portals: half of the samples of the environment lead through them

  inline vec3 portal_area(Portal portal) {
    return cross(portal.along, portal.across);
  }

  // Roughly the solid angle of a portal; 0 for points in its plane.
  inline float portal_weight(Portal portal, vec3 from) {
    vec3 area = portal_area(portal);
    vec3 to_middle = portal.corner + 0.5f * (portal.along + portal.across) - from;
    float distance2 = dot(to_middle, to_middle) + 0.5f * length(area);
    return abs(dot(area, to_middle)) / (distance2 * sqrt(distance2));
  }

  // The distance at which a ray passes through a portal; negative if it does not.
  inline float portal_distance(Portal portal, vec3 from, vec3 direction) {
    vec3 area = portal_area(portal);
    float along_ray = dot(area, direction);
    if (abs(along_ray) < 1e-12f) return -1.0f;
    float t = dot(area, portal.corner - from) / along_ray;
    vec3 at = from + direction * t - portal.corner;
    float u = dot(at, portal.along) / dot(portal.along, portal.along);
    float v = dot(at, portal.across) / dot(portal.across, portal.across);
    return min(min(u, 1.0f - u), min(v, 1.0f - v)) >= 0.0f ? t : -1.0f;
  }

  // Pdf per solid angle of sample_portal()'s directions.
  inline float portal_pdf(vec3 from, vec3 direction) {
    float weights = 0.0f;
    float pdf = 0.0f;
    for (int i = 0; i < scene_portal_count(); i++) {
      Portal portal = scene_portal(i);
      float weight = portal_weight(portal, from);
      weights += weight;
      float distance = portal_distance(portal, from, direction);
      if (distance > 0.0f) pdf += weight * triangle_pdf(1.0f, portal_area(portal), direction, distance);
    }
    return weights > 0.0f ? pdf / weights : 0.0f;
  }

  // A direction through one of the portals.
  inline vec3 sample_portal(vec3 from, float pick, vec2 uv) {
    float weights = 0.0f;
    for (int i = 0; i < scene_portal_count(); i++) weights += portal_weight(scene_portal(i), from);
    float left = pick * weights;
    int chosen = 0;
    for (int i = 0; i < scene_portal_count() - 1; i++) {
      left -= portal_weight(scene_portal(i), from);
      if (left < 0.0f) break;
      chosen = i + 1;
    }
    Portal portal = scene_portal(chosen);
    return normalize(portal.corner + portal.along * uv.x + portal.across * uv.y - from);
  }

  // Pdf per solid angle with which the table of the environment's texels samples this direction.
  inline float texel_pdf(EnvironmentInfo info, vec3 direction) {
    vec2 uv = direction_to_lat_long(direction);
    int x = clamp(int(uv.x * float(info.width)), 0, info.width - 1);
    int y = clamp(int(uv.y * float(info.height)), 0, info.height - 1);
    float pick = scene_environment_row(y).probability * scene_environment_texel(y * info.width + x).entry.probability;
    return pick / environment_texel_angle(info, y);
  }

  // by_portal: portal_pdf() in this direction.
  inline float texel_or_portal_pdf(EnvironmentInfo info, vec3 direction, float by_portal) {
    float pdf = texel_pdf(info, direction);
    if (scene_portal_count() > 0) pdf = 0.5f * (pdf + by_portal);
    return scene_light(info.light).probability * pdf;
  }

  // Pdf per solid angle with which sample_light() samples the environment in this direction.
  inline float environment_pdf(vec3 from, vec3 direction) {
    EnvironmentInfo info = scene_environment();
    if (info.light < 0) return 0.0f;
    return texel_or_portal_pdf(info, direction, portal_pdf(from, direction));
  }

  // Pdf with which sample_light() samples the triangle that a ray from the receiver hit at this distance.
  inline float hit_light_pdf(Hit hit, Receiver receiver, vec3 direction, float distance) {
    Instance instance = instance_now(hit.instance);
    if (instance.first_light < 0) return 0.0f;
    Triangle triangle = triangle_of(instance, corners_of(hit));
    int light = instance.first_light + hit.triangle;
    float pick = scene_light(light).probability;
    if (!(pick > 0.0f)) return 0.0f;
    pick = pick * probability_in_tree(scene_light_way(light), receiver);
    return triangle_pdf(pick, cross(triangle.ab, triangle.ac) * 0.5f, direction, distance);
  }

  // pick: the probability of picking the light.
  inline LightSample sample_triangle(Light light, float pick, vec3 from, vec2 uv) {
    float root = sqrt(uv.x);
    Hit hit;
    hit.t = 0.0f;
    hit.u = root * (1.0f - uv.y);
    hit.v = root * uv.y;
    hit.instance = light.instance;
    hit.triangle = light.triangle;
    Instance instance = instance_now(hit.instance);
    Corners k = corners_of(hit);
    Triangle triangle = triangle_of(instance, k);
    vec3 area = cross(triangle.ab, triangle.ac) * 0.5f;
    vec3 point = triangle.a + triangle.ab * hit.u + triangle.ac * hit.v;
    vec3 to_light = point - from;
    LightSample result = no_light();
    result.end = offset_point(point, normalize(dot(area, to_light) > 0.0f ? -area : area));
    result.distance = length(to_light);
    result.direction = to_light * (1.0f / max(result.distance, 1e-20f));
    result.pdf = triangle_pdf(pick, area, result.direction, result.distance);
    result.valid = result.pdf > 0.0f;
    Material material = scene_material(scene_mesh(instance.mesh).material);
    result.radiance = emission_at(material, k, dot(area, result.direction) * handedness_of(instance) < 0.0f);
    if (material.layers >= 0) {
      float cosine = abs(dot(normalize(area), result.direction));
      result.radiance = result.radiance * emission_below_coat(material, k, cosine);
    }
    // A ray would pass through the rest.
    if (material.alpha_mode != kAlphaOpaque) result.radiance = result.radiance * alpha_of(material, k);
    return result;
  }

  // A light with a size is a sphere of uniform radiance, or a disc in the sky. Its solid angle times its radiance is
  // its contribution as a point light, times 2 / (1 + cosine of its half angle). pick: the probability of picking it.
  inline LightSample sample_punctual(Light light, float pick, vec3 from, vec2 uv) {
    LightSample result = no_light();
    result.valid = true;
    result.distance = kFarAway;
    result.direction = -light.direction;
    result.end = light.position;
    result.radiance = light.intensity * (1.0f / pick);
    if (light.kind == kLightDirectional) {
      if (light.size <= 0.0f) return result;
      float cosine = cos_of(light.size);
      result.direction = direction_in_cone(result.direction, cosine, uv);
      result.radiance = result.radiance * (2.0f / (1.0f + cosine));
      return result;
    }
    vec3 to_light = light.position - from;
    result.distance = length(to_light);
    result.direction = to_light * (1.0f / max(result.distance, 1e-20f));
    result.radiance = result.radiance * punctual_falloff(result.distance, light.range);
    if (light.size > 0.0f) {
      float sine = min(light.size / max(result.distance, 1e-20f), 1.0f);
      float cosine = sqrt(1.0f - sine * sine);
      vec3 axis = result.direction;
      result.direction = direction_in_cone(axis, cosine, uv);
      result.radiance = result.radiance * (2.0f / (1.0f + cosine));
      float along = dot(axis, result.direction);
      float half_chord = sqrt(max(sine * sine + along * along - 1.0f, 0.0f));
      result.distance = result.distance * max(along - half_chord, 0.0f);
      result.end = from + result.direction * result.distance;
    }
    if (light.kind == kLightSpot) {
      result.radiance = result.radiance * cone_falloff(light, -dot(result.direction, light.direction));
    }
    return result;
  }

  // cell chooses row and column, uv the point within the texel.
  inline vec3 sample_texel(EnvironmentInfo info, vec2 cell, vec2 uv) {
    float place = cell.x * float(info.height);
    int row = min(int(place), info.height - 1);
    row = alias_pick(scene_environment_row(row), row, place - float(row));
    place = cell.y * float(info.width);
    int column = min(int(place), info.width - 1);
    column = alias_pick(scene_environment_texel(row * info.width + column).entry, column, place - float(column));
    float theta = ((float(column) + uv.x) / float(info.width) - 0.5f) * (2.0f * kPi);
    float top = cos_of(kPi * float(row) / float(info.height));
    float bottom = cos_of(kPi * float(row + 1) / float(info.height));
    float height = mix(top, bottom, uv.y);
    float r = sqrt(max(1.0f - height * height, 0.0f));
    vec2 around = cos_sin(theta);
    return vec3(r * around.y, height, -r * around.x);
  }

  inline LightSample sample_environment(vec3 from, vec2 cell, vec2 uv) {
    LightSample result = no_light();
    EnvironmentInfo info = scene_environment();
    bool by_portals = scene_portal_count() > 0;
    bool through = by_portals && cell.x < 0.5f;
    if (by_portals) cell.x = fract(2.0f * cell.x);
    if (through) result.direction = sample_portal(from, cell.y, uv);
    if (!through) result.direction = sample_texel(info, cell, uv);
    result.distance = kFarAway;
    result.end = result.direction;
    result.radiance = environment_radiance(result.direction);
    float by_portal = portal_pdf(from, result.direction);
    bool leads_out = by_portal > 0.0f;
    result.pdf = texel_or_portal_pdf(info, result.direction, by_portal);
    if (by_portals && !leads_out) result.chance = kChanceBesidePortals;
    result.valid = result.pdf > 0.0f && (leads_out || !through);
    return result;
  }

  // pick chooses the light, cell a texel of an environment, uv the point on the light; all are uniform in [0, 1).
  // Precondition: at least one light has power.
  inline LightSample sample_light(Receiver receiver, vec2 pick, vec2 cell, vec2 uv) {
    int count = scene_light_pick_count();
    float place = pick.x * float(count);
    int index = min(int(place), count - 1);
    LightPick slot = scene_light_pick(index);
    int picked = pick.y < slot.threshold ? slot.light : slot.alias;
    float probability = 1.0f;
    if (picked == kTreeOfLights) {
      TreePick among = pick_in_tree(receiver, place - float(index));
      picked = among.light;
      probability = among.probability;
    }
    Light light = scene_light(picked);
    probability = probability * light.probability;
    if (light.kind == kLightTriangle) return sample_triangle(light, probability, receiver.position, uv);
    if (light.kind == kLightEnvironment) return sample_environment(receiver.position, cell, uv);
    return sample_punctual(light, probability, receiver.position, uv);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
