#include "toolpath/pose_check.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "models/defect_words.h"
#include "octoblisk/batch.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

std::string inwardPartsOf(const Surface* surface) {
  if (!surface) return {};
  bool has_inward = false, has_outward = false;
  for (std::uint32_t t = 0; t < surface->tree().mesh().triangleCount(); ++t) {
    has_inward |= surface->role(t) == TriangleRole::inward;
    has_outward |= surface->role(t) == TriangleRole::outward;
  }
  if (!has_inward || !has_outward) return {};
  const MeshInspection found = inspect(*surface);
  return found.facesInward() ? std::string() : inwardText(found);
}

}  // namespace

PoseCheck::PoseCheck(const ClusteredOctree& fixed, const ClusteredOctree& moving,
                     const PoseCheckOptions& options)
    : fixed_(fixed), moving_(moving), options_(options) {
  if (!options.depth && !options.signed_distance) return;
  fixed_surface_ = std::make_unique<const Surface>(fixed, options.threads);
  moving_surface_ = std::make_unique<const Surface>(moving, options.threads);
  requireClosed();
  depth_queries_.resize(static_cast<std::size_t>(threadCount(options.threads)));
}

void PoseCheck::requireClosed() const {
  if (fixed_surface_->isClosed() || (!options_.depth && moving_surface_->isClosed())) return;
  std::string message =
      options_.depth ? "depths need a closed fixed mesh, but "
                     : "signed distances need a closed mesh; the moving mesh is open and so is this one: ";
  message += openText(inspect(*fixed_surface_)) + " (octoblisk inspect shows the places, and closes holes)";
  if (moving_surface_->isClosed()) {
    message +=
        "; the moving mesh is closed: unless it may be inside the fixed one, swap the two meshes and "
        "invert each pose";
  }
  throw std::invalid_argument(message);
}

PoseCheck::~PoseCheck() = default;

std::string PoseCheck::inwardPartsOfFixed() const { return inwardPartsOf(fixed_surface_.get()); }
std::string PoseCheck::inwardPartsOfMoving() const { return inwardPartsOf(moving_surface_.get()); }

std::vector<PoseAnswer> PoseCheck::answer(std::span<const Pose> poses, std::size_t begin, std::size_t end) {
  std::vector<PoseAnswer> answers(end - begin);
  const std::span<const Pose> asked = poses.subspan(begin, end - begin);
  const auto touching = collideAll(fixed_, moving_, asked, options_.threads);
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i].touching = touching[i];
  if (options_.clearance) {
    const auto clearances = distanceAll(fixed_, moving_, asked, {}, options_.threads);
    for (std::size_t i = 0; i < answers.size(); ++i) answers[i].clearance = clearances[i].distance;
  }
  if (options_.signed_distance) {
    const auto found = signedDistanceAll(*fixed_surface_, *moving_surface_, asked,
                                         {.tolerance = options_.tolerance}, options_.threads);
    for (std::size_t i = 0; i < answers.size(); ++i) answers[i].signed_distance = found[i];
  }
  if (!options_.depth && !options_.continuous) return answers;
  parallelFor(answers.size(), options_.threads, [&](std::size_t i, std::size_t worker) {
    if (options_.depth) answers[i].depth = depthAt(asked[i], worker);
    if (options_.continuous && begin + i > 0) {
      const Motion motion(poses[begin + i - 1], asked[i], moving_.mesh().bounds().center());
      answers[i].hit_on_motion = sweep(fixed_, moving_, motion, options_.tolerance);
    }
  });
  return answers;
}

double PoseCheck::depthAt(const Pose& moving_in_fixed, std::size_t worker) {
  DepthQuery& query = depth_queries_[worker];
  const double of_moving =
      query.deepest(*fixed_surface_, *moving_surface_, moving_in_fixed, options_.tolerance).depth;
  const GougeDepth of_fixed =
      query.deepest(*moving_surface_, *fixed_surface_, moving_in_fixed.inverse(), options_.tolerance);
  const bool is_inside_known = isMovingSolid() || of_fixed.is_known;
  return is_inside_known ? std::max(of_moving, of_fixed.depth) : of_moving;
}

}  // namespace octoblisk::demos
