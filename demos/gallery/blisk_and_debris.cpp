// A blisk turns on a spindle and is hit by debris that flies along its axis. Bullet's solver slows it down.
#include <cmath>
#include <numbers>
#include <random>

#include "gallery/gallery_scene.h"
#include "gallery/rigid_scene.h"
#include "models/blisk.h"
#include "shapes/seeded.h"

namespace octoblisk::gallery {
namespace {

/// Units are millimetres, kg and seconds: docs/units.md explains the settings for them.
class BliskAndDebris final : public RigidScene {
 public:
  BliskAndDebris(int bodies, const BuildOptions& tree) : RigidScene(1.0 / 960.0, tree) {
    world_->setGravity(btVector3(0, 0, 0));
    world_->getSolverInfo().m_splitImpulsePenetrationThreshold *= 1000;
    const auto mesh = std::make_shared<const TriangleMesh>(demos::makeDefaultBlisk(12'000).mesh);
    blisk_ = &add(shapeInMm(mesh), 12, at(0, 0, 0), demos::palette::kSteel);
    blisk_->setActivationState(DISABLE_DEACTIVATION);
    blisk_->setAngularVelocity(btVector3(0, 0, kSpeed));
    spindle_ = std::make_unique<btHingeConstraint>(*blisk_, btVector3(0, 0, 0), btVector3(0, 0, 1));
    world_->addConstraint(spindle_.get());

    std::mt19937_64 random(1);
    ClusteredOctreeShape* const kinds[] = {&shapeInMm(shapes::bumpySphere(random, 7, 2.5, 16)),
                                           &shapeInMm(shapes::uProfile(7, 6, 2.5, 8)),
                                           &shapeInMm(shapes::torus(7, 2.5, 20, 10))};
    const demos::Color colors[] = {demos::palette::kOrange, demos::palette::kSky, demos::palette::kGreen};
    for (int i = 0; i < bodies; ++i) {
      const double angle = 2.0 * std::numbers::pi * 0.618 * i, radius = shapes::uniform(random, 145.0, 225.0);
      const Vec3 place(radius * std::cos(angle), radius * std::sin(angle), 130.0 + 4.0 * i);
      btRigidBody& body =
          add(*kinds[i % 3], 0.05, toBullet(Pose{shapes::randomRotation(random), place}), colors[i % 3]);
      body.setLinearVelocity(btVector3(0, 0, -1200));
      body.setFriction(btScalar(0.3));
      body.setSleepingThresholds(800, 1);
      debris_.push_back(&body);
    }
    look({Vec3(-260, -260, -150), Vec3(260, 260, 370)}, {-0.5, 1.0, -0.55});
  }
  ~BliskAndDebris() override { world_->removeConstraint(spindle_.get()); }

  demos::Picture picture() const override {
    demos::Picture picture = RigidScene::picture();
    // The line shows how far the blisk has turned.
    const Pose blisk = fromBullet(blisk_->getWorldTransform());
    const Vec3 line[] = {blisk * Vec3(68, 0, 101), blisk * Vec3(120, 0, 101)};
    picture.scene.addPolyline(line, {.color = demos::palette::kInk, .width = 9.0f});
    return picture;
  }

  std::vector<Number> numbers() const override {
    double beyond = 0;
    for (const btRigidBody* body : debris_) beyond += body->getWorldTransform().getOrigin().z() < -110;
    return {{"blisk_rad_s", double(blisk_->getAngularVelocity().z())},
            {"bodies_through", beyond},
            {"contact_points", static_cast<double>(world_.contactPoints())}};
  }

 private:
  static constexpr btScalar kSpeed = 6;  ///< rad/s

  ClusteredOctreeShape& shapeInMm(const shapes::SharedMesh& mesh) {
    ClusteredOctreeShape& shape = shapeOf(mesh, 0.1);
    shape.setContactBreakingThreshold(1);
    return shape;
  }

  btRigidBody* blisk_;
  std::unique_ptr<btHingeConstraint> spindle_;
  std::vector<const btRigidBody*> debris_;
};

}  // namespace

std::unique_ptr<GalleryScene> makeBliskAndDebris(int bodies, const BuildOptions& tree) {
  return std::make_unique<BliskAndDebris>(bodies, tree);
}

}  // namespace octoblisk::gallery
