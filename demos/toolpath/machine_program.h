// Recognizes programs of machines and robots, which users give by mistake instead of a toolpath.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace octoblisk::demos {

/// What the first lines of a file seem to be, with an article: G-code, or a program of Heidenhain, KUKA, ABB
/// or FANUC; none if they seem to be none of these. Throws std::runtime_error if the file cannot be read.
std::optional<std::string_view> machineProgramIn(const std::filesystem::path& file);

}  // namespace octoblisk::demos
