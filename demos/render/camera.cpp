#include "render/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace octoblisk::demos {
namespace {

/// Rows: right, up and forward in the picture.
Mat3 cameraAxes(const Vec3& direction, const Vec3& up) {
  if (!direction.allFinite() || !up.allFinite() || direction.norm() == 0.0) {
    throw std::invalid_argument("the camera's direction is zero");
  }
  const Vec3 forward = direction.normalized();
  Vec3 right = forward.cross(up);
  if (right.norm() <= 1e-9 * up.norm()) right = forward.unitOrthogonal();
  right.normalize();
  Mat3 axes;
  axes << right.transpose(), right.cross(forward).transpose(), forward.transpose();
  return axes;
}

}  // namespace

Camera frame(std::span<const Vec3> points, const Vec3& direction, const Vec3& up, Projection projection,
             double margin) {
  Camera camera;
  camera.direction = direction;
  camera.up = up;
  camera.projection = projection;
  const Mat3 axes = cameraAxes(direction, up);
  if (points.empty()) return camera;

  Aabb seen;  // in the camera's axes
  for (const Vec3& point : points) seen.extend(axes * point);
  const Vec3 center = seen.center();
  const Vec3 half = seen.halfExtents().cwiseMax(std::max(1e-9, 1e-6 * seen.halfExtents().norm()));
  camera.target = axes.transpose() * center;
  camera.view_width = 2.0 * margin * half.x();
  camera.view_height = 2.0 * margin * half.y();
  if (projection == Projection::orthographic) return camera;

  // From an eye at (x_e, z_e) a point (x, z) is visible if ±(x − x_e) ≤ slope · (z − z_e), where z is the
  // depth.
  // The two tightest of these bounds, those of the points farthest right and left, determine the nearest
  // possible eye; the same holds for y.
  const double full_slope = std::tan(0.5 * camera.field_of_view);
  const double shape = half.x() / half.y();
  Vec3 eye(0.0, 0.0, std::numeric_limits<double>::infinity());
  for (int axis = 0; axis < 2; ++axis) {
    const double slope = full_slope / margin * (axis == 0 ? shape : 1.0);
    double positive = -std::numeric_limits<double>::infinity();
    double negative = positive;
    for (const Vec3& point : points) {
      const Vec3 place = axes * point;
      positive = std::max(positive, place[axis] - slope * place.z());
      negative = std::max(negative, -place[axis] - slope * place.z());
    }
    eye[axis] = 0.5 * (positive - negative);
    eye.z() = std::min(eye.z(), -0.5 * (positive + negative) / slope);
  }
  const double distance = std::max(center.z() - eye.z(), half.y() / full_slope);
  camera.target = axes.transpose() * Vec3(eye.x(), eye.y(), center.z());
  camera.view_height = 2.0 * distance * full_slope;
  camera.view_width = shape * camera.view_height;
  return camera;
}

Camera frame(const Aabb& box, const Vec3& direction, const Vec3& up, Projection projection, double margin) {
  if (box.isEmpty()) return frame(std::span<const Vec3>(), direction, up, projection, margin);
  return frame(box.corners(), direction, up, projection, margin);
}

View::View(const Camera& camera, int width, int height, const Aabb& scene)
    : width_(width),
      height_(height),
      target_(camera.target),
      perspective_(camera.projection == Projection::perspective),
      pixel_size_(std::max(camera.view_width / width, camera.view_height / height)) {
  if (!(camera.view_width > 0.0 && camera.view_height > 0.0 && std::isfinite(pixel_size_))) {
    throw std::invalid_argument("the camera's view must be wider and higher than zero");
  }
  const Mat3 axes = cameraAxes(camera.direction, camera.up);
  right_ = axes.row(0).cast<float>();
  up_ = axes.row(1).cast<float>();
  forward_ = axes.row(2).cast<float>();

  double distance = 1.0;
  if (perspective_) {
    if (!(camera.field_of_view > 0.0 && camera.field_of_view < std::numbers::pi)) {
      throw std::invalid_argument("the camera's field of view must lie between 0 and π");
    }
    distance = 0.5 * height * pixel_size_ / std::tan(0.5 * camera.field_of_view);
  } else if (!scene.isEmpty()) {
    const double room = 0.02 * scene.halfExtents().norm() + 50.0 * pixel_size_;
    for (const Vec3& corner : scene.corners()) {
      distance = std::max(distance, room - axes.row(2).dot(corner - target_));
    }
  }
  distance_ = static_cast<float>(distance);
}

Ray View::ray(float column, float row) const {
  const auto size = static_cast<float>(pixel_size_);
  const Vec3f on_target_plane =
      right_ * ((column - 0.5f * width_) * size) - up_ * ((row - 0.5f * height_) * size);
  const Vec3f eye = -distance_ * forward_;
  if (perspective_) return {eye, (on_target_plane - eye).normalized()};
  return {on_target_plane + eye, forward_};
}

float View::pixelSizeAt(const Vec3f& local_point) const {
  const auto size = static_cast<float>(pixel_size_);
  if (!perspective_) return size;
  return size * std::max(0.01f, 1.0f + forward_.dot(local_point) / distance_);
}

}  // namespace octoblisk::demos
