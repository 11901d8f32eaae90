// The option of the subcommands that write a replay.
#pragma once

#include <CLI/App.hpp>

namespace octoblisk::demos {

/// Adds --report, which is the default, and --no-report.
inline void addReportOption(CLI::App& command, bool& report) {
  command
      .add_flag("--report,!--no-report", report,
                "Write report.html, run.glb and the files for ParaView, or do not")
      ->capture_default_str();
}

}  // namespace octoblisk::demos
