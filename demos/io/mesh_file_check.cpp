#include "io/mesh_file_check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& message) {
  throw std::runtime_error(file + ": " + message);
}

/// Reads a text by words and lines. Its errors are std::runtime_error, "FILE:LINE: message".
class TextReader {
 public:
  TextReader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool atEnd() const { return rest().empty(); }
  std::size_t position() const { return position_; }

  /// The next word of this line; empty at the end of the line.
  std::string_view word() {
    position_ += std::min(rest().find_first_not_of(" \t\r\v\f"), rest().size());
    const std::size_t length = std::min(rest().find_first_of(" \t\r\v\f\n"), rest().size());
    const std::string_view result = rest().substr(0, length);
    position_ += length;
    return result;
  }

  /// Goes to the beginning of the next line.
  void nextLine() {
    const std::size_t line_end = rest().find('\n');
    position_ = line_end == std::string_view::npos ? text_.size() : position_ + line_end + 1;
    ++line_;
  }

  /// The next word of this line as a number. NaN and infinity pass: the mesh reader finds them.
  double number() {
    const std::string_view found = word();
    if (found.empty()) fail("a number is missing");
    const std::string_view digits = found.front() == '+' ? found.substr(1) : found;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || stop != digits.data() + digits.size()) {
      fail(inQuotes(found) + " is not a number");
    }
    return value;
  }

  /// The line of the next word, counted from 1.
  std::size_t line() const { return line_; }

  [[noreturn]] void fail(const std::string& message) const { failAt(line_, message); }
  [[noreturn]] void failAt(std::size_t line, const std::string& message) const {
    throw std::runtime_error(file_ + ":" + std::to_string(line) + ": " + message);
  }

 private:
  std::string_view rest() const { return text_.substr(position_); }

  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

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

template <typename Number>
double numberIn(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return static_cast<double>(number);
}

struct PlyType {
  std::string_view names[2];
  std::size_t size;
  double (*number)(const char* bytes);
};

constexpr PlyType kPlyTypes[] = {
    {{"char", "int8"}, 1, numberIn<std::int8_t>},    {{"uchar", "uint8"}, 1, numberIn<std::uint8_t>},
    {{"short", "int16"}, 2, numberIn<std::int16_t>}, {{"ushort", "uint16"}, 2, numberIn<std::uint16_t>},
    {{"int", "int32"}, 4, numberIn<std::int32_t>},   {{"uint", "uint32"}, 4, numberIn<std::uint32_t>},
    {{"float", "float32"}, 4, numberIn<float>},      {{"double", "float64"}, 8, numberIn<double>}};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  ///< of a list
};

struct PlyElement {
  std::string name;
  double count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
};

const PlyType* plyType(std::string_view name, const TextReader& text) {
  for (const PlyType& type : kPlyTypes) {
    if (name == type.names[0] || name == type.names[1]) return &type;
  }
  text.fail(inQuotes(name) + " is not a PLY type");
}

bool isCount(double number) { return number >= 0 && number == std::floor(number); }

/// Reads the header and leaves the reader at the beginning of the body.
PlyHeader readPlyHeader(TextReader& text) {
  if (text.word() != "ply") text.fail("a PLY file must begin with 'ply'");
  PlyHeader header;
  for (text.nextLine(); !text.atEnd(); text.nextLine()) {
    const std::string_view word = text.word();
    if (word == "format") {
      header.format = text.word();
    } else if (word == "element") {
      const std::string name(text.word());
      const double count = text.number();
      if (!isCount(count)) text.fail("the number of elements must be a whole number from 0");
      header.elements.push_back({name, count, {}});
    } else if (word == "property") {
      if (header.elements.empty()) text.fail("a property before any element");
      PlyProperty property;
      std::string_view type = text.word();
      if (type == "list") {
        property.count_type = plyType(text.word(), text);
        type = text.word();
      }
      property.type = plyType(type, text);
      property.name = text.word();
      header.elements.back().properties.push_back(property);
    } else if (word == "end_header") {
      text.nextLine();
      return header;
    }
  }
  text.fail("the file is truncated: its header has no end_header");
}

[[noreturn]] void refuseTruncatedPly(const std::string& file, std::size_t bytes) {
  refuse(file,
         "the file is truncated: its header declares more than its " + std::to_string(bytes) + " bytes");
}

/// Reads the numbers of a binary PLY body.
struct BinaryReader {
  double number(const PlyType& type) {
    if (bytes.size() - position < type.size) refuseTruncatedPly(file, bytes.size());
    char raw[sizeof(double)];
    std::memcpy(raw, bytes.data() + position, type.size);
    if (is_big_endian) std::reverse(raw, raw + type.size);
    position += type.size;
    return type.number(raw);
  }
  void endElement() {}
  [[noreturn]] void fail(const std::string& message) const { refuse(file, message); }

  std::string_view bytes;
  std::size_t position;
  bool is_big_endian;
  const std::string& file;
};

/// Reads the numbers of an ASCII PLY body, one element per line.
struct AsciiReader {
  double number(const PlyType&) {
    if (text.atEnd()) text.fail("the file is truncated: its header declares more elements");
    return text.number();
  }

  void endElement() {
    if (!text.word().empty()) text.fail("the line has more values than the header declares");
    text.nextLine();
  }

  [[noreturn]] void fail(const std::string& message) const { text.fail(message); }

  TextReader& text;
};

/// The shortest text of a number, which may be too large for any integer.
std::string textOf(double number) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

template <typename Reader>
void checkPlyBody(const PlyHeader& header, Reader& reader) {
  double vertices = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertices = element.count;
  }
  for (const PlyElement& element : header.elements) {
    for (double k = 0; k < element.count; ++k) {
      for (const PlyProperty& property : element.properties) {
        const double values = property.count_type ? reader.number(*property.count_type) : 1;
        if (!isCount(values)) reader.fail("the length of a list must be a whole number from 0");
        const bool is_index = property.name == "vertex_indices" || property.name == "vertex_index";
        for (double v = 0; v < values; ++v) {
          const double value = reader.number(*property.type);
          if (is_index && !(value >= 0 && value < vertices)) {
            reader.fail(inQuotes(element.name) + " " + std::to_string(static_cast<std::uint64_t>(k) + 1) +
                        " uses vertex " + textOf(value) + ", but there are only " +
                        std::to_string(static_cast<std::uint64_t>(vertices)) + " vertices, counted from 0");
          }
        }
      }
      reader.endElement();
    }
  }
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
  } else if (isText(probe)) {
    refuse(file,
           "not an STL file: it is a text that does not begin with 'solid'" + hintOfFormat(probe, file));
  } else if (bytes.size() < body) {
    refuse(file,
           "the file is truncated: " + std::to_string(bytes.size()) + " bytes are too few for an STL header");
  } else {
    const std::size_t announced = body + facets * kFacetBytes;
    refuse(file, std::string(bytes.size() < announced ? "the file is truncated" : "the size is wrong") +
                     ": its header declares " + std::to_string(facets) + " triangles, " +
                     std::to_string(announced) + " bytes, but it has " + std::to_string(bytes.size()));
  }
}

void checkObj(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file);
  if (text.word() == "solid") {
    refuse(file, "looks like an STL file: name it .stl");
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

void checkPly(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file);
  const PlyHeader header = readPlyHeader(text);
  for (const PlyElement& element : header.elements) {
    if (element.count <= static_cast<double>(bytes.size())) continue;  // an element takes at least one byte
    refuseTruncatedPly(file, bytes.size());
  }
  if (header.format == "ascii") {
    AsciiReader reader{text};
    checkPlyBody(header, reader);
  } else if (header.format == "binary_little_endian" || header.format == "binary_big_endian") {
    static_assert(std::endian::native == std::endian::little);
    BinaryReader reader{bytes, text.position(), header.format == "binary_big_endian", file};
    checkPlyBody(header, reader);
  } else {
    refuse(file, inQuotes(header.format) + " is not a PLY format");
  }
}

}  // namespace octoblisk::demos
