// The experiment of Table 3: detection over a grinding path, by the paper's methods and ours.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "paper/belt_poses.h"
#include "paper/progress.h"
#include "paper/segmentation.h"

namespace octoblisk::demos {

struct DetectionOptions {
  std::size_t fnop = 2;             ///< the paper's optimum
  detail::KMeansOptions k_means{};  ///< for each part; the paper's optimum is k = 2
  int runs = 9;                     ///< timed runs over the ground path
};

/// The verdicts of a method, compared with the exact verdicts on the triangles.
struct Alarms {
  std::size_t touching = 0, clear = 0;  ///< poses, by the triangles
  std::size_t false_positives = 0;      ///< clear poses called colliding
  std::size_t false_negatives = 0;      ///< touching poses called clear

  void count(const BeltPose& pose, bool called_colliding);
};

/// The result of a method at a pose.
struct PoseDetection {
  bool colliding = false;
  double volume_left = 0.0;  ///< of the leaf boxes that overlap, mm³
};

struct DetectionRow {
  std::string method;
  double range = 0.0;                      ///< of the boxes with which it begins, mm³
  double volume_left = 0.0;                ///< of the leaf boxes that overlap, the mean of all poses, mm³
  double boxes_tested = 0.0;               ///< pairs of boxes per pose, the mean; 0 if not counted
  std::vector<double> run_seconds{};       ///< of each run over the ground path
  Alarms ground{};                         ///< over the ground path
  Alarms lifted{};                         ///< over the lifted path
  std::vector<PoseDetection> at_ground{};  ///< per pose of the ground path
  std::vector<PoseDetection> at_lifted{};  ///< per pose of the lifted path
  bool is_exact = false;                   ///< tests the triangles
};

/// Whether leaf boxes cover the places that the belt's triangles touch. The belt's box is not used, because
/// it is larger.
struct HolesRow {
  std::string method;
  std::size_t touching = 0;  ///< poses of both paths
  std::size_t missed = 0;    ///< of these, the belt's triangles meet no leaf box
};

/// The indices of these rows.
enum HoleKind : std::size_t {
  kCellsTraditional,
  kCellsImproved,
  kFittedTraditional,  ///< the box of a leaf's points, in the cell's frame: the subject of erratum 14
  kFittedImproved,
  kWholeTriangles,
  kHoleKinds
};

struct DetectionResult {
  std::size_t path_poses = 0, cloud_points = 0;
  DetectionOptions options{};
  std::vector<DetectionRow> rows{};  ///< in the order of the enumeration below
  std::vector<HolesRow> holes{};
};

/// The indices of the rows.
enum DetectionMethod : std::size_t {
  kOneAabb,
  kOneObb,
  kTraditionalOneAxis,
  kTraditional,
  kImprovedOneAxis,
  kImproved,
  kImprovedPrincipal,
  kOursBoxes,      ///< leaf boxes of whole triangles against the belt's one box
  kOursBothBoxes,  ///< and against the belt's leaf boxes
  kOursPairs,      ///< all touching triangle pairs
  kOursVerdict,    ///< touching or not; each pose starts from the last
  kDetectionMethods
};

/// Runs every method over the poses of the ground path and of the lifted path; both have exact verdicts on
/// the triangles. `parts` are clouds of the blisk's parts.
DetectionResult runDetectionExperiment(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                                       const std::vector<Points>& parts, const std::vector<BeltPose>& ground,
                                       const std::vector<BeltPose>& lifted, const DetectionOptions& options,
                                       const Progress& progress);

void to_json(nlohmann::json& json, const DetectionResult& result);

}  // namespace octoblisk::demos
