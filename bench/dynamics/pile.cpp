// Piles of concave bodies.
#include <random>

#include "dynamics/scenes.h"
#include "shapes/seeded.h"
#include "shapes/sheets.h"

namespace octoblisk::bench {
namespace {

struct Kind {
  shapes::SharedMesh mesh;
  Pieces pieces = {};
};

class Pile : public DynamicsScene {
 protected:
  using DynamicsScene::DynamicsScene;

  /// Drops bodies of 1 kg each, the kinds in turn, in square layers that start at `height`.
  void drop(const std::vector<Kind>& kinds, int bodies, int layer_side, double pitch, double height) {
    std::vector<std::pair<const Solid*, btCollisionShape*>> made;
    for (const auto& [mesh, pieces] : kinds) {
      const Solid& solid = keepMoving(mesh, pieces);
      made.emplace_back(&solid, &concave(solid, true));
    }
    std::mt19937_64 random(1);
    const double middle = 0.5 * (layer_side - 1);
    for (int i = 0; i < bodies; ++i) {
      const auto& [solid, shape] = made[static_cast<std::size_t>(i + i / 4) % made.size()];
      Vec3 place(pitch * (i % layer_side - middle), pitch * (i / layer_side % layer_side - middle),
                 height + pitch * (i / (layer_side * layer_side)));
      place += shapes::randomPoint(random, 0.05);
      add(*shape, *solid, 1, {shapes::randomRotation(random), place});
    }
  }
};

class PileInPit final : public Pile {
 public:
  PileInPit(ShapeKind kind, const Kind& body, int bodies) : Pile(kind) {
    constexpr double kThickness = 0.5, kWallHeight = 8.0;  // half of each wall's thickness and height
    addPlane(10.0);
    for (const double side : {-1.0, 1.0}) {
      const double middle = side * (kInner + kThickness);
      addBox({kThickness, kInner + 2.0 * kThickness, kWallHeight}, placed({middle, 0, kWallHeight}));
      addBox({kInner, kThickness, kWallHeight}, placed({0, middle, kWallHeight}));
    }
    double radius = 0.0;
    const auto mesh = inPrincipalFrame(body.mesh);
    for (const Vec3& vertex : mesh->vertices()) radius = std::max(radius, vertex.norm());
    const double pitch = 2.0 * radius + 0.1;
    drop({body}, bodies, static_cast<int>(2.0 * kInner / pitch), pitch, radius + 0.2);
  }

 private:
  static constexpr double kInner = 2.5;  ///< half the pit's width, m

  bool isLost(const Body& body) const override {
    const Vec3 middle = body.pose().translation;
    return middle.z() < 0.0 || middle.head<2>().cwiseAbs().maxCoeff() > kInner;
  }
};

class PileOnTray final : public Pile {
 public:
  PileOnTray(ShapeKind kind, int bodies) : Pile(kind) {
    const Solid& floor = keep(shapes::solidBelow(*shapes::tray(5.0, 40), -3.0));
    add(concave(floor, false), floor, 0, {});
    std::mt19937_64 random(1);
    drop({{shapes::torus(0.4, 0.15, 20, 10)},
          {shapes::gear(8, 0.4, 0.5, 0.2, 0.12)},
          {shapes::uProfile(0.35, 0.3, 0.12, 0.4)},
          {shapes::bumpySphere(random, 0.4, 0.15, 16)}},
         bodies, 4, 1.3, 1.3);
  }

 private:
  bool isLost(const Body& body) const override {
    const Vec3 middle = body.pose().translation;
    return middle.z() < shapes::trayHeight(middle.x(), middle.y()) || middle.norm() > 15.0;
  }
};

}  // namespace

std::unique_ptr<DynamicsScene> makeTrefoilPile(ShapeKind kind, int bodies) {
  return std::make_unique<PileInPit>(kind, Kind{shapes::trefoilKnot(0.15, 0.065, 75, 10)}, bodies);
}

std::unique_ptr<DynamicsScene> makeJackPile(ShapeKind kind, int bodies) {
  return std::make_unique<PileInPit>(kind, Kind{shapes::jack(0.5, 0.1), piecesOfEight(3, 8, 8)}, bodies);
}

std::unique_ptr<DynamicsScene> makeTeddyPile(ShapeKind kind, int bodies) {
  return std::make_unique<PileInPit>(kind, Kind{shapes::teddy(1.0, 56)}, bodies);
}

std::unique_ptr<DynamicsScene> makeMixedPile(ShapeKind kind, int bodies) {
  return std::make_unique<PileOnTray>(kind, bodies);
}

}  // namespace octoblisk::bench
