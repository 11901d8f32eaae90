// ODE's triangle meshes (OPCODE: axis-aligned boxes in single precision).
#include <ode/ode.h>

#include <cstdarg>
#include <cstdint>

#include "contender.h"
#include "rated_nut.h"

namespace octoblisk::bench {
namespace {

/// Must be constructed before any other ODE object.
struct OdeLibrary {
  OdeLibrary() {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    dSetMessageHandler([](int, const char*, va_list) {});  // one for most contacts of a nut
  }
};

/// A mesh in ODE's layout, and its tree.
class OdeMesh {
 public:
  explicit OdeMesh(const TriangleMesh& mesh) {
    static const OdeLibrary library;
    for (const Vec3& vertex : mesh.vertices()) {
      for (const double x : vertex) vertices_.push_back(static_cast<float>(x));
    }
    for (const auto& corners : mesh.triangles())
      triangles_.insert(triangles_.end(), corners.begin(), corners.end());
  }
  ~OdeMesh() { clear(); }
  OdeMesh(const OdeMesh&) = delete;
  OdeMesh& operator=(const OdeMesh&) = delete;

  void build() {
    clear();
    data_ = dGeomTriMeshDataCreate();
    constexpr int kStride = 3 * sizeof(float);
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), kStride, static_cast<int>(vertices_.size() / 3),
                                triangles_.data(), static_cast<int>(triangles_.size()), kStride);
    geom_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }

  void clear() {
    if (data_ == nullptr) return;
    dGeomDestroy(geom_);
    dGeomTriMeshDataDestroy(data_);
    data_ = nullptr;
  }

  /// Fits the boxes to the vertices of a mesh with the same triangles.
  void refit(const TriangleMesh& deformed) {
    std::size_t k = 0;
    for (const Vec3& vertex : deformed.vertices()) {
      for (const double x : vertex) vertices_[k++] = static_cast<float>(x);
    }
    dGeomTriMeshDataUpdate(data_);
  }

  dGeomID geom() const { return geom_; }

 private:
  std::vector<float> vertices_;
  std::vector<std::uint32_t> triangles_;
  dTriMeshDataID data_ = nullptr;
  dGeomID geom_ = nullptr;
};

class Ode final : public CollideQuery, public ContactsQuery, public RefitQuery {
 public:
  explicit Ode(const Scene& scene)
      : mesh_(scene.blisk), blisk_(*scene.blisk), belt_(*scene.belt), found_(kMaxContacts) {
    blisk_.build();
    belt_.build();
  }

  bool collides(const Pose& belt_in_blisk, bool) override {
    return ask(belt_in_blisk, 1 | static_cast<int>(CONTACTS_UNIMPORTANT)) > 0;
  }

  std::size_t contacts(const Pose& belt_in_blisk) override {
    return static_cast<std::size_t>(ask(belt_in_blisk, kMaxContacts));
  }

  void refit(bool bent) override {
    if (!bent_) bent_ = bench::bent(*mesh_);
    blisk_.refit(bent ? *bent_ : *mesh_);
  }
  bool touches(const Pose& belt_in_blisk) override { return collides(belt_in_blisk, false); }

  /// ODE merges contacts that are close to each other.
  bool countsPairs() const override { return false; }

 private:
  static constexpr int kMaxContacts = 0xffff;

  int ask(const Pose& belt_in_blisk, int flags) {
    const Mat3& r = belt_in_blisk.rotation;
    const Vec3& t = belt_in_blisk.translation;
    const dMatrix3 rotation = {r(0, 0), r(0, 1), r(0, 2), 0,       r(1, 0), r(1, 1),
                               r(1, 2), 0,       r(2, 0), r(2, 1), r(2, 2), 0};
    dGeomSetPosition(belt_.geom(), t.x(), t.y(), t.z());
    dGeomSetRotation(belt_.geom(), rotation);
    return dCollide(blisk_.geom(), belt_.geom(), flags, found_.data(), sizeof(dContactGeom));
  }

  std::shared_ptr<const TriangleMesh> mesh_, bent_;
  OdeMesh blisk_, belt_;
  std::vector<dContactGeom> found_;
};

/// In mm: some of ODE's tolerances are lengths. Everything else is ODE's default.
class OdeNut final : public RatedNut {
 public:
  explicit OdeNut(const Scene&)
      : run_(kNutThread, kNutPitches),
        bolt_(*shapes::scaled(*run_.boltMesh(), kMillimetres)),
        nut_(*shapes::scaled(*run_.nutMesh(), kMillimetres)),
        found_(kMaxContacts) {
    bolt_.build();
    nut_.build();
    dWorldSetGravity(world_, 0, 0, -9810);
    dMass mass;
    const Vec3 moments = kMillimetres * kMillimetres * run_.moments();
    dMassSetParameters(&mass, gallery::NutRun::kMass, 0, 0, 0, moments.x(), moments.y(), moments.z(), 0, 0,
                       0);
    dBodySetMass(body_, &mass);
    dGeomSetBody(nut_.geom(), body_);
  }
  ~OdeNut() override {
    dJointGroupDestroy(contacts_);
    dWorldDestroy(world_);
  }
  OdeNut(const OdeNut&) = delete;
  OdeNut& operator=(const OdeNut&) = delete;

 private:
  static constexpr double kMillimetres = 1e3;  ///< in a metre
  static constexpr int kMaxContacts = 0xffff;

  void putBack() override {
    const Vec3 start = kMillimetres * run_.poseAt(0).translation;
    const dQuaternion upright = {1, 0, 0, 0};
    dBodySetPosition(body_, start.x(), start.y(), start.z());
    dBodySetQuaternion(body_, upright);
    dBodySetLinearVel(body_, 0, 0, 0);
    dBodySetAngularVel(body_, 0, 0, 0);
    run_.noticeRestart();
  }
  void advance() override {
    const int count = dCollide(bolt_.geom(), nut_.geom(), kMaxContacts, found_.data(), sizeof(dContactGeom));
    for (int k = 0; k < count; ++k) {
      dContact contact{};  // without friction
      contact.geom = found_[static_cast<std::size_t>(k)];
      dJointAttach(dJointCreateContact(world_, contacts_, &contact), nullptr, body_);
    }
    dWorldQuickStep(world_, gallery::NutRun::kTimeStep);
    dJointGroupEmpty(contacts_);
    const dReal* r = dBodyGetRotation(body_);
    const dReal* p = dBodyGetPosition(body_);
    Pose pose;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) pose.rotation(row, column) = r[4 * row + column];
      pose.translation[row] = p[row] / kMillimetres;
    }
    run_.notice(pose);
  }
  const gallery::NutRun& run() const override { return run_; }

  gallery::NutRun run_;
  OdeMesh bolt_, nut_;
  dWorldID world_ = dWorldCreate();
  dJointGroupID contacts_ = dJointGroupCreate(0);
  dBodyID body_ = dBodyCreate(world_);
  std::vector<dContactGeom> found_;
};

class OdeBuild final : public BuildQuery {
 public:
  explicit OdeBuild(const Scene& scene) : mesh_(*scene.blisk) {}
  void build() override { mesh_.build(); }
  void clear() override { mesh_.clear(); }

 private:
  OdeMesh mesh_;
};

const bool kRegistered =
    registerContender<Ode, OdeNut, OdeBuild>("ode") &&
    describe("ode", std::string("ODE ") + OCTOBLISK_ODE_VERSION + ", OPCODE, " +
                        (sizeof(dReal) == 8 ? "double" : "single") + " precision, boxes in single");

}  // namespace
}  // namespace octoblisk::bench
