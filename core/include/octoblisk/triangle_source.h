// An interface to triangles that the caller stores and enumerates by bounding box.
#pragma once

#include <type_traits>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

/// A triangle with the part and index that its source assigns to it. Two triangles may have the same numbers.
struct SourceTriangle {
  Triangle corners;
  int part = 0;
  int index = 0;
};

class TriangleSource {
 public:
  virtual ~TriangleSource() = default;

  /// A box, in the source's frame, that contains all triangles. It may be infinite.
  virtual Aabb bounds() const = 0;

  /// Calls visit(user, triangle) once for every triangle whose bounds meet the box, in the source's frame,
  /// and possibly for others.
  virtual void forEachTriangleIn(const Aabb& box, void (*visit)(void* user, const SourceTriangle& triangle),
                                 void* user) const = 0;

  /// The same for any callable that takes a triangle.
  template <typename Visit>
  void forEachTriangleIn(const Aabb& box, Visit&& visit) const {
    forEachTriangleIn(
        box,
        [](void* user, const SourceTriangle& triangle) {
          (*static_cast<std::remove_reference_t<Visit>*>(user))(triangle);
        },
        &visit);
  }
};

}  // namespace octoblisk
