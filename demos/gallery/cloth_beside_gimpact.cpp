// A cloth falls on a channel of our shape and, beside it, on a channel of GImpact's, whose algorithm takes
// every pair with its meshes, soft bodies included, although it does not support those.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <algorithm>

#include "gallery/bullet_mesh.h"
#include "gallery/bullet_world.h"
#include "gallery/gallery_scene.h"
#include "octoblisk/clustered_octree.h"
#include "shapes/bodies.h"

namespace octoblisk::gallery {
namespace {

/// A world with a floor, a channel that may move and a cloth above it. Lengths in m.
class ClothOnChannel {
 public:
  static constexpr double kStep = 1.0 / 240.0;                               ///< s
  static constexpr double kHalfWidth = 0.5, kHalfDepth = 0.3, kWall = 0.12;  ///< of the channel
  static constexpr double kHalfFloor = 1.15, kHalfCloth = 0.9, kHeight = 0.8, kMargin = 0.02;
  static constexpr std::uint32_t kNodes = 41;  ///< along each side of the cloth

  /// The algorithms of the channel's shape must be registered with `dispatcher()`.
  explicit ClothOnChannel(btCollisionShape& channel) : channel_(2, nullptr, &channel, inertiaOf(channel, 2)) {
    world_.setGravity(btVector3(0, 0, btScalar(-9.81)));
    btSoftBodyWorldInfo& info = world_.getWorldInfo();
    info.m_gravity = world_.getGravity();
    info.m_sparsesdf.setDefaultVoxelsz(btScalar(kWall));  // as fine as the details that the cloth must detect
    info.m_sparsesdf.Reset();
    floor_.setWorldTransform(at(0, 0, -0.1));
    const btQuaternion opening_upward(btVector3(1, 0, 0), SIMD_HALF_PI);
    channel_.setWorldTransform(btTransform(opening_upward, toBullet(Vec3(0, 0, kHalfDepth + kMargin))));
    for (btRigidBody* body : {&floor_, &channel_}) {
      body->setFriction(btScalar(0.5));
      world_.addRigidBody(body);
    }
    const auto corner = [](double x, double y) { return toBullet(Vec3(x, y, kHeight)); };
    cloth_.reset(btSoftBodyHelpers::CreatePatch(
        info, corner(-kHalfCloth, -kHalfCloth), corner(kHalfCloth, -kHalfCloth),
        corner(-kHalfCloth, kHalfCloth), corner(kHalfCloth, kHalfCloth), int(kNodes), int(kNodes), 0, true));
    cloth_->setTotalMass(btScalar(0.5));
    cloth_->m_cfg.piterations = 4;
    cloth_->m_cfg.kDP = btScalar(0.02);
    cloth_->getCollisionShape()->setMargin(btScalar(kMargin));
    world_.addSoftBody(cloth_.get());
  }
  ~ClothOnChannel() {
    world_.removeSoftBody(cloth_.get());
    for (btRigidBody* body : {&floor_, &channel_}) world_.removeRigidBody(body);
  }
  ClothOnChannel(const ClothOnChannel&) = delete;
  ClothOnChannel& operator=(const ClothOnChannel&) = delete;

  btCollisionDispatcher& dispatcher() { return dispatcher_; }
  void step() { world_.stepSimulation(btScalar(kStep), 0); }
  Pose channel() const { return fromBullet(channel_.getWorldTransform()); }

  TriangleMesh cloth() const {
    std::vector<Vec3> nodes;
    for (int n = 0; n < cloth_->m_nodes.size(); ++n) nodes.push_back(fromBullet(cloth_->m_nodes[n].m_x));
    std::vector<TriangleMesh::Indices> triangles;
    for (std::uint32_t i = 0; i + 1 < kNodes; ++i) {
      for (std::uint32_t j = 0; j + 1 < kNodes; ++j) {
        const std::uint32_t a = i * kNodes + j;
        triangles.push_back({a, a + 1, a + kNodes + 1});
        triangles.push_back({a, a + kNodes + 1, a + kNodes});
      }
    }
    return {std::move(nodes), std::move(triangles)};
  }

 private:
  static btVector3 inertiaOf(const btCollisionShape& shape, double mass) {
    btVector3 inertia(0, 0, 0);
    shape.calculateLocalInertia(btScalar(mass), inertia);
    return inertia;
  }

  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btBoxShape floor_shape_{toBullet(Vec3(kHalfFloor, kHalfFloor, 0.1))};
  btRigidBody floor_{0, nullptr, &floor_shape_};
  btRigidBody channel_;
  std::unique_ptr<btSoftBody> cloth_;
};

class ClothBesideGimpact final : public GalleryScene {
 public:
  explicit ClothBesideGimpact(const BuildOptions& tree)
      : ours_shape_(std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh_, tree))) {
    ours_shape_.setMargin(btScalar(ClothOnChannel::kMargin));
    gimpact_shape_.setMargin(btScalar(ClothOnChannel::kMargin));
    gimpact_shape_.updateBound();
    ours_ = std::make_unique<ClothOnChannel>(ours_shape_);
    gimpact_ = std::make_unique<ClothOnChannel>(gimpact_shape_);
    registerAlgorithm(&ours_->dispatcher());
    btGImpactCollisionAlgorithm::registerAlgorithm(&gimpact_->dispatcher());
  }

  void step() override {
    ours_->step();
    gimpact_->step();
  }

  demos::Picture picture() const override {
    demos::Picture picture;
    addTo(picture.scene, *ours_, -ClothOnChannel::kHalfFloor - 0.15, demos::palette::kSky);
    addTo(picture.scene, *gimpact_, ClothOnChannel::kHalfFloor + 0.15, demos::palette::kPurple);
    picture.annotation.legend = {{demos::palette::kSky, "ClusteredOctreeShape"},
                                 {demos::palette::kPurple, "btGImpactMeshShape"},
                                 {demos::palette::kSand, "cloth, a btSoftBody"}};
    const double side = 2.0 * ClothOnChannel::kHalfFloor + 0.15;
    picture.camera = demos::frame(Aabb{Vec3(-side, -ClothOnChannel::kHalfFloor, 0.0),
                                       Vec3(side, ClothOnChannel::kHalfFloor, ClothOnChannel::kHeight)},
                                  {0.0, 1.0, -0.75}, Vec3::UnitZ());
    return picture;
  }

  std::vector<Number> numbers() const override {
    return {{"cloth_top_m", topOf(*ours_)}, {"cloth_top_gimpact_m", topOf(*gimpact_)}};
  }

 private:
  void addTo(demos::Scene& scene, const ClothOnChannel& world, double x, const demos::Color& color) const {
    const Pose there{Mat3::Identity(), Vec3(x, 0, 0)};
    const shapes::SharedMesh floor =
        shapes::boxMesh({ClothOnChannel::kHalfFloor, ClothOnChannel::kHalfFloor, 0.05});
    scene.addMesh(*floor, there * Pose{Mat3::Identity(), Vec3(0, 0, -0.05)}, demos::palette::kSteel);
    scene.addMesh(*mesh_, there * world.channel(), color);
    scene.addMesh(world.cloth(), there, demos::palette::kSand);
  }

  static double topOf(const ClothOnChannel& world) {
    const TriangleMesh mesh = world.cloth();
    double top = 0.0;
    for (const Vec3& node : mesh.vertices()) top = std::max(top, node.z());
    return top;
  }

  shapes::SharedMesh mesh_ =
      shapes::uProfile(ClothOnChannel::kHalfWidth, ClothOnChannel::kHalfDepth, ClothOnChannel::kWall, 0.5);
  BulletMesh source_{*mesh_};
  ClusteredOctreeShape ours_shape_;
  btGImpactMeshShape gimpact_shape_{source_.view()};
  std::unique_ptr<ClothOnChannel> ours_, gimpact_;
};

}  // namespace

std::unique_ptr<GalleryScene> makeClothBesideGimpact(const BuildOptions& tree) {
  return std::make_unique<ClothBesideGimpact>(tree);
}

}  // namespace octoblisk::gallery
