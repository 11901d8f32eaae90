// Tables with one row per method and one column per FNOP, like the paper's Tables 1 and 2.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace octoblisk::demos {

/// Rows: the traditional octree, then k = 2..8.
inline constexpr std::size_t kMethods = 8;
/// Columns: FNOP = 1..10.
inline constexpr std::size_t kFnops = 10;
inline constexpr std::size_t kImprovedCells = (kMethods - 1) * kFnops;

template <typename Number>
using MethodTable = std::array<std::array<Number, kFnops>, kMethods>;

/// k of a row; 0 for the traditional method.
constexpr std::size_t clustersOfMethod(std::size_t method) { return method == 0 ? 0 : method + 1; }
constexpr std::size_t methodOfClusters(std::size_t k) { return k == 0 ? 0 : k - 1; }
constexpr std::size_t fnopOf(std::size_t column) { return column + 1; }
constexpr std::size_t columnOfFnop(std::size_t fnop) { return fnop - 1; }
std::string nameOfMethod(std::size_t method);  ///< "traditional", "k = 2"

/// Whether this number of nodes is k + 8 · splits, as for all trees over k clusters in which every divided
/// cell has eight children (k = 0: one tree).
bool canBeNodeCount(int nodes, std::size_t k);

/// The number of the improved method's 70 cells whose number is below the traditional method's at the same
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

/// The ratio of the cell's number to the traditional method's at the same FNOP.
template <typename Number>
double ratioToTraditional(const MethodTable<Number>& table, std::size_t method, std::size_t column) {
  return static_cast<double>(table[method][column]) / static_cast<double>(table[0][column]);
}

/// The mean over FNOP of a row's ratios to the traditional method.
template <typename Number>
double meanRatio(const MethodTable<Number>& table, std::size_t method) {
  double sum = 0.0;
  for (std::size_t column = 0; column < kFnops; ++column) sum += ratioToTraditional(table, method, column);
  return sum / kFnops;
}

/// Row and column of the improved method's cell with the least ratio to the traditional method's at the same
/// FNOP; the first of equal ones.
struct TableCell {
  std::size_t method = 1, column = 0;
};
template <typename Number>
TableCell bestAgainstTraditional(const MethodTable<Number>& table) {
  TableCell best;
  for (std::size_t method = 1; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      if (ratioToTraditional(table, method, column) < ratioToTraditional(table, best.method, best.column)) {
        best = {method, column};
      }
    }
  }
  return best;
}

/// k of the improved method's row with the least number in a column; the least k of equal ones.
template <typename Number>
std::size_t bestK(const MethodTable<Number>& table, std::size_t column) {
  std::size_t best = 1;
  for (std::size_t method = 2; method < kMethods; ++method) {
    if (table[method][column] < table[best][column]) best = method;
  }
  return clustersOfMethod(best);
}

}  // namespace octoblisk::demos
