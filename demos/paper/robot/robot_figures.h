// The picture of Table 4's cell.
#pragma once

#include <filesystem>

#include "paper/robot/robot_report.h"

namespace octoblisk::demos {

/// Draws the cell halfway along the first run. Throws as writePng.
void drawRobotCell(const RobotReport& report, const RobotScene& scene, const std::filesystem::path& file);

}  // namespace octoblisk::demos
