// Embree 3. rtcCollide pairs the boxes of two scenes. The belt's boxes are refitted at each pose. OctoBlisk's
// exact test then checks the pairs. rtcCollide cannot stop at the first one. Rays use rtcIntersect1.
#include <embree3/rtcore.h>

#include <string>

#include "contender.h"
#include "geometry/triangle_pair.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

/// Uses the given number of threads, 0 for all, and counts the memory that Embree takes.
class EmbreeDevice {
 public:
  explicit EmbreeDevice(unsigned threads = 1)
      : device_(rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str())) {
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* bytes, ssize_t change, bool) {
          *static_cast<std::ptrdiff_t*>(bytes) += change;
          return true;
        },
        &bytes_);
  }
  ~EmbreeDevice() { rtcReleaseDevice(device_); }
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  operator RTCDevice() const { return device_; }
  std::size_t bytes() const { return static_cast<std::size_t>(bytes_); }

 private:
  std::ptrdiff_t bytes_ = 0;
  RTCDevice device_;
};

/// Triangles as user geometry over vertices that may move. rtcCollide accepts no other geometry.
class EmbreeBoxes {
 public:
  EmbreeBoxes(RTCDevice device, const TriangleMesh& mesh, RTCBuildQuality quality)
      : vertices(mesh.vertices()),
        triangles_(mesh.triangles()),
        scene_(rtcNewScene(device)),
        geometry_(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER)) {
    const bool refitted = quality == RTC_BUILD_QUALITY_REFIT;
    rtcSetSceneBuildQuality(scene_, refitted ? RTC_BUILD_QUALITY_LOW : quality);
    rtcSetSceneFlags(scene_, refitted ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE);
    rtcSetGeometryBuildQuality(geometry_, quality);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(triangles_.size()));
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, &boundsOf, nullptr);
    rtcAttachGeometry(scene_, geometry_);
    commit();
  }
  ~EmbreeBoxes() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
  }
  EmbreeBoxes(const EmbreeBoxes&) = delete;
  EmbreeBoxes& operator=(const EmbreeBoxes&) = delete;

  /// Must be called after the vertices have moved.
  void commit() {
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }
  RTCScene scene() const { return scene_; }
  Triangle triangle(std::size_t index) const {
    const auto& [a, b, c] = triangles_[index];
    return {vertices[a], vertices[b], vertices[c]};
  }

  std::vector<Vec3> vertices;

 private:
  /// Larger than the single-precision rounding of coordinates below 1024 mm, so no pair is lost.
  static constexpr double kRoundingPad = 1e-4;

  static void boundsOf(const RTCBoundsFunctionArguments* arguments) {
    const auto& boxes = *static_cast<const EmbreeBoxes*>(arguments->geometryUserPtr);
    const auto& [a, b, c] = boxes.triangles_[arguments->primID];
    const std::vector<Vec3>& v = boxes.vertices;
    const Eigen::Vector3f lower = (v[a].cwiseMin(v[b]).cwiseMin(v[c]).array() - kRoundingPad).cast<float>();
    const Eigen::Vector3f upper = (v[a].cwiseMax(v[b]).cwiseMax(v[c]).array() + kRoundingPad).cast<float>();
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = lower.x();
    bounds.lower_y = lower.y();
    bounds.lower_z = lower.z();
    bounds.upper_x = upper.x();
    bounds.upper_y = upper.y();
    bounds.upper_z = upper.z();
  }

  std::vector<TriangleMesh::Indices> triangles_;
  RTCScene scene_;
  RTCGeometry geometry_;
};

class Embree final : public CollideQuery, public ContactsQuery {
 public:
  explicit Embree(const Scene& scene, RTCBuildQuality of_blisk = RTC_BUILD_QUALITY_MEDIUM)
      : belt_mesh_(scene.belt),
        blisk_(device_, *scene.blisk, of_blisk),
        belt_(device_, *scene.belt, RTC_BUILD_QUALITY_REFIT) {}

  bool collides(const Pose& belt_in_blisk, bool) override { return ask(belt_in_blisk, true) > 0; }
  std::size_t contacts(const Pose& belt_in_blisk) override { return ask(belt_in_blisk, false); }
  void moveBlisk(const TriangleMesh& deformed) {
    blisk_.vertices = deformed.vertices();
    blisk_.commit();
  }

 private:
  struct Search {
    const Embree* self;
    bool first_only;
    std::size_t pairs;
  };

  static void onPairs(void* user, RTCCollision* found, unsigned count) {
    Search& search = *static_cast<Search*>(user);
    for (unsigned k = 0; k < count; ++k) {
      if (search.first_only && search.pairs > 0) return;
      search.pairs += intersects(search.self->blisk_.triangle(found[k].primID0),
                                 search.self->belt_.triangle(found[k].primID1));
    }
  }

  std::size_t ask(const Pose& belt_in_blisk, bool first_only) {
    for (std::size_t v = 0; v < belt_.vertices.size(); ++v) {
      belt_.vertices[v] = belt_in_blisk * belt_mesh_->vertices()[v];
    }
    belt_.commit();
    Search search{this, first_only, 0};
    rtcCollide(blisk_.scene(), belt_.scene(), &onPairs, &search);
    return search.pairs;
  }

  EmbreeDevice device_;
  std::shared_ptr<const TriangleMesh> belt_mesh_;
  EmbreeBoxes blisk_, belt_;
};

class EmbreeRefit final : public RefitQuery {
 public:
  explicit EmbreeRefit(const Scene& scene)
      : mesh_(scene.blisk), bent_(bench::bent(*scene.blisk)), embree_(scene, RTC_BUILD_QUALITY_REFIT) {}
  void refit(bool bent) override { embree_.moveBlisk(bent ? *bent_ : *mesh_); }
  bool touches(const Pose& belt_in_blisk) override { return embree_.collides(belt_in_blisk, false); }

 private:
  std::shared_ptr<const TriangleMesh> mesh_, bent_;
  Embree embree_;
};

/// The tree for rays. It shares its buffers with the caller.
class EmbreeTriangles {
 public:
  explicit EmbreeTriangles(const TriangleMesh& mesh, unsigned threads = 1)
      : device_(threads), triangles_(mesh.triangles()) {
    for (const Vec3& vertex : mesh.vertices()) {
      for (const double x : vertex) vertices_.push_back(static_cast<float>(x));
    }
    vertices_.push_back(0.0f);  // Embree reads the last vertex as four floats
  }
  ~EmbreeTriangles() { clear(); }
  EmbreeTriangles(const EmbreeTriangles&) = delete;
  EmbreeTriangles& operator=(const EmbreeTriangles&) = delete;

  void build() {
    clear();
    scene_ = rtcNewScene(device_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices_.data(), 0,
                               3 * sizeof(float), vertices_.size() / 3);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles_.data(), 0,
                               sizeof triangles_[0], triangles_.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }

  void clear() {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    scene_ = nullptr;
  }

  RTCScene scene() const { return scene_; }
  std::size_t bytes() const { return device_.bytes(); }

 private:
  EmbreeDevice device_;
  std::vector<float> vertices_;
  std::vector<TriangleMesh::Indices> triangles_;
  RTCScene scene_ = nullptr;
};

class EmbreeRays final : public RayQuery {
 public:
  explicit EmbreeRays(const Scene& scene) : tree_(*scene.blisk) { tree_.build(); }

  double firstHit(const Segment& segment) override {
    const Eigen::Vector3f from = segment.from.cast<float>(),
                          direction = (segment.to - segment.from).cast<float>();
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = from.x();
    ray.ray.org_y = from.y();
    ray.ray.org_z = from.z();
    ray.ray.dir_x = direction.x();
    ray.ray.dir_y = direction.y();
    ray.ray.dir_z = direction.z();
    ray.ray.tfar = 1.0f;
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tree_.scene(), &context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? 1.0 : static_cast<double>(ray.ray.tfar);
  }

 private:
  EmbreeTriangles tree_;
};

class EmbreeBuild final : public BuildQuery {
 public:
  explicit EmbreeBuild(const Scene& scene) : tree_(*scene.blisk, 0) {}
  void build() override { tree_.build(); }
  void clear() override { tree_.clear(); }
  std::optional<std::size_t> ownCount() const override { return tree_.bytes(); }

 private:
  EmbreeTriangles tree_;
};

const bool kRegistered = registerContender<Embree, EmbreeRays, EmbreeBuild, EmbreeRefit>("embree") &&
                         describe("embree", "Embree " RTC_VERSION_STRING ", single precision");

}  // namespace
}  // namespace octoblisk::bench
