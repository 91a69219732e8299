// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/cpu/embree_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "ods/render/cpu/exact_hit.h"
#include "ods/render/cpu/tree_plan.h"
#include "ods/scene/placement.h"

// The differences between Embree 3 and 4.
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

static void intersect16(const int* valid, RTCScene scene, EmbreeContext& context, bool coherent, RTCRayHit16& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  if (coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

static void occlude16(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay16& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded16(valid, scene, &rays, &arguments);
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

static void intersect16(const int* valid, RTCScene scene, EmbreeContext& context, bool coherent, RTCRayHit16& rays) {
  if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
}

static void occlude16(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay16& rays) {
  rtcOccluded16(valid, scene, &context, &rays);
}
#endif

namespace ods {

namespace {

struct RayContext {
  EmbreeContext embree;
  PathTracer* tracer;
  const TreePlan* plan;
  int ray;
  uint index;       // index of the first ray's sample
  int clear;        // number of surfaces of clear glass that a shadow ray met
  ExactRays exact;  // if the scene is portable
};

}  // namespace

// A geometry's number in its scene is the index of our instance. If something moves, all static instances together are
// one additional instance in the top scene, TreePlan::still_id.
struct EmbreeScene::Handles {
  const Scene* scene = nullptr;
  TreePlan plan;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  RTCScene still = nullptr;      // null if nothing moves
  bool portable = false;         // Scene::portable: ods/render/cpu/exact_hit.h decides what a ray meets
  bool coherent = true;          // trace packets of rays as one; with instances, Embree 3.13 may never return
  std::vector<RTCScene> shared;  // by mesh; null if the mesh is copied

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (top) rtcReleaseScene(top);
    if (still) rtcReleaseScene(still);
    for (RTCScene mesh : shared) {
      if (mesh) rtcReleaseScene(mesh);
    }
    if (device) rtcReleaseDevice(device);
  }
};

static int instance_of(uint geometry, uint instance, uint still) {
  return static_cast<int>(instance == RTC_INVALID_GEOMETRY_ID || instance == still ? geometry : instance);
}

// Returns whether a candidate is the back of a face that the file contains a second time, for this side. Embree's
// normal, and the ray, are in the space of the tree's triangles.
static bool is_hidden_back(const RTCFilterFunctionNArguments* arguments, uint i, const RayContext& context,
                           const Hit& hit, bool is_copy) {
  const Instance& instance = context.tracer->scene_instance(hit.instance);
  const std::vector<char>& doubled = context.plan->doubled[static_cast<size_t>(instance.mesh)];
  if (doubled.empty() || doubled[static_cast<size_t>(hit.triangle)] == 0) return false;
  const uint count = arguments->N;
  const vec3 normal(RTCHitN_Ng_x(arguments->hit, count, i), RTCHitN_Ng_y(arguments->hit, count, i),
                    RTCHitN_Ng_z(arguments->hit, count, i));
  const vec3 way(RTCRayN_dir_x(arguments->ray, count, i), RTCRayN_dir_y(arguments->ray, count, i),
                 RTCRayN_dir_z(arguments->ray, count, i));
  return dot(normal, way) * (is_copy ? handedness_of(instance) : 1.0f) > 0.0f;
}

// Embree calls this for the candidate hits of one or several rays on surfaces with alpha, on surfaces that are
// invisible to some rays, on doubled faces, and, for shadow rays, on surfaces that may be clear glass; on all surfaces
// if the scene is portable.
template <bool kShadow>
static void filter(const RTCFilterFunctionNArguments* arguments) {
  auto* context = reinterpret_cast<RayContext*>(arguments->context);
  const uint count = arguments->N;
  for (uint i = 0; i < count; i++) {
    if (arguments->valid[i] != -1) continue;
    const uint geometry = RTCHitN_geomID(arguments->hit, count, i);
    const uint instance = RTCHitN_instID(arguments->hit, count, i, 0);
    Hit hit;
    hit.t = 0.0f;
    hit.u = RTCHitN_u(arguments->hit, count, i);
    hit.v = RTCHitN_v(arguments->hit, count, i);
    hit.instance = instance_of(geometry, instance, context->plan->still_id);
    hit.triangle = static_cast<int>(RTCHitN_primID(arguments->hit, count, i));
    const uint id = RTCRayN_id(arguments->ray, count, i);
    context->tracer->path.index = context->index + id;
    const bool is_copy = instance == RTC_INVALID_GEOMETRY_ID || instance == context->plan->still_id;
    if (is_hidden_back(arguments, i, *context, hit, is_copy)) {
      arguments->valid[i] = 0;
      continue;
    }
    const bool is_portable = context->exact.rays != nullptr;
    const double t = is_portable ? context->exact.distance(*context->tracer, id, hit) : 0.0;
    if (t < 0.0) {
      arguments->valid[i] = 0;
    } else if (context->tracer->is_absent(context->ray, hit.instance) ||
               context->tracer->passes(hit, context->tracer->alpha_draw(context->ray, hit))) {
      arguments->valid[i] = 0;
    } else if (kShadow && context->ray == kShadowRay && context->tracer->is_clear(hit, true)) {
      arguments->valid[i] = 0;
      context->clear++;
    } else if (!kShadow && is_portable) {
      context->exact.keep(id, t, hit);
      RTCRayN_tfar(arguments->ray, count, i) =
          static_cast<float>(t) * kCandidates;  // Embree asks for those up to there
    }
  }
}

static uint key_count(const Scene& scene, int motion) {
  return motion < 0 ? 1u : static_cast<uint>(scene.motion_keys);
}

// Writes a mesh's vertices at a key of the shutter. placed: the instance whose matrix transforms them, or null.
static void write_positions(const Scene& scene, const Mesh& mesh, uint key, const Instance* placed, float* positions) {
  const Vertex* vertices = scene.vertices.data() + mesh.first_vertex;
  const MotionVertex* bent = nullptr;
  if (mesh.motion >= 0) bent = scene.motion_vertices.data() + mesh.motion + size_t(key) * mesh.vertex_count;
  for (uint i = 0; i < mesh.vertex_count; i++) {
    vec3 p = bent ? bent[i].position : vertices[i].position;
    if (placed) p = to_world(*placed, p);
    positions[3 * i] = p.x, positions[3 * i + 1] = p.y, positions[3 * i + 2] = p.z;
  }
}

namespace {
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
}  // namespace

using Geometry = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

static Geometry new_geometry(RTCDevice device, RTCGeometryType type) {
  Geometry geometry(rtcNewGeometry(device, type));
  if (!geometry) throw std::bad_alloc();
  return geometry;
}

// Makes an Embree geometry of a mesh's triangles. placed: the instance whose matrix transforms copies of the vertices,
// or null. chosen: some rays do not meet all of its triangles.
static Geometry make_geometry(RTCDevice device, const Scene& scene, const Mesh& mesh, const Instance* placed,
                              bool chosen) {
  Geometry owner = new_geometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  RTCGeometry geometry = owner.get();
  const uint keys = key_count(scene, mesh.motion);
  rtcSetGeometryTimeStepCount(geometry, keys);
  for (uint key = 0; key < keys; key++) {
    auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, key, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertex_count));
    if (!positions) throw std::bad_alloc();
    write_positions(scene, mesh, key, placed, positions);
  }
  auto* corners = static_cast<uint*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                             3 * sizeof(uint), mesh.triangle_count));
  if (!corners) throw std::bad_alloc();
  const uvec3* triangles = scene.triangles.data() + mesh.first_triangle;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    corners[3 * i] = triangles[i].x, corners[3 * i + 1] = triangles[i].y, corners[3 * i + 2] = triangles[i].z;
  }
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const bool may_pass = material.alpha_mode != kAlphaOpaque || chosen;
  if (may_pass || scene.portable) rtcSetGeometryIntersectFilterFunction(geometry, filter<false>);
  if (may_pass || scene.portable || material.transmission > 0.0f) {
    rtcSetGeometryOccludedFilterFunction(geometry, filter<true>);
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitGeometry(geometry);
  return owner;
}

static RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  // Without the robust flag a few rays in a million slip between adjacent triangles.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  return scene;
}

static void set_transform(RTCGeometry geometry, const Scene& scene, const Instance& instance) {
  const uint keys = key_count(scene, instance.motion);
  rtcSetGeometryTimeStepCount(geometry, keys);
  for (uint key = 0; key < keys; key++) {
    MotionPose pose{instance.row0, instance.row1, instance.row2};
    if (instance.motion >= 0) pose = scene.motion_poses[static_cast<size_t>(instance.motion) + key];
    const vec4 rows[3] = {pose.row0, pose.row1, pose.row2};
    float matrix[12];
    for (int row = 0; row < 3; row++) {
      for (int column = 0; column < 4; column++) matrix[row * 4 + column] = rows[row][column];
    }
    rtcSetGeometryTransform(geometry, key, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, matrix);
  }
}

static Geometry make_instance(RTCDevice device, RTCScene mesh, const Scene& scene, const Instance& instance) {
  Geometry geometry = new_geometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry.get(), mesh);
  set_transform(geometry.get(), scene, instance);
  rtcCommitGeometry(geometry.get());
  return geometry;
}

static void attach(RTCScene scene, const Geometry& geometry, size_t id) {
  rtcAttachGeometryByID(scene, geometry.get(), static_cast<uint>(id));
}

EmbreeScene::EmbreeScene(const Scene& scene, size_t max_copied_triangles, const std::vector<char>& left_out)
    : handles_(std::make_unique<Handles>()) {
  handles_->scene = &scene;
  handles_->portable = scene.portable;
  // The instruction set that every x86-64 processor has; other processors have only one.
  handles_->device = rtcNewDevice(scene.portable ? "isa=sse2" : nullptr);
  if (!handles_->device) throw std::bad_alloc();
  RTCDevice device = handles_->device;
  handles_->top = new_scene(device);
  handles_->shared.resize(scene.meshes.size());
  handles_->plan = plan_trees(scene, max_copied_triangles);
  const TreePlan& plan = handles_->plan;
  const bool split = std::count(plan.moves.begin(), plan.moves.end(), 1) > 0;
  if (split) handles_->still = new_scene(device);
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Instance& instance = scene.instances[i];
    const size_t mesh = static_cast<size_t>(instance.mesh);
    const bool hidden = is_hidden(scene, i);
    if (hidden && !plan.moves[i]) continue;
    if (!left_out.empty() && left_out[i] != 0) continue;
    if (!plan.shared[mesh]) {
      const bool chosen = has_absences(instance) || plan.is_doubled(mesh);
      attach(split ? handles_->still : handles_->top,
             make_geometry(device, scene, scene.meshes[mesh], &instance, chosen), i);
      continue;
    }
    if (!handles_->shared[mesh]) {
      handles_->shared[mesh] = new_scene(device);
      const bool chosen = plan.absent[mesh] != 0 || plan.is_doubled(mesh);
      attach(handles_->shared[mesh], make_geometry(device, scene, scene.meshes[mesh], nullptr, chosen), 0);
      rtcCommitScene(handles_->shared[mesh]);
    }
    handles_->coherent = false;
    const Geometry geometry = make_instance(device, handles_->shared[mesh], scene, instance);
    if (hidden) rtcDisableGeometry(geometry.get());
    attach(handles_->top, geometry, i);
  }
  if (split) {
    handles_->coherent = false;
    rtcCommitScene(handles_->still);
    Instance here{};
    here.motion = -1;
    set_matrix(here, glm::dmat4(1.0));
    attach(handles_->top, make_instance(device, handles_->still, scene, here), plan.still_id);
  }
  rtcCommitScene(handles_->top);
  if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

EmbreeScene::~EmbreeScene() = default;

void EmbreeScene::update(const SceneChange& change) {
  const Scene& scene = *handles_->scene;
  if (change.instances.empty() && change.meshes.empty()) return;
  for (const int mesh : change.meshes) {
    RTCScene tree = handles_->shared[static_cast<size_t>(mesh)];
    if (!tree) continue;  // no instance uses it
    RTCGeometry triangles = rtcGetGeometry(tree, 0);
    const Mesh& record = scene.meshes[static_cast<size_t>(mesh)];
    for (uint key = 0; key < key_count(scene, record.motion); key++) {
      auto* positions = static_cast<float*>(rtcGetGeometryBufferData(triangles, RTC_BUFFER_TYPE_VERTEX, key));
      write_positions(scene, record, key, nullptr, positions);
      rtcUpdateGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, key);
    }
    rtcCommitGeometry(triangles);
    rtcCommitScene(tree);
  }
  for (size_t i = 0; i < handles_->plan.moves.size(); i++) {
    if (!handles_->plan.moves[i]) continue;
    RTCGeometry geometry = rtcGetGeometry(handles_->top, static_cast<uint>(i));
    set_transform(geometry, scene, scene.instances[i]);
    is_hidden(scene, i) ? rtcDisableGeometry(geometry) : rtcEnableGeometry(geometry);
    rtcCommitGeometry(geometry);
  }
  rtcCommitScene(handles_->top);
  if (rtcGetDeviceError(handles_->device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

static void set_ray(RTCRay& out, const Ray& ray, float length, float time) {
  out.org_x = ray.origin.x, out.org_y = ray.origin.y, out.org_z = ray.origin.z;
  out.dir_x = ray.direction.x, out.dir_y = ray.direction.y, out.dir_z = ray.direction.z;
  out.tnear = 0.0f, out.tfar = length;
  out.time = time, out.mask = ~0u, out.id = 0, out.flags = 0;
}

static RayContext make_context(PathTracer& tracer, int ray, const TreePlan& plan) {
  RayContext context;
  init_context(context.embree);
  context.tracer = &tracer;
  context.plan = &plan;
  context.ray = ray;
  context.index = tracer.path.index;
  context.clear = 0;
  context.exact = {};
  return context;
}

Hit EmbreeScene::closest_hit(PathTracer& tracer, const Ray& ray, int kind) const {
  RTCRayHit found;
  set_ray(found.ray, ray, std::numeric_limits<float>::infinity(), tracer.ray_time);
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RayContext context = make_context(tracer, kind, handles_->plan);
  NearestHit nearest;
  if (handles_->portable) context.exact = {&ray, &tracer.ray_time, nullptr, &nearest};
  intersect(handles_->top, context.embree, found);
  if (handles_->portable) return nearest.hit;
  Hit hit;
  const bool missed = found.hit.geomID == RTC_INVALID_GEOMETRY_ID;
  hit.t = missed ? -1.0f : found.ray.tfar;
  hit.u = missed ? 0.0f : found.hit.u;
  hit.v = missed ? 0.0f : found.hit.v;
  hit.instance = missed ? -1 : instance_of(found.hit.geomID, found.hit.instID[0], handles_->plan.still_id);
  hit.triangle = missed ? -1 : static_cast<int>(found.hit.primID);
  return hit;
}

bool EmbreeScene::occluded(PathTracer& tracer, const Ray& ray, float length, int kind, int* clear) const {
  RTCRay shadow;
  set_ray(shadow, ray, handles_->portable ? length * kCandidates : length, tracer.ray_time);
  RayContext context = make_context(tracer, kind, handles_->plan);
  if (handles_->portable) context.exact = {&ray, &tracer.ray_time, &length};
  occlude(handles_->top, context.embree, shadow);
  if (clear) *clear = context.clear;
  return shadow.tfar < 0.0f;
}

bool EmbreeScene::reaches_light(PathTracer& tracer) const {
  const PathState& path = tracer.path;
  int clear = 0;
  if (occluded(tracer, path.shadow_ray, path.shadow_length, kShadowRay, &clear)) return false;
  for (; clear > 0; clear--) {
    const Hit hit = closest_hit(tracer, path.shadow_ray, kShadowRay);
    if (hit.t < 0.0f || hit.t >= path.shadow_length) break;
    tracer.pass_shadow(hit);
  }
  return true;
}

// Embree without AVX-512 also checks the rays of unused lanes, so they are copies of the first ray.
static void set_rays(RTCRay16& out, const RayPacket& packet) {
  for (int i = 0; i < RayPacket::kMax; i++) {
    const int from = i < packet.count ? i : 0;
    const Ray& ray = packet.rays[from];
    out.org_x[i] = ray.origin.x, out.org_y[i] = ray.origin.y, out.org_z[i] = ray.origin.z;
    out.dir_x[i] = ray.direction.x, out.dir_y[i] = ray.direction.y, out.dir_z[i] = ray.direction.z;
    out.tnear[i] = 0.0f, out.tfar[i] = packet.lengths[from];
    out.time[i] = packet.times[from], out.mask[i] = ~0u, out.id[i] = static_cast<uint>(i), out.flags[i] = 0;
  }
}

// Decides the alpha of surfaces as for the paths that begin with these rays.
static RayContext packet_context(PathTracer& tracer, const RayPacket& packet, const TreePlan& plan) {
  tracer.start_path(packet.rays[0], no_media(), packet.seed, packet.index);
  return make_context(tracer, kPathRay, plan);
}

static void start_ray(PathTracer& tracer, const RayPacket& packet, int i) {
  tracer.ray_time = packet.times[i];
  tracer.start_path(packet.rays[i], no_media(), packet.seed, packet.index + static_cast<uint>(i));
}

// A few rays are faster one by one. For the tracer they remain rays of a packet.
static bool is_small(const RayPacket& packet) {
  return packet.count <= 4;
}

void EmbreeScene::closest_hits(PathTracer& tracer, const RayPacket& packet, Hit* hits) const {
  if (is_small(packet)) {
    for (int i = 0; i < packet.count; i++) {
      start_ray(tracer, packet, i);
      hits[i] = closest_hit(tracer, packet.rays[i], kPathRay);
    }
    return;
  }
  RTCRayHit16 found;
  alignas(64) int valid[RayPacket::kMax] = {};
  set_rays(found.ray, packet);
  std::fill_n(found.ray.tfar, RayPacket::kMax, std::numeric_limits<float>::infinity());
  for (int i = 0; i < packet.count; i++) {
    valid[i] = -1;
    found.hit.geomID[i] = found.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RayContext context = packet_context(tracer, packet, handles_->plan);
  NearestHit nearest[RayPacket::kMax];
  if (handles_->portable) context.exact = {packet.rays, packet.times, nullptr, nearest};
  intersect16(valid, handles_->top, context.embree, handles_->coherent, found);
  for (int i = 0; i < packet.count; i++) {
    const bool missed = found.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID;
    hits[i].t = missed ? -1.0f : found.ray.tfar[i];
    hits[i].u = missed ? 0.0f : found.hit.u[i];
    hits[i].v = missed ? 0.0f : found.hit.v[i];
    hits[i].instance = missed ? -1 : instance_of(found.hit.geomID[i], found.hit.instID[0][i], handles_->plan.still_id);
    hits[i].triangle = missed ? -1 : static_cast<int>(found.hit.primID[i]);
    if (handles_->portable) hits[i] = nearest[i].hit;
  }
}

void EmbreeScene::occluded(PathTracer& tracer, const RayPacket& packet, bool* hidden) const {
  if (is_small(packet)) {
    for (int i = 0; i < packet.count; i++) {
      start_ray(tracer, packet, i);
      hidden[i] = packet.lengths[i] <= 0.0f || occluded(tracer, packet.rays[i], packet.lengths[i], kPathRay);
    }
    return;
  }
  RTCRay16 shadows;
  alignas(64) int valid[RayPacket::kMax] = {};
  set_rays(shadows, packet);
  for (int i = 0; i < packet.count; i++) valid[i] = packet.lengths[i] > 0.0f ? -1 : 0;
  RayContext context = packet_context(tracer, packet, handles_->plan);
  if (handles_->portable) {
    context.exact = {packet.rays, packet.times, packet.lengths};
    for (float& farthest : shadows.tfar) farthest *= kCandidates;
  }
  occlude16(valid, handles_->top, context.embree, shadows);
  for (int i = 0; i < packet.count; i++) hidden[i] = valid[i] == 0 || shadows.tfar[i] < 0.0f;
}

}  // namespace ods
