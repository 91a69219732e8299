// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/cpu/embree_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <limits>
#include <new>
#include <vector>

// All that differs between Embree 3 and 4.
#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;

static void init_context(EmbreeContext& context) {
  rtcInitRayQueryContext(&context);
}

static void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}

static void occlude(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using EmbreeContext = RTCIntersectContext;

static void init_context(EmbreeContext& context) {
  rtcInitIntersectContext(&context);
}

static void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) {
  rtcIntersect1(scene, &context, &ray);
}

static void occlude(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  rtcOccluded1(scene, &context, &ray);
}
#endif

namespace ods {

struct RayContext {
  EmbreeContext embree;
  PathTracer* tracer;
  int ray;
};

struct EmbreeScene::Handles {
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> shared;  // by mesh, null where the mesh is copied

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (top) rtcReleaseScene(top);
    for (RTCScene scene : shared) {
      if (scene) rtcReleaseScene(scene);
    }
    if (device) rtcReleaseDevice(device);
  }
};

// Embree asks this for each candidate hit on a surface with alpha.
static void filter_alpha(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] != -1) return;
  auto* context = reinterpret_cast<RayContext*>(arguments->context);
  const uint geometry = RTCHitN_geomID(arguments->hit, 1, 0);
  const uint instance = RTCHitN_instID(arguments->hit, 1, 0, 0);
  Hit hit;
  hit.t = 0.0f;
  hit.u = RTCHitN_u(arguments->hit, 1, 0);
  hit.v = RTCHitN_v(arguments->hit, 1, 0);
  hit.instance = static_cast<int>(instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance);
  hit.triangle = static_cast<int>(RTCHitN_primID(arguments->hit, 1, 0));
  if (context->tracer->passes(hit, context->tracer->alpha_draw(context->ray, hit))) arguments->valid[0] = 0;
}

// A mesh's triangles as Embree geometry; placed: with the instance's matrix applied to copies of the vertices.
static RTCGeometry make_geometry(RTCDevice device, const Scene& scene, const Mesh& mesh, const Instance* placed) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const Vertex* vertices = scene.vertices.data() + mesh.first_vertex;
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), mesh.vertex_count));
  auto* corners = static_cast<uint*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                             3 * sizeof(uint), mesh.triangle_count));
  if (!positions || !corners) throw std::bad_alloc();
  for (uint i = 0; i < mesh.vertex_count; i++) {
    const vec3 p = placed ? to_world(*placed, vertices[i].position) : vertices[i].position;
    positions[3 * i] = p.x, positions[3 * i + 1] = p.y, positions[3 * i + 2] = p.z;
  }
  const uvec3* triangles = scene.triangles.data() + mesh.first_triangle;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    corners[3 * i] = triangles[i].x, corners[3 * i + 1] = triangles[i].y, corners[3 * i + 2] = triangles[i].z;
  }
  if (scene.materials[static_cast<size_t>(mesh.material)].alpha_mode != kAlphaOpaque) {
    rtcSetGeometryIntersectFilterFunction(geometry, filter_alpha);
    rtcSetGeometryOccludedFilterFunction(geometry, filter_alpha);
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitGeometry(geometry);
  return geometry;
}

static RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  // Without the robust flag a few rays in a million slip between triangles that touch.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  return scene;
}

static RTCGeometry make_instance(RTCDevice device, RTCScene mesh, const Instance& instance) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, mesh);
  const vec4 rows[3] = {instance.row0, instance.row1, instance.row2};
  float matrix[12];
  for (int row = 0; row < 3; row++) {
    for (int column = 0; column < 4; column++) matrix[row * 4 + column] = rows[row][column];
  }
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, matrix);
  rtcCommitGeometry(geometry);
  return geometry;
}

// Which meshes are worth instancing.
static std::vector<bool> choose_shared(const Scene& scene, size_t max_copied_triangles) {
  std::vector<size_t> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) uses[static_cast<size_t>(instance.mesh)]++;
  size_t copies = 0;
  for (size_t i = 0; i < uses.size(); i++) copies += uses[i] * scene.meshes[i].triangle_count;
  std::vector<bool> shared(scene.meshes.size());
  for (size_t i = 0; i < uses.size(); i++) shared[i] = uses[i] > 1 && copies > max_copied_triangles;
  return shared;
}

EmbreeScene::EmbreeScene(const Scene& scene, size_t max_copied_triangles) : handles_(std::make_unique<Handles>()) {
  handles_->device = rtcNewDevice(nullptr);
  if (!handles_->device) throw std::bad_alloc();
  RTCDevice device = handles_->device;
  handles_->top = new_scene(device);
  handles_->shared.resize(scene.meshes.size());
  const std::vector<bool> shared = choose_shared(scene, max_copied_triangles);
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Instance& instance = scene.instances[i];
    const size_t mesh = static_cast<size_t>(instance.mesh);
    RTCGeometry geometry = nullptr;
    if (shared[mesh]) {
      if (!handles_->shared[mesh]) {
        handles_->shared[mesh] = new_scene(device);
        RTCGeometry triangles = make_geometry(device, scene, scene.meshes[mesh], nullptr);
        rtcAttachGeometry(handles_->shared[mesh], triangles);
        rtcReleaseGeometry(triangles);
        rtcCommitScene(handles_->shared[mesh]);
      }
      geometry = make_instance(device, handles_->shared[mesh], instance);
    } else {
      geometry = make_geometry(device, scene, scene.meshes[mesh], &instance);
    }
    // The geometry's number in the top scene is the instance's number in ours.
    rtcAttachGeometryByID(handles_->top, geometry, static_cast<uint>(i));
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(handles_->top);
  if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

EmbreeScene::~EmbreeScene() = default;

static void set_ray(RTCRay& out, const Ray& ray, float length) {
  out.org_x = ray.origin.x, out.org_y = ray.origin.y, out.org_z = ray.origin.z;
  out.dir_x = ray.direction.x, out.dir_y = ray.direction.y, out.dir_z = ray.direction.z;
  out.tnear = 0.0f, out.tfar = length;
  out.time = 0.0f, out.mask = ~0u, out.id = 0, out.flags = 0;
}

static RayContext make_context(PathTracer& tracer, int ray) {
  RayContext context;
  init_context(context.embree);
  context.tracer = &tracer;
  context.ray = ray;
  return context;
}

Hit EmbreeScene::closest_hit(PathTracer& tracer, const Ray& ray, int kind) const {
  RTCRayHit found;
  set_ray(found.ray, ray, std::numeric_limits<float>::infinity());
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RayContext context = make_context(tracer, kind);
  intersect(handles_->top, context.embree, found);
  Hit hit;
  const bool missed = found.hit.geomID == RTC_INVALID_GEOMETRY_ID;
  hit.t = missed ? -1.0f : found.ray.tfar;
  hit.u = missed ? 0.0f : found.hit.u;
  hit.v = missed ? 0.0f : found.hit.v;
  const uint instance = found.hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? found.hit.geomID : found.hit.instID[0];
  hit.instance = missed ? -1 : static_cast<int>(instance);
  hit.triangle = missed ? -1 : static_cast<int>(found.hit.primID);
  return hit;
}

bool EmbreeScene::occluded(PathTracer& tracer, const Ray& ray, float length) const {
  RTCRay shadow;
  set_ray(shadow, ray, length);
  RayContext context = make_context(tracer, kShadowRay);
  occlude(handles_->top, context.embree, shadow);
  return shadow.tfar < 0.0f;
}

}  // namespace ods
