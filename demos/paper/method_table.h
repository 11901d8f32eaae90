// Tables with one row per method and one column per FNOP, like the paper's Tables 1 and 2.
#pragma once

#include <array>
#include <cstddef>

namespace octoblisk::demos {

/// Rows: the traditional octree, then k = 2..8.
inline constexpr std::size_t kMethods = 8;
/// Columns: FNOP = 1..10.
inline constexpr std::size_t kFnops = 10;

template <typename Number>
using MethodTable = std::array<std::array<Number, kFnops>, kMethods>;

/// k of a row; 0 for the traditional method.
constexpr std::size_t clustersOfMethod(std::size_t method) { return method == 0 ? 0 : method + 1; }
constexpr std::size_t fnopOf(std::size_t column) { return column + 1; }

}  // namespace octoblisk::demos
