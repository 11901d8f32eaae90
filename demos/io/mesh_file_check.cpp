#include "io/mesh_file_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "io/text_reader.h"

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
      if (in_facet) text.fail("a facet begins before the previous one has ended");
      in_facet = true;
      corners = 0;
    } else if (word == "endfacet") {
      if (corners != 3) text.fail("a facet has " + std::to_string(corners) + " vertices; it must have 3");
      in_facet = false;
    } else if (word == "solid" || word == "endsolid") {
      in_solid = word == "solid";
      text.nextLine();  // skips its name
    } else if (word.empty()) {
      text.nextLine();
    }
  }
  if (in_facet) text.fail("the file is truncated: its last facet has no endfacet");
  if (in_solid) text.fail("the file is truncated: its solid has no endsolid");
}

bool isText(std::string_view bytes) {
  return std::ranges::all_of(bytes, [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code >= ' ' || (code >= '\t' && code <= '\r');
  });
}

/// A guess of the format from the beginning of a text that is not STL.
std::string hintOfFormat(std::string_view begin, const std::string& file) {
  TextReader text(begin, file);
  if (text.word() == "ply") return "; it looks like a PLY file: name it .ply";
  text = TextReader(begin, file);
  for (; !text.atEnd(); text.nextLine()) {
    const std::string_view keyword = text.word();
    for (const std::string_view of_obj : {"v", "vn", "vt", "f", "o", "g", "mtllib"}) {
      if (keyword == of_obj) return "; it looks like an OBJ file: name it .obj";
    }
  }
  return "";
}

/// Compares the vertices that the faces of an OBJ use with those that the file has.
class ObjIndices {
 public:
  void addVertex() { ++vertices_; }

  /// Takes a corner's vertex: counted from 1, or if negative, back from the latest.
  void useVertex(std::string_view word, const TextReader& text) {
    std::int64_t index = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc{} || stop != word.data() + word.size()) {
      text.fail(inQuotes(word) + " is not an index of a vertex");
    }
    if (index == 0 || index < -vertices_) fail(index, text.line(), text);
    if (index <= greatest_) return;
    greatest_ = index;
    line_of_greatest_ = text.line();
  }

  /// Faces may come before their vertices, so this check needs the whole file.
  void requireVertices(const TextReader& text) const {
    if (greatest_ > vertices_) fail(greatest_, line_of_greatest_, text);
  }

 private:
  [[noreturn]] void fail(std::int64_t index, std::size_t line, const TextReader& text) const {
    text.failAt(line, "a face uses vertex " + std::to_string(index) + ", but there are only " +
                          std::to_string(vertices_) + " vertices, counted from 1");
  }

  std::int64_t vertices_ = 0, greatest_ = 0;
  std::size_t line_of_greatest_ = 0;
};

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
  } else if (isText(probe)) {
    throw std::runtime_error(file + ": not an STL file: it is a text that does not begin with 'solid'" +
                             hintOfFormat(probe, file));
  } else if (bytes.size() < body) {
    throw std::runtime_error(file + ": the file is truncated: " + std::to_string(bytes.size()) +
                             " bytes are too few for an STL header");
  } else {
    const std::size_t announced = body + facets * kFacetBytes;
    throw std::runtime_error(
        file + (bytes.size() < announced ? ": the file is truncated" : ": the size is wrong") +
        ": its header declares " + std::to_string(facets) + " triangles, " + std::to_string(announced) +
        " bytes, but it has " + std::to_string(bytes.size()));
  }
}

void checkObj(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file);
  if (text.word() == "solid") {
    throw std::runtime_error(file + ": looks like an STL file: name it .stl");
  }
  text = TextReader(bytes, file);
  ObjIndices indices;
  for (; !text.atEnd(); text.nextLine()) {
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      for (int axis = 0; axis < 3; ++axis) text.number();
      indices.addVertex();
    } else if (keyword == "f") {
      std::size_t corners = 0;
      for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
        if (word == "\\") {
          text.nextLine();  // the face continues on the next line
        } else {
          indices.useVertex(word.substr(0, word.find('/')), text);
          ++corners;
        }
      }
      if (corners < 3)
        text.fail("a face has " + std::to_string(corners) + " corners; it must have 3 or more");
    }
  }
  indices.requireVertices(text);
}

}  // namespace octoblisk::demos
