// Meshes and poses as FCL's, in double precision.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <memory>
#include <vector>

#include "octoblisk/function_ref.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

/// With the bounding volumes that FCL's authors recommend.
using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

/// The vertices and triangles that a model is made of.
struct FclMesh {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;

  explicit FclMesh(const TriangleMesh& mesh) : FclMesh(mesh, [](std::size_t) { return true; }) {}
  /// The triangles for which keeps(triangle).
  FclMesh(const TriangleMesh& mesh, FunctionRef<bool(std::size_t)> keeps) : vertices(mesh.vertices()) {
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const auto& [a, b, c] = mesh.triangles()[t];
      if (keeps(t)) triangles.emplace_back(a, b, c);
    }
  }

  std::unique_ptr<FclModel> model() const {
    auto model = std::make_unique<FclModel>();
    model->beginModel();
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
  }
};

inline fcl::Transform3d fclTransform(const Pose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = pose.rotation;
  transform.translation() = pose.translation;
  return transform;
}

}  // namespace octoblisk::testing
