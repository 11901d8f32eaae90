// Collects the triangles that a shape passes to a callback.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include <map>
#include <utility>

#include "octoblisk/triangle_mesh.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk {

struct CollectedTriangles final : btTriangleCallback {
  std::map<std::pair<int, int>, Triangle> triangles;  ///< by part and index
  int calls = 0;

  void processTriangle(btVector3* t, int part, int index) override {
    ++calls;
    triangles[{part, index}] = {fromBullet(t[0]), fromBullet(t[1]), fromBullet(t[2])};
  }
};

inline CollectedTriangles trianglesOf(const btConcaveShape& shape) {
  CollectedTriangles found;
  const btVector3 far(btScalar(1e9), btScalar(1e9), btScalar(1e9));
  shape.processAllTriangles(&found, -far, far);
  return found;
}

}  // namespace octoblisk
