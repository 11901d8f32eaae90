// A chain of rings, linked only by their contacts, hangs from a kinematic ring that swings.
#include <algorithm>
#include <cmath>

#include "gallery/gallery_scene.h"
#include "gallery/rigid_scene.h"

namespace octoblisk::gallery {
namespace {

constexpr double kRadius = 0.5, kTube = 0.12;  // m
constexpr double kStep = 1.0 / 120.0;          // s

class ChainOfTori final : public RigidScene {
 public:
  ChainOfTori(int links, const BuildOptions& tree) : RigidScene(kStep, tree) {
    ClusteredOctreeShape& shape = shapeOf(shapes::torus(kRadius, kTube, 32, 16));
    const btQuaternion upright(btVector3(1, 0, 0), SIMD_HALF_PI), across(btVector3(0, 0, 1), SIMD_HALF_PI);
    for (int i = 0; i <= links; ++i) {
      const btTransform pose(i % 2 == 0 ? upright : across * upright, toBullet(Vec3(0, 0, -kPitch * i)));
      const demos::Color color = i == 0       ? demos::palette::kSlate
                                 : i % 2 == 0 ? demos::palette::kSky
                                              : demos::palette::kOrange;
      rings_.push_back(&add(shape, i > 0 ? 1 : 0, pose, color));
      rings_.back()->setActivationState(DISABLE_DEACTIVATION);
      rings_.back()->setDamping(btScalar(0.05), btScalar(0.05));
    }
    rings_[0]->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    const double length = kPitch * links + kRadius + kTube;
    look({Vec3(-0.55 * length, -0.7, -length), Vec3(0.55 * length, 0.7, 0.7)}, {0.25, 1.0, -0.1});
  }

  void step() override {
    // One swing to and fro, then at rest.
    time_ += kStep;
    btTransform swung = rings_[0]->getWorldTransform();
    swung.setOrigin(toBullet(Vec3(time_ < 2.0 ? 1.5 * std::sin(SIMD_PI * time_) : 0.0, 0, 0)));
    rings_[0]->setWorldTransform(swung);
    RigidScene::step();
  }

  std::vector<Number> numbers() const override {
    double least = 2.0 * kRadius, most = 0.0;
    for (std::size_t i = 1; i < rings_.size(); ++i) {
      const double pitch =
          double((rings_[i]->getWorldTransform().getOrigin() - rings_[i - 1]->getWorldTransform().getOrigin())
                     .length());
      least = std::min(least, pitch);
      most = std::max(most, pitch);
    }
    return {
        {"least_pitch_m", least}, {"greatest_pitch_m", most}, {"kinetic_energy_j", world_.kineticEnergy()}};
  }

 private:
  static constexpr double kPitch = 1.96 * (kRadius - kTube);  ///< of the links, about to touch

  std::vector<btRigidBody*> rings_;
  double time_ = 0.0;
};

}  // namespace

std::unique_ptr<GalleryScene> makeChainOfTori(int links, const BuildOptions& tree) {
  return std::make_unique<ChainOfTori>(links, tree);
}

}  // namespace octoblisk::gallery
