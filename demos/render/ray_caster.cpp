#include "render/ray_caster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace octoblisk::demos {
namespace {

constexpr double kCreaseAngle = 0.6;  // radians, about 34°
constexpr unsigned kOpaqueMask = 1;
constexpr unsigned kTransparentMask = 2;

/// Embree's vertex of a round curve: a sphere.
struct Ball {
  float x, y, z, radius;
};

Ball ball(const Vec3f& center, float radius) { return {center.x(), center.y(), center.z(), radius}; }

/// Two balls for each round cone between them: one cone per line, two (shaft and head) per arrow.
std::vector<Ball> lineBalls(const Scene::Marks& marks, const View& view, float width_in_pixels) {
  constexpr float kHeadRadius = 3.0f;   // in radii of the shaft
  constexpr float kHeadLength = 10.0f;  // in radii of the shaft, at most
  constexpr float kHeadShare = 0.6f;    // of the arrow
  std::vector<Ball> balls;
  for (std::size_t index = 0; index + 1 < marks.points.size(); index += 2) {
    const Vec3f from = view.local(marks.points[index]);
    const Vec3f to = view.local(marks.points[index + 1]);
    const float from_radius = 0.5f * width_in_pixels * view.pixelSizeAt(from);
    const float to_radius = 0.5f * width_in_pixels * view.pixelSizeAt(to);
    if (marks.kind != Scene::MarkKind::arrows) {
      balls.insert(balls.end(), {ball(from, from_radius), ball(to, to_radius)});
      continue;
    }
    const float length = (to - from).norm();
    const float head_length = std::min(kHeadLength * to_radius, kHeadShare * length);
    const Vec3f neck = to + head_length * (from - to).normalized();
    balls.insert(balls.end(), {ball(from, from_radius), ball(neck, to_radius),
                               ball(neck, kHeadRadius * to_radius), ball(to, 0.0f)});
  }
  return balls;
}

RTCRay embreeRay(const Ray& ray, float from, float to, unsigned mask) {
  RTCRay result{};
  result.org_x = ray.origin.x();
  result.org_y = ray.origin.y();
  result.org_z = ray.origin.z();
  result.dir_x = ray.direction.x();
  result.dir_y = ray.direction.y();
  result.dir_z = ray.direction.z();
  result.tnear = from;
  result.tfar = to;
  result.mask = mask;
  return result;
}

bool intersect(RTCScene tree, RTCRayHit& query) {
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(tree, &context, &query);
  return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

float roundingDistanceOf(const Scene& scene, const View& view) {
  const double pixel_share = 1e-3 * view.pixelSize();
  if (scene.solids().empty()) return static_cast<float>(pixel_share);
  return static_cast<float>(std::max(pixel_share, 1e-5 * scene.bounds().halfExtents().norm()));
}

template <class Item>
Item* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<Item*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), count));
}

}  // namespace

RayCaster::RayCaster(const Scene& scene, const View& view, float pixels_per_point)
    : scene_(scene),
      rounding_distance_(roundingDistanceOf(scene, view)),
      // One thread, so that the tree, and with it every tie between triangles, is always the same.
      device_(rtcNewDevice("threads=1,set_affinity=0")) {
  if (!device_) throw std::runtime_error("Embree could not be started; give --no-pictures or --no-picture");
  solids_.reset(rtcNewScene(device_.get()));
  marks_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(solids_.get(), RTC_SCENE_FLAG_ROBUST);
  throwOnError();

  for (unsigned index = 0; index < scene.solids().size(); ++index) {
    const Scene::Solid& solid = scene.solids()[index];
    attach(solids_.get(), solidGeometry(solid, view), index);
    normals_.push_back(cornerNormals(solid.vertices, solid.triangles, kCreaseAngle));
  }
  rtcCommitScene(solids_.get());

  for (unsigned index = 0; index < scene.marks().size(); ++index) {
    const Scene::Marks& marks = scene.marks()[index];
    attach(marks_.get(),
           marks.kind == Scene::MarkKind::points ? pointGeometry(marks, view, pixels_per_point)
                                                 : lineGeometry(marks, view, pixels_per_point),
           index);
  }
  rtcCommitScene(marks_.get());
  throwOnError();
}

RayCaster::Geometry RayCaster::solidGeometry(const Scene::Solid& solid, const View& view) const {
  struct Position {
    float x, y, z;
  };
  Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* position =
      newBuffer<Position>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, solid.vertices.size());
  auto* corners = newBuffer<TriangleMesh::Indices>(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                   solid.triangles.size());
  throwOnError();
  for (const Vec3& vertex : solid.vertices) {
    const Vec3f local = view.local(vertex);
    *position++ = {local.x(), local.y(), local.z()};
  }
  std::copy(solid.triangles.begin(), solid.triangles.end(), corners);
  rtcSetGeometryMask(geometry.get(), solid.opacity < 1.0f ? kTransparentMask : kOpaqueMask);
  return geometry;
}

RayCaster::Geometry RayCaster::lineGeometry(const Scene::Marks& marks, const View& view,
                                            float pixels_per_point) const {
  const std::vector<Ball> balls = lineBalls(marks, view, pixels_per_point * marks.style.width);
  Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE));
  auto* vertex = newBuffer<Ball>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, balls.size());
  auto* first =
      newBuffer<std::uint32_t>(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, balls.size() / 2);
  throwOnError();
  std::copy(balls.begin(), balls.end(), vertex);
  for (std::uint32_t index = 0; index < balls.size() / 2; ++index) first[index] = 2 * index;
  return geometry;
}

RayCaster::Geometry RayCaster::pointGeometry(const Scene::Marks& marks, const View& view,
                                             float pixels_per_point) const {
  Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT));
  auto* vertex =
      newBuffer<Ball>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, marks.points.size());
  throwOnError();
  for (const Vec3& point : marks.points) {
    const Vec3f center = view.local(point);
    *vertex++ = ball(center, 0.5f * pixels_per_point * marks.style.width * view.pixelSizeAt(center));
  }
  return geometry;
}

void RayCaster::attach(RTCScene tree, Geometry geometry, unsigned index) const {
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(tree, geometry.get(), index);
  throwOnError();
}

void RayCaster::throwOnError() const {
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree failed with error " + std::to_string(error));
  }
}

std::optional<RayCaster::SolidHit> RayCaster::nearestSolid(const Ray& ray, float from) const {
  RTCRayHit query{};
  query.ray = embreeRay(ray, from, std::numeric_limits<float>::infinity(), kOpaqueMask | kTransparentMask);
  if (!intersect(solids_.get(), query)) return std::nullopt;

  const RTCHit& hit = query.hit;
  const Scene::Solid& solid = scene_.solids()[hit.geomID];
  const CornerNormals& corners = normals_[hit.geomID][hit.primID];
  SolidHit result;
  result.distance = query.ray.tfar;
  result.position = ray.origin + query.ray.tfar * ray.direction;
  result.flat_normal = Vec3f(hit.Ng_x, hit.Ng_y, hit.Ng_z).normalized();
  result.normal =
      ((1.0f - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2]).normalized();
  if (result.flat_normal.dot(result.normal) < 0.0f) result.normal = -result.normal;
  if (result.flat_normal.dot(ray.direction) > 0.0f) {
    result.flat_normal = -result.flat_normal;
    result.normal = -result.normal;
  }
  result.solid = static_cast<std::int32_t>(hit.geomID);
  result.color = solid.colors.size() == 1 ? solid.colors.front() : solid.colors[hit.primID];
  result.opacity = solid.opacity;
  return result;
}

std::optional<RayCaster::MarkHit> RayCaster::nearestMark(const Ray& ray) const {
  if (scene_.marks().empty()) return std::nullopt;
  RTCRayHit query{};
  query.ray = embreeRay(ray, 0.0f, std::numeric_limits<float>::infinity(), ~0u);
  if (!intersect(marks_.get(), query)) return std::nullopt;
  const Scene::Marks& marks = scene_.marks()[query.hit.geomID];
  return MarkHit{query.ray.tfar, Vec3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized(),
                 static_cast<std::int32_t>(query.hit.geomID),
                 marks.kind == Scene::MarkKind::points ? static_cast<std::int32_t>(query.hit.primID) : 0};
}

bool RayCaster::isBlocked(const Ray& ray, float reach) const {
  RTCRay query = embreeRay(ray, 0.0f, reach, kOpaqueMask);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(solids_.get(), &context, &query);
  return query.tfar < 0.0f;
}

}  // namespace octoblisk::demos
