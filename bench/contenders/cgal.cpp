// CGAL's collision detection of rigid meshes: AABB trees. One of them is rotated together with its boxes.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version_macros.h>

#include "contender.h"

namespace octoblisk::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh meshOf(const TriangleMesh& source) {
  Mesh mesh;
  for (const Vec3& v : source.vertices()) mesh.add_vertex({v.x(), v.y(), v.z()});
  for (const auto& [a, b, c] : source.triangles()) {
    mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  }
  return mesh;
}

class Cgal final : public CollideQuery {
 public:
  explicit Cgal(const Scene& scene) : blisk_(meshOf(*scene.blisk)), belt_(meshOf(*scene.belt)) {
    blisk_id_ = detection_.add_mesh(blisk_);
    belt_id_ = detection_.add_mesh(belt_);
  }

  bool collides(const Pose& belt_in_blisk, bool) override {
    const Mat3& r = belt_in_blisk.rotation;
    const Vec3& t = belt_in_blisk.translation;
    detection_.set_transformation(
        belt_id_, Kernel::Aff_transformation_3(r(0, 0), r(0, 1), r(0, 2), t.x(), r(1, 0), r(1, 1), r(1, 2),
                                               t.y(), r(2, 0), r(2, 1), r(2, 2), t.z()));
    return !detection_.get_all_intersections(belt_id_).empty();
  }

 private:
  Mesh blisk_, belt_;
  CGAL::Rigid_triangle_mesh_collision_detection<Mesh> detection_;
  std::size_t blisk_id_ = 0, belt_id_ = 0;
};

class CgalBuild final : public BuildQuery {
 public:
  explicit CgalBuild(const Scene& scene) : mesh_(meshOf(*scene.blisk)) {}

  void build() override {
    clear();
    tree_ = std::make_unique<Tree>(faces(mesh_).begin(), faces(mesh_).end(), mesh_);
    tree_->build();
  }
  void clear() override { tree_.reset(); }

 private:
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;

  Mesh mesh_;
  std::unique_ptr<Tree> tree_;
};

const bool kRegistered = registerContender<Cgal, CgalBuild>("cgal") &&
                         describe("cgal", "CGAL " CGAL_VERSION_STR ", exact predicates");

}  // namespace
}  // namespace octoblisk::bench
