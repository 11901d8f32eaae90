// The tables of Table 4's section.
#pragma once

#include <string>
#include <vector>

#include "paper/robot/robot_report.h"
#include "render/document.h"

namespace octoblisk::demos {

/// In the paper's form; times; alarms; the robot; the assumptions.
std::vector<Table> robotTables(const RobotReport& report);

std::string microseconds(double seconds);  ///< "12.3"
std::string milliseconds(double seconds);  ///< "0.12"

}  // namespace octoblisk::demos
