// Runs every example of the guides in docs/, extracted unchanged from its page.
#include <cstdio>
#include <filesystem>

#include "guide/bullet.h"
#include "guide/core.h"
#include "guide/first-shape.h"
#include "guide/how-it-works.h"
#include "guide/migrating.h"
#include "guide/threads.h"
#include "guide/units.h"
#ifdef WITH_IMPORTER
#include "guide/saving.h"
#endif

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  std::printf("%s: %s\n", holds ? "ok" : "FAILED", what);
  failures += !holds;
}

bool isNear(double number, double expected, double tolerance) {
  return std::abs(number - expected) <= tolerance;
}

octoblisk::TriangleMesh meshOf(int segments, btScalar radius, btScalar half_width) {
  btTriangleMesh ring;
  addRing(ring, segments, radius, half_width);
  return octoblisk::ClusteredOctreeShape(&ring).tree().mesh();
}

void runFirstShape() {
  btScalar ring = 0, ball = 0;
  dropRingAndBall(ring, ball);
  expect(isNear(ring, 0.2, 0.02), "first-shape: the ring lies on the floor");
  expect(isNear(ball, 0.3, 0.02), "first-shape: the ball lies in its hole");
}

/// Drops a ring of each of the three shapes and compares its final height over the floor.
void runMigrating() {
  btTriangleMesh mesh, wider;
  addRing(mesh, 16, 1, btScalar(0.2));
  addRing(wider, 16, 2, btScalar(0.2));
  FirstWorld first;
  const std::unique_ptr<btConcaveShape> bvh(bvhShape(&mesh)), gimpact(gimpactShape(&mesh, first.dispatcher)),
      ours(ourShape(&mesh, first.dispatcher));
  btBoxShape box(btVector3(btScalar(0.1), btScalar(0.1), btScalar(0.1)));
  const auto contactsWithBox = [&](btConcaveShape* shape, btScalar x) {
    btRigidBody mesh_body(0, nullptr, shape), box_body(0, nullptr, &box);
    box_body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(x, 0, btScalar(0.25))));
    struct Count final : btCollisionWorld::ContactResultCallback {
      int contacts = 0;
      btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int,
                               const btCollisionObjectWrapper*, int, int) override {
        ++contacts;
        return 0;
      }
    } count;
    first.world.contactPairTest(&mesh_body, &box_body, count);
    return count.contacts;
  };
  for (btConcaveShape* shape : {bvh.get(), gimpact.get(), ours.get()}) {
    expect(contactsWithBox(shape, 1) > 0 && contactsWithBox(shape, 0) == 0,
           "migrating: a box meets ring, not hole");
  }
  btRigidBody body(0, nullptr, ours.get());
  first.world.addRigidBody(&body);
  moveVertices(first.world, body, wider);
  first.world.removeRigidBody(&body);
  expect(contactsWithBox(ours.get(), 2) > 0 && contactsWithBox(ours.get(), 1) == 0,
         "migrating: the ring is wider");
}

void runUnits() {
  btTriangleMesh mesh;
  addRing(mesh, 32, 1000, 200);
  octoblisk::ClusteredOctreeShape shape(&mesh);
  btStaticPlaneShape floor_shape(btVector3(0, 0, 1), 0);
  btVector3 inertia;
  shape.calculateLocalInertia(1, inertia);
  btRigidBody ring(1, nullptr, &shape, inertia), floor(0, nullptr, &floor_shape);
  ring.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 300)));
  FirstWorld first;
  first.world.addRigidBody(&floor);
  first.world.addRigidBody(&ring);
  useMillimetres(first.world);
  for (int step = 0; step < 480; ++step) first.world.stepSimulation(btScalar(1) / 240, 0);
  expect(isNear(ring.getWorldTransform().getOrigin().z(), 205, 10), "units: the ring lies on its margin");
  first.world.removeRigidBody(&ring);
  first.world.removeRigidBody(&floor);
}

void runHowItWorks() {
  const auto mesh = std::make_shared<const octoblisk::TriangleMesh>(meshOf(128, 1, btScalar(0.2)));
  const auto tree = octoblisk::ClusteredOctree::build(mesh);
  expect(isNear(volumeLeft(tree, 0), 1, 1e-6), "how-it-works: the root's box is all");
  expect(volumeLeft(tree, 1) < 0.9 && volumeLeft(tree, 64) < volumeLeft(tree, 1),
         "how-it-works: boxes fit closer");
  expect(meets(tree, {0.5, 0, 0}).has_value() && !meets(tree, {0, 0, 0.5}), "how-it-works: rings meet");
}

void runCore() {
  const auto mesh = std::make_shared<const octoblisk::TriangleMesh>(meshOf(32, 1, btScalar(0.2)));
  const auto wider = std::make_shared<const octoblisk::TriangleMesh>(meshOf(32, 2, btScalar(0.2)));
  octoblisk::ClusteredOctree tree = treeOfSoftBody(mesh);
  follow(tree, wider);
  expect(tree.sharedMesh() == wider, "core: the tree follows the mesh");
  expect(isNear(gapBetween(tetrahedron(), tetrahedron(), {.translation = {3, 0, 0}}), 2, 1e-12),
         "core: the distance of two tetrahedra");
  expect(gapBetween(tetrahedron(), tetrahedron(), {.translation = {0.5, 0, 0}}) == 0, "core: they touch");
  const std::filesystem::path file = "guide_example.tree";
  std::filesystem::remove(file);
  const auto isCompact = [](const octoblisk::ClusteredOctree& read) {
    return read.options().storage == octoblisk::Storage::compact;
  };
  expect(isCompact(treeFrom(file, mesh)) && std::filesystem::exists(file), "core: built and saved");
  expect(isCompact(treeFrom(file, mesh)), "core: mapped");
  expect(treeFrom(file, wider).mesh().triangleCount() == 256, "core: built for another mesh");
  std::filesystem::remove(file);

  const octoblisk::ConvexHull ball({octoblisk::Vec3::Zero()}, 0.25);
  std::vector<octoblisk::Pose> down(3);
  for (std::size_t k = 0; k < down.size(); ++k) down[k].translation = {2, 0, 0.6 - 0.1 * double(k)};
  const std::vector<double> clear = clearances(tree, ball, down, 0.1);
  expect(clear[0] == 0.1 && isNear(clear[1], 0.05, 1e-6) && isNear(clear[2], -0.05, 1e-6),
         "core: a ball comes down on a ring");
}

void runThreads() {
  const auto mesh = std::make_shared<const octoblisk::TriangleMesh>(meshOf(32, 1, btScalar(0.2)));
  const auto tree = octoblisk::ClusteredOctree::build(mesh);
  std::array<octoblisk::Pose, 2> poses;
  poses[0].translation = {0, 0, 0.5};
  poses[1].translation = {0.5, 0, 0};
  expect(isNear(leastDistance(tree, tree, {poses[0]}), 0.1, 1e-6), "threads: distance of two rings");
  expect(askTwice(tree, tree, poses) == std::array{false, true}, "threads: two threads ask");
}

#ifdef WITH_IMPORTER
void runSaving() {
  btTriangleMesh mesh;
  addRing(mesh, 16, 1, btScalar(0.2));
  octoblisk::ClusteredOctreeShape shape(&mesh);
  btVector3 inertia;
  shape.calculateLocalInertia(2, inertia);
  btRigidBody ring(2, nullptr, &shape, inertia);
  FirstWorld first, second;
  first.world.addRigidBody(&ring);
  octoblisk::WorldImporter importer(&second.world);
  expect(loadWorld(saveWorld(first.world), importer), "saving: the file is read");
  const auto* again = btRigidBody::upcast(importer.getRigidBodyByIndex(0));
  expect(again->getInvMass() == ring.getInvMass() &&
             dynamic_cast<const octoblisk::ClusteredOctreeShape*>(again->getCollisionShape()),
         "saving: mass and shape come back");
  importer.deleteAllData();
  first.world.removeRigidBody(&ring);
}
#endif

/// Drops a body so fast that it is above the floor at one step and below it at the next.
bool isHeld(bool clamped) {
  btTriangleMesh mesh, wide;
  addRing(mesh, 16, 1, btScalar(0.2));
  addRing(wide, 16, 3, btScalar(0.2));
  octoblisk::ClusteredOctreeShape shape(&mesh), floor_shape(&wide);
  btVector3 inertia;
  shape.calculateLocalInertia(1, inertia);
  btRigidBody ring(1, nullptr, &shape, inertia), floor(0, nullptr, &floor_shape);
  ring.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(3, 0, 1)));
  ring.setLinearVelocity(btVector3(0, 0, -500));
  FirstWorld first;
  octoblisk::MotionClamping clamping;
  first.world.addRigidBody(&floor);
  first.world.addRigidBody(&ring);
  if (clamped) clampMotions(first.world, clamping, btScalar(0.4));
  for (int step = 0; step < 10; ++step) first.world.stepSimulation(btScalar(1) / 240, 0);
  const btScalar height = ring.getWorldTransform().getOrigin().z();
  if (clamped) first.world.removeAction(&clamping);
  first.world.removeRigidBody(&ring);
  first.world.removeRigidBody(&floor);
  return height > 0;
}

void runBullet() {
  btTriangleMesh mesh;
  addRing(mesh, 16, 1, btScalar(0.2));
  octoblisk::ClusteredOctreeShape shape(&mesh);
  btRigidBody lower(1, nullptr, &shape), upper(1, nullptr, &shape);
  upper.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 1)));
  upper.setLinearVelocity(btVector3(0, 0, -500));
  const btScalar step = btScalar(1) / 240;
  expect(isNear(timeUntilImpact(upper, lower, step), 0.6 / 500, 1e-4), "bullet: a fast ring meets another");
  upper.setLinearVelocity(btVector3(0, 0, 500));
  expect(timeUntilImpact(upper, lower, step) == step, "bullet: a ring that moves away meets nothing");

  FirstWorld first;
  upper.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.35))));
  const btCollisionObject* a = nullptr;
  const std::vector<octoblisk::Contact> contacts = allContacts(first.world, upper, lower, a);
  expect(contacts.size() > 16 && (a == &upper || a == &lower), "bullet: all contacts of two rings");
  expect(isNear(depthOf(upper, lower, 1e-6), 0.05, 1e-3), "bullet: a ring is deep in another");
}

}  // namespace

int main() {
  runBullet();
  runFirstShape();
  runMigrating();
  runUnits();
  runHowItWorks();
  runCore();
  runThreads();
#ifdef WITH_IMPORTER
  runSaving();
#endif
  expect(isHeld(true) && !isHeld(false), "limits: a fast ring is held by clamping alone");
  return failures == 0 ? 0 : 1;
}
