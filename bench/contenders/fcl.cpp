// FCL in double precision, with the boxes that its authors advise: OBBRSS.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "contender.h"

namespace octoblisk::bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

fcl::Transform3d transformOf(const Pose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = pose.rotation;
  transform.translation() = pose.translation;
  return transform;
}

struct FclMesh {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;

  explicit FclMesh(const TriangleMesh& mesh) : vertices(mesh.vertices()) {
    for (const auto& [a, b, c] : mesh.triangles()) triangles.emplace_back(a, b, c);
  }

  std::unique_ptr<Model> model() const {
    auto model = std::make_unique<Model>();
    model->beginModel();
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
  }
};

class Fcl final : public CollideQuery, public ContactsQuery, public DistanceQuery {
 public:
  explicit Fcl(const Scene& scene)
      : blisk_(FclMesh(*scene.blisk).model()), belt_(FclMesh(*scene.belt).model()) {}

  bool collides(const Pose& belt_in_blisk) override {
    fcl::CollisionResultd result;
    ask(belt_in_blisk, fcl::CollisionRequestd(1, false), result);
    return result.isCollision();
  }

  /// A pair of triangles may have several contact points, one after the other.
  std::size_t contacts(const Pose& belt_in_blisk) override {
    constexpr std::size_t kAll = 1'000'000;
    fcl::CollisionResultd result;
    ask(belt_in_blisk, fcl::CollisionRequestd(kAll, true), result);
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
      const bool again = k > 0 && result.getContact(k).b1 == result.getContact(k - 1).b1 &&
                         result.getContact(k).b2 == result.getContact(k - 1).b2;
      if (!again) ++pairs;
    }
    return pairs;
  }

  /// FCL keeps nothing from one call to the next.
  double distance(const Pose& belt_in_blisk, bool /*warm*/) override {
    fcl::DistanceRequestd request;
    request.enable_nearest_points = false;
    request.rel_err = 0.0;
    request.abs_err = 0.0;
    fcl::DistanceResultd result;
    return fcl::distance(blisk_.get(), fcl::Transform3d::Identity(), belt_.get(), transformOf(belt_in_blisk),
                         request, result);
  }

 private:
  void ask(const Pose& belt_in_blisk, const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
    fcl::collide(blisk_.get(), fcl::Transform3d::Identity(), belt_.get(), transformOf(belt_in_blisk), request,
                 result);
  }

  std::unique_ptr<Model> blisk_, belt_;
};

class FclBuild final : public BuildQuery {
 public:
  explicit FclBuild(const Scene& scene) : mesh_(*scene.blisk) {}

  void build() override {
    clear();
    model_ = mesh_.model();
  }
  void clear() override { model_.reset(); }

 private:
  FclMesh mesh_;
  std::unique_ptr<Model> model_;
};

const bool kRegistered = registerContender<Fcl, FclBuild>("fcl");

}  // namespace
}  // namespace octoblisk::bench
