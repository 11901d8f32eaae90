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

}  // namespace octoblisk::demos
