// The content of a replay, whatever made it: a blisk, a tool along one or more paths, and the findings there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grinding/fixture.h"
#include "grinding/grinding_cell.h"
#include "render/display_mesh.h"
#include "render/document.h"

namespace octoblisk::demos {

/// The display of a verdict: each tone has a colour and a sign.
enum class Tone { clear, intended, near, interference, open };

struct ReplayVerdict {
  std::string name{};
  Tone tone = Tone::clear;
};

/// Indices of verdicts refer to Replay::verdicts, those of parts to Replay::parts; points are in the blisk's
/// frame, mm.
struct ReplayContact {
  std::size_t verdict = 0;
  std::size_t part = 0;
  int blade = 0;  ///< 0: hub or shroud; above the number of blades: a fixture
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit, from the part into the blisk
  double depth = 0.0;          ///< mm; a clearance is negative
};

/// The part and blade that touch at a pose, or are nearest to touching.
struct ReplayNearest {
  std::size_t part = 0;
  int blade = 0;
  double depth = 0.0;  ///< mm; a clearance is negative
  std::string side{};  ///< "convex" or "concave"; if unknown, "forward" or "backward"; or empty
};

struct ReplayPose {
  Pose tool_in_blisk{};
  std::size_t verdict = 0;
  std::vector<ReplayContact> contacts{};
  std::optional<ReplayNearest> worst{};      ///< decides the verdict
  std::optional<ReplayNearest> clearance{};  ///< from forbidden surfaces
  std::string text{};                        ///< replaces these two in the display if it is not empty
};

/// A row of the table of findings.
struct ReplayFinding {
  double at = 0.0;  ///< the pose, or a place between two
  std::size_t verdict = 0;
  std::optional<std::size_t> part{};
  std::optional<int> blade{};
  std::string side{};             ///< as above
  std::optional<double> value{};  ///< in the table's last column
  std::optional<std::size_t> motion_to{};
};

/// Numbers over the path.
struct ReplaySeries {
  std::size_t chart = 0;  ///< index into Replay::charts
  std::string name{};
  std::string unit{};
  std::vector<double> values{};  ///< one per pose; NaN: none
  bool in_status = false;        ///< whether the status line shows it at poses where it is not 0
};

struct ReplayTrack {
  std::string name{};
  std::vector<ReplayPose> poses{};  ///< at least one
  std::vector<ReplaySeries> series{};
  std::vector<ReplayFinding> findings{};
};

struct ReplayChart {
  struct Limit {
    double value;
    std::string name;
  };
  std::string title{}, unit{};
  double linear_within = 0.0;  ///< outside, the scale may be logarithmic; 0: the scale is linear
  std::vector<Limit> limits{};
};

struct ReplayCount {
  std::string name{};
  std::size_t count = 0;
  Tone tone = Tone::clear;
};

/// A share of a whole, in percent.
struct ReplayShare {
  std::string name{};
  double percent = 0.0;
  Tone tone = Tone::clear;
};

/// Coloured cells over a blade's side.
struct ReplaySide {
  struct Color {
    std::string color{}, name{};  ///< "#rrggbb", and its meaning
  };
  std::string name{};           ///< of the check box that shows them
  std::size_t columns = 0;      ///< of cells
  std::vector<Vec3> corners{};  ///< row by row, columns + 1 in each, a little off the blade
  std::vector<std::uint8_t> color_of_cell{};
  std::vector<Color> colors{};
  std::string region{};               ///< "convex side of blade 1"
  std::vector<ReplayShare> shares{};  ///< of the region
};

struct Replay {
  std::string command{}, title{}, subtitle{};
  std::string one = "pose", many = "poses";  ///< name of a step of a track
  std::string findings_title{}, findings_value{}, no_findings{};
  std::vector<ReplayVerdict> verdicts{};
  std::vector<ReplayCount> counts{};
  std::shared_ptr<const ClusteredOctree> blisk{};
  std::vector<int> blade_of_triangle{};
  int blade_count = 0, ground_blade = 0;
  std::vector<Fixture> fixtures{};
  std::vector<ToolPart> parts{};
  std::optional<ReplaySide> side{};
  std::vector<ReplayChart> charts{};
  std::vector<ReplayTrack> tracks{};  ///< at least one
  std::size_t start_track = 0;
  double start_at = 0.0;
  bool contacts_of_all_poses = false;  ///< whether all contacts are shown at first, and no path
  std::vector<Table> facts{};          ///< limits, files, versions
  std::vector<std::string> notes{};
};

/// The display colour of a tool's part, "#rrggbb".
std::string colorOfPart(const std::string& name, std::size_t index);

/// Meshes with more triangles are simplified (display_mesh.h).
struct DrawnTriangles {
  std::size_t blisk = 150'000;
  std::size_t part = 40'000;  ///< per part
};

struct ReplayMeshes {
  DisplayMesh blisk;  ///< one group per blade
  std::vector<DisplayMesh> parts;
};

ReplayMeshes replayMeshesOf(const Replay& replay, const DrawnTriangles& most = {});

}  // namespace octoblisk::demos
