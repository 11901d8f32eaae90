// Recognizes programs of machines and robots, which users give by mistake instead of a toolpath.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace octoblisk::demos {

/// Names the kind of program that a file seems to be: G-code, or a program for Heidenhain, KUKA, ABB or
/// FANUC. None if its first lines look like none of these. Throws std::runtime_error if the file cannot be
/// read.
std::optional<std::string_view> machineProgramIn(const std::filesystem::path& file);

}  // namespace octoblisk::demos
