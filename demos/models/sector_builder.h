// Builds one sector of a blisk: a blade, and the passage on its side of greater angles.
#pragma once

#include <vector>

#include "models/blade_surface.h"
#include "models/ring.h"
#include "models/sector_mesh.h"

namespace octoblisk::demos {

/// Adds a blade and the rings' parts of one sector to a mesh; all share the blade's vertices.
///
/// Where a ring meets the blades it is one grid: columns from the blade's forward side to the next blade's
/// backward side, rows from the leading edges to the trailing edges. From the row of the leading edges that
/// grid continues as a band, upstream, around the ring's meridian and back to the row of the trailing edges.
class SectorBuilder {
 public:
  /// The grid and the mesh must outlive the builder. `passage_cells` is the number of columns from blade to
  /// blade.
  SectorBuilder(const BladeGrid& blade, int passage_cells, SectorMesh& mesh);

  void addBlade();
  void addTipCap();

  /// `spacing` is that of the cells along the blade, mm.
  void addRing(const Ring& ring, double spacing);

 private:
  using Row = std::vector<SectorVertex>;

  SectorVertex vertex(BladeSide side, int row, int station) const;
  Row passageRow(const Ring& ring, int station);
  SectorVertex inColumn(const Row& row, int column) const;
  void addBand(const Ring& ring, double spacing, const Row& leading_row, const Row& trailing_row);
  void addCell(const Ring& ring, SectorVertex a, SectorVertex b, SectorVertex c, SectorVertex d);

  const BladeGrid& blade_;
  int passage_cells_;
  SectorMesh& mesh_;
  std::vector<SectorVertex> vertices_;  ///< of the blade's grid
};

}  // namespace octoblisk::demos
