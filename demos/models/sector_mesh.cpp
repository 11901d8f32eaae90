#include "models/sector_mesh.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace octoblisk::demos {

using enum BladeSide;

SectorMesh::SectorMesh(int sector_count)
    : sector_count_(sector_count), pitch_(2.0 * std::numbers::pi / sector_count) {}

SectorVertex SectorMesh::addVertex(const CylindricalPoint& point) {
  points_.push_back(point);
  return {static_cast<std::uint32_t>(points_.size() - 1), 0};
}

Vec3 SectorMesh::position(SectorVertex vertex) const {
  CylindricalPoint point = points_[vertex.index];
  point.angle += 2.0 * std::numbers::pi * vertex.sector / sector_count_;
  return toCartesian(point);
}

void SectorMesh::addQuad(SectorVertex a, SectorVertex b, SectorVertex c, SectorVertex d, bool of_blade) {
  if (a == b || c == d) {
    faces_.push_back({{a, a == b ? c : b, a == b ? d : c}, of_blade});
    return;
  }
  const Vec3 corner_a = position(a);
  const Vec3 corner_b = position(b);
  const Vec3 corner_c = position(c);
  const Vec3 corner_d = position(d);
  const auto agree = [](const Triangle& s, const Triangle& t) {
    return scaledNormal(s).dot(scaledNormal(t)) > 0.0;
  };
  const bool flat_along_ac = agree({corner_a, corner_b, corner_c}, {corner_a, corner_c, corner_d});
  const bool flat_along_bd = agree({corner_a, corner_b, corner_d}, {corner_b, corner_c, corner_d});
  constexpr double kTie = 1.0 + 1e-6;  // equal diagonals are all cut in the same way, whatever the rounding
  const bool ac_is_shorter = (corner_c - corner_a).norm() <= kTie * (corner_d - corner_b).norm();
  if (flat_along_ac == flat_along_bd ? ac_is_shorter : flat_along_ac) {
    faces_.push_back({{a, b, c}, of_blade});
    faces_.push_back({{a, c, d}, of_blade});
  } else {
    faces_.push_back({{a, b, d}, of_blade});
    faces_.push_back({{b, c, d}, of_blade});
  }
}

Blisk SectorMesh::repeat() const {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<int> blade_of_triangle;
  vertices.reserve(points_.size() * sector_count_);
  triangles.reserve(faces_.size() * sector_count_);
  blade_of_triangle.reserve(faces_.size() * sector_count_);

  const auto points = static_cast<std::uint32_t>(points_.size());
  const auto index = [&](SectorVertex vertex, int sector) {
    const int wrapped = ((vertex.sector + sector) % sector_count_ + sector_count_) % sector_count_;
    return static_cast<std::uint32_t>(wrapped) * points + vertex.index;
  };
  for (int sector = 0; sector < sector_count_; ++sector) {
    for (std::uint32_t p = 0; p < points; ++p) vertices.push_back(position({p, sector}));
    for (const Face& face : faces_) {
      triangles.push_back(
          {index(face.corners[0], sector), index(face.corners[1], sector), index(face.corners[2], sector)});
      blade_of_triangle.push_back(face.of_blade ? sector + 1 : 0);
    }
  }
  return {TriangleMesh(std::move(vertices), std::move(triangles)), std::move(blade_of_triangle)};
}

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
