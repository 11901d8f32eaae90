// An M16 nut runs down its bolt without friction. Only the contacts of the threads guide it.
#include "gallery/nut_on_bolt.h"

#include "gallery/gallery_scene.h"
#include "gallery/rigid_scene.h"

namespace octoblisk::gallery {
namespace {

/// Lengths in m.
class NutOnBoltScene final : public RigidScene {
 public:
  explicit NutOnBoltScene(const BuildOptions& tree)
      : RigidScene(NutOnBolt::kTimeStep, tree),
        nut_on_bolt_(world_, shapes::coarseThread(16, 192), 9, NutOnBolt::ourShapes(tree)) {
    show(nut_on_bolt_.bolt(), demos::palette::kSteel);
    show(nut_on_bolt_.nut(), demos::palette::kOrange);
    look({Vec3(-0.015, -0.015, -0.0096), Vec3(0.015, 0.015, 0.036)}, {-1.0, 1.6, -0.7});
  }
  ~NutOnBoltScene() override { world_.clear(); }

  void step() override {
    RigidScene::step();
    nut_on_bolt_.notice();
    time_ += NutOnBolt::kTimeStep;
  }

  std::vector<Number> numbers() const override {
    return {{"sunk_mm", 1e3 * nut_on_bolt_.sunk()},
            {"sunk_by_closed_form_mm", 1e3 * 0.5 * nut_on_bolt_.acceleration() * time_ * time_},
            {"off_helix_mm", 1e3 * nut_on_bolt_.offHelix()},
            {"contact_points", static_cast<double>(world_.contactPoints())}};
  }

 private:
  NutOnBolt nut_on_bolt_;
  double time_ = 0.0;
};

}  // namespace

std::unique_ptr<GalleryScene> makeNutOnBolt(const BuildOptions& tree) {
  return std::make_unique<NutOnBoltScene>(tree);
}

}  // namespace octoblisk::gallery
