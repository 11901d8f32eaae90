// The simplest program: a ring falls over a peg. Its convex hull would lie on the peg.
#include "gallery/gallery_scene.h"
#include "gallery/rigid_scene.h"
#include "shapes/sheets.h"

namespace octoblisk::gallery {
namespace {

/// Lengths in m.
class HelloShape final : public RigidScene {
 public:
  explicit HelloShape(const BuildOptions& tree) : RigidScene(1.0 / 240.0, tree) {
    // Mass 0 is static. A mesh is a surface; this one is open and faces up.
    add(shapeOf(shapes::waveSheet(1.5, 0.0, 8)), 0, at(0, 0, 0), demos::palette::kSteel);
    add(shapeOf(shapes::boxMesh({0.15, 0.15, 0.7})), 0, at(0, 0, 0.7), demos::palette::kSky);
    // The moving mesh is made in the same way.
    const btTransform above(btQuaternion(btVector3(1, 0, 0), btScalar(0.3)), btVector3(btScalar(0.1), 0, 2));
    ring_ = &add(shapeOf(shapes::torus(0.5, 0.15, 48, 24)), 1, above, demos::palette::kOrange);
    ring_->setDamping(btScalar(0.05), btScalar(0.05));
    look({Vec3(-1.5, -1.5, 0.0), Vec3(1.5, 1.5, 2.1)}, {-1.0, 1.6, -0.7});
  }

  std::vector<Number> numbers() const override {
    return {{"ring_height_m", double(ring_->getWorldTransform().getOrigin().z())},
            {"kinetic_energy_j", world_.kineticEnergy()},
            {"contact_points", static_cast<double>(world_.contactPoints())}};
  }

 private:
  btRigidBody* ring_;
};

}  // namespace

std::unique_ptr<GalleryScene> makeHelloShape(const BuildOptions& tree) {
  return std::make_unique<HelloShape>(tree);
}

}  // namespace octoblisk::gallery
