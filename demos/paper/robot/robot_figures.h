// The figures for Table 4: errors and times along the path, and the cell.
#pragma once

#include <filesystem>
#include <vector>

#include "paper/robot/robot_report.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Draws into the folder two plots of the first run, and a picture of the cell halfway along it. Throws as
/// writeSvg and writePng.
std::vector<Figure> drawRobotFigures(const RobotReport& report, const RobotScene& scene,
                                     const std::filesystem::path& folder);

}  // namespace octoblisk::demos
