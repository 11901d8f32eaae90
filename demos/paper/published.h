// The numbers that the paper prints in Tables 1–4, and what follows from them alone.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace octoblisk::demos {

/// Rows of Tables 1 and 2: the traditional octree, then k = 2..8.
inline constexpr std::size_t kMethods = 8;
/// Columns of Tables 1 and 2: FNOP = 1..10.
inline constexpr std::size_t kFnops = 10;

template <typename Number>
using MethodTable = std::array<std::array<Number, kFnops>, kMethods>;

/// k of a row; 0 for the traditional method.
constexpr std::size_t clustersOfMethod(std::size_t method) { return method == 0 ? 0 : method + 1; }
constexpr std::size_t methodOfClusters(std::size_t k) { return k == 0 ? 0 : k - 1; }
constexpr std::size_t fnopOf(std::size_t column) { return column + 1; }
std::string nameOfMethod(std::size_t method);  ///< "traditional", "k = 2"

/// Table 1: TNON.
inline constexpr MethodTable<int> kPublishedNodes = {{
    {11809, 5553, 3209, 2425, 2017, 1633, 1313, 1137, 985, 881},
    {11718, 4842, 3154, 2402, 1954, 1506, 1298, 1130, 1026, 970},
    {12131, 5315, 3371, 2451, 1995, 1555, 1283, 1131, 963, 899},
    {12052, 5324, 3444, 2340, 1820, 1500, 1308, 1092, 948, 828},
    {11933, 5205, 3317, 2317, 1853, 1549, 1317, 1101, 989, 813},
    {12238, 5326, 3486, 2382, 1846, 1534, 1358, 1166, 1006, 862},
    {12151, 5407, 3479, 2351, 1879, 1575, 1255, 1111, 1015, 829},
    {12304, 5256, 3440, 2286, 1904, 1568, 1264, 1064, 896, 832},
}};

/// Table 2: the split time, s.
inline constexpr MethodTable<double> kPublishedSeconds = {{
    {17.11, 11.79, 4.55, 3.48, 3.06, 2.47, 2.02, 1.88, 1.64, 1.50},
    {17.07, 6.97, 4.65, 4.13, 3.29, 2.56, 2.37, 1.87, 1.76, 1.68},
    {14.35, 6.95, 4.50, 3.75, 2.83, 2.28, 1.84, 1.70, 1.53, 1.57},
    {20.15, 10.02, 6.37, 4.34, 3.50, 3.08, 2.75, 2.33, 2.06, 1.93},
    {25.42, 11.25, 7.28, 5.06, 4.42, 3.63, 3.17, 2.79, 2.57, 2.03},
    {16.70, 8.69, 5.65, 4.26, 3.29, 2.94, 2.68, 2.37, 2.09, 1.95},
    {16.17, 8.53, 5.41, 4.17, 3.30, 2.89, 2.58, 2.31, 2.18, 1.98},
    {19.37, 9.43, 7.11, 5.35, 4.47, 3.86, 3.32, 2.89, 2.59, 2.44},
}};

/// Tables 3 and 4: the detection range, 10⁴ mm³, the same in every row.
inline constexpr double kPublishedTraditionalRange = 4608.00;
inline constexpr double kPublishedImprovedRange = 2534.40;

/// Table 3: the detection time of the three runs, s.
inline constexpr std::array<double, 3> kPublishedTraditionalSeconds = {469.24, 471.35, 470.62};
inline constexpr std::array<double, 3> kPublishedImprovedSeconds = {382.36, 383.41, 382.94};

/// Table 4: the same on a robot.
inline constexpr std::array<double, 3> kPublishedRobotTraditionalSeconds = {475.36, 476.29, 475.99};
inline constexpr std::array<double, 3> kPublishedRobotImprovedSeconds = {387.96, 388.45, 388.04};

/// Whether so many nodes are k + 8 · splits, as all trees over k clusters have, where every cell that is
/// divided has eight children (k = 0: one tree).
bool canBeNodeCount(int nodes, std::size_t k);

/// In how many of the 70 cells of the improved method the number is below the traditional one's of the same
/// FNOP.
template <typename Number>
int cellsBelowTraditional(const MethodTable<Number>& table) {
  int count = 0;
  for (std::size_t method = 1; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      count += table[method][column] < table[0][column];
    }
  }
  return count;
}

/// Row and column of the cell of the improved method that is least against the traditional one's of the same
/// FNOP; the first of equals.
struct TableCell {
  std::size_t method = 1, column = 0;
};
template <typename Number>
TableCell bestAgainstTraditional(const MethodTable<Number>& table) {
  TableCell best;
  const auto ratio = [&](std::size_t method, std::size_t column) {
    return static_cast<double>(table[method][column]) / static_cast<double>(table[0][column]);
  };
  for (std::size_t method = 1; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      if (ratio(method, column) < ratio(best.method, best.column)) best = {method, column};
    }
  }
  return best;
}

}  // namespace octoblisk::demos
