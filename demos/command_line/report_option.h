// The option of the commands that write a replay.
#pragma once

#include <CLI/App.hpp>

namespace octoblisk::demos {

/// --report, the default, and --no-report.
inline void addReportOption(CLI::App& command, bool& report) {
  command
      .add_flag("--report,!--no-report", report,
                "Write report.html, run.glb and the files for ParaView, or leave them out")
      ->capture_default_str();
}

/// For the footers.
inline constexpr const char* kReportFooter =
    "To look at, in OUT, without a network: report.html, a replay in the browser with chart and table; "
    "run.glb,\n"
    "the same as glTF for Blender and others, 20 poses a second; contacts.vtk and path.vtk for ParaView.\n";

}  // namespace octoblisk::demos
