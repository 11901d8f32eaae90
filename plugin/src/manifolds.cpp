#include "manifolds.h"

#include <algorithm>
#include <limits>

#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {
namespace {

/// The contact's point in the mesh's frame, on the margin around the mesh.
Vec3 onMargin(const Contact& contact, const PatchesMesh& mesh) {
  return contact.point_on_a - mesh.margin * contact.normal;
}

Vec3 onMargin(const btManifoldPoint& point, const PatchesMesh& mesh) {
  // The world positions of a manifold point are those of the last step.
  const Vec3 on_body = fromBullet(mesh.is_body1 ? point.m_localPointB : point.m_localPointA);
  return mesh.in_world.inverse() * (mesh.body_in_world * on_body);
}

/// How much a patch's first contact differs in position and normal from the most similar point of a manifold,
/// squared; infinite if there are no points. A difference of 1 of the normals counts like one of `length` of
/// the positions. The manifold's normals are those of the last step.
double squaredDifference(const ContactPatch& patch, const btPersistentManifold& manifold,
                         const PatchesMesh& mesh, double length) {
  if (manifold.getNumContacts() == 0) return std::numeric_limits<double>::infinity();
  const Contact& deepest = patch.contacts[0];
  const Vec3 place = onMargin(deepest, mesh);
  const Vec3 normal = (mesh.is_body1 ? -1.0 : 1.0) * (mesh.in_world.rotation * deepest.normal);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    const Vec3 turn = fromBullet(point.m_normalWorldOnB) - normal;
    least = std::min(least, (onMargin(point, mesh) - place).squaredNorm() + (length * turn).squaredNorm());
  }
  return least;
}

/// Removes the points that are farther than `distance` from all contacts of a patch.
void keepNear(const ContactPatch& patch, btPersistentManifold& manifold, const PatchesMesh& mesh,
              double distance) {
  for (int i = manifold.getNumContacts() - 1; i >= 0; --i) {
    const Vec3 point = onMargin(manifold.getContactPoint(i), mesh);
    const auto isNear = [&](const Contact& contact) {
      return (onMargin(contact, mesh) - point).squaredNorm() <= distance * distance;
    };
    if (std::ranges::none_of(patch.points(), isNear)) manifold.removeContactPoint(i);
  }
}

}  // namespace

Manifolds::~Manifolds() {
  for (btPersistentManifold* manifold : manifolds_) dispatcher_.releaseManifold(manifold);
}

void Manifolds::match(std::span<const ContactPatch> patches, const PatchesMesh& mesh,
                      btScalar breaking_threshold) {
  while (manifolds_.size() < patches.size() && add()) {
  }
  patches = patches.first(std::min(patches.size(), manifolds_.size()));
  std::array<bool, ContactPatches::kMaxPatches> matched{};
  for (std::size_t round = 0; round < patches.size(); ++round) {
    // Match the most similar remaining pair; the other patches get empty manifolds.
    std::size_t best_patch = 0, best_manifold = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < patches.size(); ++p) {
      if (matched[p]) continue;
      for (std::size_t m = 0; m < manifolds_.size(); ++m) {
        if (m < patches.size() && matched[m]) continue;
        const double squared =
            squaredDifference(patches[p], *manifolds_[m], mesh, double(breaking_threshold));
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
    if (m < patches.size() && matched[m]) {
      keepNear(patches[m], *manifolds_[m], mesh, double(breaking_threshold));
    } else {
      manifolds_[m]->clearManifold();
    }
    manifolds_[m]->setContactBreakingThreshold(breaking_threshold);
  }
}

bool Manifolds::add() {
  manifolds_.reserve(manifolds_.size() + 1);  // push_back must not throw after getNewManifold
  btPersistentManifold* const manifold = dispatcher_.getNewManifold(body0_, body1_);
  if (manifold) manifolds_.push_back(manifold);
  return manifold != nullptr;
}

}  // namespace octoblisk::detail
