// Reruns the paper's experiments and writes the report on them.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace octoblisk::demos {

/// Parts of the report; combine them with |.
enum PaperPart : unsigned {
  kTable1 = 1,
  kTable2 = 2,
  kTable3 = 4,
  kTable4 = 8,
  kTable5 = 16,
  kFigures = 32,
  kAllParts = 63
};

struct PaperRequest {
  std::string blade;          ///< mesh file; empty: the built-in blisk
  std::string units;          ///< of the mesh file, as units_option.h reads it; empty: mm
  std::string out;            ///< folder; created if missing
  std::size_t points = 1900;  ///< of a blade
  std::uint64_t seed = 1;     ///< of clouds, clusters, poses, stock and noise
  int starts = 16;            ///< of k-means; 1 is the paper's method
};

/// Writes the report into the folder. When all parts are asked for, those that do not apply to the mesh are
/// left out, and the report says so. Warnings and a progress bar go to `messages`.
///
/// Throws std::invalid_argument for a mesh that cannot be read, or that does not support a part asked for by
/// name; std::runtime_error if gnuplot is missing or the folder is not writable. If it throws, a folder that
/// it created is removed again, unless it has files in it.
void runPaper(const PaperRequest& request, unsigned parts, std::ostream& messages);

}  // namespace octoblisk::demos
