// One sector of a blisk, a blade and the passage on its side of greater angles, repeated about Z.
#pragma once

#include <cstdint>
#include <vector>

#include "models/blade_surface.h"
#include "models/blisk.h"
#include "models/ring.h"

namespace octoblisk::demos {

/// A vertex of the described sector, or the same vertex some sectors forward (towards greater angles) or
/// backward.
struct SectorVertex {
  std::uint32_t index = 0;
  int sector = 0;

  bool operator==(const SectorVertex&) const = default;
};

/// Collects the vertices and faces of one sector and repeats them about Z.
class SectorMesh {
 public:
  explicit SectorMesh(int sector_count);

  /// The angle from one sector to the next, radians.
  double pitch() const { return pitch_; }

  SectorVertex addVertex(const CylindricalPoint& point);

  /// Adds a face with corners counter-clockwise from outside, divided along its shorter diagonal unless that
  /// folds it. Two neighbouring corners may be the same; then it is one triangle.
  void addQuad(SectorVertex a, SectorVertex b, SectorVertex c, SectorVertex d, bool of_blade);

  /// All sectors. Faces of blades have their sector's number, from 1; the others have 0.
  Blisk repeat() const;

 private:
  struct Face {
    SectorVertex corners[3];
    bool of_blade;
  };

  Vec3 position(SectorVertex vertex) const;

  int sector_count_;
  double pitch_;
  std::vector<CylindricalPoint> points_;
  std::vector<Face> faces_;
};

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
