// A surface that repeats about Z, described by one of its sectors.
#pragma once

#include <cstdint>
#include <vector>

#include "models/blade_surface.h"
#include "models/blisk.h"

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

}  // namespace octoblisk::demos
