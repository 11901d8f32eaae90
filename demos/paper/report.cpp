#include "paper/report.h"

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

extern "C" {
#include <libjsonnet.h>
}

#include "io/embedded_file.h"
#include "io/number_text.h"

OCTOBLISK_EMBED(octoblisk_paper_report, OCTOBLISK_PAPER_REPORT);

namespace octoblisk::demos {

NLOHMANN_JSON_SERIALIZE_ENUM(SeriesStyle, {{SeriesStyle::line_and_points, "line_and_points"},
                                           {SeriesStyle::line, "line"},
                                           {SeriesStyle::dashed_line, "dashed_line"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Series, name, x, y, style)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Plot, title, x_label, y_label, y_log, series)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PaperPlot, file, plot)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Table, name, caption, columns, rows)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Figure, file, caption)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Section, title, paragraphs, tables, figures)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Document, title, paragraphs, sections)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PaperReport, document, plots, more_tables)

namespace {

/// The arguments of a function of the template, which must be numbers.
template <std::size_t kCount>
std::array<double, kCount> numbersOf(JsonnetVm* vm, const JsonnetJsonValue* const* arguments, int* success) {
  std::array<double, kCount> numbers{};
  *success = 1;
  for (double& number : numbers) *success &= jsonnet_json_extract_number(vm, *arguments++, &number);
  return numbers;
}

JsonnetJsonValue* fixed(void* context, const JsonnetJsonValue* const* arguments, int* success) {
  auto* vm = static_cast<JsonnetVm*>(context);
  const auto [value, digits] = numbersOf<2>(vm, arguments, success);
  return jsonnet_json_make_string(vm, fixedText(value, static_cast<int>(digits)).c_str());
}

JsonnetJsonValue* change(void* context, const JsonnetJsonValue* const* arguments, int* success) {
  auto* vm = static_cast<JsonnetVm*>(context);
  const auto [from, to, digits] = numbersOf<3>(vm, arguments, success);
  return jsonnet_json_make_string(vm, changeText(from, to, static_cast<int>(digits)).c_str());
}

std::string filled(const std::string& run) {
  const std::unique_ptr<JsonnetVm, decltype(&jsonnet_destroy)> vm(jsonnet_make(), jsonnet_destroy);
  constexpr std::array<const char*, 3> kOfFixed = {"value", "digits", nullptr};
  constexpr std::array<const char*, 4> kOfChange = {"from", "to", "digits", nullptr};
  jsonnet_native_callback(vm.get(), "fixed", fixed, vm.get(), kOfFixed.data());
  jsonnet_native_callback(vm.get(), "change", change, vm.get(), kOfChange.data());
  jsonnet_ext_code(vm.get(), "run", run.c_str());
  int failed = 0;
  char* output = jsonnet_evaluate_snippet(vm.get(), "report.jsonnet", octoblisk_paper_report_begin, &failed);
  std::string text = output;
  jsonnet_realloc(vm.get(), output, 0);
  if (failed != 0) throw std::logic_error(text);
  return text;
}

}  // namespace

PaperReport paperReport(const nlohmann::json& run) {
  const std::string text = run.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(filled(text)).get<PaperReport>();
}

void writePaperReport(const PaperReport& report, const std::filesystem::path& folder) {
  for (const PaperPlot& plot : report.plots) writeSvg(plot.plot, folder / plot.file);
  for (const Table& table : report.more_tables) writeCsv(table, folder);
  writeReport(report.document, folder);
}

}  // namespace octoblisk::demos
