#include "models/mesh_file_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "models/text_reader.h"

namespace octoblisk::demos {
namespace {

void checkAsciiStl(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file);
  bool in_solid = false;
  bool in_facet = false;
  int corners = 0;
  while (!text.atEnd()) {
    const std::string_view word = text.word();
    if (word == "vertex") {
      for (int axis = 0; axis < 3; ++axis) text.number();
      ++corners;
    } else if (word == "facet") {
      if (in_facet) text.fail("a facet begins before the one before has ended");
      in_facet = true;
      corners = 0;
    } else if (word == "endfacet") {
      if (corners != 3) text.fail("a facet of " + std::to_string(corners) + " vertices; it must have 3");
      in_facet = false;
    } else if (word == "solid" || word == "endsolid") {
      in_solid = word == "solid";
      text.nextLine();  // past its name
    } else if (word.empty()) {
      text.nextLine();
    }
  }
  if (in_facet) text.fail("the file is truncated: its last facet has no endfacet");
  if (in_solid) text.fail("the file is truncated: its solid has no endsolid");
}

}  // namespace

void checkStl(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kHeaderBytes = 80;
  constexpr std::size_t kFacetBytes = 50;
  constexpr std::size_t kProbedBytes = 512;
  std::uint32_t facets = 0;
  const std::size_t body = kHeaderBytes + sizeof(facets);
  if (bytes.size() >= body) std::memcpy(&facets, bytes.data() + kHeaderBytes, sizeof(facets));
  if (bytes.size() >= body && bytes.size() == body + facets * kFacetBytes) return;

  const std::string_view probe = bytes.substr(0, kProbedBytes);
  const std::size_t text_begin = std::min(probe.find_first_not_of(" \t\r\n"), probe.size());
  if (probe.substr(text_begin).starts_with("solid") && probe.find('\0') == std::string_view::npos) {
    checkAsciiStl(bytes, file);
  } else if (bytes.size() < body) {
    throw std::runtime_error(file + ": the file is truncated: " + std::to_string(bytes.size()) +
                             " bytes are less than an STL header");
  } else {
    const std::size_t announced = body + facets * kFacetBytes;
    throw std::runtime_error(
        file + (bytes.size() < announced ? ": the file is truncated" : ": the size is wrong") +
        ": its header announces " + std::to_string(facets) + " triangles, " + std::to_string(announced) +
        " bytes, but it has " + std::to_string(bytes.size()));
  }
}

void checkObj(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file);
  for (; !text.atEnd(); text.nextLine()) {
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      for (int axis = 0; axis < 3; ++axis) text.number();
    } else if (keyword == "f") {
      std::size_t corners = 0;
      for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
        if (word == "\\") text.nextLine();  // goes on in the next line
        if (word != "\\") ++corners;
      }
      if (corners < 3) text.fail("a face of " + std::to_string(corners) + " corners; it must have 3 or more");
    }
  }
  if (!bytes.ends_with('\n')) {
    throw std::runtime_error(file + ": the file is truncated: its last line has no line end");
  }
}

}  // namespace octoblisk::demos
