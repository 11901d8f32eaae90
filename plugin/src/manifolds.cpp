#include "manifolds.h"

#include <algorithm>
#include <limits>

#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {
namespace {

/// The squared distance of a patch's deepest point to the nearest point of a manifold, on the mesh; infinite
/// where the manifold is empty.
double squaredDistance(const Vec3& deepest_in_world, const btPersistentManifold& manifold,
                       bool mesh_is_body1) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    const btVector3& on_mesh = mesh_is_body1 ? point.m_positionWorldOnB : point.m_positionWorldOnA;
    least = std::min(least, (fromBullet(on_mesh) - deepest_in_world).squaredNorm());
  }
  return least;
}

}  // namespace

Manifolds::~Manifolds() {
  for (btPersistentManifold* manifold : manifolds_) dispatcher_.releaseManifold(manifold);
}

void Manifolds::match(std::span<const ContactPatch> patches, const Pose& mesh_in_world, bool mesh_is_body1,
                      btScalar breaking_threshold) {
  while (manifolds_.size() < patches.size() && add()) {
  }
  patches = patches.first(std::min(patches.size(), manifolds_.size()));
  std::array<bool, ContactPatches::kMaxPatches> matched{};
  for (std::size_t round = 0; round < patches.size(); ++round) {
    // The closest pair of those that are left; then empty manifolds for the rest.
    std::size_t best_patch = 0, best_manifold = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < patches.size(); ++p) {
      if (matched[p]) continue;
      const Vec3 deepest = mesh_in_world * patches[p].contacts[0].point_on_a;
      for (std::size_t m = 0; m < manifolds_.size(); ++m) {
        if (m < patches.size() && matched[m]) continue;
        const double squared = squaredDistance(deepest, *manifolds_[m], mesh_is_body1);
        if (squared >= least) continue;
        least = squared;
        best_patch = p;
        best_manifold = m;
      }
    }
    if (least == std::numeric_limits<double>::infinity()) break;
    std::swap(manifolds_[best_patch], manifolds_[best_manifold]);
    matched[best_patch] = true;
  }
  for (std::size_t m = 0; m < manifolds_.size(); ++m) {
    if (m >= patches.size() || !matched[m]) manifolds_[m]->clearManifold();
    manifolds_[m]->setContactBreakingThreshold(breaking_threshold);
  }
}

btPersistentManifold* Manifolds::any() {
  if (manifolds_.empty() && !add()) return nullptr;
  return manifolds_.front();
}

bool Manifolds::add() {
  btPersistentManifold* const manifold = dispatcher_.getNewManifold(body0_, body1_);
  if (manifold) manifolds_.push_back(manifold);
  return manifold != nullptr;
}

}  // namespace octoblisk::detail
