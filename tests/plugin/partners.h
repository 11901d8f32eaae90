// Every kind of shape that the plugin's shape can meet, with its triangles.
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

/// A shape and everything it points to.
struct Made {
  std::vector<std::shared_ptr<void>> kept;
  std::shared_ptr<btCollisionShape> shape;
  SharedMesh mesh;              ///< its triangles, if it consists of triangles
  std::vector<TriangleId> ids;  ///< Bullet's numbers of these
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
  double spread;               ///< of poses around a torus of radii 2 and 0.7, half of which meet it
  std::function<Made()> make;  ///< a body a few units across
  /// A floor with its top at z = 0, near the origin. Empty if nothing can rest on the shape.
  std::function<Made()> floor = nullptr;

  friend void PrintTo(const Partner& partner, std::ostream* out) { *out << partner.name; }
};

/// Bullet's concave shapes and the plugin's. Mesh shapes use `body`.
std::vector<Partner> concavePartners(const SharedMesh& body = fan(5, 8));
/// Bullet's convex shapes, and compounds.
std::vector<Partner> convexPartners();

/// The mesh as Bullet stores it, with coordinates rounded to its scalar type.
SharedMesh rounded(const TriangleMesh& mesh);

}  // namespace octoblisk::testing
