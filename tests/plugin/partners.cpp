#include "plugin/partners.h"

#include <BulletCollision/CollisionShapes/btBox2dShape.h>
#include <BulletCollision/CollisionShapes/btConvex2dShape.h>
#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btMultimaterialTriangleMeshShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <cmath>

#include "octoblisk_bullet/convert.h"

namespace octoblisk::testing {
namespace {

/// A mesh as a Bullet interface with two parts. The first part has half of the triangles.
class PartedMesh {
 public:
  explicit PartedMesh(const TriangleMesh& mesh) {
    for (const Vec3& vertex : mesh.vertices()) vertices_.push_back(toBullet(vertex));
    for (const auto& [a, b, c] : mesh.triangles()) indices_.insert(indices_.end(), {int(a), int(b), int(c)});
    const int count = int(mesh.triangleCount()), half = count / 2;
    addPart(0, half);
    addPart(half, count);
  }
  btStridingMeshInterface* operator&() { return &interface_; }
  const std::vector<TriangleId>& ids() const { return ids_; }

 private:
  void addPart(int begin, int end) {
    btIndexedMesh part;
    part.m_numTriangles = end - begin;
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices_.data() + 3 * begin);
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = int(vertices_.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_.data());
    part.m_vertexStride = sizeof(btVector3);
    for (int i = 0; i < end - begin; ++i) ids_.push_back({interface_.getNumSubParts(), i});
    interface_.addIndexedMesh(part);
  }

  std::vector<btVector3> vertices_;
  std::vector<int> indices_;
  std::vector<TriangleId> ids_;
  btTriangleIndexVertexArray interface_;
};

const btVector3 kScaling(btScalar(1.5), btScalar(-0.75), btScalar(1.25));

PartedMesh& source(Made& made, const SharedMesh& mesh) {
  made.mesh = rounded(*mesh);
  auto& parted = made.keep<PartedMesh>(*made.mesh);
  made.ids = parted.ids();
  return parted;
}

Made ours(const SharedMesh& mesh) {
  Made made;
  auto& shape = made.is<ClusteredOctreeShape>(&source(made, mesh));
  shape.setMargin(0);
  shape.setSolid(false);
  return made;
}

Made bvh(const SharedMesh& mesh) {
  Made made;
  made.is<btBvhTriangleMeshShape>(&source(made, mesh), true);
  return made;
}

/// Scales the shape's mesh and turns its triangles outward again, because the scaling mirrors.
void scaleMesh(Made& made) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : made.mesh->vertices())
    vertices.push_back(fromBullet(toBullet(vertex) * kScaling));
  std::vector<TriangleMesh::Indices> triangles = made.mesh->triangles();
  for (TriangleMesh::Indices& corners : triangles) std::swap(corners[1], corners[2]);
  made.mesh = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

Made scaledBvh(const SharedMesh& mesh) {
  Made made;
  auto& child = made.keep<btBvhTriangleMeshShape>(&source(made, mesh), true);
  made.is<btScaledBvhTriangleMeshShape>(&child, kScaling);
  scaleMesh(made);
  return made;
}

Made multimaterial(const SharedMesh& mesh) {
  Made made;
  made.is<btMultimaterialTriangleMeshShape>(&source(made, mesh), true);
  return made;
}

Made gimpact(const SharedMesh& mesh) {
  Made made;
  made.is<btGImpactMeshShape>(&source(made, mesh)).updateBound();
  return made;
}

Made scaledGImpact(const SharedMesh& mesh) {
  Made made = gimpact(mesh);
  made.shape->setLocalScaling(kScaling);
  static_cast<btGImpactMeshShape&>(*made.shape).updateBound();
  scaleMesh(made);
  return made;
}

/// A foreign shape with the plugin's shape type.
struct Foreign final : btBvhTriangleMeshShape {
  explicit Foreign(btStridingMeshInterface* mesh) : btBvhTriangleMeshShape(mesh, true) {
    m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  }
};

Made foreign(const SharedMesh& mesh) {
  Made made;
  made.is<Foreign>(&source(made, mesh));
  return made;
}

/// Scaled heights over a grid, with z up. Bullet puts the centre of the bounds at the origin.
Made heightfield(double amplitude) {
  constexpr int kWidth = 13, kLength = 11;
  const btVector3 scaling(btScalar(0.5), btScalar(0.75), btScalar(1.5));
  Made made;
  auto& heights = made.keep<std::vector<float>>();
  std::vector<Vec3> vertices;
  for (int y = 0; y < kLength; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      heights.push_back(float(amplitude * std::sin(0.9 * x) * std::cos(0.7 * y)));
      const btVector3 vertex(btScalar(x) - btScalar(kWidth - 1) / 2, btScalar(y) - btScalar(kLength - 1) / 2,
                             btScalar(heights.back()));
      vertices.push_back(fromBullet(vertex * scaling));
    }
  }
  std::vector<TriangleMesh::Indices> triangles;
  for (int y = 0; y + 1 < kLength; ++y) {
    for (int x = 0; x + 1 < kWidth; ++x) {
      const auto at = [&](int dx, int dy) { return static_cast<std::uint32_t>((y + dy) * kWidth + x + dx); };
      triangles.push_back({at(0, 0), at(1, 0), at(0, 1)});  // faces up; Bullet's face down
      triangles.push_back({at(1, 0), at(1, 1), at(0, 1)});
      made.ids.insert(made.ids.end(), {{2 * x, y}, {2 * x + 1, y}});
    }
  }
  made.mesh = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
  made.is<btHeightfieldTerrainShape>(kWidth, kLength, heights.data(), btScalar(-1), btScalar(1), 2, false)
      .setLocalScaling(scaling);
  return made;
}

Made plane(const Vec3& normal, double constant) {
  Made made;
  made.is<btStaticPlaneShape>(toBullet(normal), btScalar(constant));
  made.half_space = std::make_shared<HalfSpace>(HalfSpace{normal.normalized(), constant});
  return made;
}

template <typename Shape, typename... Arguments>
std::function<Made()> convex(const Arguments&... arguments) {
  return [=] {
    Made made;
    made.is<Shape>(arguments...);
    return made;
  };
}

std::vector<Vec3> randomPoints() {
  std::mt19937_64 random(33);
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) points.push_back(randomPoint(random, 0.6));
  return points;
}

Made hull(const std::vector<Vec3>& points) {
  Made made;
  auto& shape = made.is<btConvexHullShape>();
  for (const Vec3& point : points) shape.addPoint(toBullet(point));
  return made;
}

Made pointCloud() {
  Made made;
  auto& points = made.keep<std::vector<btVector3>>();
  for (const Vec3& point : randomPoints()) points.push_back(toBullet(point));
  made.is<btConvexPointCloudShape>(points.data(), int(points.size()), btVector3(1, 1, 1));
  return made;
}

Made triangleMeshHull(const Vec3& half_extents) {
  Made made;
  made.is<btConvexTriangleMeshShape>(&made.keep<PartedMesh>(*boxMesh(half_extents)));
  return made;
}

Made multiSphere() {
  const btVector3 centers[] = {
      {btScalar(-0.4), 0, 0}, {btScalar(0.4), btScalar(0.2), 0}, {0, 0, btScalar(0.5)}};
  const btScalar radii[] = {btScalar(0.4), btScalar(0.3), btScalar(0.2)};
  Made made;
  made.is<btMultiSphereShape>(centers, radii, 3);
  return made;
}

Made convex2d() {
  Made made;
  auto& child = made.keep<btConvexHullShape>();
  for (int i = 0; i < 5; ++i) child.addPoint(toBullet(Vec3(std::cos(1.25 * i), std::sin(1.25 * i), 0)));
  made.is<btConvex2dShape>(&child);
  return made;
}

Made uniformScaling() {
  Made made;
  auto& child = made.keep<btBoxShape>(toBullet(Vec3(0.3, 0.2, 0.4)));
  made.is<btUniformScalingShape>(&child, btScalar(1.75));
  return made;
}

/// A compound of a box and a sphere, or of two boxes with their tops at z = 0.
Made compound(bool floor) {
  Made made;
  auto& shape = made.is<btCompoundShape>();
  const auto add = [&](const Vec3& place, btCollisionShape& child) {
    shape.addChildShape(btTransform(btMatrix3x3::getIdentity(), toBullet(place)), &child);
  };
  if (floor) {
    auto& half = made.keep<btBoxShape>(toBullet(Vec3(3, 5, 0.5)));
    add({-3, 0, -0.5}, half);
    add({3, 0, -0.5}, half);
  } else {
    add({0.6, 0, 0}, made.keep<btBoxShape>(toBullet(Vec3(0.5, 0.4, 0.3))));
    add({-0.6, 0, 0.2}, made.keep<btSphereShape>(btScalar(0.4)));
  }
  return made;
}

Made movedDown(Made made) {  // uses a compound of one child, because convex shapes contain the origin
  auto child = made.shape;
  child->setMargin(0);  // beyond the points of the hull
  made.kept.push_back(child);
  made.is<btCompoundShape>().addChildShape(
      btTransform(btMatrix3x3::getIdentity(), btVector3(0, 0, btScalar(-0.5))), child.get());
  return made;
}

}  // namespace

void Made::setMargin(double margin) {
  shape->setMargin(btScalar(margin));
  if (auto* gimpact_shape = dynamic_cast<btGImpactShapeInterface*>(shape.get())) gimpact_shape->updateBound();
}

SharedMesh rounded(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(fromBullet(toBullet(vertex)));
  return std::make_shared<const TriangleMesh>(std::move(vertices), mesh.triangles());
}

std::vector<Partner> concavePartners(const SharedMesh& body) {
  const auto of = [&](std::string name, double spread, Made (*make)(const SharedMesh&)) {
    return Partner{std::move(name), spread, [=] { return make(body); },
                   [=] { return make(waveSheet(5, 0.0, 20)); }};
  };
  return {of("ours", 3.3, ours),
          of("bvh", 3.3, bvh),
          of("scaledBvh", 3.5, scaledBvh),
          of("multimaterial", 3.3, multimaterial),
          of("gimpact", 3.3, gimpact),
          of("gimpactScaled", 3.5, scaledGImpact),
          of("foreign", 3.3, foreign),
          {"heightfield", 4.5, [] { return heightfield(0.6); }, [] { return heightfield(0.0); }},
          {"plane", 5.0,
           [] {
             return plane({1, 2, 2}, -1.25);
           },
           [] {
             return plane({0, 0, 1}, 0);
           }}};
}

std::vector<Partner> convexPartners() {
  const Vec3 slab(5, 5, 0.5);
  std::vector<Vec3> slab_corners;
  for (int corner = 0; corner < 8; ++corner) {
    slab_corners.push_back(
        slab.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)));
  }
  return {{"box", 2.4, convex<btBoxShape>(toBullet(Vec3(0.7, 0.5, 0.3))),
           [=] { return movedDown(convex<btBoxShape>(toBullet(slab))()); }},
          {"sphere", 2.4, convex<btSphereShape>(btScalar(0.6))},
          {"capsule", 2.4, convex<btCapsuleShape>(btScalar(0.4), btScalar(0.8))},
          {"cylinder", 2.4, convex<btCylinderShape>(toBullet(Vec3(0.5, 0.6, 0.5))),
           [=] { return movedDown(convex<btCylinderShapeZ>(toBullet(slab))()); }},
          {"cone", 2.4, convex<btConeShape>(btScalar(0.6), btScalar(1.0))},
          {"hull", 2.4, [] { return hull(randomPoints()); }, [=] { return movedDown(hull(slab_corners)); }},
          {"pointCloud", 2.4, pointCloud},
          {"triangleMeshHull", 2.4,
           [] {
             return triangleMeshHull({0.7, 0.5, 0.3});
           },
           [=] { return movedDown(triangleMeshHull(slab)); }},
          {"multiSphere", 2.4, multiSphere},
          {"simplex", 2.4,
           convex<btBU_Simplex1to4>(btVector3(-1, -1, 0), btVector3(1, 0, 0), btVector3(0, 1, 0),
                                    btVector3(0, 0, 1))},
          {"triangle", 2.4,
           convex<btTriangleShape>(btVector3(-1, -1, 0), btVector3(1, 0, 0), btVector3(0, 1, 0))},
          {"box2d", 2.4, convex<btBox2dShape>(toBullet(Vec3(0.8, 0.6, 0)))},
          {"convex2d", 2.4, convex2d},
          {"uniformScaling", 2.4, uniformScaling},
          {"compound", 2.4, [] { return compound(false); }, [] { return compound(true); }}};
}

}  // namespace octoblisk::testing
