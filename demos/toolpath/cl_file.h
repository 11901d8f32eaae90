// The moves that a cutter location file tells: APT text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// One motion statement. Lengths in mm, whatever the file's units.
struct ClMove {
  Vec3 position = Vec3::Zero();
  Vec3 tool_axis = Vec3::UnitZ();       ///< of length 1, from the tool's tip to where it is held
  std::optional<Vec3> second_axis;      ///< of length 1, square to the tool axis: GOTO with nine numbers
  double feed = 0.0;                    ///< mm/min; 0: rapid, or not told
  std::size_t line = 0, last_line = 0;  ///< of its statement
  double unit = 1.0;                    ///< mm, of the lengths in it
};

/// A statement that has no meaning here, and where it is first met.
struct ClSkipped {
  std::string word;
  std::size_t line = 0;
};

struct ClFile {
  std::vector<ClMove> moves;
  std::vector<ClSkipped> unknown;  ///< words that may mean anything; one entry a word
};

/// Reads FROM, GOTO and GODLTA with UNITS, FEDRAT, RAPID, SPINDL, TLAXIS and MULTAX.
///
/// Without UNITS lengths are mm; feeds go by minute in the file's units, by IPM or MMPM, or by revolution
/// (PERREV, IPR, MMPR) of a spindle whose speed SPINDL tells in RPM. RAPID is for the next move alone. GOTO
/// takes a point, a point and a tool axis (its length within 1e-3 of 1), or a point, a tool axis and a second
/// axis, our own way to tell a whole pose. Machine functions and the cutter (CUTTER, LOADTL, SPINDL, COOLNT,
/// PPRINT and their like) are passed over.
///
/// Throws std::runtime_error in one line naming the file, and the line: what AptText refuses; arcs and other
/// motions than those above (CIRCLE, MOVARC, CYCLE, GOFWD, ...); statements that move or turn what follows
/// (TRACUT, ORIGIN, ROTATE, COPY, MODE/INCR, ...); wrong counts, units, axes or numbers; coordinates beyond
/// ±TriangleMesh::kMaxCoordinate; statements behind FINI; a file without a move.
ClFile readClFile(const std::filesystem::path& file);

}  // namespace octoblisk::demos
