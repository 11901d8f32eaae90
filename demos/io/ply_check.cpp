#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_file_check.h"
#include "io/quoted_text.h"
#include "io/text_reader.h"

namespace octoblisk::demos {
namespace {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;
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

PlyType plyType(std::string_view name, const TextReader& text) {
  constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64},
  };
  for (const auto& [known, type] : kNames) {
    if (name == known) return type;
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
      property.is_list = type == "list";
      if (property.is_list) {
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

/// Reads the numbers of a binary PLY body.
class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, std::size_t position, bool big_endian, const std::string& file)
      : bytes_(bytes), position_(position), swap_(big_endian), file_(file) {}

  double number(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return get<std::int8_t>();
      case PlyType::uint8:
        return get<std::uint8_t>();
      case PlyType::int16:
        return get<std::int16_t>();
      case PlyType::uint16:
        return get<std::uint16_t>();
      case PlyType::int32:
        return get<std::int32_t>();
      case PlyType::uint32:
        return get<std::uint32_t>();
      case PlyType::float32:
        return get<float>();
      case PlyType::float64:
        break;
    }
    return get<double>();
  }

  void endElement() {}

  [[noreturn]] void fail(const std::string& message) const {
    throw std::runtime_error(file_ + ": " + message);
  }

 private:
  template <typename Number>
  Number get() {
    if (bytes_.size() - position_ < sizeof(Number)) {
      fail("the file is truncated: its header declares more than its " + std::to_string(bytes_.size()) +
           " bytes");
    }
    char raw[sizeof(Number)];
    std::memcpy(raw, bytes_.data() + position_, sizeof(Number));
    if (swap_) std::reverse(raw, raw + sizeof(Number));
    position_ += sizeof(Number);
    Number value;
    std::memcpy(&value, raw, sizeof(Number));
    return value;
  }

  std::string_view bytes_;
  std::size_t position_;
  bool swap_;
  const std::string& file_;
};

/// Reads the numbers of an ASCII PLY body, one element per line.
class AsciiReader {
 public:
  explicit AsciiReader(TextReader& text) : text_(text) {}

  double number(PlyType) {
    if (text_.atEnd()) text_.fail("the file is truncated: its header declares more elements");
    return text_.number();
  }

  void endElement() {
    if (!text_.word().empty()) text_.fail("the line has more values than the header declares");
    text_.nextLine();
  }

  [[noreturn]] void fail(const std::string& message) const { text_.fail(message); }

 private:
  TextReader& text_;
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
        const double values = property.is_list ? reader.number(property.count_type) : 1;
        if (!isCount(values)) reader.fail("the length of a list must be a whole number from 0");
        const bool is_index = property.name == "vertex_indices" || property.name == "vertex_index";
        for (double v = 0; v < values; ++v) {
          const double value = reader.number(property.type);
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

void checkPly(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file);
  const PlyHeader header = readPlyHeader(text);
  for (const PlyElement& element : header.elements) {
    if (element.count <= static_cast<double>(bytes.size())) continue;  // an element takes at least one byte
    throw std::runtime_error(file + ": the file is truncated: its header declares more than its " +
                             std::to_string(bytes.size()) + " bytes");
  }
  if (header.format == "ascii") {
    AsciiReader reader(text);
    checkPlyBody(header, reader);
  } else if (header.format == "binary_little_endian" || header.format == "binary_big_endian") {
    static_assert(std::endian::native == std::endian::little);
    BinaryReader reader(bytes, text.position(), header.format == "binary_big_endian", file);
    checkPlyBody(header, reader);
  } else {
    throw std::runtime_error(file + ": " + inQuotes(header.format) + " is not a PLY format");
  }
}

}  // namespace octoblisk::demos
