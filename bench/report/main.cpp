// Makes one page and plots from the rows.
//
//   bench_report RESULTS [PAGE]
//
// Reads RESULTS/*.json (rows) and RESULTS/google/*.json (Google Benchmark's files, which describe the
// machine). Writes RESULTS/machine.json, RESULTS/README.md and RESULTS/*.svg. Inserts a table and the plots
// into PAGE between its marker lines. Prints the rows in which another library is faster.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "report/markdown.h"
#include "report/results_page.h"

namespace octoblisk::bench {
namespace {

namespace fs = std::filesystem;

Row objectIn(const fs::path& file) {
  std::ifstream in(file);
  const Row parsed = in ? Row::parse(in, nullptr, false) : Row();
  return parsed.is_object() ? parsed : Row::object();
}

/// The machine in the newest file of Google Benchmark, or else in machine.json.
Row machineIn(const fs::path& results) {
  Row newest = objectIn(results / "machine.json");
  if (!fs::is_directory(results / "google")) return newest;
  for (const auto& entry : fs::directory_iterator(results / "google")) {
    const Row parsed = objectIn(entry.path());
    if (!parsed.contains("context")) continue;
    const Row& context = parsed["context"];
    if (newest.value("date", "") < context.value("date", "")) newest = context;
  }
  return newest;
}

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

int run(const fs::path& results, const char* page_file) {
  const Rows rows = readAllRows(results);
  if (rows.empty()) throw std::runtime_error(results.string() + ": contains no rows");
  const Row machine = machineIn(results);
  write(results / "machine.json", machine.dump(1) + '\n');
  const ResultsPage page = resultsPage(rows, machine);
  write(results / "README.md", page.text);
  for (const auto& [file, plot] : page.plots) draw(plot, results / file);
  for (const auto& [file, plot] : page.time_plots) draw(plot, results / file);
  if (page_file != nullptr) {
    const std::string folder = fs::relative(results, fs::absolute(page_file).parent_path()).generic_string();
    write(page_file, spliced(textOf(page_file), "benchmarks", summary(rows, folder)));
  }
  std::printf("%zu rows: %s\n", rows.size(), (results / "README.md").c_str());
  if (const std::string lost = lostTable(rows); !lost.empty())
    std::printf("Rows in which another library is faster:\n\n%s", lost.c_str());
  return 0;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::fprintf(stderr, "usage: bench_report RESULTS [PAGE]\n");
    return 2;
  }
  try {
    return octoblisk::bench::run(argv[1], argc > 2 ? argv[2] : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_report: %s\n", error.what());
    return 2;
  }
}
