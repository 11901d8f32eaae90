// The report's section on Table 4: the experiment on a robot.
#pragma once

#include <vector>

#include "paper/claims.h"
#include "paper/robot/robot_report.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Text and tables, without figures.
Section robotSection(const RobotReport& report);

std::vector<Claim> robotClaims(const RobotReport& report);

}  // namespace octoblisk::demos
