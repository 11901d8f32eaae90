#include "models/sector_builder.h"

#include <cmath>

namespace octoblisk::demos {

using enum BladeSide;

SectorBuilder::SectorBuilder(const BladeGrid& blade, int passage_cells, SectorMesh& mesh)
    : blade_(blade), passage_cells_(passage_cells), mesh_(mesh) {
  for (const BladeSide side : {forward, backward}) {
    for (int row = 0; row <= blade.spanCells(); ++row) {
      for (int station = 0; station <= blade.chordCells(); ++station) {
        const bool at_edge = station == 0 || station == blade.chordCells();
        const bool is_shared = side == backward && at_edge;
        vertices_.push_back(is_shared ? vertex(forward, row, station)
                                      : mesh.addVertex(blade.at(side, row, station)));
      }
    }
  }
}

void SectorBuilder::addBlade() {
  for (int row = 0; row < blade_.spanCells(); ++row) {
    for (int station = 0; station < blade_.chordCells(); ++station) {
      mesh_.addQuad(vertex(forward, row, station), vertex(forward, row, station + 1),
                    vertex(forward, row + 1, station + 1), vertex(forward, row + 1, station), true);
      mesh_.addQuad(vertex(backward, row, station), vertex(backward, row + 1, station),
                    vertex(backward, row + 1, station + 1), vertex(backward, row, station + 1), true);
    }
  }
}

void SectorBuilder::addTipCap() {
  const int tip = blade_.spanCells();
  for (int station = 0; station < blade_.chordCells(); ++station) {
    mesh_.addQuad(vertex(backward, tip, station), vertex(forward, tip, station),
                  vertex(forward, tip, station + 1), vertex(backward, tip, station + 1), true);
  }
}

void SectorBuilder::addRing(const Ring& ring, double spacing) {
  std::vector<Row> passage;
  for (int station = 0; station <= blade_.chordCells(); ++station)
    passage.push_back(passageRow(ring, station));
  for (int station = 0; station < blade_.chordCells(); ++station) {
    for (int column = 0; column < passage_cells_; ++column) {
      addCell(ring, passage[station][column], passage[station][column + 1], passage[station + 1][column + 1],
              passage[station + 1][column]);
    }
  }
  addBand(ring, spacing, passage.front(), passage.back());
}

SectorVertex SectorBuilder::vertex(BladeSide side, int row, int station) const {
  const int side_and_row = (side == forward ? 0 : blade_.spanCells() + 1) + row;
  return vertices_[static_cast<std::size_t>(side_and_row) * (blade_.chordCells() + 1) + station];
}

/// From the blade's forward side to the next blade's backward side.
SectorBuilder::Row SectorBuilder::passageRow(const Ring& ring, int station) {
  const CylindricalPoint& from = blade_.at(forward, ring.blade_row, station);
  const CylindricalPoint& to = blade_.at(backward, ring.blade_row, station);
  Row row{vertex(forward, ring.blade_row, station)};
  for (int column = 1; column < passage_cells_; ++column) {
    const double fraction = static_cast<double>(column) / passage_cells_;
    const double z = std::lerp(from.z, to.z, fraction);
    const double angle = std::lerp(from.angle, to.angle + mesh_.pitch(), fraction);
    row.push_back(mesh_.addVertex({z, ring.surface.radiusAt(z), angle}));
  }
  SectorVertex end = vertex(backward, ring.blade_row, station);
  ++end.sector;
  row.push_back(end);
  return row;
}

/// The vertex of any column of a row that goes around once, continued into the other sectors.
SectorVertex SectorBuilder::inColumn(const Row& row, int column) const {
  const int wrapped = ((column % passage_cells_) + passage_cells_) % passage_cells_;
  SectorVertex result = row[wrapped];
  result.sector += (column - wrapped) / passage_cells_;
  return result;
}

/// The band's columns start at the row of the leading edges. The row of the trailing edges is rotated
/// relative to it by the blades' wrap: whole columns of the wrap are counted, and the last leg rotates by the
/// rest.
void SectorBuilder::addBand(const Ring& ring, double spacing, const Row& leading_row,
                            const Row& trailing_row) {
  const double column_angle = mesh_.pitch() / passage_cells_;
  const double leading_angle = blade_.at(forward, ring.blade_row, 0).angle;
  const double wrap = blade_.at(forward, ring.blade_row, blade_.chordCells()).angle - leading_angle;
  const int whole_columns = static_cast<int>(std::lround(wrap / column_angle));
  const double rest = wrap - whole_columns * column_angle;

  const auto addRow = [&](const Row& before, int before_shift, const Row& after, int after_shift) {
    for (int column = 0; column < passage_cells_; ++column) {
      addCell(ring, inColumn(after, column + after_shift), inColumn(after, column + 1 + after_shift),
              inColumn(before, column + 1 + before_shift), inColumn(before, column + before_shift));
    }
  };
  Row before = leading_row;
  for (const MeridianLeg& leg : ring.band) {
    const bool is_last = &leg == &ring.band.back();
    const int cells = leg.cells(spacing);
    for (int cell = 1; cell <= cells - (is_last ? 1 : 0); ++cell) {
      const double fraction = static_cast<double>(cell) / cells;
      const double turn = is_last ? rest * fraction : 0.0;
      Row row;
      for (int column = 0; column < passage_cells_; ++column) {
        row.push_back(mesh_.addVertex(leg.at(fraction, leading_angle + column * column_angle + turn)));
      }
      addRow(before, 0, row, 0);
      before = std::move(row);
    }
  }
  addRow(before, 0, trailing_row, -whole_columns);
}

/// A cell of a ring; its corners are counter-clockwise seen from far off the axis.
void SectorBuilder::addCell(const Ring& ring, SectorVertex a, SectorVertex b, SectorVertex c,
                            SectorVertex d) {
  if (ring.faces_axis) {
    mesh_.addQuad(d, c, b, a, false);
  } else {
    mesh_.addQuad(a, b, c, d, false);
  }
}

}  // namespace octoblisk::demos
