// Finds the surfaces and marks that a ray hits in a scene. Built once per scene and view; any number of
// threads may use it.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "render/camera.h"
#include "render/corner_normals.h"
#include "render/scene.h"

namespace octoblisk::demos {

class RayCaster {
 public:
  /// Keeps a reference to the scene, which must outlive it. The widths of the marks are fitted to the view;
  /// `pixels_per_point` is the scale of those widths. Throws std::runtime_error if the ray tracing library
  /// fails.
  RayCaster(const Scene& scene, const View& view, float pixels_per_point);

  struct SolidHit {
    float distance = 0.0f;              ///< along the ray (mesh units)
    Vec3f position = Vec3f::Zero();     ///< local to the view
    Vec3f normal = Vec3f::Zero();       ///< unit, smooth, facing the ray's origin
    Vec3f flat_normal = Vec3f::Zero();  ///< the triangle's own, also facing the ray's origin
    std::int32_t solid = 0;             ///< index into Scene::solids()
    Color color;
    float opacity = 1.0f;
  };
  /// The nearest surface along the ray beyond `from`.
  std::optional<SolidHit> nearestSolid(const Ray& ray, float from) const;

  struct MarkHit {
    float distance = 0.0f;         ///< along the ray (mesh units)
    Vec3f normal = Vec3f::Zero();  ///< unit
    std::int32_t mark = 0;         ///< index into Scene::marks()
    std::int32_t point = 0;        ///< index of its point; 0 for lines
  };
  std::optional<MarkHit> nearestMark(const Ray& ray) const;

  /// Whether an opaque surface lies on the ray within `reach` (mesh units).
  bool isBlocked(const Ray& ray, float reach) const;

  /// A distance (mesh units) greater than rounding errors: rays start this far off the surface that they
  /// leave.
  float roundingDistance() const { return rounding_distance_; }

 private:
  template <auto release>
  struct Releaser {
    template <class Handle>
    void operator()(Handle* handle) const {
      release(handle);
    }
  };
  using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>>;
  using Tree = std::unique_ptr<std::remove_pointer_t<RTCScene>, Releaser<rtcReleaseScene>>;
  using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Releaser<rtcReleaseGeometry>>;

  Geometry solidGeometry(const Scene::Solid& solid, const View& view) const;
  Geometry lineGeometry(const Scene::Marks& marks, const View& view, float pixels_per_point) const;
  Geometry pointGeometry(const Scene::Marks& marks, const View& view, float pixels_per_point) const;
  void attach(RTCScene tree, Geometry geometry, unsigned index) const;
  void throwOnError() const;

  const Scene& scene_;
  std::vector<std::vector<CornerNormals>> normals_;  ///< per solid
  float rounding_distance_;
  Device device_;
  Tree solids_;
  Tree marks_;
};

}  // namespace octoblisk::demos
