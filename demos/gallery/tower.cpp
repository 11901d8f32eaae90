// A tower of cylinders that may not sleep. The floor and the cylinders are ClusteredOctreeShapes.
#include <algorithm>
#include <cmath>

#include "gallery/gallery_scene.h"
#include "gallery/rigid_scene.h"
#include "shapes/sheets.h"

namespace octoblisk::gallery {
namespace {

class Tower final : public RigidScene {
 public:
  Tower(int cylinders, const BuildOptions& tree) : RigidScene(1.0 / 60.0, tree) {
    add(shapeOf(shapes::solidBelow(*shapes::waveSheet(1.5, 0.0, 24), -0.2), kMargin), 0,
        btTransform::getIdentity(), demos::palette::kSteel);
    ClusteredOctreeShape& cylinder = shapeOf(shapes::cylinder(kRadius, kHalfHeight, 64), kMargin);
    for (int i = 0; i < cylinders; ++i) {
      const btTransform pose(btQuaternion::getIdentity(), toBullet(Vec3(0, 0, heightOf(i))));
      cylinders_.push_back(
          &add(cylinder, 1, pose, i % 2 == 0 ? demos::palette::kOrange : demos::palette::kSky));
      cylinders_.back()->setActivationState(DISABLE_DEACTIVATION);
    }
    look({Vec3(-1.5, -1.5, -0.2), Vec3(1.5, 1.5, heightOf(cylinders))}, {-0.4, 1.0, -0.5});
  }

  std::vector<Number> numbers() const override {
    double creep = 0.0;
    for (const btRigidBody* body : cylinders_) {
      const btVector3& at = body->getWorldTransform().getOrigin();
      creep = std::max(creep, double(std::hypot(at.x(), at.y())));
    }
    const double top = double(cylinders_.back()->getWorldTransform().getOrigin().z()) + kHalfHeight;
    return {{"top_m", top}, {"creep_mm", 1e3 * creep}, {"kinetic_energy_j", world_.kineticEnergy()}};
  }

 private:
  static constexpr double kRadius = 0.5, kHalfHeight = 0.25, kMargin = 0.01;  ///< m

  static double heightOf(int i) { return kMargin + (2 * i + 1) * (kHalfHeight + kMargin); }

  std::vector<btRigidBody*> cylinders_;
};

}  // namespace

std::unique_ptr<GalleryScene> makeTower(int cylinders, const BuildOptions& tree) {
  return std::make_unique<Tower>(cylinders, tree);
}

}  // namespace octoblisk::gallery
