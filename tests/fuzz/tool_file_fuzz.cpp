// Reads any bytes as a tool's JSON file. It is refused with a one-line message, or its meaning survives
// writing and reading.
#include "fuzz/fuzz_input.h"
#include "grinding/tool_file.h"

using namespace octoblisk;
using namespace octoblisk::demos;

namespace {

bool isSame(const BladeChoice& a, const BladeChoice& b) { return a.kind == b.kind && a.number == b.number; }

bool isSame(const ToolFilePart& a, const ToolFilePart& b) {
  return a.name == b.name && a.max_depth == b.max_depth;
}
bool isSame(const AllowedPair& a, const AllowedPair& b) {
  return a.part == b.part && isSame(a.blade, b.blade);
}
bool isSame(const PairMargin& a, const PairMargin& b) {
  return a.part == b.part && isSame(a.blade, b.blade) && a.near_miss == b.near_miss;
}

template <typename Row>
void requireSame(const std::vector<Row>& read, const std::vector<Row>& again) {
  const auto same = [](const Row& a, const Row& b) { return isSame(a, b); };
  if (!std::ranges::equal(read, again, same)) fuzz::fail("a row changed");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFolder folder;
  static const std::filesystem::path mesh = folder.write("a.ply", "");  // the seeds name it
  const std::filesystem::path file = folder.write("tool.json", fuzz::textOf(data, size));
  ToolFile tool;
  try {
    tool = readToolFile(file);
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, file);
    return 0;
  }
  const std::filesystem::path copy = folder.path() / "written.json";
  writeToolFile(copy, tool);
  const ToolFile again = readToolFile(copy);
  requireSame(tool.parts, again.parts);
  requireSame(tool.allowed, again.allowed);
  requireSame(tool.margins, again.margins);
  return 0;
}
