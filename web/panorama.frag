// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One pixel of the viewer. Where a picture has a line of sight is the kernel's to say: the build runs the C
// preprocessor over this file and adds the line "#version 300 es".
//
// The filter is that of ods/convert/texel_filter.h: a pixel that covers a texel or less is interpolated by the
// Catmull-Rom cubic, clamped to the range of its texels. A pixel that covers s texels averages with the variance
// (s^2 - 1) / 6; here mip levels, which are boxes, supply the variance of the narrow axis, and points along the wide one
// supply the rest.
precision highp float;
precision highp int;
precision highp sampler2DArray;
#define inline
#include "ods/kernel/camera/merge.h"
#include "ods/kernel/camera/projection.h"
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/camera/line.h"

const int kOneEye = 0;
const int kAnaglyph = 1;
const int kDifference = 2;
const float kBorder = 16.0;  // texels around a tile
const int kLastLevel = 5;    // of the mip levels

// An eye's picture, cut into tiles that are the layers of a texture.
struct Eye {
  vec2 size;  // texels
  vec2 tile;  // of a tile without its border
  int columns;
};

uniform Camera camera;
uniform bool over;         // the picture is a finer window of one that is drawn already,
uniform Projection below;  // whose projection this is
uniform Eye eyes[2];
uniform sampler2DArray left_tiles;
uniform sampler2DArray right_tiles;
uniform sampler2D merge_texels;
uniform sampler2D head_tilt_texels;
uniform mat3 rays;        // a pixel at (x, y), both -1..1, looks along rays * (x, y, 1) in the picture's frame
uniform bool all_around;  // the view is a lat-long picture of the whole sphere instead
uniform float bend;       // 0: perspective; 0.25: stereographic, a little planet
uniform float shift;      // radians by which the left eye's picture turns to the left, the right eye's to the right
uniform vec2 viewport;    // pixels
uniform int mode;
uniform int eye;          // for kOneEye
uniform bool mono;        // both eyes are the same picture
uniform bool fast;        // let the GPU filter what is minified
uniform bool grid;
in vec2 screen;
out vec4 color;

float camera_map_texel(Camera a_camera, int which, int i) {
  int width = which == kMapOfMerge ? a_camera.merge_map.width : a_camera.head_tilt_map.width;
  ivec2 at = ivec2(i % width, i / width);
  return which == kMapOfMerge ? texelFetch(merge_texels, at, 0).x : texelFetch(head_tilt_texels, at, 0).x;
}

vec3 direction_at(vec2 at) {
  if (all_around) return look_at_angles(at.x * kPi, at.y * 0.5 * kPi).direction;
  vec3 aside = rays * vec3(at, 0.0);
  return aside + rays[2] * (1.0 - bend * dot(aside, aside));
}

// Where an eye's picture has what the view shows along a direction.
vec3 shifted(int which, vec3 direction) {
  float turn = which == kLeft ? shift : -shift;
  return vec3(cos(turn) * direction.x - sin(turn) * direction.z, direction.y, sin(turn) * direction.x + cos(turn) * direction.z);
}

// --- where ----------------------------------------------------------------------------------------------------------

struct Place {
  vec2 at;    // texels from the left and top edge of the eye's picture
  vec2 low;   // the texels that are contiguous in the world: a cube's face, or everything
  vec2 high;
  bool seen;
  vec3 label;  // the direction under which the picture stores the line of sight
};

bool wraps() {
  return has_range(camera.projection.kind) && camera.projection.span.x > 2.0 * kPi - 1e-4;
}

Place place_at(int which, vec3 direction) {
  vec3 label = line_label(camera, mono ? kMono : which, normalize(direction));
  ImagePoint point = place_of(camera.projection, label);
  vec2 size = eyes[which].size;
  Place place;
  place.label = label;
  place.at = point.uv * size;
  place.low = vec2(-1e6);
  place.high = vec2(1e6);
  // Rounding may put a place on the picture's edge just outside.
  vec2 off = abs(point.uv - 0.5);
  place.seen = point.seen || (!has_image_circle(camera.projection.kind) && max(off.x, off.y) < 0.50001);
  int kind = camera.projection.kind;
  if (is_cube(kind)) {
    int columns = cube_columns(kind);
    int cell = cube_cell_toward(kind, label);
    vec2 face = size / vec2(float(columns), float(6 / columns));
    vec2 corner = vec2(float(cell % columns), float(cell / columns));
    place.low = ceil(corner * face - 0.5);
    place.high = ceil((corner + 1.0) * face - 0.5);
    place.at = clamp(place.at, place.low + 1.0 / 128.0, place.high - 1.0 / 128.0);
  }
  return place;
}

// How the place moves with a step of the direction, in texels. A step that leaves the face is taken backwards.
// (Drivers inline every call and compile for seconds: whatever is large is called from few places, in loops.)
vec2 movement(int which, vec3 direction, vec3 step_by, Place from) {
  const float kPart = 0.25;
  vec2 size = eyes[which].size;
  float turn = size.x * 2.0 * kPi / camera.projection.span.x;
  for (int i = 0; i < 2; i++) {
    float part = i == 0 ? kPart : -kPart;
    Place there = place_at(which, direction + step_by * part);
    vec2 move = there.at - from.at;
    if (has_range(camera.projection.kind)) move.x -= turn * floor(move.x / turn + 0.5);
    bool is_near = max(abs(move.x) / size.x, abs(move.y) / size.y) < 0.2;
    if (there.low == from.low && is_near) return move / part;
  }
  return vec2(0.0);
}

// --- texels ---------------------------------------------------------------------------------------------------------

// A place in a layer, in texels of the level 0.
struct Spot {
  vec2 at;
  vec2 low;
  vec2 high;
  int layer;
};

vec2 layer_size(int which) {
  return vec2((which == kLeft ? textureSize(left_tiles, 0) : textureSize(right_tiles, 0)).xy);
}

Spot spot_at(int which, Place place, vec2 offset) {
  vec2 size = eyes[which].size;
  vec2 tile = eyes[which].tile;
  vec2 at = clamp(place.at + offset, place.low + 0.5, place.high - 0.5);
  if (wraps()) at.x -= size.x * floor(at.x / size.x);
  at = clamp(at, vec2(0.0), size);
  vec2 last = vec2(float(eyes[which].columns - 1), ceil(size.y / tile.y) - 1.0);
  vec2 cell = min(floor(at / tile), last);
  vec2 origin = cell * tile - kBorder;
  Spot spot;
  spot.at = at - origin;
  spot.low = max(place.low - origin, vec2(0.0));
  spot.high = min(place.high - origin, layer_size(which));
  spot.layer = int(cell.y) * eyes[which].columns + int(cell.x);
  return spot;
}

vec4 cubic(float t) {
  return vec4(0.0, 1.0, 0.0, 0.0) + t * (vec4(-0.5, 0.0, 0.5, 0.0) + t * (vec4(1.0, -2.5, 2.0, -0.5) +
         t * vec4(-0.5, 1.5, -1.5, 0.5)));
}

vec3 bicubic(int which, Spot spot, int level) {
  float scale = exp2(float(-level));
  vec2 at = spot.at * scale - 0.5;
  vec2 whole = floor(at);
  vec4 across = cubic(at.x - whole.x);
  vec4 down = cubic(at.y - whole.y);
  ivec2 high = ivec2(floor(spot.high * scale)) - 1;
  ivec2 low = min(ivec2(ceil(spot.low * scale)), high);
  vec3 sum = vec3(0.0);
  vec3 least = vec3(1.0);
  vec3 most = vec3(0.0);
  for (int j = 0; j < 4; j++) {
    for (int i = 0; i < 4; i++) {
      ivec3 texel = ivec3(clamp(ivec2(whole) + ivec2(i - 1, j - 1), low, high), spot.layer);
      vec3 light = which == kLeft ? texelFetch(left_tiles, texel, level).rgb : texelFetch(right_tiles, texel, level).rgb;
      sum += light * across[i] * down[j];
      least = min(least, light);
      most = max(most, light);
    }
  }
  return clamp(sum, least, most);
}

// The level's box has the variance (4^level - 1) / 12, the pixel wants (square - 1) / 6: two levels are mixed.
vec3 averaged(int which, Spot spot, float square) {
  float boxes = 2.0 * square - 1.0;
  int level = clamp(int(floor(0.5 * log2(boxes))), 0, kLastLevel - 1);
  float box = exp2(2.0 * float(level));
  float more = clamp((boxes - box) / (3.0 * box), 0.0, 1.0);
  if (more < 0.01) more = 0.0;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 2; i++) {
    float weight = i == 0 ? 1.0 - more : more;
    if (weight > 0.0) sum += weight * bicubic(which, spot, level + i);
  }
  return sum;
}

// dx, dy: how far the place moves from pixel to pixel, in texels.
vec3 filtered(int which, Place place, vec2 dx, vec2 dy) {
  // The squared half axes of the ellipse that a round pixel becomes.
  float xx = dx.x * dx.x + dy.x * dy.x;
  float yy = dx.y * dx.y + dy.y * dy.y;
  float xy = dx.x * dx.y + dy.x * dy.y;
  float middle = 0.5 * (xx + yy);
  float spread = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  float large = max(middle + spread, 1.0);
  if (fast && large > 1.0) {
    Spot spot = spot_at(which, place, vec2(0.0));
    vec2 size = layer_size(which);
    vec3 at = vec3(spot.at / size, float(spot.layer));
    if (which == kLeft) return textureGrad(left_tiles, at, dx / size, dy / size).rgb;
    return textureGrad(right_tiles, at, dx / size, dy / size).rgb;
  }
  float square = max(max(middle - spread, 1.0), large / 9.0);
  float rest = large - square;
  int count = 1 + int(ceil(2.0 * sqrt(rest / square) - 0.1));
  // A tent of points, as make_tent() in ods/convert/texel_filter.cpp.
  vec2 axis = xx >= yy ? vec2(middle + spread - yy, xy) : vec2(xy, middle + spread - xx);
  axis = count > 1 ? normalize(axis) : vec2(0.0);
  float n = float(count);
  bool is_even = count % 2 == 0;
  float variance = is_even ? 1.0 + 2.0 / (n * n) : (n * n - 1.0) * (n * n + 3.0) / (n * n * (n * n + 1.0));
  float radius = count > 1 ? sqrt(rest / variance) : 0.0;
  float unit = 2.0 / (is_even ? n * n : n * n + 1.0);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; i++) {
    float offset = (float(i) + 0.5) * 2.0 * radius / n - radius;
    float weight = unit * float(min(2 * i + 1, 2 * (count - i) - 1));
    sum += weight * averaged(which, spot_at(which, place, axis * offset), square);
  }
  return sum;
}

// --- colour ---------------------------------------------------------------------------------------------------------

// Linear light of an eye's picture along a direction; dx, dy: the direction's steps from pixel to pixel. And how much it
// covers what is below it: a window fades at its edges, and adds nothing where the picture below ends.
vec4 light_of(int which, vec3 direction, vec3 dx, vec3 dy) {
  Place place = place_at(which, direction);
  if (!place.seen) return vec4(vec3(0.0103), over ? 0.0 : 1.0);  // a neutral dark grey: the picture has nothing there
  vec2 moves[2];
  for (int i = 0; i < 2; i++) moves[i] = movement(which, direction, i == 0 ? dx : dy, place);
  vec2 inside = min(place.at, eyes[which].size - place.at);
  float cover = !over ? 1.0 : place_of(below, place.label).seen ? clamp(min(inside.x, inside.y) / 12.0, 0.0, 1.0) : 0.0;
  return vec4(filtered(which, place, moves[0], moves[1]), cover);
}

vec3 encode(vec3 light) {
  light = clamp(light, 0.0, 1.0);
  return mix(1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, 12.92 * light, vec3(lessThanEqual(light, vec3(0.0031308))));
}

// The matrices of ods/picture/anaglyph.cpp, by columns.
vec3 dubois(vec3 left, vec3 right) {
  return mat3(0.437, -0.062, -0.048, 0.449, -0.062, -0.050, 0.164, -0.024, -0.017) * left +
         mat3(-0.011, 0.377, -0.026, -0.032, 0.761, -0.093, -0.007, 0.009, 1.234) * right;
}

// How strongly a line at a multiple of `every` degrees covers the pixel, whose size is in degrees.
float line_at(float angle, float every, float stretch, float pixel) {
  float off = abs(angle - every * floor(angle / every + 0.5)) * stretch;
  return clamp(1.2 - off / pixel, 0.0, 1.0);
}

vec3 with_grid(vec3 shown, vec3 direction, vec3 dy) {
  float level = length(direction.xz);
  float pixel = degrees(length(dy) / length(direction));
  float heading = degrees(atan(direction.x, -direction.z));
  float elevation = degrees(atan(direction.y, level));
  float stretch = level / length(direction);
  float meridian = abs(elevation) < 80.5 ? line_at(heading, 10.0, stretch, pixel) : 0.0;
  float thin = max(meridian, line_at(elevation, 10.0, 1.0, pixel));
  float thick = max(line_at(heading, 90.0, stretch, 1.5 * pixel), line_at(elevation, 180.0, 1.0, 1.5 * pixel));
  shown = mix(shown, vec3(1.0), 0.3 * thin);
  return mix(shown, vec3(1.0, 0.8, 0.3), 0.8 * thick);
}

void main() {
  vec3 direction = direction_at(screen);
  vec3 dx = direction_at(screen + vec2(2.0 / viewport.x, 0.0)) - direction;
  vec3 dy = direction_at(screen - vec2(0.0, 2.0 / viewport.y)) - direction;
  vec4 light[2];
  for (int i = 0; i < 2; i++) {
    if (mode != kOneEye || i == eye) light[i] = light_of(i, shifted(i, direction), shifted(i, dx), shifted(i, dy));
  }
  vec3 shown;
  if (mode == kOneEye) shown = encode(light[eye].rgb);
  if (mode == kAnaglyph) shown = encode(dubois(light[kLeft].rgb, light[kRight].rgb));
  if (mode == kDifference) shown = abs(encode(light[kLeft].rgb) - encode(light[kRight].rgb));
  if (grid) shown = with_grid(shown, direction, dy);
  color = vec4(shown, mode == kOneEye ? light[eye].a : min(light[kLeft].a, light[kRight].a));
}
