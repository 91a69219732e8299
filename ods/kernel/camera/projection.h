// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Projections: image position <-> direction, each with its exact inverse. CONTRIBUTING.md lists what a new one needs.
// Code that distinguishes kinds without a switch has a static_assert on kProjectionCount, so that a new kind is not
// forgotten.
//
// Image positions: u is 0..1 from left to right, v is 0..1 from top to bottom of one eye's picture. Directions are in
// the camera's frame: x right, y up, z back. theta is the heading, 0 ahead and positive to the right;
// phi is the elevation.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/merge.h"
namespace ods {
#endif

const int kLatLong = 0;                // linear in theta and phi, over the whole sphere or a part of it
const int kCylinder = 1;               // linear in theta and in the tangent of phi
const int kFisheye = 2;                // equidistant: the radius is proportional to the angle from the lens axis
const int kFisheyeEquisolid = 3;       // equal areas have equal solid angles
const int kPerspective = 4;            // a flat window; with 90 degrees it is a face of a cube
const int kCube3x2 = 5;                // faces arranged as by the VR camera for Arnold
const int kCube6x1 = 6;                // NVIDIA's order of the faces
const int kCube1x6 = 7;                // the faces of kCube6x1 in a column
const int kEac = 8;                    // equi-angular cube, 3x2 as players of 360 video expect it
const int kEacFace = 9;                // one face of kEac, which can be pointed in any direction
const int kFisheyePolynomial = 10;     // the angle from the lens axis is a polynomial of the radius on a sensor
const int kFisheyeStereographic = 11;  // keeps shapes: seen from the point opposite to the lens axis on the unit sphere
const int kProjectionCount = 12;

// Headings and heights are linear from edge to edge.
inline bool has_range(int kind) {
  return kind == kLatLong || kind == kCylinder;
}

inline bool is_fisheye(int kind) {
  return kind == kFisheye || kind == kFisheyeEquisolid || kind == kFisheyeStereographic;
}

// The picture is an ellipse, Projection::circle; outside it the frame is empty.
// A fisheye's circle touches the frame's edges.
inline bool has_image_circle(int kind) {
  return is_fisheye(kind) || kind == kFisheyePolynomial;
}

// Has an angle of view that users can set.
inline bool has_fov(int kind) {
  return has_image_circle(kind) || kind == kPerspective;
}

// Users can point the lens.
inline bool has_lens(int kind) {
  return has_image_circle(kind) || kind == kPerspective || kind == kEacFace;
}

// Six faces, each in its own cell.
inline bool is_cube(int kind) {
  return kind == kCube3x2 || kind == kCube6x1 || kind == kCube1x6 || kind == kEac;
}

struct Projection {
  int kind;
  vec2 center;  // kLatLong, kCylinder: theta and phi of the picture's centre, radians; kCylinder: tan(phi)
  vec2 span;    // the range that the picture covers from edge to edge, in the units of `center`
  float angle;  // kFisheye...: from edge to edge of the image circle, radians
  vec2 circle;  // has_image_circle(): its half axes, in units of half the frame's width and height
  vec2 sensor;  // kFisheyePolynomial: the frame's width and height, millimetres
  float k0;     // the coefficients of the radius to the power of 0, 1, .. in the negated angle, radians
  float k1;
  float k2;
  float k3;
  float k4;
  vec2 half_size;   // kPerspective: tangents of half the horizontal and vertical angle
  vec3 lens_right;  // has_lens(): the orientation of the lens, in the camera's frame
  vec3 lens_up;
  vec3 lens_back;
};

// The direction that an image position looks in.
struct ViewDirection {
  vec3 direction;   // unit length
  vec3 heading;     // (sin theta, 0, -cos theta)
  float elevation;  // phi; beyond +-pi/2 where a lat-long picture continues over its pole
  bool seen;        // false if the picture is empty there
};

struct ImagePoint {
  vec2 uv;
  bool seen;  // false if the direction is outside the picture
};

inline ViewDirection look_along(vec3 direction) {
  ViewDirection look;
  float level = sqrt(direction.x * direction.x + direction.z * direction.z);
  float size = length(direction);
  look.direction = direction * (1.0f / size);
  look.heading = vec3(0.0f, 0.0f, -1.0f);
  if (level > 0.0f) look.heading = vec3(direction.x / level, 0.0f, direction.z / level);
  look.elevation = atan_of(direction.y, level);
  look.seen = true;
  return look;
}

inline ViewDirection look_at_angles(float theta, float phi) {
  ViewDirection look;
  vec2 around = cos_sin(theta);
  vec2 rise = cos_sin(phi);
  look.heading = vec3(around.y, 0.0f, -around.x);
  look.direction = look.heading * rise.x + vec3(0.0f, rise.y, 0.0f);
  look.elevation = phi;
  look.seen = true;
  return look;
}

// Position of a direction in a lat-long picture, both coordinates 0..1.
inline vec2 direction_to_lat_long(vec3 d) {
  return vec2(0.5f + atan_of(d.x, -d.z) * (0.5f / kPi),
              0.5f - atan_of(d.y, sqrt(d.x * d.x + d.z * d.z)) * (1.0f / kPi));
}

// u of a heading, shifted by whole turns to the picture's side of the sphere.
inline float place_heading(Projection projection, vec3 direction) {
  float off = atan_of(direction.x, -direction.z) - projection.center.x;
  float turns = off * (0.5f / kPi) + 0.5f;
  off = (turns - floor(turns) - 0.5f) * (2.0f * kPi);
  return 0.5f + off / projection.span.x;
}

inline bool inside_picture(vec2 uv) {
  return uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f;
}

inline ViewDirection lat_long_look(Projection projection, vec2 uv) {
  return look_at_angles(projection.center.x + (uv.x - 0.5f) * projection.span.x,
                        projection.center.y + (0.5f - uv.y) * projection.span.y);
}

inline ImagePoint lat_long_place(Projection projection, vec3 direction) {
  float phi = atan_of(direction.y, sqrt(direction.x * direction.x + direction.z * direction.z));
  ImagePoint place;
  place.uv = vec2(place_heading(projection, direction), 0.5f - (phi - projection.center.y) / projection.span.y);
  place.seen = inside_picture(place.uv);
  return place;
}

inline ViewDirection cylinder_look(Projection projection, vec2 uv) {
  return look_at_angles(projection.center.x + (uv.x - 0.5f) * projection.span.x,
                        atan_of(projection.center.y + (0.5f - uv.y) * projection.span.y, 1.0f));
}

inline ImagePoint cylinder_place(Projection projection, vec3 direction) {
  float level = sqrt(direction.x * direction.x + direction.z * direction.z);
  float slope = direction.y / max(level, 1e-30f);
  ImagePoint place;
  place.uv = vec2(place_heading(projection, direction), 0.5f - (slope - projection.center.y) / projection.span.y);
  place.seen = inside_picture(place.uv);
  return place;
}

inline vec3 from_lens(Projection projection, vec3 p) {
  return projection.lens_right * p.x + projection.lens_up * p.y + projection.lens_back * p.z;
}

inline vec3 to_lens(Projection projection, vec3 d) {
  return vec3(dot(d, projection.lens_right), dot(d, projection.lens_up), dot(d, projection.lens_back));
}

// Returns whether a position is inside the image circle, which touches the picture's edges. As in look_of(), pass
// `home` to decide for a pixel.
inline bool inside_circle(Projection projection, vec2 uv) {
  return length(vec2(2.0f * uv.x - 1.0f, 1.0f - 2.0f * uv.y) / projection.circle) <= 1.0f;
}

// The angle from the lens axis at a radius, in units of the image circle's radius, and its inverse.
inline float fisheye_angle(Projection projection, float r) {
  float quarter = 0.25f * projection.angle;
  if (projection.kind == kFisheyeEquisolid) return 2.0f * asin_of(min(sin_of(quarter) * r, 1.0f));
  if (projection.kind == kFisheyeStereographic) return 2.0f * atan_of(tan_of(quarter) * r, 1.0f);
  return 2.0f * quarter * r;
}

inline float fisheye_radius(Projection projection, float angle) {
  float quarter = 0.25f * projection.angle;
  if (projection.kind == kFisheyeEquisolid) return sin_of(0.5f * angle) / sin_of(quarter);
  if (projection.kind == kFisheyeStereographic) return tan_of(min(0.5f * angle, 1.57f)) / tan_of(quarter);
  return 0.5f * angle / quarter;
}

inline ViewDirection fisheye_look(Projection projection, vec2 home, vec2 uv) {
  vec2 p = vec2(2.0f * uv.x - 1.0f, 1.0f - 2.0f * uv.y);
  float r = length(p);
  float angle = fisheye_angle(projection, r);
  vec2 bend = cos_sin(angle);
  float out_of_axis = r > 0.0f ? bend.y / r : 0.0f;
  ViewDirection look = look_along(from_lens(projection, vec3(p.x * out_of_axis, p.y * out_of_axis, -bend.x)));
  look.seen = inside_circle(projection, home);
  return look;
}

inline ImagePoint fisheye_place(Projection projection, vec3 direction) {
  vec3 p = to_lens(projection, direction);
  float out_of_axis = sqrt(p.x * p.x + p.y * p.y);
  float r = fisheye_radius(projection, atan_of(out_of_axis, -p.z));
  float scale = out_of_axis > 0.0f ? r / out_of_axis : 0.0f;
  ImagePoint place;
  place.uv = vec2(0.5f + 0.5f * p.x * scale, 0.5f - 0.5f * p.y * scale);
  if (out_of_axis == 0.0f && p.z > 0.0f)
    place.uv.x = 0.5f + 0.5f * r;  // the direction straight behind is the whole rim
  place.seen = r <= 1.0f;
  return place;
}

// Source: Cycles, fisheye_lens_polynomial_to_direction(). Angles below 0, near the axis, become 0.
inline float polynomial_angle(Projection projection, float r) {
  float k = projection.k1 + r * (projection.k2 + r * (projection.k3 + r * projection.k4));
  return max(-(projection.k0 + r * k), 0.0f);
}

// The derivative of the angle, radians per millimetre. It is above 0 within the picture:
// projection_fault() ensures that.
inline float polynomial_slope(Projection projection, float r) {
  return -(projection.k1 + r * (2.0f * projection.k2 + r * (3.0f * projection.k3 + r * 4.0f * projection.k4)));
}

inline ViewDirection polynomial_look(Projection projection, vec2 home, vec2 uv) {
  vec2 p = vec2((uv.x - 0.5f) * projection.sensor.x, (0.5f - uv.y) * projection.sensor.y);
  float r = length(p);
  float angle = polynomial_angle(projection, r);
  vec2 bend = cos_sin(angle);
  float out_of_axis = r > 0.0f ? bend.y / r : 0.0f;
  ViewDirection look = look_along(from_lens(projection, vec3(p.x * out_of_axis, p.y * out_of_axis, -bend.x)));
  look.seen = inside_circle(projection, home);
  return look;
}

// Newton's method, kept between two radii whose angles enclose the given one. Beyond the circle the radius is
// proportional to the angle.
inline float polynomial_radius(Projection projection, float angle) {
  float high = 0.5f * projection.circle.x * projection.sensor.x;
  float widest = polynomial_angle(projection, high);
  if (angle >= widest) return high * angle / widest;
  float low = 0.0f;
  float r = high * angle / widest;
  for (int i = 0; i < 40; i++) {
    float beyond = polynomial_angle(projection, r) - angle;
    if (beyond > 0.0f) {
      high = r;
    } else {
      low = r;
    }
    float next = r - beyond / polynomial_slope(projection, r);
    if (!(next > low && next < high)) next = 0.5f * (low + high);
    if (next == r) return r;
    r = next;
  }
  return r;
}

inline ImagePoint polynomial_place(Projection projection, vec3 direction) {
  vec3 p = to_lens(projection, direction);
  float out_of_axis = sqrt(p.x * p.x + p.y * p.y);
  float r = polynomial_radius(projection, atan_of(out_of_axis, -p.z));
  vec2 outwards = vec2(p.z > 0.0f ? 1.0f : 0.0f, 0.0f);  // the direction straight behind is the whole rim
  if (out_of_axis > 0.0f) outwards = vec2(p.x, p.y) * (1.0f / out_of_axis);
  ImagePoint place;
  place.uv = vec2(0.5f + outwards.x * r / projection.sensor.x, 0.5f - outwards.y * r / projection.sensor.y);
  place.seen = r <= 0.5f * projection.circle.x * projection.sensor.x && inside_picture(place.uv);
  return place;
}

inline ViewDirection perspective_look(Projection projection, vec2 uv) {
  vec2 p = vec2((2.0f * uv.x - 1.0f) * projection.half_size.x, (1.0f - 2.0f * uv.y) * projection.half_size.y);
  return look_along(from_lens(projection, vec3(p.x, p.y, -1.0f)));
}

inline ImagePoint perspective_place(Projection projection, vec3 direction) {
  vec3 p = to_lens(projection, direction);
  float ahead = max(-p.z, 1e-30f);
  ImagePoint place;
  place.uv =
      vec2(0.5f + 0.5f * p.x / (ahead * projection.half_size.x), 0.5f - 0.5f * p.y / (ahead * projection.half_size.y));
  place.seen = p.z < 0.0f && inside_picture(place.uv);
  return place;
}

inline ViewDirection eac_face_look(Projection projection, vec2 uv) {
  vec3 p = vec3(tan_of(0.25f * kPi * (2.0f * uv.x - 1.0f)), tan_of(0.25f * kPi * (1.0f - 2.0f * uv.y)), -1.0f);
  return look_along(from_lens(projection, p));
}

inline ImagePoint eac_face_place(Projection projection, vec3 direction) {
  vec3 p = to_lens(projection, direction);
  ImagePoint place;
  place.uv = vec2(0.5f + atan_of(p.x, -p.z) * (2.0f / kPi), 0.5f - atan_of(p.y, -p.z) * (2.0f / kPi));
  place.seen = p.z < 0.0f && inside_picture(place.uv);
  return place;
}

// One face of a cube around the camera: its centre, and the directions from there to its picture's right and top edge.
struct CubeFace {
  vec3 middle;
  vec3 right;
  vec3 top;
};

inline CubeFace cube_face(vec3 middle, vec3 right, vec3 top) {
  CubeFace face;
  face.middle = middle;
  face.right = right;
  face.top = top;
  return face;
}

inline int cube_columns(int kind) {
  return kind == kCube6x1 ? 6 : kind == kCube1x6 ? 1 : 3;
}

// The face in a cell; cells are counted in reading order.
inline CubeFace cube_cell(int kind, int cell) {
  vec3 x = vec3(1.0f, 0.0f, 0.0f);
  vec3 y = vec3(0.0f, 1.0f, 0.0f);
  vec3 z = vec3(0.0f, 0.0f, 1.0f);
  if (kind == kEac) {
    if (cell == 0) return cube_face(-x, -z, y);
    if (cell == 1) return cube_face(-z, x, y);
    if (cell == 2) return cube_face(x, z, y);
    if (cell == 3) return cube_face(-y, z, x);
    if (cell == 4) return cube_face(z, y, x);
    return cube_face(y, -z, x);
  }
  if (kind == kCube3x2) {
    if (cell == 0) return cube_face(-z, x, y);
    if (cell == 1) return cube_face(y, -x, -z);
    if (cell == 2) return cube_face(-y, -x, z);
    if (cell == 3) return cube_face(x, z, y);
    if (cell == 4) return cube_face(z, -x, y);
    return cube_face(-x, -z, y);
  }
  if (cell == 0) return cube_face(x, -y, z);
  if (cell == 1) return cube_face(-x, y, z);
  if (cell == 2) return cube_face(z, x, -y);
  if (cell == 3) return cube_face(-z, x, y);
  if (cell == 4) return cube_face(y, x, z);
  return cube_face(-y, -x, z);
}

// Beyond the edge of its home cell a face continues as the plane that it is.
inline ViewDirection cube_look(int kind, vec2 home, vec2 uv) {
  int columns = cube_columns(kind);
  int rows = 6 / columns;
  int column = clamp(int(floor(home.x * float(columns))), 0, columns - 1);
  int row = clamp(int(floor(home.y * float(rows))), 0, rows - 1);
  float s = 2.0f * (uv.x * float(columns) - float(column)) - 1.0f;
  float t = 1.0f - 2.0f * (uv.y * float(rows) - float(row));
  if (kind == kEac) {
    s = tan_of(0.25f * kPi * s);
    t = tan_of(0.25f * kPi * t);
  }
  CubeFace face = cube_cell(kind, row * columns + column);
  return look_along(face.middle + face.right * s + face.top * t);
}

// The cell whose face a direction meets.
inline int cube_cell_toward(int kind, vec3 direction) {
  int best = 0;
  for (int cell = 1; cell < 6; cell++) {
    if (dot(direction, cube_cell(kind, cell).middle) > dot(direction, cube_cell(kind, best).middle)) best = cell;
  }
  return best;
}

inline ImagePoint cube_place(int kind, vec3 direction) {
  int columns = cube_columns(kind);
  int best = cube_cell_toward(kind, direction);
  CubeFace face = cube_cell(kind, best);
  float ahead = dot(direction, face.middle);
  float s = clamp(dot(direction, face.right) / ahead, -1.0f, 1.0f);
  float t = clamp(dot(direction, face.top) / ahead, -1.0f, 1.0f);
  if (kind == kEac) {
    s = atan_of(s, 1.0f) * (4.0f / kPi);
    t = atan_of(t, 1.0f) * (4.0f / kPi);
  }
  ImagePoint place;
  place.uv = vec2((float(best % columns) + 0.5f + 0.5f * s) / float(columns),
                  (float(best / columns) + 0.5f - 0.5f * t) / float(6 / columns));
  place.seen = true;
  return place;
}

// The direction that an image position looks in. home: the centre of the pixel that the position belongs to, which
// decides about faces and edges; a pixel filter may reach beyond them, and sees the face or the sphere continue there.
inline ViewDirection look_of(Projection projection, vec2 home, vec2 uv) {
  if (projection.kind == kLatLong) return lat_long_look(projection, uv);
  if (projection.kind == kCylinder) return cylinder_look(projection, uv);
  if (projection.kind == kPerspective) return perspective_look(projection, uv);
  if (is_fisheye(projection.kind)) return fisheye_look(projection, home, uv);
  if (is_cube(projection.kind)) return cube_look(projection.kind, home, uv);
  if (projection.kind == kEacFace) return eac_face_look(projection, uv);
  if (projection.kind == kFisheyePolynomial) return polynomial_look(projection, home, uv);
  ViewDirection nothing = lat_long_look(projection, uv);  // unknown projection
  nothing.seen = false;
  return nothing;
}

// The position of a direction (any length but 0) in the picture.
inline ImagePoint place_of(Projection projection, vec3 direction) {
  if (projection.kind == kLatLong) return lat_long_place(projection, direction);
  if (projection.kind == kCylinder) return cylinder_place(projection, direction);
  if (projection.kind == kPerspective) return perspective_place(projection, direction);
  if (is_fisheye(projection.kind)) return fisheye_place(projection, direction);
  if (is_cube(projection.kind)) return cube_place(projection.kind, direction);
  if (projection.kind == kEacFace) return eac_face_place(projection, direction);
  if (projection.kind == kFisheyePolynomial) return polynomial_place(projection, direction);
  ImagePoint nothing = lat_long_place(projection, direction);
  nothing.seen = false;
  return nothing;
}

// Position within the cube face that contains `home`, both coordinates -1..1, upwards.
inline vec2 place_in_cell(int kind, vec2 home, vec2 uv) {
  float columns = float(cube_columns(kind));
  float rows = 6.0f / columns;
  return vec2(2.0f * (uv.x * columns - floor(home.x * columns)) - 1.0f,
              1.0f - 2.0f * (uv.y * rows - floor(home.y * rows)));
}

// Returns whether uv is on the same cube face as `home`. Always true for other projections.
inline bool same_face(Projection projection, vec2 home, vec2 uv) {
  if (!is_cube(projection.kind)) return true;
  vec2 place = place_in_cell(projection.kind, home, uv);
  return abs(place.x) <= 1.0f && abs(place.y) <= 1.0f;
}

// Solid angle per area of a plane at distance 1.
inline float plane_solid_angle(vec2 p) {
  float square = 1.0f + dot(p, p);
  return 1.0f / (square * sqrt(square));
}

// Solid angle per square of the angles in -pi/4..pi/4 whose tangents are the coordinates on a plane at distance 1.
inline float eac_solid_angle(vec2 place) {
  vec2 p = vec2(tan_of(0.25f * kPi * place.x), tan_of(0.25f * kPi * place.y));
  return plane_solid_angle(p) * (1.0f + p.x * p.x) * (1.0f + p.y * p.y);
}

// The solid angle that a small piece of the picture covers, over that of an equally large piece elsewhere in it:
// steradians up to a factor that is the same for the whole picture.
inline float relative_solid_angle(Projection projection, vec2 home, vec2 uv) {
  vec2 p = vec2(2.0f * uv.x - 1.0f, 1.0f - 2.0f * uv.y);
  if (projection.kind == kLatLong) return abs(cos_of(projection.center.y + 0.5f * p.y * projection.span.y));
  if (projection.kind == kCylinder)
    return plane_solid_angle(vec2(0.0f, projection.center.y + 0.5f * p.y * projection.span.y));
  if (projection.kind == kPerspective) return plane_solid_angle(p * projection.half_size);
  if (projection.kind == kFisheye) {
    float angle = max(0.5f * projection.angle * length(p), 1e-4f);
    return sin_of(min(angle, kPi)) / angle;
  }
  if (projection.kind == kFisheyeStereographic) {
    p = p * tan_of(0.25f * projection.angle);
    return 1.0f / ((1.0f + dot(p, p)) * (1.0f + dot(p, p)));
  }
  if (projection.kind == kFisheyePolynomial) {
    float r = max(length(vec2(0.5f * p.x * projection.sensor.x, 0.5f * p.y * projection.sensor.y)), 1e-4f);
    return sin_of(min(polynomial_angle(projection, r), kPi)) * polynomial_slope(projection, r) / r;
  }
  if (projection.kind == kEacFace) return eac_solid_angle(p);
  if (projection.kind == kEac) return eac_solid_angle(place_in_cell(projection.kind, home, uv));
  if (is_cube(projection.kind)) return plane_solid_angle(place_in_cell(projection.kind, home, uv));
  if (projection.kind == kFisheyeEquisolid) return 1.0f;
  return 0.0f;  // unknown projection
}

#ifdef __cplusplus
static_assert(sizeof(Projection) == 104);
static_assert(
    kProjectionCount == 12,
    "a new projection is named in is_cube() .. above, cube_cell(), look_of(), place_of(), relative_solid_angle()");
}  // namespace ods
#endif
