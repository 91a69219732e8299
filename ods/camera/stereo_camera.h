// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera as users set it: degrees, metres, defaults. make_camera() turns it into the kernel's record.
//
// World: right-handed, +Y up; with yaw = pitch = roll = 0 the picture's centre looks along -Z and +X is to the right
// (glTF's own camera). Angles are applied as roll, then pitch, then yaw.
#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "ods/base/names.h"
#include "ods/camera/projection.h"
#include "ods/camera/texel_rays.h"
#include "ods/image/image.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

// Shrinks the distance between the eyes towards one pole, so that the picture can be viewed there. Elevations are
// degrees from the horizon (0) towards the pole (90), 0 <= start < end <= 90.
struct PoleMergeSetting {
  int mode = kMergeNone;  // kMergeNone, kMergeLinear .. (ods/kernel/camera/merge.h)
  float start = 60.0f;
  float end = 90.0f;
  float exponent = 1.0f;  // the curve is raised to this power, > 0

  bool operator==(const PoleMergeSetting&) const = default;
};

// The commands' default if no option, preset or file specifies a merge: full stereo up to the elevation that people see
// without bending the neck, none at the pole (docs/ods.md).
inline constexpr PoleMergeSetting kUsualMerge{kMergeCosine, 60.0f, 90.0f, 1.0f};

inline constexpr NameRow<int> kMergeTable[] = {
    {kMergeNone, "none"},
    {kMergeLinear, "linear"},
    {kMergeCosine, "cosine"},
    {kMergeSmoothstep, "smoothstep"},
    {kMergeSmootherstep, "smootherstep"},
    {kMergeGaussian, "gaussian"},
    {kMergePower, "power"},
    {kMergeTiltBrush, "tilt-brush"},
    {kMergeMap, "map"},
};
static_assert(has_each_of(kMergeTable, kMergeCount));
inline constexpr auto kMerges = members_of(kMergeTable);
constexpr std::string_view merge_name(int mode) {
  return name_in(kMergeTable, mode);
}
constexpr std::optional<int> merge_of(std::string_view name) {
  return find_in(kMergeTable, name);
}
// Two settings of kMergeNone are equal whatever their numbers.
bool same_merge(const PoleMergeSetting& a, const PoleMergeSetting& b);

inline constexpr NameRow<int> kConvergenceTable[] = {{kParallel, "parallel"}, {kToeIn, "toe-in"}, {kShift, "shift"}};
static_assert(has_each_of(kConvergenceTable, kConvergenceCount));
inline constexpr auto kConvergences = members_of(kConvergenceTable);
constexpr std::string_view convergence_name(int convergence) {
  return name_in(kConvergenceTable, convergence);
}

struct StereoCamera {
  vec3 position{0.0f, 0.0f, 0.0f};
  float yaw = 0.0f;    // degrees to the right
  float pitch = 0.0f;  // degrees up; it tilts the viewing circle too, unless the circle has its own axis
  float roll = 0.0f;   // degrees clockwise
  float ipd = 0.065f;  // distance between the eyes, metres; 0 is mono
  PoleMergeSetting top;
  PoleMergeSetting bottom;
  std::shared_ptr<const Image> merge_map;  // for kMergeMap: lat-long, 1 channel, 1 is full stereo and 0 is merged
  // The tilt of the head in each direction, from 90 degrees to the left (0) over level (0.5) to 90 degrees to the right
  // (1, the right eye below the left one). Lat-long, 1 channel. A level head if not set.
  std::shared_ptr<const Image> head_tilt_map;
  ProjectionSetting projection;
  int convergence = kParallel;
  float convergence_distance = 2.0f;  // metres
  float neck = 0.0f;            // distance of the eyes in front of the neck's axis, metres; the merge scales it too
  std::optional<vec3> axis;     // normal of the viewing circle, in the world; the camera's up if not set
  float lens_radius = 0.0f;     // metres; 0 is a pinhole. There is no rolling shutter.
  float focus_distance = 2.0f;  // metres along the ray
  bool mirrored = false;        // front and back are swapped, as if a left-handed world were read as right-handed
  std::shared_ptr<const TexelRays> texel_rays;  // see texel_camera()

  bool operator==(const StereoCamera&) const = default;
};

// Returns whether two maps have the same numbers.
bool same_map(const std::shared_ptr<const Image>& a, const std::shared_ptr<const Image>& b);

// Returns whether a map has one value per elevation, all the way around.
bool is_same_around(const Image& map);

// Returns whether the camera's merge map has, or the camera has no such map.
bool merges_same_around(const Camera& camera);

// Returns whether the eyes of both are at the same positions, relative to the circle's centre, for every line of sight.
// Precondition: both have the same circle. Maps turn with the camera, so a camera with a map that varies around may not
// be turned.
bool same_eyes(const StereoCamera& a, const StereoCamera& b);

// Precondition: every field is finite, ipd >= 0, the projection has no fault.
// The result points into the maps of `stereo`.
Camera make_camera(const StereoCamera& stereo);

// The camera of a texture: a picture, for the renderers and the denoiser only, whose rays come from a table. It has one
// eye and no lens, and the table's size (with_texels() in ods/render/render_target.h). viewer: the place from which the
// texture is seen; rays start in the volumes that contain it. Precondition: the table has a ray and an owner for each
// texel.
StereoCamera texel_camera(std::shared_ptr<const TexelRays> rays, vec3 viewer);

// Turns the camera in its own frame, by degrees relative to its orientation.
void turn(StereoCamera& camera, float yaw, float pitch, float roll);

// Normal of the viewing circle, in the world. Unit length.
vec3 axis_in_world(const Camera& camera);

// Degrees, as in StereoCamera.
struct ViewAngles {
  float yaw;
  float pitch;
  float roll;
};

// The inverse of make_camera(): the angles of a camera that looks along `forward`. If it looks straight up or down, yaw
// and roll turn about the same axis, and roll is 0. Precondition: perpendicular unit vectors.
ViewAngles view_angles(glm::dvec3 forward, glm::dvec3 up);

}  // namespace ods
