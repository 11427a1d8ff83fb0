#include "propagation/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "propagation/edge_visibility.h"

namespace grimaldi {

struct Tracer::Device {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Vec3 centre;  ///< subtracted before coordinates are rounded to single precision
  ~Device() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  RTCRayHit ray(const Vec3& origin, const Vec3& direction, double near, double far) const {
    RTCRayHit query;
    query.ray.org_x = static_cast<float>(origin.x - centre.x);
    query.ray.org_y = static_cast<float>(origin.y - centre.y);
    query.ray.org_z = static_cast<float>(origin.z - centre.z);
    query.ray.dir_x = static_cast<float>(direction.x);
    query.ray.dir_y = static_cast<float>(direction.y);
    query.ray.dir_z = static_cast<float>(direction.z);
    query.ray.tnear = static_cast<float>(near);
    query.ray.tfar = static_cast<float>(far);
    query.ray.time = 0;
    query.ray.mask = ~0u;
    query.ray.id = 0;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
  }
};

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Context of a query that counts every surface along a ray.
struct CountingContext {
  RTCIntersectContext base;
  const Scene* scene;
  std::size_t surfaces = 0;
};

/// Counts the hit and rejects it, so that the traversal goes on to the end of the ray.
void count_surface(const RTCFilterFunctionNArguments* arguments) {
  auto* context = reinterpret_cast<CountingContext*>(arguments->context);
  const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
  if (!context->scene->triangle_is_ground[triangle]) ++context->surfaces;
  arguments->valid[0] = 0;
}

}  // namespace

Tracer::Tracer(const Scene& scene) : device_(std::make_unique<Device>()), scene_(&scene) {
  device_->centre = 0.5 * (scene.low + scene.high);
  const double half_diagonal = std::max(0.5 * distance(scene.low, scene.high), 1e-3);
  surface_gap_ = std::max(16 * half_diagonal * std::numeric_limits<float>::epsilon() / 2, 1e-4);
  // One thread: building is a fraction of the loading time, and Embree then leaves no workers behind.
  device_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (!device_->device) throw std::runtime_error("Embree gives no device");
  device_->scene = rtcNewScene(device_->device);
  rtcSetSceneFlags(device_->scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(device_->scene, RTC_BUILD_QUALITY_MEDIUM);
  if (!scene.triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), scene.vertices.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), scene.triangles.size()));
    if (!vertices || !indices) throw std::bad_alloc();
    for (std::size_t i = 0; i < scene.vertices.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        vertices[3 * i + axis] = static_cast<float>(scene.vertices[i][axis] - device_->centre[axis]);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
      for (int corner = 0; corner < 3; ++corner) indices[3 * i + corner] = scene.triangles[i][corner];
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(device_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(device_->scene);
  if (rtcGetDeviceError(device_->device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree could not build the scene");
}

Tracer::~Tracer() = default;

const EdgeVisibility& Tracer::edges() const {
  std::call_once(edges_asked_, [this] { edges_ = std::make_unique<EdgeVisibility>(*scene_, *this); });
  return *edges_;
}

Hit Tracer::nearest(const Vec3& origin, const Vec3& direction, std::uint32_t leave0, std::uint32_t leave1) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const auto& patches = scene_->patches;
  // Embree starts a little off the face that is left, on the side where the ray goes: else it hits that face first
  // nearly always and is asked twice.
  Vec3 start = origin;
  if (leave0 != no_index && leave1 == no_index) {
    const Vec3& normal = patches.patches[leave0].normal;
    start += std::copysign(0.5 * surface_gap_, dot(normal, direction)) * normal;
  }
  float near = 0;
  for (;;) {
    RTCRayHit query = device_->ray(start, direction, near, infinite);
    rtcIntersect1(device_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const std::uint32_t patch_index = patches.triangle_patch[query.hit.primID];
    const Patch& patch = patches.patches[patch_index];
    bool own = patch_index == leave0 || patch_index == leave1;
    if (!own && query.ray.tfar < surface_gap_) {
      // Another surface laid upon the face that the ray leaves.
      for (const std::uint32_t left : {leave0, leave1})
        if (left != no_index && std::abs(dot(patches.patches[left].normal, patch.normal)) > 1 - 1e-5) own = true;
    }
    if (!own) {
      Hit hit{query.hit.primID, query.ray.tfar};
      const double cosine = dot(patch.normal, direction);
      // The plane gives the distance in double; at grazing incidence single precision knows it better.
      if (std::abs(cosine) > 1e-3) {
        const double exact = (patch.offset - dot(patch.normal, origin)) / cosine;
        if (std::abs(exact - hit.distance) < 4 * surface_gap_ / std::abs(cosine)) hit.distance = exact;
      }
      return hit;
    }
    near = std::nextafter(std::max(query.ray.tfar, near), std::numeric_limits<float>::infinity());
  }
}

bool Tracer::visible(const Vec3& a, const Vec3& b) const {
  const Vec3 way = b - a;
  const double length = norm(way);
  if (length <= 2 * surface_gap_) return true;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = device_->ray(a, way / length, surface_gap_, length - surface_gap_);
  rtcOccluded1(device_->scene, &context, &query.ray);
  return query.ray.tfar >= 0;
}

bool Tracer::inside_solid(const Vec3& point) const {
  CountingContext context;
  rtcInitIntersectContext(&context.base);
  context.base.filter = count_surface;
  context.scene = scene_;
  // A ray through the common edge of two triangles would count both: step aside by an amount that no mesh shares.
  const Vec3 aside = point + surface_gap_ * Vec3{0.5377, 0.3119, 0};
  RTCRayHit query = device_->ray(aside, {0, 0, 1}, 0, infinite);
  rtcIntersect1(device_->scene, &context.base, &query);
  return context.surfaces % 2 == 1;
}

}  // namespace grimaldi
