#include "report/vtk_file.h"

#include <bit>
#include <cctype>
#include <concepts>
#include <cstdint>
#include <vector>

#include "io/new_file.h"

namespace octoblisk::demos {
namespace {

/// Legacy VTK's numbers are big-endian.
template <typename Number>
requires(sizeof(Number) == 4) void appendBigEndian(std::string& bytes, Number number) {
  const auto word = std::bit_cast<std::uint32_t>(number);
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
}

void appendPoint(std::string& bytes, const Vec3& point) {
  for (const double value : point) appendBigEndian(bytes, static_cast<float>(value));
}

/// ASCII only: units in words, and "?" for every other byte that is not ASCII.
std::string asciiText(const std::string& text) {
  std::string ascii;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "°") == 0) {
      ascii += " degrees";
      ++i;
    } else {
      ascii += std::isprint(static_cast<unsigned char>(text[i])) != 0 ? text[i] : '?';
    }
  }
  return ascii;
}

/// A line of text of at most 255 characters.
std::string titleLine(const std::string& text) {
  constexpr std::size_t kMaxLength = 255;
  return asciiText(text).substr(0, kMaxLength);
}

std::string vtkHead(const std::string& title, std::size_t points) {
  return "# vtk DataFile Version 3.0\n" + titleLine(title) + "\nBINARY\nDATASET POLYDATA\nPOINTS " +
         std::to_string(points) + " float\n";
}

/// A word to name an array: characters other than letters and digits become "_".
std::string arrayName(const std::string& text) {
  std::string name;
  for (const char c : asciiText(text)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  if (name.ends_with('_')) name.pop_back();
  return name;
}

template <typename Number>
std::string scalars(const std::string& name, const std::vector<Number>& values) {
  const char* const type = std::same_as<Number, float> ? " float 1" : " int 1";
  std::string bytes = "\nSCALARS " + arrayName(name) + type + "\nLOOKUP_TABLE default\n";
  for (const Number value : values) appendBigEndian(bytes, value);
  return bytes;
}

std::string namesOf(const Replay& replay) {
  std::string text = "verdict:";
  for (std::size_t v = 0; v < replay.verdicts.size(); ++v) {
    text += (v > 0 ? ", " : " ") + std::to_string(v) + ' ' + replay.verdicts[v].name;
  }
  text += "; part:";
  for (std::size_t p = 0; p < replay.parts.size(); ++p) {
    text += (p > 0 ? ", " : " ") + std::to_string(p) + ' ' + replay.parts[p].name;
  }
  return text;
}

}  // namespace

std::string contactsVtk(const Replay& replay, std::size_t track) {
  const std::vector<ReplayPose>& poses = replay.tracks.at(track).poses;
  std::string points, cells, normals;
  std::vector<std::int32_t> pose, verdict, part, blade;
  std::vector<float> depth;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    for (const ReplayContact& contact : poses[p].contacts) {
      appendBigEndian(cells, std::int32_t{1});
      appendBigEndian(cells, static_cast<std::int32_t>(pose.size()));
      appendPoint(points, contact.point);
      appendPoint(normals, contact.normal);
      pose.push_back(static_cast<std::int32_t>(p));
      verdict.push_back(static_cast<std::int32_t>(contact.verdict));
      part.push_back(static_cast<std::int32_t>(contact.part));
      blade.push_back(contact.blade);
      depth.push_back(static_cast<float>(contact.depth));
    }
  }
  const std::string count = std::to_string(pose.size());
  return vtkHead("octoblisk contacts, mm; " + namesOf(replay), pose.size()) + points + "\nVERTICES " + count +
         ' ' + std::to_string(2 * pose.size()) + '\n' + cells + "\nPOINT_DATA " + count +
         scalars("pose", pose) + scalars("verdict", verdict) + scalars("part", part) +
         scalars("blade", blade) + scalars("depth_mm", depth) + "\nNORMALS normal float\n" + normals + '\n';
}

std::string pathVtk(const Replay& replay, std::size_t track) {
  const ReplayTrack& shown = replay.tracks.at(track);
  std::string points, cells;
  std::vector<std::int32_t> pose, verdict;
  appendBigEndian(cells, static_cast<std::int32_t>(shown.poses.size()));
  for (std::size_t p = 0; p < shown.poses.size(); ++p) {
    appendPoint(points, shown.poses[p].tool_in_blisk.translation);
    appendBigEndian(cells, static_cast<std::int32_t>(p));
    pose.push_back(static_cast<std::int32_t>(p));
    verdict.push_back(static_cast<std::int32_t>(shown.poses[p].verdict));
  }
  const std::string count = std::to_string(pose.size());
  std::string text = vtkHead("octoblisk path of the tool's origin, mm; " + namesOf(replay), pose.size()) +
                     points + "\nLINES 1 " + std::to_string(pose.size() + 1) + '\n' + cells +
                     "\nPOINT_DATA " + count + scalars("pose", pose) + scalars("verdict", verdict);
  for (const ReplaySeries& series : shown.series) {
    std::vector<float> values;
    for (const double value : series.values) values.push_back(static_cast<float>(value));
    text += scalars(series.name + ' ' + series.unit, values);
  }
  return text + '\n';
}

void writeVtk(const Replay& replay, const std::filesystem::path& contacts,
              const std::filesystem::path& path) {
  writeFile(contacts, contactsVtk(replay));
  writeFile(path, pathVtk(replay));
}

}  // namespace octoblisk::demos
