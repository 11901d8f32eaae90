// An interface to triangles that the caller stores and enumerates by bounding box.
#pragma once

#include "octoblisk/function_ref.h"
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

  /// Calls visit(triangle) once for every triangle whose bounds meet the box, in the source's frame,
  /// and possibly for others.
  virtual void forEachTriangleIn(const Aabb& box,
                                 FunctionRef<void(const SourceTriangle& triangle)> visit) const = 0;
};

}  // namespace octoblisk
