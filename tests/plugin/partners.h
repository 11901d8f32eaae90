// Every kind of shape that ours meets, with what it is made of.
#pragma once

#include <btBulletCollisionCommon.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "octoblisk/half_space_contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

/// A shape and all that it points to.
struct Made {
  std::vector<std::shared_ptr<void>> kept;
  std::shared_ptr<btCollisionShape> shape;
  SharedMesh mesh;              ///< what it consists of, where it consists of triangles
  std::vector<TriangleId> ids;  ///< how Bullet numbers these
  std::shared_ptr<HalfSpace> half_space;

  template <typename Kept, typename... Arguments>
  Kept& keep(Arguments&&... arguments) {
    auto made = std::make_shared<Kept>(std::forward<Arguments>(arguments)...);
    kept.push_back(made);
    return *made;
  }
  template <typename Shape, typename... Arguments>
  Shape& is(Arguments&&... arguments) {
    auto made = std::make_shared<Shape>(std::forward<Arguments>(arguments)...);
    shape = made;
    return *made;
  }
  void setMargin(double margin);
};

struct Partner {
  std::string name;
  double spread;               ///< of poses about a torus of radii 2 and 0.7 that meet it every second time
  std::function<Made()> make;  ///< a body of some few units
  /// A floor whose top is z = 0, not far below the origin; none for what nothing comes to rest on.
  std::function<Made()> floor = nullptr;

  friend void PrintTo(const Partner& partner, std::ostream* out) { *out << partner.name; }
};

/// Bullet's concave shapes, and ours; those of a mesh are of this one.
std::vector<Partner> concavePartners(const SharedMesh& body = fan(5, 8));
/// Bullet's convex shapes, and compounds.
std::vector<Partner> convexPartners();

/// The mesh as Bullet stores it: coordinates of the precision of its scalar.
SharedMesh rounded(const TriangleMesh& mesh);

}  // namespace octoblisk::testing
