// The paper's experiments run again, and the report on them.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace octoblisk::demos {

/// Parts of the report, to be joined by |.
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
  std::string out;            ///< folder; made where missing
  std::size_t points = 1900;  ///< of a blade
  std::uint64_t seed = 1;     ///< of clouds, clusters, poses, stock and noise
  int starts = 16;            ///< of k-means; 1 is the paper's own
};

/// Writes the report into the folder. Of all parts, those that the mesh is not made for are left out, which
/// the report says; warnings and a progress bar go to `messages`.
///
/// Throws std::invalid_argument for a mesh that cannot be read, or one of which a part that was asked for by
/// name cannot be made; std::runtime_error where gnuplot is missing or the folder cannot be written. A folder
/// that was made for it is gone again then, unless something is in it.
void runPaper(const PaperRequest& request, unsigned parts, std::ostream& messages);

}  // namespace octoblisk::demos
