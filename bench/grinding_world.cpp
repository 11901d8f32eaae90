#include "grinding_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>

#include "models/belt_grinder.h"
#include "models/blade_finder.h"
#include "models/shared_tree.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/kinematic_body.h"
#include "octoblisk_bullet/register.h"
#include "shared/meshes.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::bench {
namespace {

using testing::uniform;

constexpr double kLooseRadius = 3.0;  // of a sphere around any loose body
constexpr double kClear = 1.0;        // from anything else at the start

/// The path in steps of equal time.
std::vector<Pose> drivenAlong(const std::vector<Pose>& path) {
  constexpr double kStep = GrindingScene::kFeed * GrindingScene::kTimeStep;
  std::vector<Pose> steps = {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Pose &from = path[i - 1], &to = path[i];
    const Eigen::Quaterniond turn_from(from.rotation), turn_to(to.rotation);
    const int count =
        std::max(1, static_cast<int>(std::ceil((to.translation - from.translation).norm() / kStep)));
    for (int k = 1; k <= count; ++k) {
      const double part = static_cast<double>(k) / count;
      steps.push_back({turn_from.slerp(part, turn_to).toRotationMatrix(),
                       from.translation + part * (to.translation - from.translation)});
    }
  }
  return steps;
}

/// Finds seeded places for loose bodies, clear of everything else.
class LoosePlaces {
 public:
  explicit LoosePlaces(GrindingScene& scene) : scene_(scene), surface_(*scene.blisk) {}

  /// Adds `count` places between two radii and two heights.
  void add(int count, double least_radius, double most_radius, double low, double high) {
    constexpr int kMaxTries = 1'000'000;
    int tries = 0;
    for (int added = 0; added < count && tries < kMaxTries; ++tries) {
      const double angle = uniform(random_, 0, 2.0 * std::numbers::pi);
      const double radius =
          std::sqrt(uniform(random_, least_radius * least_radius, most_radius * most_radius));
      const Vec3 place(radius * std::cos(angle), radius * std::sin(angle), uniform(random_, low, high));
      if (!isClear(place)) continue;
      scene_.loose.push_back({testing::randomRotation(random_), place});
      ++added;
    }
    if (tries == kMaxTries) throw std::invalid_argument(scene_.name + ": no room for loose bodies");
  }

 private:
  bool isClear(const Vec3& place) const {
    constexpr double kApart = kLooseRadius + kClear;
    for (const Pose& other : scene_.loose) {
      if ((other.translation - place).norm() < kApart + kLooseRadius) return false;
    }
    if (closestPoint(*scene_.blisk, place, kApart) || locate(surface_, place) == PointLocation::inside)
      return false;
    const Vec3 in_tool = scene_.tool_in_blisk.front().inverse() * place;
    return std::ranges::none_of(
        scene_.tool, [&](const auto& part) { return closestPoint(*part, in_tool, kApart).has_value(); });
  }

  GrindingScene& scene_;
  Surface surface_;
  std::mt19937_64 random_{17};
};

/// The convex hull of points on a sphere.
std::unique_ptr<btCollisionShape> chip() {
  std::mt19937_64 random(18);
  auto hull = std::make_unique<btConvexHullShape>();
  for (int corner = 0; corner < 12; ++corner)
    hull->addPoint(toBullet(0.9 * kLooseRadius * (testing::randomRotation(random) * Vec3::UnitX())), false);
  hull->recalcLocalAabb();
  return hull;
}

}  // namespace

GrindingScene makeGrindingScene(std::string name, TriangleMesh blisk) {
  GrindingScene scene;
  scene.name = std::move(name);
  scene.blisk = demos::treeOf(std::move(blisk));
  const TriangleMesh& mesh = scene.blisk->mesh();
  const demos::BladesFound blades = demos::findBlades(mesh);
  scene.blade_of_triangle = blades.blade_of_triangle;
  scene.tool = {demos::treeOf(demos::makeBelt()), demos::treeOf(demos::makeContactWheel()),
                demos::treeOf(demos::makeDriveWheel()), demos::treeOf(demos::makeArm())};
  scene.tool_in_blisk = drivenAlong(demos::makeGrindingPath(mesh, blades));

  Aabb of_blades;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (scene.blade_of_triangle[t] == 0) continue;
    for (const Vec3& corner : mesh.triangle(t)) of_blades.extend(corner);
  }
  LoosePlaces places(scene);
  places.add(80, 0.0, blades.root_radius, mesh.bounds().min.z(), mesh.bounds().max.z());
  places.add(120, blades.root_radius, blades.tip_radius, of_blades.min.z(), of_blades.max.z());
  return scene;
}

GrindingWorld::GrindingWorld(const GrindingScene& scene, Mount mount, btBroadphaseInterface& broadphase)
    : broadphase_(broadphase),
      world_(&dispatcher_, &broadphase, &solver_, &configuration_),
      blisk_shape_(scene.blisk),
      tool_parts_(scene.tool.size()) {
  blisk_shape_.setMargin(0);
  registerAlgorithm(&dispatcher_);
  world_.setGravity(btVector3(0, 0, 0));
  if (mount == Mount::spindle) {
    constexpr btScalar kMass = 20, kMaxImpulse = btScalar(1e6);
    btRigidBody& blisk = addDynamic(blisk_shape_, kMass, Pose());
    auto hinge = std::make_unique<btHingeConstraint>(blisk, btVector3(0, 0, 0), btVector3(0, 0, 1));
    hinge->enableAngularMotor(true, 0, kMaxImpulse);
    world_.addConstraint(hinge.get());
    hinge_ = std::move(hinge);
  } else {
    bodies_.push_back(std::make_unique<btRigidBody>(0, nullptr, &blisk_shape_));
    if (mount == Mount::table) {
      bodies_.back()->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
      bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
      world_.addRigidBody(bodies_.back().get(), btBroadphaseProxy::DefaultFilter,
                          btBroadphaseProxy::AllFilter);
    } else {
      world_.addRigidBody(bodies_.back().get());
    }
  }
  for (const auto& part : scene.tool) {
    shapes_.push_back(std::make_unique<ClusteredOctreeShape>(part));
    shapes_.back()->setMargin(0);
    bodies_.push_back(std::make_unique<btRigidBody>(0, nullptr, shapes_.back().get()));
    bodies_.back()->setWorldTransform(toBullet(scene.tool_in_blisk.front()));
    bodies_.back()->setInterpolationWorldTransform(bodies_.back()->getWorldTransform());
    addKinematicBody(world_, *bodies_.back());
  }
  std::unique_ptr<btCollisionShape> kinds[] = {std::make_unique<btSphereShape>(btScalar(2)),
                                               std::make_unique<btBoxShape>(btVector3(2, btScalar(1.5), 1)),
                                               chip()};
  for (std::size_t k = 0; k < scene.loose.size(); ++k) {
    btRigidBody& body = addDynamic(*kinds[k % std::size(kinds)], btScalar(0.001), scene.loose[k]);
    body.setDamping(btScalar(0.5), btScalar(0.5));
  }
  for (auto& kind : kinds) shapes_.push_back(std::move(kind));
}

GrindingWorld::~GrindingWorld() {
  if (hinge_) world_.removeConstraint(hinge_.get());
  for (const auto& body : bodies_) world_.removeRigidBody(body.get());
}

btRigidBody& GrindingWorld::addDynamic(btCollisionShape& shape, btScalar mass, const Pose& pose) {
  btVector3 inertia;
  shape.calculateLocalInertia(mass, inertia);
  bodies_.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
  btRigidBody& body = *bodies_.back();
  body.setWorldTransform(toBullet(pose));
  body.setInterpolationWorldTransform(body.getWorldTransform());
  world_.addRigidBody(&body);
  return body;
}

void GrindingWorld::step(const Pose& tool_in_blisk) {
  for (std::size_t part = 1; part <= tool_parts_; ++part)
    bodies_[part]->setWorldTransform(toBullet(tool_in_blisk));
  world_.stepSimulation(btScalar(GrindingScene::kTimeStep), 0);
}

int GrindingWorld::pairs() { return broadphase_.getOverlappingPairCache()->getNumOverlappingPairs(); }

int GrindingWorld::toolContacts() {
  const btCollisionObject* blisk = bodies_.front().get();
  int points = 0;
  for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
    const btCollisionObject *a = manifold.getBody0(), *b = manifold.getBody1();
    if ((a == blisk && b->isKinematicObject()) || (b == blisk && a->isKinematicObject()))
      points += manifold.getNumContacts();
  }
  return points;
}

double GrindingWorld::bliskTurned() const {
  return double(bodies_.front()->getWorldTransform().getRotation().getAngleShortestPath()) * 180.0 /
         std::numbers::pi;
}

int GrindingWorld::awakeBodies() const {
  return static_cast<int>(std::ranges::count_if(
      bodies_, [](const auto& body) { return !body->isStaticOrKinematicObject() && body->isActive(); }));
}

int GrindingWorld::awakeIslands() const {
  std::set<int> islands;
  for (const auto& body : bodies_) {
    if (!body->isStaticOrKinematicObject() && body->isActive()) islands.insert(body->getIslandTag());
  }
  return static_cast<int>(islands.size());
}

}  // namespace octoblisk::bench
