// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The shaders of real-time objects. Light is linear and exposed: 1 is white but for the tone curve.

const VERSION = '#version 300 es\n';

// ods/image/tone.cpp, and its inverse: the Khronos PBR Neutral tone mapper's, from its specification.
const TONE = `
uniform bool neutral;
vec3 tone(vec3 color) {
  color = clamp(color, 0.0, 1e30);
  if (!neutral) return min(color, 1.0);
  float low = min(color.r, min(color.g, color.b));
  color -= low < 0.08 ? low - 6.25 * low * low : 0.04;
  float peak = max(color.r, max(color.g, color.b));
  if (peak < 0.76) return color;
  float rolled = 1.0 - 0.0576 / (peak + 0.24 - 0.76);
  return mix(vec3(rolled), color * (rolled / peak), 1.0 / (0.15 * (peak - rolled) + 1.0));
}
vec3 untone(vec3 color) {
  if (!neutral) return color;
  float rolled = min(max(color.r, max(color.g, color.b)), 0.995);
  if (rolled > 0.76) {
    float peak = 0.0576 / (1.0 - rolled) - 0.24 + 0.76;
    float colorful = 1.0 / (0.15 * (peak - rolled) + 1.0);
    color = max((color - rolled * (1.0 - colorful)) / colorful, 0.0) * (peak / rolled);
  }
  float low = min(color.r, min(color.g, color.b));
  return color + (low > 0.04 ? 0.04 : sqrt(max(low, 0.0) / 6.25) - low);
}`;

const HARMONICS = `
vec3 harmonics(vec3 terms[9], vec3 d) {
  return max(terms[0] + terms[1] * d.y + terms[2] * d.z + terms[3] * d.x + terms[4] * (d.x * d.y) + terms[5] * (d.y * d.z) +
             terms[6] * (3.0 * d.z * d.z - 1.0) + terms[7] * (d.x * d.z) + terms[8] * (d.x * d.x - d.y * d.y), 0.0);
}`;

// --- the object ------------------------------------------------------------------------------------------------------

export const OBJECT_VERTICES = (near) => `#version 300 es
uniform mat4 to_world;
uniform mat3 to_screen;
uniform vec3 eye;
uniform float part;  // of the way to the next frame
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec3 next_position;
layout(location = 4) in vec3 next_normal;
out vec2 at;
out vec3 facing;
out vec3 toward;
void main() {
  at = uv;
  facing = transpose(inverse(mat3(to_world))) * mix(normal, next_normal, part);
  vec3 there = (to_world * vec4(mix(position, next_position, part), 1.0)).xyz;
  toward = eye - there;
  vec3 p = to_screen * -toward;
  gl_Position = vec4(p.xy, p.z - ${near}, p.z);
}`;

// Specular light by the split sum (Karis 2013), whose second factor is his fit (Karis 2014, "Physically Based Shading on
// Mobile"), with the energy that a single scattering loses, as in the renderer (ods/kernel/bsdf.h). Rough surfaces
// reflect the light of the probes. hide: the code that finds the part of a fragment that is seen, where the test of depth
// does not.
export const OBJECT = ({ head = VERSION, open = '1.0' } = {}) => `${head}precision highp float;
uniform vec3 terms[9];
uniform vec4 base;
uniform bool has_page;
uniform sampler2D page;
uniform bool has_mirror;
uniform samplerCube mirror;
uniform float levels;  // of it
uniform vec2 kind;     // metallic, roughness
uniform vec3 emitted;
uniform float cutoff;
uniform bool blends;
in vec2 at;
in vec3 facing;
in vec3 toward;
out vec4 color;
${TONE}${HARMONICS}
void main() {
  color = base * (has_page ? texture(page, at) : vec4(1.0));
  vec3 view = normalize(toward);
  vec3 n = normalize(facing) * (gl_FrontFacing ? 1.0 : -1.0);
  float cosine = max(dot(n, view), 0.001);
  vec4 r = kind.y * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  vec2 fit = vec2(-1.04, 1.04) * (min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y) + r.zw;
  float lost = 1.0 / clamp(fit.x + fit.y, 0.1, 1.0) - 1.0;
  float coat = clamp((0.04 * fit.x + fit.y) * (1.0 + 0.04 * lost), 0.0, 1.0);
  vec3 metal = (color.rgb * fit.x + fit.y) * (1.0 + color.rgb * lost);
  vec3 diffuse = color.rgb * ((1.0 - kind.x) * (1.0 - coat));
  vec3 back = reflect(-view, n);
  vec3 glint = harmonics(terms, back);
  if (has_mirror) glint = mix(textureLod(mirror, back, kind.y * (levels - 1.0)).rgb, glint, smoothstep(0.5, 1.0, kind.y));
  color.rgb = tone(diffuse * harmonics(terms, n) + glint * mix(vec3(coat), metal, kind.x) + emitted);
  float edge = fwidth(color.a);
  if (cutoff > 0.0) color.a = clamp((color.a - cutoff) / max(edge, 0.001) + 0.5, 0.0, 1.0);
  else if (!blends) color.a = 1.0;
  color.a *= ${open};
}`;

// --- its shadow ------------------------------------------------------------------------------------------------------

// The object as its light sees it: coverage, the highest place and 1 - the lowest one, 0..1 along the light, each the
// largest that was drawn.
export const CASTER_VERTICES = `#version 300 es
uniform mat4 to_map;
uniform float part;
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 3) in vec3 next_position;
out vec2 at;
out float height;
void main() {
  at = uv;
  gl_Position = to_map * vec4(mix(position, next_position, part), 1.0);
  height = 0.5 + 0.5 * gl_Position.z;
}`;
export const CASTER = `#version 300 es
precision highp float;
uniform float alpha;
uniform bool has_page;
uniform sampler2D page;
uniform float cutoff;
in vec2 at;
in float height;
out vec4 color;
void main() {
  float covers = alpha * (has_page ? texture(page, at).a : 1.0);
  if (covers < cutoff) discard;
  color = vec4(1.0, height, 1.0 - height, 0.0) * (cutoff > 0.0 ? 1.0 : covers);
}`;

// The remaining part of the light of a surface, to be multiplied with what it shows. Two maps of what the object covers:
// seen from the brightest direction, and from above.
export const SHADOW = (bias) => `
uniform sampler2D from_sun;
uniform sampler2D from_above;
uniform mat4 to_sun;    // from the world to the map and the height, 0..1
uniform mat4 to_above;
uniform vec3 toward;    // the sun
uniform vec3 sun;
uniform vec3 ambient;
uniform float size;     // of the maps, metres
uniform float deep;     // of their heights, metres
uniform vec2 spread;    // of the light, a tangent: the sun's, and that from above
uniform vec2 soft;      // metres by which even what touches is soft
uniform vec2 reach;     // metres below the object
${TONE}
const int COUNT = 12;
// Circles of the map that grow with the distance below the object: its edges are as soft as the light is wide.
float covered(sampler2D map, vec3 place, float spread, float soft, float reach) {
  if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)))) return 0.0;
  float texels = float(textureSize(map, 0).x);
  vec3 wide = 8.0 * textureLod(map, place.xy, log2(texels) - 5.0).rgb + textureLod(map, place.xy, log2(texels) - 2.5).rgb;
  if (wide.r < 0.001) return 0.0;
  float gap = max((1.0 - wide.b / wide.r - place.z) * deep, 0.0);
  float circle = clamp((spread * gap + soft) / size, 1.0 / texels, 0.12);
  float level = max(log2(circle * texels) - 0.5, 0.0);
  vec3 sum = textureLod(map, place.xy, level).rgb;
  for (int i = 1; i < COUNT; i++) {
    float angle = 2.399963 * float(i);
    sum += textureLod(map, place.xy + circle * sqrt(float(i) / float(COUNT)) * vec2(cos(angle), sin(angle)), level).rgb;
  }
  if (sum.r < 0.001) return 0.0;
  float below = smoothstep(${bias}, 2.0 * ${bias}, (sum.g / sum.r - place.z) * deep);
  gap = max((1.0 - sum.b / sum.r - place.z) * deep, 0.0);
  vec2 margin = smoothstep(vec2(0.5), vec2(0.4), abs(place.xy - 0.5));
  return sum.r / float(COUNT) * below * (1.0 - smoothstep(0.5 * reach, reach, gap)) * margin.x * margin.y;
}
vec3 remaining(vec3 shown, vec3 world, vec3 n) {
  vec3 direct = sun * max(dot(n, toward), 0.0);
  float hidden = dot(direct, direct) > 0.0 ? covered(from_sun, (to_sun * vec4(world, 1.0)).xyz, spread.x, soft.x, reach.x) : 0.0;
  float closed = n.y > 0.01 ? 0.9 * n.y * covered(from_above, (to_above * vec4(world, 1.0)).xyz, spread.y, soft.y, reach.y) : 0.0;
  vec3 rest = (direct * (1.0 - hidden) + ambient * (1.0 - closed)) / (direct + ambient);
  if (hidden + closed == 0.0) return vec3(1.0);
  return min(tone(untone(shown) * rest) / max(shown, 1e-4), 1.0);
}`;

// Draws a layer's triangles in the shade of objects.
export const SHADE = (bias) => `#version 300 es
precision highp float;
uniform sampler2D page;
uniform float cutoff;
uniform vec3 eye;
in vec2 at;
in vec3 world;
out vec4 color;
${SHADOW(bias)}
void main() {
  vec4 shown = texture(page, at);
  float edge = fwidth(shown.a);
  vec3 n = normalize(cross(dFdx(world), dFdy(world)));
  n *= dot(n, eye - world) < 0.0 ? -1.0 : 1.0;
  color.rgb = remaining(shown.rgb, world, n);
  color.a = cutoff > 0.0 ? clamp((shown.a - cutoff) / max(edge, 0.001) + 0.5, 0.0, 1.0) : 1.0;
}`;

// --- what it reflects ------------------------------------------------------------------------------------------------

// The light of a view of the scene; where there are no triangles, that of the probes.
// decode: of a picture of codes instead.
export const LIGHT = (decode = '') => `#version 300 es
precision highp float;
uniform sampler2D seen;
uniform mat3 rays;
uniform vec3 terms[9];
in vec2 screen;
out vec4 color;
${TONE}${HARMONICS}${decode}
void main() {
  vec4 shown = texelFetch(seen, ivec2(gl_FragCoord.xy), 0);
  ${decode && 'shown.rgb = decode(shown.rgb);'}
  vec3 around = harmonics(terms, normalize(rays * vec3(screen, 1.0)));
  color = vec4(mix(around, untone(shown.rgb / max(shown.a, 0.001)), shown.a), 1.0);
}`;

// The first factor of the split sum: a cube map for one roughness (Karis 2013), with smaller levels of the map for
// samples that stand for more of it.
export const ROUGHEN = `#version 300 es
precision highp float;
uniform samplerCube light;
uniform mat3 rays;
uniform float rough;
uniform float side;  // of the map, texels
in vec2 screen;
out vec4 color;
const int COUNT = 32;
void main() {
  vec3 n = normalize(rays * vec3(screen, 1.0));
  vec3 u = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
  vec3 v = cross(n, u);
  float a = rough * rough;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < COUNT; i++) {
    float x = (float(i) + 0.5) / float(COUNT);
    float angle = 2.399963 * float(i);
    float cosine = sqrt((1.0 - x) / (1.0 + (a * a - 1.0) * x));
    float sine = sqrt(1.0 - cosine * cosine);
    vec3 half_way = u * (sine * cos(angle)) + v * (sine * sin(angle)) + n * cosine;
    vec3 to = 2.0 * cosine * half_way - n;
    float weight = dot(n, to);
    if (weight <= 0.0) continue;
    float d = (cosine * cosine * (a * a - 1.0) + 1.0);
    float density = a * a / (3.14159265 * d * d) / 4.0;
    float level = 0.5 * log2(6.0 * side * side / (4.0 * 3.14159265 * float(COUNT) * density)) + 0.5;
    sum += weight * vec4(textureLod(light, to, max(level, 0.0)).rgb, 1.0);
  }
  color = sum / sum.a;
}`;
