// An M16 nut runs down its bolt without friction. Only the contacts of the threads guide it.
#include <cmath>
#include <numbers>

#include "gallery/rigid_scene.h"
#include "gallery/scenes.h"
#include "shapes/threads.h"

namespace octoblisk::gallery {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kGravity = 9.81;
constexpr double kMargin = 1e-4;

/// Lengths in m.
class NutOnBolt final : public RigidScene {
 public:
  explicit NutOnBolt(const BuildOptions& tree) : RigidScene(kTimeStep, tree) {
    thread_.segments = 192;
    const double length = 0.036, height = 0.013;
    add(shapeOf(shapes::bolt(thread_, length), kMargin), 0, at(0, 0, 0), demos::palette::kSteel);
    start_ = 9.0 * thread_.pitch;
    // The origin of a moving body is its centre.
    shapes::SharedMesh nut = shapes::nut(thread_, height);
    std::vector<Vec3> vertices = nut->vertices();
    for (Vec3& vertex : vertices) vertex.z() -= 0.5 * height;
    nut = std::make_shared<const TriangleMesh>(std::move(vertices), nut->triangles());
    nut_ = &add(shapeOf(nut, kMargin), 0.03, at(0, 0, start_ + 0.5 * height), demos::palette::kOrange);
    start_ += 0.5 * height;
    nut_->setFriction(0);
    look({Vec3(-0.015, -0.015, -0.0096), Vec3(0.015, 0.015, 0.036)}, {-1.0, 1.6, -0.7});
  }

  void step() override {
    RigidScene::step();
    time_ += kTimeStep;
    const btMatrix3x3& axes = nut_->getWorldTransform().getBasis();
    turned_ += std::remainder(std::atan2(double(axes[1][0]), double(axes[0][0])) - turned_, kTurn);
  }

  std::vector<Number> numbers() const override {
    const double sunk = start_ - double(nut_->getWorldTransform().getOrigin().z());
    const double lead = thread_.pitch / kTurn,
                 inertia_over_mass = double(nut_->getInvMass()) / double(nut_->getInvInertiaDiagLocal().z());
    const double acceleration = kGravity / (1.0 + inertia_over_mass / (lead * lead));
    return {{"sunk_mm", 1e3 * sunk},
            {"sunk_by_closed_form_mm", 1e3 * 0.5 * acceleration * time_ * time_},
            {"off_helix_mm", 1e3 * std::abs(sunk + lead * turned_)},
            {"contact_points", static_cast<double>(world_.contactPoints())}};
  }

 private:
  static constexpr double kTimeStep = 1.0 / 240.0;

  shapes::Thread thread_ = shapes::coarseThread(16);
  btRigidBody* nut_;
  double start_, time_ = 0.0, turned_ = 0.0;
};

}  // namespace

std::unique_ptr<GalleryScene> makeNutOnBolt(const BuildOptions& tree) {
  return std::make_unique<NutOnBolt>(tree);
}

}  // namespace octoblisk::gallery
