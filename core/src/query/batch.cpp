#include "octoblisk/batch.h"

#include "base/parallel.h"
#include "octoblisk/path_query.h"

namespace octoblisk {

using namespace detail;

namespace {

template <typename Answer, typename Body, typename Ask>
std::vector<Answer> answersFor(const Body& a, const Body& b, std::span<const Pose> poses, int threads,
                               const Ask& ask) {
  std::vector<Answer> answers(poses.size());
  parallelForChunks(poses.size(), kPosesAtOnce, threads, [&](std::size_t begin, std::size_t end) {
    PathQuery query(a, b);
    for (std::size_t pose = begin; pose < end; ++pose) answers[pose] = ask(query, poses[pose]);
  });
  return answers;
}

}  // namespace

std::vector<std::optional<TrianglePair>> collideAll(const ClusteredOctree& a, const ClusteredOctree& b,
                                                    std::span<const Pose> poses_of_b_in_a, int threads) {
  return answersFor<std::optional<TrianglePair>>(
      a, b, poses_of_b_in_a, threads, [](PathQuery& query, const Pose& pose) { return query.collide(pose); });
}

std::vector<Clearance> distanceAll(const ClusteredOctree& a, const ClusteredOctree& b,
                                   std::span<const Pose> poses_of_b_in_a, const DistanceOptions& options,
                                   int threads) {
  return answersFor<Clearance>(a, b, poses_of_b_in_a, threads, [&](PathQuery& query, const Pose& pose) {
    return query.distance(pose, options);
  });
}

std::vector<SignedDistance> signedDistanceAll(const Surface& a, const Surface& b,
                                              std::span<const Pose> poses_of_b_in_a,
                                              const SignedDistanceOptions& options, int threads) {
  return answersFor<SignedDistance>(a, b, poses_of_b_in_a, threads, [&](PathQuery& query, const Pose& pose) {
    return query.signedDistance(pose, options);
  });
}

}  // namespace octoblisk
