// FCL in double precision, with OBBRSS, the bounding volumes that its authors recommend.
#include <fcl/config.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/distance.h>

#include <array>

#include "contender.h"
#include "shared/fcl_model.h"

namespace octoblisk::bench {
namespace {

using testing::FclMesh;
using testing::FclModel;
using testing::fclTransform;

/// The two models, posed for a query.
class FclPair {
 public:
  explicit FclPair(const Scene& scene)
      : blisk_(FclMesh(*scene.blisk).model()), belt_(FclMesh(*scene.belt).model()) {}

  fcl::CollisionResultd collide(const Pose& belt_in_blisk, std::size_t most, bool with_points) const {
    fcl::CollisionResultd result;
    fcl::collide(blisk_.get(), fcl::Transform3d::Identity(), belt_.get(), fclTransform(belt_in_blisk),
                 fcl::CollisionRequestd(most, with_points), result);
    return result;
  }

  const FclModel& blisk() const { return *blisk_; }
  const FclModel& belt() const { return *belt_; }

 private:
  std::unique_ptr<FclModel> blisk_, belt_;
};

constexpr std::size_t kAll = 1'000'000;

class Fcl final : public CollideQuery, public ContactsQuery, public DistanceQuery {
 public:
  explicit Fcl(const Scene& scene) : pair_(scene) {}

  bool collides(const Pose& belt_in_blisk, bool) override {
    return pair_.collide(belt_in_blisk, 1, false).isCollision();
  }

  /// Without points, FCL reports one contact for each triangle pair.
  std::size_t contacts(const Pose& belt_in_blisk) override {
    return pair_.collide(belt_in_blisk, kAll, false).numContacts();
  }

  /// FCL keeps nothing between calls and takes no starting pair. It does take an upper bound of the distance.
  /// A warm query passes the distance of the previous nearest pair at the new pose.
  double distance(const Pose& belt_in_blisk, bool warm) override {
    const fcl::Transform3d pose = fclTransform(belt_in_blisk);
    fcl::DistanceRequestd request;  // exact and unsigned
    request.enable_nearest_points = false;
    fcl::DistanceResultd result;
    if (warm && blisk_triangle_ >= 0) result.min_distance = distanceOfNearestBefore(pose);
    fcl::distance(&pair_.blisk(), fcl::Transform3d::Identity(), &pair_.belt(), pose, request, result);
    if (result.b1 >= 0) {  // otherwise no pair is nearer than the previous one
      blisk_triangle_ = result.b1;
      belt_triangle_ = result.b2;
    }
    return result.min_distance;
  }

 private:
  static std::array<fcl::Vector3d, 3> cornersOf(const FclModel& model, std::intptr_t triangle) {
    const fcl::Triangle& corners = model.tri_indices[triangle];
    return {model.vertices[corners[0]], model.vertices[corners[1]], model.vertices[corners[2]]};
  }

  double distanceOfNearestBefore(const fcl::Transform3d& pose) const {
    fcl::Vector3d on_blisk, on_belt;
    return fcl::detail::TriangleDistance<double>::triDistance(
        cornersOf(pair_.blisk(), blisk_triangle_).data(), cornersOf(pair_.belt(), belt_triangle_).data(),
        pose, on_blisk, on_belt);
  }

  FclPair pair_;
  std::intptr_t blisk_triangle_ = -1, belt_triangle_ = -1;  // the nearest of the previous call
};

/// With points, normals and depths.
class FclPoints final : public ContactsQuery {
 public:
  explicit FclPoints(const Scene& scene) : pair_(scene) {}

  /// A triangle pair may have several points, which follow each other.
  std::size_t contacts(const Pose& belt_in_blisk) override {
    const fcl::CollisionResultd result = pair_.collide(belt_in_blisk, kAll, true);
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
      const bool again = k > 0 && result.getContact(k).b1 == result.getContact(k - 1).b1 &&
                         result.getContact(k).b2 == result.getContact(k - 1).b2;
      if (!again) ++pairs;
    }
    return pairs;
  }

 private:
  FclPair pair_;
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
  std::unique_ptr<FclModel> model_;
};

class FclRefit final : public RefitQuery {
 public:
  explicit FclRefit(const Scene& scene)
      : mesh_(*scene.blisk),
        bent_(*bench::bent(*scene.blisk)),
        blisk_(mesh_.model()),
        belt_(FclMesh(*scene.belt).model()) {}

  void refit(bool bent) override {
    blisk_->beginReplaceModel();
    blisk_->replaceSubModel((bent ? bent_ : mesh_).vertices);
    blisk_->endReplaceModel(true, true);  // keeps the tree and recomputes its boxes from the leaves up
  }
  bool touches(const Pose& belt_in_blisk) override {
    fcl::CollisionResultd result;
    return fcl::collide(blisk_.get(), fcl::Transform3d::Identity(), belt_.get(), fclTransform(belt_in_blisk),
                        fcl::CollisionRequestd(1, false), result) > 0;
  }

 private:
  FclMesh mesh_, bent_;
  std::unique_ptr<FclModel> blisk_, belt_;
};

const bool kRegistered = registerContender<Fcl, FclBuild, FclRefit>("fcl") &&
                         describe("fcl", "FCL " FCL_VERSION ", double precision, OBBRSS");
const bool kPoints = registerContender<FclPoints>("fcl-points");

}  // namespace
}  // namespace octoblisk::bench
