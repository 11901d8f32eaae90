// Nuts that run down their bolts without friction.
#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/scenes.h"
#include "gallery/nut_run.h"

namespace octoblisk::bench {
namespace {

class Nuts final : public DynamicsScene {
 public:
  Nuts(ShapeKind kind, int nuts) : DynamicsScene(kind, gallery::NutRun::kTimeStep, 1.0 / kMillimetres) {
    constexpr double kApart = 40.0;
    world().setGravity(btVector3(0, 0, -9810));
    const Solid& bolt = keep(shapes::scaled(*run_.boltMesh(), kMillimetres));
    const Solid& nut = keep(shapes::scaled(*run_.nutMesh(), kMillimetres));
    btCollisionShape& bolt_shape = concave(bolt, false);
    btCollisionShape& nut_shape = concave(nut, true);
    Pose start = run_.poseAt(0);
    start.translation *= kMillimetres;
    for (int i = 0; i < nuts; ++i) {
      const Pose place = placed({kApart * i, 0, 0});
      add(bolt_shape, bolt, 0, place);
      add(nut_shape, nut, gallery::NutRun::kMass, place * start).setFriction(0);
    }
  }

  std::vector<Figure> figures() const override {
    double least_sunk = std::numeric_limits<double>::infinity(), off_helix = 0.0, tilt = 0.0;
    for (const Body& body : moving()) {
      const gallery::NutRun seen = run(body);
      least_sunk = std::min(least_sunk, kMillimetres * seen.sunk());
      off_helix = std::max(off_helix, kMillimetres * offHelix(body));
      tilt = std::max(tilt, 1e3 * seen.tilt());
    }
    return {
        {"least_sunk_mm", least_sunk}, {"greatest_off_helix_mm", off_helix}, {"greatest_tilt_mrad", tilt}};
  }

 private:
  static constexpr double kMillimetres = 1e3;  ///< in a metre

  gallery::NutRun run(const Body& body) const {
    gallery::NutRun seen = run_;
    Pose pose = body.pose();
    pose.translation /= kMillimetres;
    seen.notice(pose);
    return seen;
  }

  /// From the nearest thread: the run does not know about whole turns.
  double offHelix(const Body& body) const {
    return std::abs(std::remainder(run(body).offHelix(), thread_.pitch));
  }

  /// The flanks have gone through each other.
  bool isLost(const Body& body) const override { return offHelix(body) > thread_.pitch / 8.0; }

  const shapes::Thread thread_ = shapes::coarseThread(16, 192);
  const gallery::NutRun run_{thread_, 9};
};

}  // namespace

std::unique_ptr<DynamicsScene> makeNuts(ShapeKind kind, int nuts) {
  return std::make_unique<Nuts>(kind, nuts);
}

}  // namespace octoblisk::bench
