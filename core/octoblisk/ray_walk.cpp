#include "octoblisk/ray_walk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "octoblisk/ray_triangle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "octoblisk/ray_walk.cpp"
#include <hwy/foreach_target.h>
// Must come after it.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "octoblisk/node_boxes.h"

#ifndef OCTOBLISK_RAY_WALK_ONCE
#define OCTOBLISK_RAY_WALK_ONCE
namespace octoblisk {

/// The part of a ray near the tree, in single precision: the points origin + reach · direction,
/// 0 <= reach <= length, relative to the tree's origin. The largest component of the direction is ±1.
struct LocalRay {
  std::array<float, 3> origin;
  std::array<float, 3> direction;
  /// How far any point of the ray or of a triangle may be off by rounding, once it is in the frame of a box
  /// or of the ray: boxes are grown by it.
  float slack;
  float length;

  // reach = scale · (t − start)
  double scale;
  double start;

  /// No less than the reach of a hit at t.
  float reachOf(double t) const { return static_cast<float>(std::min(scale * (t - start), 1e30)) + slack; }
};

/// Nothing where the ray passes by the sphere round the tree.
inline std::optional<LocalRay> clipped(const ClusteredOctree& tree, const Ray& ray) {
  const double largest = ray.direction.cwiseAbs().maxCoeff();
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || !(ray.t_max >= 0.0)) return std::nullopt;
  if (!(largest >= Ray::kMinDirection && largest <= TriangleMesh::kMaxCoordinate)) return std::nullopt;
  const Vec3 origin = ray.origin - tree.origin();
  const double distance = origin.cwiseAbs().maxCoeff();
  if (!(ray.origin.cwiseAbs().maxCoeff() <= TriangleMesh::kMaxCoordinate)) return std::nullopt;

  // 64 units in the last place of single precision, and some in double precision of the way to the tree.
  const double slack = 0x1p-18 * tree.radius() + 0x1p-48 * distance + 0x1p-120;
  const double radius = tree.radius() + slack;
  const double nearest = -origin.dot(ray.direction) / ray.direction.squaredNorm();  // to the middle
  if (!((origin + nearest * ray.direction).squaredNorm() <= radius * radius)) return std::nullopt;
  const double unit = 1.0 / largest;
  const double in_sphere = radius * unit;  // no less than half the chord
  const double start = std::max(0.0, nearest - in_sphere);

  LocalRay local;
  for (int i = 0; i < 3; ++i) {
    local.origin[static_cast<std::size_t>(i)] = static_cast<float>(origin[i] + start * ray.direction[i]);
    local.direction[static_cast<std::size_t>(i)] = static_cast<float>(ray.direction[i] * unit);
  }
  local.slack = static_cast<float>(slack);
  local.scale = largest;
  local.start = start;
  local.length = local.reachOf(std::min(nearest + in_sphere, ray.t_max));
  if (!(local.length >= 0.0f)) return std::nullopt;
  return local;
}

/// What a ray has yet to look into, and at which reach it gets there: ordered by the latter. Reaches are not
/// negative, so that their bits are in the order of their values.
class RayTask {
 public:
  RayTask() {}  // not set: there are many of them
  RayTask(float reach, Slot slot)
      : bits_(std::uint64_t{std::bit_cast<std::uint32_t>(reach)} << 32 | slot.node << 3 | slot.lane) {}
  float reach() const { return std::bit_cast<float>(static_cast<std::uint32_t>(bits_ >> 32)); }
  Slot slot() const {
    const auto low = static_cast<std::uint32_t>(bits_);
    return {low >> 3, low & 7u};
  }
  bool operator<(const RayTask& other) const { return bits_ < other.bits_; }

 private:
  std::uint64_t bits_;
};

}  // namespace octoblisk
#endif

HWY_BEFORE_NAMESPACE();
namespace octoblisk::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kLanes>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;

// Fused products and sums: the walk's numbers differ between processors in their last bits, what it finds
// does not, since all of them only exclude what is certain and every hit is confirmed in double precision.

/// One bit a lane, of lanes from `lane` on.
HWY_INLINE unsigned bitsOf(hn::Mask<Tag> mask, std::size_t lane) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(kTag, mask, bits);
  return static_cast<unsigned>(bits[0]) << lane;
}

/// The eight reaches at which a ray enters the boxes of a node; a bit for each box that it enters before
/// `limit`.
HWY_INLINE unsigned enter(const Box8& boxes, const LocalRay& ray, float limit, float* reaches) {
  unsigned entered = 0;
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(kTag)) {
    Floats offset[3];
    for (int i = 0; i < 3; ++i) {
      offset[i] = hn::Sub(hn::Set(kTag, ray.origin[i]), hn::LoadU(kTag, &boxes.center[i][lane]));
    }
    Floats near = hn::Zero(kTag), far = hn::Set(kTag, limit);
    for (int axis = 0; axis < 3; ++axis) {
      const Floats x = hn::LoadU(kTag, &boxes.axes[0][axis][lane]);
      const Floats y = hn::LoadU(kTag, &boxes.axes[1][axis][lane]);
      const Floats z = hn::LoadU(kTag, &boxes.axes[2][axis][lane]);
      const Floats along = hn::MulAdd(
          z, hn::Set(kTag, ray.direction[2]),
          hn::MulAdd(y, hn::Set(kTag, ray.direction[1]), hn::Mul(x, hn::Set(kTag, ray.direction[0]))));
      const Floats from = hn::MulAdd(z, offset[2], hn::MulAdd(y, offset[1], hn::Mul(x, offset[0])));
      // Along the axis, turned so that the ray ascends, it is between -half and half from the reach
      // -(ahead + half) / speed to (half - ahead) / speed.
      const Floats speed = hn::Max(hn::Abs(along), hn::Set(kTag, 0x1p-30f));
      const Floats ahead = hn::Xor(hn::And(along, hn::SignBit(kTag)), from);
      const Floats half = hn::Add(hn::LoadU(kTag, &boxes.half_extents[axis][lane]), hn::Set(kTag, ray.slack));
      const Floats inverse = hn::Div(hn::Set(kTag, 1.0f), speed);
      const Floats middle = hn::Mul(ahead, inverse), width = hn::Mul(half, inverse);
      near = hn::Max(near, hn::Neg(hn::Add(middle, width)));
      far = hn::Min(far, hn::Sub(width, middle));
    }
    hn::StoreU(hn::Abs(near), kTag, reaches + lane);  // no -0: RayTask compares bits
    entered |= bitsOf(hn::Le(near, far), lane);
  }
  return entered;
}

/// A ray in the frame in which it is the z axis: the axis nearest to it stays, and x and y are sheared
/// (S. Woop, C. Benthin, I. Wald, Watertight Ray/Triangle Intersection, 2013).
struct ShearedRay {
  int x, y, z;
  float shear_x, shear_y;
  float inverse_z;
  float slack;
  std::array<float, 3> origin;

  /// The ray in the frame of a box.
  ShearedRay(const LocalRay& ray, const Box8& boxes, std::uint32_t lane) : slack(ray.slack) {
    float direction[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      direction[axis] = origin[axis] = 0.0f;
      for (std::size_t i = 0; i < 3; ++i) {
        const float along = boxes.axes[i][axis][lane];
        direction[axis] += along * ray.direction[i];
        origin[axis] += along * (ray.origin[i] - boxes.center[i][lane]);
      }
    }
    const auto size = [&](int i) { return std::abs(direction[i]); };
    z = size(0) > size(1) ? (size(0) > size(2) ? 0 : 2) : (size(1) > size(2) ? 1 : 2);
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    inverse_z = 1.0f / direction[z];
    shear_x = direction[x] * inverse_z;
    shear_y = direction[y] * inverse_z;
  }
};

/// A bit for each of a leaf's triangles, given by the rows of their corners, that the ray may cross at a
/// reach of 0 to `limit`: only such are left out that it certainly does not. Bits beyond their count are
/// anything.
HWY_INLINE unsigned mayCross(const float* rows, std::size_t count, const ShearedRay& ray, float limit) {
  unsigned crossed = 0;
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(kTag)) {
    Floats x[3], y[3], z[3];
    Floats size = hn::Zero(kTag);
    for (int v = 0; v < 3; ++v) {
      const auto component = [&](int i) HWY_ATTR {
        return hn::Sub(hn::LoadU(kTag, rows + (3 * v + i) * count + lane), hn::Set(kTag, ray.origin[i]));
      };
      z[v] = component(ray.z);
      x[v] = hn::NegMulAdd(hn::Set(kTag, ray.shear_x), z[v], component(ray.x));
      y[v] = hn::NegMulAdd(hn::Set(kTag, ray.shear_y), z[v], component(ray.y));
      size = hn::Add(size, hn::Add(hn::Abs(x[v]), hn::Abs(y[v])));
    }
    Floats least = hn::Zero(kTag), greatest = hn::Zero(kTag);
    for (int v = 0; v < 3; ++v) {
      const int w = (v + 1) % 3;
      const Floats side = hn::NegMulAdd(y[v], x[w], hn::Mul(x[v], y[w]));
      least = hn::Min(least, side);
      greatest = hn::Max(greatest, side);
    }
    // x and y err by less than the slack.
    const Floats slack = hn::Set(kTag, ray.slack);
    const Floats tolerance =
        hn::MulAdd(slack, hn::MulAdd(hn::Set(kTag, 2.0f), slack, size), hn::Set(kTag, 0x1p-120f));
    const auto outside = hn::And(hn::Lt(least, hn::Neg(tolerance)), hn::Gt(greatest, tolerance));
    const Floats inverse_z = hn::Set(kTag, ray.inverse_z);
    for (Floats& reach : z) reach = hn::Mul(reach, inverse_z);
    const Floats nearest = hn::Min(z[0], hn::Min(z[1], z[2]));
    const Floats farthest = hn::Max(z[0], hn::Max(z[1], z[2]));
    const auto in_reach = hn::And(hn::Le(nearest, hn::Set(kTag, limit)), hn::Ge(farthest, hn::Neg(slack)));
    crossed |= bitsOf(hn::AndNot(outside, in_reach), lane);
  }
  return crossed;
}

class RayWalk {
 public:
  RayWalk(const ClusteredOctree& tree, const Ray& ray, const LocalRay& local, CrossingVisitor visitor,
          void* context)
      : tree_(tree),
        ray_(ray),
        local_(local),
        visitor_(visitor),
        context_(context),
        t_limit_(ray.t_max),
        limit_(local.length) {}

  void run() {
    Slot here = ClusteredOctree::kRoot;
    while (true) {
      if (tree_.child(here).isLeaf()) {
        if (!visitLeaf(here)) return;
      } else if (enterNode(here)) {
        continue;
      }
      do {
        if (count_ == 0) return;
        --count_;
      } while (tasks_[count_].reach() > limit_);
      here = tasks_[count_].slot();
    }
  }

 private:
  /// Puts the children entered on the list, but for the nearest, which `here` becomes; false: there is none.
  HWY_INLINE bool enterNode(Slot& here) {
    const std::uint32_t index = tree_.child(here).node();
    Box8 room(Box8::Unset{});
    HWY_ALIGN float reaches[kLanes];
    unsigned entered = enter(boxesOf(tree_, index, room), local_, limit_, reaches);
    if (entered == 0) return false;
    const auto next = [&]() HWY_ATTR {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(entered));
      entered &= entered - 1;
      return RayTask(reaches[lane], {index, lane});
    };
    RayTask nearest = next();
    const std::size_t first = count_;
    while (entered != 0) {
      RayTask task = next();
      if (task < nearest) std::swap(task, nearest);
      std::size_t place = count_++;
      for (; place > first && tasks_[place - 1] < task; --place) tasks_[place] = tasks_[place - 1];
      tasks_[place] = task;
    }
    here = nearest.slot();
    return true;
  }

  /// False where nothing is of interest any more.
  HWY_INLINE bool visitLeaf(Slot slot) {
    const Child leaf = tree_.child(slot);
    Box8 room(Box8::Unset{});
    LeafVertices corners;
    const ShearedRay sheared(local_, boxesAt(tree_, slot, room), slot.lane);
    const std::span<const std::uint32_t> triangles = tree_.triangles(leaf);
    hwy::Prefetch(triangles.data());  // while the corners are waited for
    const unsigned in_leaf = (1u << triangles.size()) - 1;
    unsigned crossed =
        mayCross(tree_.leafVertices(slot, corners), triangles.size(), sheared, limit_) & in_leaf;
    for (; crossed != 0; crossed &= crossed - 1) {
      const std::uint32_t triangle = triangles[static_cast<std::size_t>(std::countr_zero(crossed))];
      const auto found = crossing(ray_.origin, ray_.direction, tree_.mesh().triangle(triangle));
      if (!found || found->t > t_limit_ || (found->back_face && ray_.cull_back_faces)) continue;
      const double wanted = visitor_(context_, {found->t, triangle, found->back_face});
      if (wanted < 0.0) return false;
      if (wanted < t_limit_) {
        t_limit_ = wanted;
        limit_ = std::min(limit_, local_.reachOf(wanted));
      }
    }
    return true;
  }

  const ClusteredOctree& tree_;
  const Ray& ray_;
  const LocalRay& local_;
  const CrossingVisitor visitor_;
  void* const context_;
  double t_limit_;
  float limit_;  ///< the reach of t_limit_, and of the sphere round the tree
  std::size_t count_ = 0;
  std::array<RayTask, (kLanes - 1) * ClusteredOctree::kMaxDepth> tasks_;
};

void walk(const ClusteredOctree& tree, const Ray& ray, const LocalRay& local, CrossingVisitor visitor,
          void* context) {
  RayWalk(tree, ray, local, visitor, context).run();
}

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

HWY_EXPORT(walk);

void walkRay(const ClusteredOctree& tree, const Ray& ray, CrossingVisitor visitor, void* context) {
  const std::optional<LocalRay> local = clipped(tree, ray);
  if (local) HWY_DYNAMIC_DISPATCH(walk)(tree, ray, *local, visitor, context);
}

}  // namespace octoblisk
#endif
