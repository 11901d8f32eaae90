// What octoblisk inspect tells about a mesh, as text and as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "octoblisk/inspection.h"

namespace octoblisk::demos {

/// A mesh whose planar holes were closed.
struct ClosedReport {
  std::filesystem::path file;
  std::vector<HoleCap> added;
  std::vector<MeshGap> refused;
  MeshInspection found;
};

struct InspectionReport {
  std::filesystem::path file;
  std::string unit;  ///< "mm", or empty for the file's
  Vec3 size = Vec3::Zero();
  MeshInspection found;
  std::optional<ClosedReport> closed{};

  /// Of the mesh, or of the closed one if there is one.
  bool isSolid() const { return (closed ? closed->found : found).isSolid(); }
};

/// Size, state, the defects that occur with their numbers and first places, and what follows.
std::string inspectionText(const InspectionReport& report);

/// The same as one JSON object. All holes, and of each kind of defect the places of the first ten.
std::string inspectionJson(const InspectionReport& report);

}  // namespace octoblisk::demos
