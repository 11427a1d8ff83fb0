#include "benchmarks/bare_embree.h"

#include <embree3/rtcore.h>

#include <limits>
#include <stdexcept>

namespace grimaldi {

struct BareEmbree::Device {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Vec3 centre;
  ~Device() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

BareEmbree::BareEmbree(const Scene& scene) : device_(std::make_unique<Device>()) {
  device_->centre = 0.5 * (scene.low + scene.high);
  device_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (!device_->device) throw std::runtime_error("Embree gives no device");
  device_->scene = rtcNewScene(device_->device);
  rtcSetSceneFlags(device_->scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(device_->scene, RTC_BUILD_QUALITY_MEDIUM);
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
  rtcCommitScene(device_->scene);
  if (rtcGetDeviceError(device_->device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree could not build the scene");
}

BareEmbree::~BareEmbree() = default;

BareSegment BareEmbree::segment(const Vec3& origin, const Vec3& direction, double near) const {
  BareSegment segment;
  for (int axis = 0; axis < 3; ++axis) {
    segment.origin[axis] = static_cast<float>(origin[axis] - device_->centre[axis]);
    segment.direction[axis] = static_cast<float>(direction[axis]);
  }
  segment.near = static_cast<float>(near);
  return segment;
}

std::size_t BareEmbree::intersect(std::span<const BareSegment> segments) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::size_t hits = 0;
  for (const BareSegment& segment : segments) {
    RTCRayHit query;
    query.ray.org_x = segment.origin[0];
    query.ray.org_y = segment.origin[1];
    query.ray.org_z = segment.origin[2];
    query.ray.dir_x = segment.direction[0];
    query.ray.dir_y = segment.direction[1];
    query.ray.dir_z = segment.direction[2];
    query.ray.tnear = segment.near;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.time = 0;
    query.ray.mask = ~0u;
    query.ray.id = 0;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(device_->scene, &context, &query);
    hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  return hits;
}

}  // namespace grimaldi
