// Whether the clusters of two bodies' shapes separate them: the second test of the broadphase, after boxes.
#pragma once

#include <unordered_map>

struct btBroadphaseProxy;
class btCollisionShape;

namespace octoblisk::detail {

/// Tests whether clusters separate two bodies. Does not apply to ghosts (they stand for their boxes), soft
/// bodies, user-defined clients and null.
class ClusterTest {
 public:
  /// `depth`: the depth of the clusters.
  explicit ClusterTest(int depth) : depth_(depth) {}

  /// Call this when shapes may have changed.
  void beginStep() { holders_.clear(); }

  /// Whether clusters decide about the pair: both are bodies, and one of them has clusters.
  bool applies(const btBroadphaseProxy& a, const btBroadphaseProxy& b);
  /// Whether clusters decide about the pair, or would if a child with clusters were added to a compound.
  /// Searches no compound.
  static bool mayApply(const btBroadphaseProxy& a, const btBroadphaseProxy& b);

  /// Whether two bodies to which the test applies are apart at their current transforms:
  /// - No cluster meets a cluster or the box of the other body. Each cluster is grown by its shape's margin
  ///   and contact breaking threshold.
  /// - No body is inside the other as a solid.
  /// A compound that contains a ClusteredOctreeShape is tested child by child. Any other body is represented
  /// by two boxes, that of its proxy and that of its shape. They differ if the body was moved by hand. With
  /// `ahead`, true also proves that the bodies stay apart until both together have moved by this length; not
  /// for compounds.
  bool separates(const btBroadphaseProxy& a, const btBroadphaseProxy& b, double ahead = 0.0);

 private:
  bool holdsOurShape(const btCollisionShape& shape);

  const int depth_;
  /// Whether a large compound holds our shape: a compound with thousands of children may be in as many pairs.
  std::unordered_map<const btCollisionShape*, bool> holders_;
};

}  // namespace octoblisk::detail
