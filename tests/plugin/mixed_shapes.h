// Shapes of every kind for worlds in which any two may meet.
#pragma once

#include <cmath>
#include <random>

#include "plugin/bullet_world.h"
#include "plugin/partners.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

class MixedShapes {
 public:
  /// The number of triangles of a mesh grows with the square of `detail`: 16 makes rings of 768 triangles.
  /// Shapes are one to three units across.
  explicit MixedShapes(int detail) {
    const auto ring = [&](double radius, double tube) {
      return torus(radius, tube, 2 * detail, 3 * detail / 4);
    };
    for (const auto& partners : {convexPartners(), concavePartners(ring(0.8, 0.4))}) {
      for (const Partner& partner : partners) {
        if (partner.name == "plane") continue;  // passes through all bodies; plane_ does not
        made_.push_back(partner.make());
        others_.push_back(made_.back().shape.get());
      }
    }
    ClusteredOctreeShape& held = add(ring(0.9, 0.2));
    add(ring(1.0, 0.3)).setMargin(btScalar(0.15));
    add(ring(0.7, 0.4)).setContactBreakingThreshold(btScalar(0.2));
    add(boxMesh({0.8, 0.6, 0.4}));
    add(fan(5, detail / 2)).setLocalScaling(btVector3(btScalar(0.6), btScalar(-0.8), btScalar(0.9)));
    compound_.addChildShape(at(0, 0, 0.6), &held);
    compound_.addChildShape(at(0, 0, -0.6), &ball_);
    compound_.addChildShape(btTransform(btQuaternion(btVector3(1, 0, 0), 1), btVector3(1, 0, 0)), &held);
    nested_.addChildShape(at(0.5, 0, 0), &compound_);
    nested_.addChildShape(at(-1.5, 0, 0), &ball_);
    for (int i = 0; i < 24; ++i) {  // enough that the compound uses its own tree
      large_.addChildShape(at(2.0 * std::cos(0.26 * i), 2.0 * std::sin(0.26 * i), 0), &ball_);
    }
    large_.addChildShape(at(0, 0, 0), &compound_);
  }

  /// Every second shape is the plugin's, or a compound that contains it. Planes have a pair with everything,
  /// so they are rare. They are far from their origin, because every triangle of a mesh below a plane has a
  /// contact.
  btCollisionShape& any(std::mt19937_64& random) {
    if (random() % 1000 == 0) return plane_;
    if (random() % 10 == 0) {
      btCollisionShape* const compounds[] = {&compound_, &nested_, &large_};
      return *compounds[random() % 3];
    }
    if (random() % 2 == 0) return *ours_[random() % ours_.size()];
    return *others_[random() % others_.size()];
  }

  /// Changes the scale, margin or threshold of one of the plugin's shapes that is in no compound.
  void change(std::mt19937_64& random) {
    ClusteredOctreeShape& shape = *ours_[1 + random() % (ours_.size() - 1)];
    const std::uint64_t what = random() % 3;
    const double x = uniform(random, 0.7, 1.3), y = uniform(random, 0.7, 1.3);
    if (what == 0) shape.setLocalScaling(toBullet(Vec3(x, -y, 1.0)));
    if (what == 1) shape.setMargin(btScalar(0.3 * (x - 0.7)));
    if (what == 2) shape.setContactBreakingThreshold(btScalar(0.4 * (x - 0.7)));
  }

  /// Scales the contact breaking thresholds that were set.
  void scaleThresholds(btScalar factor) {
    for (const std::unique_ptr<ClusteredOctreeShape>& shape : ours_) {
      const btScalar threshold = shape->getContactBreakingThreshold(0);  // 0 for the default
      if (threshold > 0) shape->setContactBreakingThreshold(threshold * factor);
    }
  }

 private:
  ClusteredOctreeShape& add(const SharedMesh& mesh) {
    ours_.push_back(std::make_unique<ClusteredOctreeShape>(treeOver(mesh)));
    return *ours_.back();
  }

  std::vector<Made> made_;
  std::vector<btCollisionShape*> others_;
  std::vector<std::unique_ptr<ClusteredOctreeShape>> ours_;
  btSphereShape ball_{btScalar(0.5)};
  btStaticPlaneShape plane_{btVector3(0, 0, 1), -12};
  btCompoundShape compound_, nested_, large_;
};

}  // namespace octoblisk::testing
