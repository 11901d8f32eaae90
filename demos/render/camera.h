// The camera of a picture, and the rays through its pixels.
#pragma once

#include <span>

#include "octoblisk/types.h"

namespace octoblisk::demos {

using Vec3f = Eigen::Vector3f;

enum class Projection { orthographic, perspective };

/// A camera that looks at a target. It does not depend on the picture's shape: whatever the shape, a
/// rectangle of `view_width` × `view_height` around the target is fully visible.
struct Camera {
  Vec3 target = Vec3::Zero();
  Vec3 direction = -Vec3::UnitZ();  ///< the direction of view; any length but zero
  Vec3 up = Vec3::UnitY();          ///< up in the picture; need not be perpendicular to the direction
  double view_width = 1.0;          ///< at the target (mesh units), > 0
  double view_height = 1.0;         ///< at the target (mesh units), > 0
  Projection projection = Projection::orthographic;  ///< orthographic: the scale bar holds at any depth
  double field_of_view = 0.45;                       ///< vertical, radians, in (0, π); perspective only
};

/// A camera that looks along `direction` and sees all points, with `margin` times the space that they need.
/// Without points it has the default view in that direction.
Camera frame(std::span<const Vec3> points, const Vec3& direction, const Vec3& up,
             Projection projection = Projection::orthographic, double margin = 1.06);

/// The same for the corners of a box.
Camera frame(const Aabb& box, const Vec3& direction, const Vec3& up,
             Projection projection = Projection::orthographic, double margin = 1.06);

/// A half-line. Points are relative to the camera's target, so that single precision is accurate near it.
struct Ray {
  Vec3f origin;
  Vec3f direction;  ///< of unit length
};

/// A camera in front of a grid of pixels.
class View {
 public:
  /// `scene` must lie in front of an orthographic camera; it may be empty. Throws std::invalid_argument if
  /// the camera's direction, view size or field of view is invalid.
  View(const Camera& camera, int width, int height, const Aabb& scene);

  int width() const { return width_; }
  int height() const { return height_; }
  const Vec3f& right() const { return right_; }
  const Vec3f& up() const { return up_; }
  const Vec3f& forward() const { return forward_; }

  /// The ray through a point of the picture, in pixels from its top left corner.
  Ray ray(float column, float row) const;

  /// The point relative to the camera's target.
  Vec3f local(const Vec3& point) const { return (point - target_).cast<float>(); }

  /// The side of a pixel at the target (mesh units).
  double pixelSize() const { return pixel_size_; }

  /// The side of a pixel at the depth of a local point (mesh units); at least a hundredth of its size at the
  /// target.
  float pixelSizeAt(const Vec3f& local_point) const;

 private:
  int width_;
  int height_;
  Vec3 target_;
  Vec3f right_;
  Vec3f up_;
  Vec3f forward_;
  bool perspective_;
  double pixel_size_;
  float distance_;  ///< from the eye, or from the plane where the rays start, to the target
};

}  // namespace octoblisk::demos
