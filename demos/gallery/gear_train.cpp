// Gears on axles: the first has a motor; the teeth turn the others.
#include <numbers>

#include "gallery/gallery_scene.h"
#include "gallery/rigid_scene.h"

namespace octoblisk::gallery {
namespace {

constexpr double kModule = 0.08;  // m: pitch diameter over number of teeth
constexpr double kSpeed = 2.0;    // rad/s, of the first gear
constexpr int kTeeth[] = {12, 20, 16};

class GearTrain final : public RigidScene {
 public:
  explicit GearTrain(const BuildOptions& tree) : RigidScene(1.0 / 240.0, tree) {
    world_->setGravity(btVector3(0, 0, 0));
    const demos::Color colors[] = {demos::palette::kOrange, demos::palette::kSky, demos::palette::kGreen};
    double x = 0.0;
    Aabb box;
    for (int g = 0; g < 3; ++g) {
      const double pitch_radius = 0.5 * kModule * kTeeth[g];
      if (g > 0) x += 0.5 * kModule * (kTeeth[g - 1] + kTeeth[g]);
      const double root = pitch_radius - 1.25 * kModule, tip = pitch_radius + 0.9 * kModule;
      ClusteredOctreeShape& shape = shapeOf(shapes::gear(kTeeth[g], root, tip, 0.3 * root, 0.12), 0.001);
      // A tooth's middle is at 0.7 pitches, a gap's at 0.2. The second gear has gaps where its neighbours on
      // either side have teeth.
      const double pitch = 2.0 * std::numbers::pi / kTeeth[g];
      const double turn[] = {-0.7 * pitch, std::numbers::pi - 0.2 * pitch, std::numbers::pi - 0.7 * pitch};
      const btTransform pose(btQuaternion(btVector3(0, 0, 1), btScalar(turn[g])), toBullet(Vec3(x, 0, 0)));
      btRigidBody& gear = add(shape, 1, pose, colors[g]);
      gear.setActivationState(DISABLE_DEACTIVATION);
      gear.setFriction(btScalar(0.1));
      axles_.push_back(std::make_unique<btHingeConstraint>(gear, btVector3(0, 0, 0), btVector3(0, 0, 1)));
      world_->addConstraint(axles_.back().get());
      gears_.push_back(&gear);
      box.extend(Vec3(x, 0, 0) - Vec3(tip, tip, 0.15));
      box.extend(Vec3(x, 0, 0) + Vec3(tip, tip, 0.15));
    }
    axles_[0]->enableAngularMotor(true, kSpeed, 1000);
    look(box, {0.1, 0.5, -1.0});
  }
  ~GearTrain() override {
    for (const auto& axle : axles_) world_->removeConstraint(axle.get());
  }

  demos::Picture picture() const override {
    demos::Picture picture = RigidScene::picture();
    for (const btRigidBody* gear : gears_) {  // the line on each gear shows how far it has turned
      const Pose pose = fromBullet(gear->getWorldTransform());
      const Vec3 line[] = {pose * Vec3(0.2, 0, 0.121), pose * Vec3(0.37, 0, 0.121)};
      picture.scene.addPolyline(line, {.color = demos::palette::kInk, .width = 9.0f});
    }
    return picture;
  }

  std::vector<Number> numbers() const override {
    std::vector<Number> numbers;
    for (std::size_t g = 0; g < gears_.size(); ++g) {
      const std::string name = "gear_" + std::to_string(kTeeth[g]) + "_teeth_rad_s";
      numbers.push_back({name, double(gears_[g]->getAngularVelocity().z())});
    }
    numbers.push_back({"contact_points", static_cast<double>(world_.contactPoints())});
    return numbers;
  }

 private:
  std::vector<btRigidBody*> gears_;
  std::vector<std::unique_ptr<btHingeConstraint>> axles_;
};

}  // namespace

std::unique_ptr<GalleryScene> makeGearTrain(const BuildOptions& tree) {
  return std::make_unique<GearTrain>(tree);
}

}  // namespace octoblisk::gallery
