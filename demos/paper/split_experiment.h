// The experiment of Tables 1 and 2: a blade's cloud is divided for each method and FNOP.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "paper/belt_poses.h"
#include "paper/progress.h"
#include "paper/segmentation.h"

namespace octoblisk::demos {

/// A table has one row per method and one column per FNOP, like the paper's Tables 1 and 2.
/// Rows: the traditional octree, then k = 2..8.
inline constexpr std::size_t kMethods = 8;
/// Columns: FNOP = 1..10.
inline constexpr std::size_t kFnops = 10;

template <typename Number>
using MethodTable = std::array<std::array<Number, kFnops>, kMethods>;

/// k of a row; 0 for the traditional method.
constexpr std::size_t clustersOfMethod(std::size_t method) { return method == 0 ? 0 : method + 1; }
constexpr std::size_t fnopOf(std::size_t column) { return column + 1; }

struct SplitOptions {
  detail::KMeansOptions k_means{};  ///< for each k
  int repeats = 15;                 ///< split_ms is the median of these, interleaved over all cells
};

/// The result of a method at an FNOP.
struct SplitCell {
  std::size_t nodes = 0;            ///< TNON
  double split_ms = 0.0;            ///< processor time to build the octrees of given clusters
  double leaf_volume = 0.0;         ///< of the leaf cells with points, mm³
  std::size_t false_positives = 0;  ///< clear poses at which the belt's box overlaps a leaf cell
  std::size_t false_negatives = 0;  ///< touching poses at which it overlaps no leaf cell
};

struct SplitResult {
  MethodTable<SplitCell> cubes;               ///< along the axes, as in the paper
  MethodTable<SplitCell> principal;           ///< boxes in principal frames
  std::array<double, kMethods> cluster_ms{};  ///< of k-means, the median; 0 for the traditional method
  std::size_t touching = 0, clear = 0;        ///< poses
};

void to_json(nlohmann::json& json, const SplitCell& cell);
void to_json(nlohmann::json& json, const SplitResult& result);

/// Divides a cloud of at least 8 points. The belt is represented by its one box along its principal axes, in
/// the belt's frame; the poses' verdicts are for the cloud's mesh. Everything but the times is the same, bit
/// for bit, for the same seed.
SplitResult runSplitExperiment(const Points& cloud, const Obb& belt_box, std::span<const BeltPose> poses,
                               const SplitOptions& options, const Progress& progress);

}  // namespace octoblisk::demos
