// Figure 7: the flow chart of the paper's algorithm as this project runs it.
#pragma once

#include "render/flow_chart.h"

namespace octoblisk::demos {

FlowChart algorithmChart();

}  // namespace octoblisk::demos
