// Reads the motions of a cutter location file in APT.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// One motion statement. Lengths in mm, whatever the file's units.
struct ClMotion {
  Vec3 position = Vec3::Zero();
  Vec3 tool_axis = Vec3::UnitZ();   ///< of length 1, from the tool's tip to its holder
  std::optional<Vec3> second_axis;  ///< of length 1, perpendicular to the tool axis: GOTO with nine numbers
  double feed = 0.0;                ///< mm/min; 0: rapid, or not given
  std::size_t line = 0, last_line = 0;  ///< of its statement
  double unit = 1.0;                    ///< mm, of the statement's lengths
};

/// A word that is ignored, and the line of its first statement.
struct ClUnknown {
  std::string word;
  std::size_t line = 0;
};

struct ClFile {
  std::vector<ClMotion> motions;
  std::vector<ClUnknown> unknown;  ///< words of unknown meaning, one entry per word
  std::size_t second_tool = 0;     ///< line where the tool first changes; 0: it never does
};

/// Reads FROM, GOTO and GODLTA with UNITS, FEDRAT, RAPID, SPINDL, TLAXIS and MULTAX.
///
/// Without UNITS, lengths are mm. Feeds are per minute in the file's units, per minute in IPM or MMPM, or per
/// revolution (PERREV, IPR, MMPR) of a spindle whose speed SPINDL gives in RPM. RAPID applies only to the
/// next motion. GOTO takes a point, a point and a tool axis (its length within 1e-3 of 1), or a point, a tool
/// axis and a second axis; the last is our own extension, which gives a complete pose. Machine functions and
/// the cutter (CUTTER, LOADTL, SPINDL, COOLNT, PPRINT and similar words) are ignored.
///
/// Throws std::runtime_error with a one-line message that names the file and the line: for what AptText
/// refuses; for arcs and other motions than those above (CIRCLE, MOVARC, CYCLE, GOFWD, ...); for statements
/// that transform the ones after them (TRACUT, ORIGIN, ROTATE, COPY, MODE/INCR, ...); for wrong counts,
/// units, axes or numbers; for coordinates beyond ±TriangleMesh::kMaxCoordinate; for statements after FINI;
/// and for a file without a motion.
ClFile readClFile(const std::filesystem::path& file);

}  // namespace octoblisk::demos
