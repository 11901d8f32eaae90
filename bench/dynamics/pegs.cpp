// Round and square pegs that drop into their holes.
#include "shapes/pegs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "dynamics/scenes.h"
#include "shapes/seeded.h"

namespace octoblisk::bench {
namespace {

class Pegs final : public DynamicsScene {
 public:
  Pegs(ShapeKind kind, int pegs) : DynamicsScene(kind, 1.0 / 240.0, 1e-3) {
    world().setGravity(btVector3(0, 0, -9810));
    struct Fit {
      const Solid *hole, *peg;
      btCollisionShape *hole_shape, *peg_shape;
    };
    std::vector<Fit> fits;
    for (const int sides : {48, 4}) {
      const shapes::PegInHole fit{
          .sides = sides, .radius = kRadius, .clearance = kClearance, .depth = kDepth};
      const shapes::SharedMesh peg = shapes::moved(*shapes::peg(fit, kLength), Vec3(0, 0, -0.5 * kLength));
      Pieces whole(1, std::vector<std::uint32_t>(peg->vertices().size()));
      std::iota(whole[0].begin(), whole[0].end(), 0u);
      const Solid& hole_solid = keep(shapes::hole(fit));
      const Solid& peg_solid = keep(peg, whole);
      fits.push_back({&hole_solid, &peg_solid, &concave(hole_solid, false), &concave(peg_solid, true)});
    }
    std::mt19937_64 random(1);
    for (int i = 0; i < pegs; ++i) {
      const Fit& fit = fits[static_cast<std::size_t>(i) % fits.size()];
      const Vec3 place(0, kApart * i, 0);
      add(*fit.hole_shape, *fit.hole, 0, placed(place));
      const double angle = shapes::uniform(random, 0.0, 2.0 * std::numbers::pi);
      const Vec3 aside = 0.5 * kClearance * Vec3(std::cos(angle), std::sin(angle), 0.0);
      add(*fit.peg_shape, *fit.peg, 0.1, placed(place + aside + Vec3(0, 0, kDepth + 1.0 + 0.5 * kLength)));
    }
  }

  std::vector<Figure> figures() const override {
    double highest = 0.0, tilt = 0.0;
    for (const Body& body : moving()) {
      highest = std::max(highest, body.pose().translation.z() - 0.5 * kLength);
      tilt = std::max(tilt, std::acos(std::min(1.0, body.pose().rotation(2, 2))));
    }
    return {{"highest_foot_mm", highest}, {"greatest_tilt_mrad", 1e3 * tilt}};
  }

 private:
  static constexpr double kRadius = 8.0, kClearance = 0.1, kDepth = 24.0, kLength = 32.0;  ///< mm
  static constexpr double kApart = 40.0;                                                   ///< mm

  /// It has gone through the floor or through a side.
  bool isLost(const Body& body) const override {
    const auto i = static_cast<std::size_t>(&body - moving().data());
    const Vec3 middle = body.pose().translation - fixed()[i].pose().translation;
    return middle.z() < 0.5 * kLength - 1.0 || middle.head<2>().norm() > kRadius;
  }
};

}  // namespace

std::unique_ptr<DynamicsScene> makePegs(ShapeKind kind, int pegs) {
  return std::make_unique<Pegs>(kind, pegs);
}

}  // namespace octoblisk::bench
