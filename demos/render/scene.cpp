#include "render/scene.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace octoblisk::demos {

void Scene::addMesh(const TriangleMesh& mesh, const Pose& mesh_in_scene, Color color, float opacity) {
  if (!(opacity > 0.0f && opacity <= 1.0f)) {
    throw std::invalid_argument("a mesh's opacity must be in (0, 1], but is " + std::to_string(opacity));
  }
  Solid solid{{}, mesh.triangles(), {color}, opacity};
  solid.vertices.reserve(mesh.vertices().size());
  for (const Vec3& vertex : mesh.vertices()) {
    solid.vertices.push_back(mesh_in_scene * vertex);
    bounds_.extend(solid.vertices.back());
  }
  solids_.push_back(std::move(solid));
}

void Scene::addMesh(const TriangleMesh& mesh, const Pose& mesh_in_scene,
                    std::span<const Color> triangle_colors, float opacity) {
  if (triangle_colors.size() != mesh.triangleCount()) {
    throw std::invalid_argument("a mesh of " + std::to_string(mesh.triangleCount()) +
                                " triangles was given " + std::to_string(triangle_colors.size()) +
                                " colours");
  }
  addMesh(mesh, mesh_in_scene, Color{}, opacity);
  solids_.back().colors.assign(triangle_colors.begin(), triangle_colors.end());
}

void Scene::addBoxes(std::span<const Obb> boxes, const MarkStyle& style) {
  Marks marks{MarkKind::lines, style, {}};
  marks.points.reserve(24 * boxes.size());
  for (const Obb& box : boxes) {
    const auto corner = [&box](unsigned index) {
      Vec3 signs;
      for (int axis = 0; axis < 3; ++axis) signs[axis] = (index >> axis & 1u) != 0 ? 1.0 : -1.0;
      return Vec3(box.center + box.axes * box.half_extents.cwiseProduct(signs));
    };
    for (unsigned index = 0; index < 8; ++index) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        if ((index >> axis & 1u) != 0) continue;
        marks.points.insert(marks.points.end(), {corner(index), corner(index | 1u << axis)});
      }
    }
  }
  addMarks(std::move(marks));
}

void Scene::addPoints(std::span<const Vec3> points, const MarkStyle& style) {
  addMarks({MarkKind::points, style, {points.begin(), points.end()}});
}

void Scene::addPolyline(std::span<const Vec3> points, const MarkStyle& style) {
  Marks marks{MarkKind::lines, style, {}};
  for (std::size_t index = 1; index < points.size(); ++index) {
    marks.points.insert(marks.points.end(), {points[index - 1], points[index]});
  }
  addMarks(std::move(marks));
}

void Scene::addArrow(const Vec3& from, const Vec3& to, const MarkStyle& style) {
  addMarks({MarkKind::arrows, style, {from, to}});
}

void Scene::addMarks(Marks marks) {
  if (marks.points.empty()) return;
  for (const Vec3& point : marks.points) bounds_.extend(point);
  marks_.push_back(std::move(marks));
}

std::vector<Vec3> Scene::points() const {
  std::vector<Vec3> points;
  for (const Solid& solid : solids_)
    points.insert(points.end(), solid.vertices.begin(), solid.vertices.end());
  for (const Marks& marks : marks_) points.insert(points.end(), marks.points.begin(), marks.points.end());
  return points;
}

}  // namespace octoblisk::demos
