// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The viewer's shaders. The kernel's headers map a line of sight to a pixel: the build runs the C preprocessor over
// this file and adds the line "#version 300 es"; lines that begin with % are directives for the browser. panorama.js
// defines the purpose of each program with macros, because software GPUs execute every branch that is not constant.
//
// The filter is that of ods/convert/texel_filter.h: a pixel that covers a texel or less is interpolated by the
// Catmull-Rom cubic, clamped to the range of its texels. A pixel that covers s texels averages under a tent with the
// variance (s^2 - 1) / 6: here that of the narrow axis, whatever its direction, is summed texel by texel, from three
// texels on with the help of mip levels, and points along the wide one supply the rest. While the view moves, the GPU
// filters instead, with the same line of sight.
precision highp float;
precision highp int;
precision highp sampler2DArray;
#define inline
#include "ods/kernel/camera/angles.h"
#include "ods/kernel/camera/merge.h"
#include "ods/kernel/camera/projection.h"
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/camera/line.h"

uniform Camera camera;
uniform sampler2D merge_texels;
uniform sampler2D head_tilt_texels;
uniform ivec2 sides;  // the camera's eyes that are shown
uniform mat3 rays;    // a pixel at (x, y), both -1..1, looks along rays * (x, y, 1) in the picture's frame
uniform vec2 shift;   // cosine and sine of the turn: the left eye's picture to the left, the right eye's to the right

float camera_map_texel(Camera a_camera, int which, int i) {
  int width = which == kMapOfMerge ? a_camera.merge_map.width : a_camera.head_tilt_map.width;
  ivec2 at = ivec2(i % width, i / width);
  return which == kMapOfMerge ? texelFetch(merge_texels, at, 0).x : texelFetch(head_tilt_texels, at, 0).x;
}

// The direction in an eye's picture that the view shows in a direction.
vec3 shifted(int which, vec3 direction) {
  float side = sides[which] == kRight ? -shift.y : shift.y;
  return vec3(shift.x * direction.x - side * direction.z, direction.y, side * direction.x + shift.x * direction.z);
}

%ifdef ODS_VERTEX
// A corner of the view. Labels (ods/kernel/camera/line.h) are as long as the corner's direction, so they are linear
// across the view, and exact for pixels between corners. Only toed-in eyes need more than one triangle: a mesh, whose
// error is at most an eighth of the squared side of a cell times the label's second derivative.
uniform int cells;  // cells of the mesh, each way; 0 for one triangle
out vec2 screen;
out vec3 label_0;
out vec3 label_1;

vec3 label_of(int which, vec3 direction) {
  direction = shifted(which, direction);
  return line_label(camera, sides[which], normalize(direction)) * length(direction);
}

void main() {
  screen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  if (cells > 0) screen = vec2(gl_VertexID % (cells + 1), gl_VertexID / (cells + 1)) * (2.0 / float(cells)) - 1.0;
  label_0 = label_of(0, rays * vec3(screen, 1.0));
  label_1 = ODS_BOTH ? label_of(1, rays * vec3(screen, 1.0)) : label_0;
  gl_Position = vec4(screen, 0.0, 1.0);
}

%else
const int kKind = ODS_KIND;       // number of the picture's projection
const bool kBoth = ODS_BOTH;      // an anaglyph or a difference is shown, not the eye at 0
const bool kMoves = ODS_MOVES;    // the view moves
const bool kOver = ODS_OVER;      // the picture is a finer window over one that is already drawn
const bool kAround = ODS_AROUND;  // the view is a lat-long picture of the whole sphere
const bool kPlanet = ODS_PLANET;  // the view is stereographic, a little planet
const bool kGrid = ODS_GRID;
const bool kCheap = ODS_CHEAP;    // for kMoves: the same filter in each direction
const bool kLight = ODS_LIGHT;    // the texels are scene-linear, and developed here
const bool kPaged = ODS_PAGED;    // only some tiles are loaded; a coarse picture replaces the others
const bool kAsk = ODS_ASK;        // shows the needed tiles instead of the picture
const float kBorder = 16.0;  // texels around a tile
const int kLastLevel = 5;    // the coarsest mip level

// An eye's picture, cut into tiles that are the layers of a texture.
struct Eye {
  vec2 size;  // texels
  vec2 tile;  // size of a tile without its border
  int columns;
  int down;  // for kPaged: the coarse picture is reduced by 2^down
};

uniform Projection below;  // for kOver: of the picture below
uniform Eye eyes[2];
uniform sampler2DArray tiles_0;
uniform sampler2DArray tiles_1;
uniform sampler2DArray coarse_0;
uniform sampler2DArray coarse_1;
uniform highp isampler2D slots_0;  // the layer of each tile; negative if it is not loaded
uniform highp isampler2D slots_1;
uniform vec2 viewport;    // pixels
uniform float ask_scale;  // for kAsk: the view's own pixels over those of the search
uniform bool difference;  // instead of an anaglyph
uniform float exposure;   // for kLight: a factor,
uniform bool neutral;     // and whether the tone curve is neutral, else linear
in vec2 screen;
in vec3 label_0;
in vec3 label_1;
out vec4 color;

vec3 direction_at(vec2 at) {
  if (kAround) return look_at_angles(at.x * kPi, at.y * 0.5 * kPi).direction;
  if (!kPlanet) return rays * vec3(at, 1.0);
  vec3 aside = rays * vec3(at, 0.0);
  return aside + rays[2] * (1.0 - 0.25 * dot(aside, aside));
}

// --- positions ------------------------------------------------------------------------------------------------------

struct Place {
  vec2 at;    // texels from the left and top edge of the eye's picture
  vec2 low;   // the texels that are contiguous in the world: a cube's face, or everything
  vec2 high;
  bool seen;
  vec3 label;  // the direction under which the picture stores the line of sight
};

bool wraps() {
  return has_range(kKind) && camera.projection.span.x > 2.0 * kPi - 1e-4;
}

vec3 label_of(int which, vec3 direction) {
  Camera known = camera;
  known.convergence = ODS_CONVERGENCE;
  return line_label(known, sides[which], normalize(direction));
}

Place place_under(int which, vec3 label) {
  Projection known = camera.projection;
  known.kind = kKind;
  ImagePoint point = place_of(known, label);
  vec2 size = eyes[which].size;
  Place place;
  place.label = label;
  place.at = point.uv * size;
  place.low = vec2(-1e6);
  place.high = vec2(1e6);
  // Rounding may move a position on the picture's edge slightly outside.
  vec2 off = abs(point.uv - 0.5);
  place.seen = point.seen || (!has_image_circle(kKind) && max(off.x, off.y) < 0.50001);
  if (is_cube(kKind)) {
    int columns = cube_columns(kKind);
    int cell = cube_cell_toward(kKind, label);
    vec2 face = size / vec2(float(columns), float(6 / columns));
    vec2 corner = vec2(float(cell % columns), float(cell / columns));
    place.low = ceil(corner * face - 0.5);
    place.high = ceil((corner + 1.0) * face - 0.5);
    place.at = clamp(place.at, place.low + 1.0 / 128.0, place.high - 1.0 / 128.0);
  }
  return place;
}

// The movement of the position with a step of the direction, in texels. A step that leaves the face is taken backwards.
// (Drivers inline every call and compile for seconds, so large functions are called from few places, in loops.)
vec2 movement(int which, vec3 direction, vec3 step_by, Place from) {
  const float kPart = 0.25;
  vec2 size = eyes[which].size;
  float turn = size.x * 2.0 * kPi / camera.projection.span.x;
  for (int i = 0; i < 2; i++) {
    float part = i == 0 ? kPart : -kPart;
    Place there = place_under(which, label_of(which, direction + step_by * part));
    vec2 move = there.at - from.at;
    if (has_range(kKind)) move.x -= turn * floor(move.x / turn + 0.5);
    bool is_near = max(abs(move.x) / size.x, abs(move.y) / size.y) < 0.2;
    if (there.low == from.low && is_near) return move / part;
  }
  return vec2(0.0);
}

// --- texels ---------------------------------------------------------------------------------------------------------

// A position in a layer, in texels of level 0.
struct Spot {
  vec2 at;
  vec2 low;
  vec2 high;
  int layer;
  int down;  // for a layer of the coarse picture, which has this many levels less
};

vec2 layer_size(int which) {
  if (!kBoth || which == 0) return vec2(textureSize(tiles_0, 0).xy);
  return vec2(textureSize(tiles_1, 0).xy);
}

vec2 coarse_size(int which) {
  if (!kBoth || which == 0) return vec2(textureSize(coarse_0, 0).xy);
  return vec2(textureSize(coarse_1, 0).xy);
}

int slot_of(int which, ivec2 cell) {
  if (!kBoth || which == 0) return texelFetch(slots_0, cell, 0).x;
  return texelFetch(slots_1, cell, 0).x;
}

// Returns whether the coarse picture is sufficient for a pixel over this many squared texels.
bool is_coarse(int which, float square) {
  return 2.0 * square - 1.0 >= exp2(2.0 * float(eyes[which].down));
}

vec2 cell_of(int which, vec2 at) {
  vec2 size = eyes[which].size;
  vec2 tile = eyes[which].tile;
  return min(floor(at / tile), vec2(float(eyes[which].columns - 1), ceil(size.y / tile.y) - 1.0));
}

// square: of the pixel's width in texels.
Spot spot_at(int which, Place place, vec2 offset, float square) {
  vec2 size = eyes[which].size;
  vec2 at = clamp(place.at + offset, place.low + 0.5, place.high - 0.5);
  if (wraps()) at.x -= size.x * floor(at.x / size.x);
  at = clamp(at, vec2(0.0), size);
  vec2 cell = cell_of(which, at);
  vec2 origin = cell * eyes[which].tile - kBorder;
  Spot spot;
  spot.down = 0;
  spot.at = at - origin;
  spot.low = max(place.low - origin, vec2(0.0));
  spot.high = min(place.high - origin, layer_size(which));
  spot.layer = int(cell.y) * eyes[which].columns + int(cell.x);
  if (kPaged) {
    spot.layer = slot_of(which, ivec2(cell));
    if (spot.layer < 0 || is_coarse(which, square)) {
      float part = exp2(-float(eyes[which].down));
      spot.at = at * part + kBorder;
      spot.low = max(place.low * part + kBorder, vec2(0.0));
      spot.high = min(place.high * part + kBorder, coarse_size(which));
      spot.layer = 0;
      spot.down = eyes[which].down;
    }
  }
  return spot;
}

vec3 texel_of(int which, ivec3 at, int level, bool is_of_coarse) {
  if (kPaged && is_of_coarse) {
    if (!kBoth || which == 0) return texelFetch(coarse_0, at, level).rgb;
    return texelFetch(coarse_1, at, level).rgb;
  }
  if (!kBoth || which == 0) return texelFetch(tiles_0, at, level).rgb;
  return texelFetch(tiles_1, at, level).rgb;
}

vec4 cubic(float t) {
  return vec4(0.0, 1.0, 0.0, 0.0) + t * (vec4(-0.5, 0.0, 0.5, 0.0) + t * (vec4(1.0, -2.5, 2.0, -0.5) +
         t * vec4(-0.5, 1.5, -1.5, 0.5)));
}

const int kMaxTaps = 12;

// Weights of the texels from `first` on, for the cubic under a tent of a squared radius. The points and their weights
// are those of make_tent() in ods/convert/texel_filter.cpp.
struct Taps {
  int first;
  int count;
  float weights[kMaxTaps];
};

Taps taps_at(float at, float square) {
  float n = square < 0.0225 ? 1.0 : 1.0 + ceil(2.0 * sqrt(square));
  bool is_even = mod(n, 2.0) < 0.5;
  float variance = is_even ? 1.0 + 2.0 / (n * n) : (n * n - 1.0) * (n * n + 3.0) / (n * n * (n * n + 1.0));
  float radius = n > 1.5 ? sqrt(square / variance) : 0.0;
  float unit = 2.0 / (is_even ? n * n : n * n + 1.0);
  Taps taps;
  float start = at + radius / n - radius;
  taps.first = int(floor(start)) - 1;
  taps.count = min(int(floor(at + radius - radius / n)) + 3 - taps.first, kMaxTaps);
  for (int k = 0; k < kMaxTaps; k++) taps.weights[k] = 0.0;
  for (int i = 0; i < int(n); i++) {
    float point = start + float(i) * 2.0 * radius / n;
    float whole = floor(point);
    vec4 four = cubic(point - whole) * unit * float(min(2 * i + 1, 2 * (int(n) - i) - 1));
    int k = int(whole) - 1 - taps.first;
    for (int j = 0; j < 4; j++) {
      if (k + j < kMaxTaps) taps.weights[k + j] += four[j];
    }
  }
  return taps;
}

// The mean under a tent, whose radius is in texels of the level.
vec3 mean_at(int which, Spot spot, int level, float square) {
  if (kPaged) level = max(level - spot.down, 0);
  float scale = exp2(float(-level));
  vec2 at = spot.at * scale - 0.5;
  Taps across = taps_at(at.x, square);
  Taps down = taps_at(at.y, square);
  ivec2 high = ivec2(floor(spot.high * scale)) - 1;
  ivec2 low = min(ivec2(ceil(spot.low * scale)), high);
  vec3 sum = vec3(0.0);
  vec3 least = vec3(65504.0);
  vec3 most = vec3(0.0);
  for (int j = 0; j < down.count; j++) {
    for (int i = 0; i < across.count; i++) {
      ivec3 texel = ivec3(clamp(ivec2(across.first + i, down.first + j), low, high), spot.layer);
      vec3 light = texel_of(which, texel, level, spot.down > 0);
      sum += light * (across.weights[i] * down.weights[j]);
      least = min(least, light);
      most = max(most, light);
    }
  }
  return clamp(sum, least, most);
}

// The pixel needs the variance (square - 1) / 6, and a level's box has (4^level - 1) / 12: a tent has the rest. Up to
// three texels everything is the tent's; beyond, the level has most of it.
vec3 averaged(int which, Spot spot, float square) {
  int level = square < 9.0 ? 0 : int(floor(0.5 * log2(square)));
  level = min(level, kLastLevel + (kPaged ? spot.down : 0));
  float box = exp2(2.0 * float(max(level, kPaged ? spot.down : 0)));
  return mean_at(which, spot, level, clamp((square - 0.5 - 0.5 * box) / box, 0.0, 8.5));
}

// dx, dy: movement of the position from pixel to pixel, in texels.
vec3 filtered(int which, Place place, vec2 dx, vec2 dy) {
  // The squared half axes of the ellipse onto which a round pixel is mapped.
  float xx = dx.x * dx.x + dy.x * dy.x;
  float yy = dx.y * dx.y + dy.y * dy.y;
  float xy = dx.x * dx.y + dy.x * dy.y;
  float middle = 0.5 * (xx + yy);
  float spread = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  float large = max(middle + spread, 1.0);
  float square = max(max(middle - spread, 1.0), large / 400.0);
  float rest = large - square;
  int count = 1 + int(ceil(2.0 * sqrt(rest / square) - 0.1));
  // A tent of points, like make_tent() in ods/convert/texel_filter.cpp.
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
    sum += weight * averaged(which, spot_at(which, place, axis * offset, square), square);
  }
  return sum;
}

// --- light ----------------------------------------------------------------------------------------------------------

const float kNothing = 0.0103;  // a neutral dark grey, where the picture is empty

// The opacity over the picture below: a window fades at its edges, and adds nothing where the picture below ends.
float cover_of(int which, Place place) {
  if (!kOver) return 1.0;
  vec2 inside = min(place.at, eyes[which].size - place.at);
  return place_of(below, place.label).seen ? clamp(min(inside.x, inside.y) / 12.0, 0.0, 1.0) : 0.0;
}

// Like ods/image/tone.cpp.
vec3 developed(vec3 light) {
  if (!kLight) return light;
  const float kStart = 0.76;
  const float kRoom = 0.24;
  vec3 color = max(light * exposure, vec3(0.0));
  if (!neutral) return color;
  float low = min(color.r, min(color.g, color.b));
  color -= low < 0.08 ? low - 6.25 * low * low : 0.04;
  float peak = max(color.r, max(color.g, color.b));
  if (peak < kStart) return color;
  float rolled = 1.0 - kRoom * kRoom / (peak + kRoom - kStart);
  return mix(vec3(rolled), color * (rolled / peak), 1.0 / (0.15 * (peak - rolled) + 1.0));
}

// Linear light of an eye's picture along a direction, and its cover; dx, dy: the direction's steps from pixel to pixel.
vec4 light_of(int which, vec3 direction, vec3 dx, vec3 dy) {
  Place place = place_under(which, label_of(which, direction));
  if (!place.seen) return vec4(vec3(kNothing), kOver ? 0.0 : 1.0);
  vec2 moves[2];
  for (int i = 0; i < 2; i++) moves[i] = movement(which, direction, i == 0 ? dx : dy, place);
  return vec4(developed(filtered(which, place, moves[0], moves[1])), cover_of(which, place));
}

// --- while the view moves -------------------------------------------------------------------------------------------

// How the position moves to the next pixel, from the positions of adjacent pixels; label_move: how the label moves.
// Where the edges of the picture or of a cube's faces are between them, the difference is meaningless.
vec2 moved(vec2 move, vec3 label, vec3 label_move, vec2 size) {
  if (wraps()) move.x -= size.x * floor(move.x / size.x + 0.5);
  if (is_cube(kKind)) {
    float face = 0.5 * size.x / float(cube_columns(kKind)) * length(label_move) / length(label);  // at its middle
    if (dot(move, move) > 16.0 * face * face) move = vec2(face, 0.0);
  }
  return move;
}

// dx, dy: movement of the position from pixel to pixel, in fractions of a layer; square: of the pixel's width in texels
vec3 sampled(sampler2DArray tiles, vec3 at, vec2 dx, vec2 dy, float square) {
  if (!kCheap) return textureGrad(tiles, at, dx, dy).rgb;
  return textureLod(tiles, at, 0.5 * log2(max(square, 1.0))).rgb;
}

// The cube version of place_under(). Indices are constants, because software GPUs execute every branch.
struct Cell {
  vec2 corner;  // in cells
  vec2 aside;   // components of the label along the face's edges
  float ahead;
};

Cell nearer(Cell best, int number, vec3 label) {
  CubeFace face = cube_cell(kKind, number);
  Cell cell;
  cell.ahead = dot(label, face.middle);
  if (cell.ahead <= best.ahead) return best;
  cell.corner = vec2(float(number % cube_columns(kKind)), float(number / cube_columns(kKind)));
  cell.aside = vec2(dot(label, face.right), dot(label, face.top));
  return cell;
}

Place quick_cube_place(int which, vec3 label) {
  Cell cell = Cell(vec2(0.0), vec2(0.0), 0.0);
  cell = nearer(nearer(nearer(cell, 0, label), 1, label), 2, label);
  cell = nearer(nearer(nearer(cell, 3, label), 4, label), 5, label);
  vec2 at = clamp(cell.aside / cell.ahead, -1.0, 1.0);
  if (kKind == kEac) at = atan(at) * (4.0 / kPi);
  vec2 face = eyes[which].size / vec2(float(cube_columns(kKind)), float(6 / cube_columns(kKind)));
  Place place;
  place.label = label;
  place.at = (cell.corner + 0.5 + vec2(0.5, -0.5) * at) * face;
  place.low = ceil(cell.corner * face - 0.5);
  place.high = ceil((cell.corner + 1.0) * face - 0.5);
  place.seen = true;
  return place;
}

// Like light_of(), with the GPU's filter.
vec4 quick_light_of(int which, vec3 label) {
  Place place;
  if (is_cube(kKind)) place = quick_cube_place(which, label);
  else place = place_under(which, label);
  vec2 size = eyes[which].size;
  vec2 dx = moved(dFdx(place.at), label, dFdx(label), size);
  vec2 dy = moved(dFdy(place.at), label, dFdy(label), size);
  float large = max(dot(dx, dx), dot(dy, dy));
  float inset = sqrt(clamp(large, 1.0, 256.0));
  if (is_cube(kKind)) place.at = clamp(place.at, place.low + inset - 0.5, place.high - inset + 0.5);
  float square = max(min(dot(dx, dx), dot(dy, dy)), large / 9.0);
  int count = 1;
  if (kKind == kLatLong) {
    // Towards a pole a pixel covers an increasingly long part of a row: then it is the mean of several points.
    float row = length(vec2(dx.x, dy.x));
    float high = length(vec2(dx.y, dy.y));
    count = int(clamp(ceil(0.4 * row / max(high, 1.0)), 1.0, 16.0));
    dx = vec2(row / float(count), 0.0);
    dy = vec2(0.0, high);
    square = max(high * high, 0.16 * dx.x * dx.x);
  }
  if (kAsk) {
    vec2 cell = cell_of(which, clamp(place.at, vec2(0.0), eyes[which].size));
    return vec4(cell / 255.0, place.seen && !is_coarse(which, square * ask_scale * ask_scale) ? 1.0 : 0.0, 1.0);
  }
  vec3 light = vec3(0.0);
  for (int i = 0; i < count; i++) {
    Spot spot = spot_at(which, place, dx * (float(i) + 0.5 - 0.5 * float(count)), square);
    bool is_of_coarse = kPaged && spot.down > 0;
    vec2 layer = is_of_coarse ? coarse_size(which) : layer_size(which);
    vec3 at = vec3(spot.at / layer, float(spot.layer));
    float part = kPaged ? exp2(-float(spot.down)) : 1.0;
    vec2 along = dx * part / layer;
    vec2 down = dy * part / layer;
    float under = square * part * part;
    if (is_of_coarse && kBoth && which == 1) light += sampled(coarse_1, at, along, down, under);
    else if (is_of_coarse) light += sampled(coarse_0, at, along, down, under);
    else if (kBoth && which == 1) light += sampled(tiles_1, at, along, down, under);
    else light += sampled(tiles_0, at, along, down, under);
  }
  light /= float(count);
  return place.seen ? vec4(developed(light), cover_of(which, place)) : vec4(vec3(kNothing), kOver ? 0.0 : 1.0);
}

// --- colour ---------------------------------------------------------------------------------------------------------

vec3 encode(vec3 light) {
  light = clamp(light, 0.0, 1.0);
  vec3 curve;
  if (kMoves) {
    // Square roots instead of powers, which take a software GPU a fifth of a frame. Error: at most 0.1 of 255.
    vec3 root = sqrt(light);
    curve = 0.83381295 * root + 0.29806069 * sqrt(root) - 0.05534076 * light - 0.07689364;
  } else {
    curve = 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055;
  }
  return mix(curve, 12.92 * light, vec3(lessThanEqual(light, vec3(0.0031308))));
}

// The matrices of ods/picture/anaglyph.cpp, by columns.
vec3 dubois(vec3 left, vec3 right) {
  return mat3(0.437, -0.062, -0.048, 0.449, -0.062, -0.050, 0.164, -0.024, -0.017) * left +
         mat3(-0.011, 0.377, -0.026, -0.032, 0.761, -0.093, -0.007, 0.009, 1.234) * right;
}

// The coverage of the pixel by a line at a multiple of `every` degrees. The pixel size is in degrees.
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

vec4 shown_by(int which, vec3 label, vec3 direction, vec3 dx, vec3 dy) {
  direction = shifted(which, direction);
  if (!kMoves) return light_of(which, direction, shifted(which, dx), shifted(which, dy));
  return quick_light_of(which, kAround || kPlanet ? label_of(which, direction) : label);
}

void main() {
  vec3 direction = direction_at(screen);
  vec3 dx = direction_at(screen + vec2(2.0 / viewport.x, 0.0)) - direction;
  vec3 dy = direction_at(screen - vec2(0.0, 2.0 / viewport.y)) - direction;
  vec4 first = shown_by(0, label_0, direction, dx, dy);
  color = first;
  if (kAsk) return;
  if (kBoth) {
    vec4 second = shown_by(1, label_1, direction, dx, dy);
    color = vec4(difference ? abs(encode(first.rgb) - encode(second.rgb)) : encode(dubois(first.rgb, second.rgb)),
                 min(first.a, second.a));
  } else {
    color.rgb = encode(first.rgb);
  }
  if (kGrid) color.rgb = with_grid(color.rgb, direction, dy);
}
%endif
