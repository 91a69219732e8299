// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The shaders of real-time objects in a stereo picture with depth. They see points and directions by the formulas of the
// renderer itself (ods/kernel/camera), which panorama.glsl begins with.
import { SHADER } from './shader.js';

const VERSION = '#version 300 es\n';

// The formulas, and what the camera of a picture is known to be: software GPUs compile and execute every other branch.
const formulas = ({ projection, convergence, top, bottom, head_tilt_map: tilt }) => `${SHADER.split('#ifdef ODS_VERTEX')[0]}
Camera known() {
  Camera all = camera;
  all.projection.kind = ${projection.kind};
  all.convergence = ${convergence};
  all.top.mode = ${top.mode};
  all.bottom.mode = ${bottom.mode};
  if (${!tilt?.width}) all.head_tilt_map.width = 0;
  return all;
}`;

export const DECODE = `
vec3 decode(vec3 s) {
  return mix(pow((s + 0.055) / 1.055, vec3(2.4)), s / 12.92, vec3(lessThanEqual(s, vec3(0.04045))));
}`;

// The picture's surfaces: nearness is 1 / metres along the line of sight, 0 for none.
const SURFACES = `
uniform sampler2D depths;
uniform vec2 coded;   // the logarithm of the nearest distance, and its steps, to the base 2
uniform ivec2 place;  // the eye's place in the texture, and how many there are
uniform vec3 center;  // of the viewing circle, in the world
uniform mat3 frame;   // from the camera's frame to the world
float nearness_of(ivec2 at, ivec2 size) {
  if (has_range(known().projection.kind) && camera.projection.span.x > 2.0 * kPi - 1e-4) at.x = (at.x + size.x) % size.x;
  at = clamp(at, ivec2(0), size - 1);
  vec2 bytes = floor(texelFetch(depths, ivec2(at.x, at.y + place.x * size.y), 0).rg * 255.0 + 0.5);
  float code = bytes.x * 256.0 + bytes.y;
  return code > 65534.5 ? 0.0 : exp2(-coded.x - code * coded.y);
}
struct Around {
  vec4 near;   // of four texels
  vec4 share;  // of each
  bool seen;
};
Around around(vec3 label) {
  ImagePoint point = place_of(known().projection, label);
  ivec2 size = textureSize(depths, 0) / ivec2(1, place.y);
  vec2 at = point.uv * vec2(size) - 0.5;
  if (is_cube(known().projection.kind)) at = floor(at + 0.5); // adjacent texels may be of other faces
  ivec2 low = ivec2(floor(at));
  vec2 part = at - vec2(low);
  Around found;
  found.seen = point.seen;
  found.near = vec4(nearness_of(low, size), nearness_of(low + ivec2(1, 0), size), nearness_of(low + ivec2(0, 1), size), nearness_of(low + 1, size));
  found.share = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
  return found;
}
// Texels of one surface are interpolated.
bool is_one(vec4 near) {
  float low = min(min(near.x, near.y), min(near.z, near.w));
  float high = max(max(near.x, near.y), max(near.z, near.w));
  return high - low < 0.08 * high;
}
struct Met {
  vec3 place;  // in the camera's frame
  vec3 origin;
  vec3 normal; // towards the eye
  bool found;
};
Met met_at(vec3 direction) {
  direction = normalize(direction);
  Camera camera = known();
  vec3 label = line_label(camera, sides.x, direction);
  EyeOffset offset = eye_offset(camera, sides.x, look_about_axis(camera, look_along(camera.convergence == kToeIn ? label : direction)));
  Around here = around(label);
  vec2 one = max(here.share.xy, here.share.zw);
  float most = max(one.x, one.y);
  float near = dot(here.near, here.share);
  if (!is_one(here.near)) near = here.share.x == most ? here.near.x : here.share.y == most ? here.near.y : here.share.z == most ? here.near.z : here.near.w;
  Met found;
  found.found = here.seen && near > 0.0;
  found.origin = offset.stereo + offset.neck;
  found.place = found.origin + direction / max(near, 1e-6);
  return found;
}
// The surface in a direction. The normal is that of the texels around: of each axis, those of the nearer side, which are
// of the same surface.
Met met(vec3 direction) {
  direction = normalize(direction);
  vec3 u = normalize(cross(direction, abs(direction.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 v = cross(u, direction);
  float step_by = 1.5 * 2.0 * kPi / float(textureSize(depths, 0).x);
  Met here;
  vec3 across = vec3(1e9);
  vec3 down = vec3(1e9);
  for (int i = 0; i < 5; i++) { // a loop, so that it is compiled once
    float way = i % 2 == 0 ? 1.0 : -1.0;
    Met there = met_at(direction + (i == 0 ? 0.0 : way * step_by) * (i < 3 ? u : v));
    if (i == 0) here = there;
    vec3 apart = (there.place - here.place) * way;
    if (i > 2 && dot(apart, apart) < dot(down, down)) down = apart;
    else if (i > 0 && i < 3 && dot(apart, apart) < dot(across, across)) across = apart;
  }
  here.normal = normalize(cross(across, down));
  if (dot(here.normal, direction) > 0.0) here.normal = -here.normal;
  return here;
}`;

// A vertex as its eye sees it: P' = P - the place of the eye for the line of sight that meets P (look_of_point() in
// ods/kernel/camera/line.h; for a constant radius r and an axis that is up, r (sqrt(rho^2 - r^2) u + s r h) / rho, with h
// to P and u to its right). Points that no line of sight meets, or several do, are lost.
export const STAGE_VERTICES = (camera, near) => `${formulas(camera)}
uniform mat4 to_world;
uniform mat3 to_screen;
uniform float part;
uniform vec3 center;
uniform mat3 frame;
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec3 next_position;
layout(location = 4) in vec3 next_normal;
out vec2 at;
out vec3 facing;
out vec3 toward;
out vec3 seen;
out float lost;
void main() {
  at = uv;
  facing = transpose(inverse(mat3(to_world))) * mix(normal, next_normal, part);
  vec3 there = ((to_world * vec4(mix(position, next_position, part), 1.0)).xyz - center) * frame;
  PointLook look = look_of_point(known(), sides.x, there, 1.0);
  seen = there - look.origin;
  lost = look.found ? 0.0 : 1.0;
  toward = -(frame * seen);
  vec3 p = to_screen * seen;
  gl_Position = vec4(p.xy, p.z - ${near}, p.z);
}`;

// For OBJECT: the part of a fragment that nothing is in front of, by the distance along its line of sight. At the edge
// of what hides it, it is as soft as the picture's own texels.
export const HIDE = (camera) => ({
  head: `${formulas(camera)}${SURFACES}
in vec3 seen;
in float lost;
float open() {
  if (lost > 0.0) return 0.0;
  Around here = around(line_label(known(), sides.x, normalize(seen)));
  if (!here.seen) return 0.0;
  float own = 1.002 / length(seen);
  if (is_one(here.near)) return step(dot(here.near, here.share), own);
  return dot(step(here.near, vec4(own)), here.share);
}
`,
  open: 'open()',
});

// The picture of an eye, from its codes.
export const GROUND = `${VERSION}precision highp float;
uniform sampler2D page;
out vec4 color;
${DECODE}
void main() {
  color = vec4(decode(texelFetch(page, ivec2(gl_FragCoord.xy), 0).rgb), 1.0);
}`;

export const STAGE_SHADE = (camera, shadow) => `${formulas(camera)}${SURFACES}${DECODE}
uniform sampler2D page;
${shadow}
uniform vec2 view;  // pixels
out vec4 color;
void main() {
  vec3 direction = rays * vec3(2.0 * gl_FragCoord.xy / view - 1.0, 1.0);
  vec3 shown = decode(texelFetch(page, ivec2(gl_FragCoord.xy), 0).rgb);
  Met here = met(direction);
  color = vec4(1.0);
  if (here.found) color.rgb = remaining(shown, center + frame * here.place, frame * here.normal);
}`;

// The place, the eye's place, the normal, and whether there is a surface, in the world: the bytes of floats.
export const MEET = (camera) => `${formulas(camera)}${SURFACES}
uniform vec3 along;
out vec4 color;
void main() {
  Met here = met(along);
  vec3 lists[3];
  lists[0] = center + frame * here.place;
  lists[1] = center + frame * here.origin;
  lists[2] = frame * here.normal;
  int i = int(gl_FragCoord.x);
  float number = i == 9 ? (here.found ? 1.0 : 0.0) : lists[i / 3][i % 3];
  uint bits = floatBitsToUint(number);
  color = vec4(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u, bits >> 24) / 255.0;
}`;
