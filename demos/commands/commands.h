// The subcommands of octoblisk. Each adds itself to the app and sets the exit code when it has run.
// Bad input is thrown as std::exception with a one-line message that names the file and place.
#pragma once

#include <CLI/App.hpp>

namespace octoblisk::demos {

void addAccessCommand(CLI::App& app, int& exit_code);
void addBladesCommand(CLI::App& app, int& exit_code);
void addCheckCommand(CLI::App& app, int& exit_code);
void addGalleryCommand(CLI::App& app, int& exit_code);
void addGrindCommand(CLI::App& app, int& exit_code);
void addInspectCommand(CLI::App& app, int& exit_code);
void addMakeCommand(CLI::App& app, int& exit_code);
void addMergeCommand(CLI::App& app, int& exit_code);
void addPaperCommand(CLI::App& app, int& exit_code);
void addPathCommand(CLI::App& app, int& exit_code);
void addPlanCommand(CLI::App& app, int& exit_code);
void addRepairCommand(CLI::App& app, int& exit_code);

}  // namespace octoblisk::demos
