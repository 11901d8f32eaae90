// Every block of code of the pages is run as it stands there, or held to what is run: C++ by tests/consumers,
// lines for a shell here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "pages/code_blocks.h"
#include "pages/synopsis.h"

namespace octoblisk::pages {
namespace {

using demos::contentOf;
using demos::Outcome;
using demos::ScratchFolder;
using ::testing::Contains;
using ::testing::HasSubstr;

const std::filesystem::path kProject = OCTOBLISK_SOURCE_DIR;

enum class Kind { cpp, cmake, flow_chart, dev_verbs, presets, benchmark, row, octoblisk, example, study };

/// How a block that no fence names begins.
const std::vector<std::pair<std::string, Kind>> kBeginnings = {
    {"./dev ", Kind::dev_verbs},    {"cmake --preset ", Kind::presets}, {"build/bench/bin/", Kind::benchmark},
    {"{\"task\", ", Kind::row},     {"octoblisk check …", Kind::study}, {"octoblisk ", Kind::octoblisk},
    {"for side in ", Kind::example}};
const std::map<std::string, Kind> kLanguages = {
    {"cpp", Kind::cpp}, {"cmake", Kind::cmake}, {"mermaid", Kind::flow_chart}};

std::optional<Kind> kindOf(const CodeBlock& block) {
  if (const auto known = kLanguages.find(block.language); known != kLanguages.end()) return known->second;
  if (!block.language.empty()) return std::nullopt;
  for (const auto& [beginning, kind] : kBeginnings) {
    if (block.text.starts_with(beginning)) return kind;
  }
  return std::nullopt;
}

std::vector<CodeBlock> allBlocks() {
  std::vector<CodeBlock> all;
  for (const std::string& page : pagesOf(kProject)) {
    for (CodeBlock& block : codeBlocksOf(kProject, page)) all.push_back(std::move(block));
  }
  return all;
}

/// Those of a kind; a failure where there is none.
std::vector<CodeBlock> blocksOf(Kind kind) {
  std::vector<CodeBlock> blocks = allBlocks();
  std::erase_if(blocks, [&](const CodeBlock& block) { return kindOf(block) != kind; });
  EXPECT_FALSE(blocks.empty()) << "this test asks nothing";
  return blocks;
}

std::vector<std::string> found(const std::string& text, const std::string& expression) {
  const std::regex searched(expression);
  std::vector<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), searched), end; at != end; ++at) {
    all.push_back((*at)[1]);
  }
  return all;
}

/// With another text for every part that is there; a failure where there is none.
std::string replaced(std::string text, const std::string& part, const std::string& by) {
  EXPECT_THAT(text, HasSubstr(part));
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += by.size()) {
    text.replace(at, part.size(), by);
  }
  return text;
}

std::string without(const std::string& text, const std::string& part) { return replaced(text, part, ""); }

/// Runs lines for a shell in a folder, where `octoblisk` is ours.
Outcome runScript(const ScratchFolder& folder, const std::string& script) {
  const std::string path = std::filesystem::path(OCTOBLISK_COMMAND).parent_path().string();
  // Whoever the user is, and however many processors the machine has.
  const std::string mpi =
      "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
      "OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_vader_single_copy_mechanism=none "
      "OMPI_MCA_btl=self,vader\n";
  folder.write("script.sh", mpi + "export PATH='" + path + "':\"$PATH\" LSAN_OPTIONS='suppressions=" +
                                OCTOBLISK_LEAK_SUPPRESSIONS ":print_suppressions=0'\n" + script);
  const std::string command =
      "cd '" + folder.path().string() + "' && sh -eu script.sh >stdout.txt 2>stderr.txt </dev/null";
  return demos::outcomeOf(std::system(command.c_str()), folder.path());
}

/// Exit code 0; or 1 where the last call of octoblisk is one that may find interference.
void expectDone(const ScratchFolder& folder, const std::string& script) {
  const std::set<std::string> studies = {"access", "check", "grind", "merge", "repair"};
  const std::vector<std::string> commands = found(script, "octoblisk ([a-z]+)");
  const demos::ExitCode exit_code = runScript(folder, script).exit_code;
  EXPECT_TRUE(exit_code == 0 || (exit_code == 1 && !commands.empty() && studies.contains(commands.back())))
      << script << "\nexit code " << exit_code;
}

TEST(Pages, HaveNoBlocksButThoseThatAreTested) {
  std::set<Kind> kinds;
  for (const CodeBlock& block : allBlocks()) {
    const std::optional<Kind> kind = kindOf(block);
    ASSERT_TRUE(kind) << block.place() << ": no test knows what to do with it";
    kinds.insert(*kind);
    const std::filesystem::path page = block.page;
    const bool is_compiled =
        page == "README.md" || (page.parent_path() == "docs" && page.filename() != "gallery.md");
    EXPECT_TRUE(kind != Kind::cpp || is_compiled) << block.place() << ": tests/consumers does not take it";
    EXPECT_TRUE(kind != Kind::cmake || block.page == "README.md") << block.place();
  }
  EXPECT_EQ(kinds.size(), kBeginnings.size() + kLanguages.size());
}

/// In blocks and in sentences: verbs that ./dev knows.
TEST(Pages, NameVerbsOfDev) {
  const ScratchFolder folder;
  const Outcome help = runScript(folder, "cd '" + kProject.string() + "'; ./dev help");
  ASSERT_EQ(help.exit_code, 0);
  std::string lines;
  for (const CodeBlock& block : blocksOf(Kind::dev_verbs)) lines += block.text;
  EXPECT_GE(found(lines, R"(\./dev ([a-z-]+))").size(), 5u);
  for (const std::string& page : pagesOf(kProject)) {
    for (const std::string& verb : found(contentOf(kProject / page), R"(\./dev\s+([a-z][a-z-]*))")) {
      EXPECT_THAT(found(help.out, R"(\n  ([a-z-]+) +[a-z])"), Contains(verb)) << page;
    }
  }
  for (const std::string& option : found(lines, "(--[a-z]+)")) EXPECT_THAT(help.out, HasSubstr(option + " "));
  for (const std::string& tasks : found(lines, "--only ([^ ]+)")) {
    for (std::string task : found(tasks, "([a-z-]+)")) {
      std::ranges::replace(task, '-', '_');
      const auto begins = [&](const auto& entry) {
        return entry.path().filename().string().starts_with(task);
      };
      EXPECT_TRUE(std::ranges::any_of(std::filesystem::directory_iterator(kProject / "bench/tasks"), begins))
          << task;
    }
  }
}

TEST(Pages, NamePresets) {
  const auto presets = nlohmann::json::parse(contentOf(kProject / "CMakePresets.json"));
  const std::map<std::string, std::string> kinds = {{"cmake --preset", "configurePresets"},
                                                    {"cmake --build --preset", "buildPresets"},
                                                    {"ctest --preset", "testPresets"}};
  for (const CodeBlock& block : blocksOf(Kind::presets)) {
    std::istringstream commands(replaced(block.text, " && ", "\n"));
    for (std::string command; std::getline(commands, command);) {
      const std::size_t space = command.rfind(' ');
      ASSERT_TRUE(kinds.contains(command.substr(0, space))) << command;
      std::vector<std::string> names;
      for (const auto& preset : presets.at(kinds.at(command.substr(0, space))))
        names.push_back(preset.at("name"));
      EXPECT_THAT(names, Contains(command.substr(space + 1))) << block.place();
    }
  }
}

TEST(Pages, NameProgramsAndOptionsOfBenchmarks) {
  const std::string session = contentOf(kProject / "bench/session.cpp");
  for (const CodeBlock& block : blocksOf(Kind::benchmark)) {
    for (const std::string& task : found(block.text, "/bench_([a-z_]+)")) {
      EXPECT_TRUE(std::filesystem::exists(kProject / "bench/tasks" / (task + ".cpp"))) << task;
    }
    for (const std::string& option : found(block.text, "(--[a-z_]+)")) {
      EXPECT_TRUE(option.starts_with("--benchmark_") || session.find('"' + option + '"') != std::string::npos)
          << option;
    }
  }
}

TEST(Pages, TellOfRowsAsTheyAre) {
  int rows = 0;
  for (const CodeBlock& block : blocksOf(Kind::row)) {
    const std::vector<std::string> keys = found(block.text, "\"([a-z_]+)\"");
    for (const auto& entry : std::filesystem::directory_iterator(kProject / "bench/results")) {
      if (entry.path().extension() != ".json") continue;
      const auto table = nlohmann::ordered_json::parse(contentOf(entry.path()));
      if (!table.is_array()) continue;
      for (const auto& row : table) {
        if (!row.contains("ratio")) continue;
        const bool has_median = entry.path().stem() != "broadphase";  // as the page says
        for (const std::string& key : keys) {
          EXPECT_TRUE(row.contains(key) || (!has_median && key == "median_us"))
              << entry.path() << ": " << key;
        }
        ++rows;
      }
    }
  }
  EXPECT_GT(rows, 100);
}

/// Charts name the files where what they show is done.
TEST(Pages, ChartsNameFilesThatExist) {
  for (const CodeBlock& block : blocksOf(Kind::flow_chart)) {
    int files = 0;
    const auto expectFile = [&](const std::string& name) {
      EXPECT_TRUE(std::filesystem::exists(kProject / (name + ".h"))) << block.place() << ": " << name;
      ++files;
    };
    for (const std::string& name : found(block.text, "core ([a-z_]+)")) expectFile("core/octoblisk/" + name);
    for (const std::string& name : found(block.text, "([a-z]+/[a-z_]+)\\)")) expectFile("demos/" + name);
    EXPECT_GE(files, 8);
  }
}

/// Small models, and a short path.
void makeInputs(const ScratchFolder& folder) {
  const std::string path = "octoblisk path --blisk small.stl --step-over 60 --pose-step 30 --out ";
  ASSERT_EQ(runScript(folder,
                      "octoblisk make blisk --triangles 10000 --out small.stl\n"
                      "octoblisk make belt --stations 200 --out belt.stl\n"
                      "octoblisk make grinder --out tool\n" +
                          path + "poses.csv\n" + path + "poses.cl --format apt\n")
                .exit_code,
            0);
}

const std::vector<Placeholder> kPlaceholders = {{"", "DIR", "out"},
                                                {"--out", "FILE", "out.stl"},
                                                {"--blisk", "FILE", "small.stl"},
                                                {"--blade", "FILE", "small.stl"},
                                                {"--belt", "FILE", "belt.stl"},
                                                {"", "A", "small.stl"},
                                                {"", "B", "belt.stl"},
                                                {"", "POSES.csv", "poses.csv"},
                                                {"", "FILE.cl", "poses.cl"},
                                                {"", "RESULT.csv", "RESULT.csv"},
                                                {"", "TOOL.json", "tool/tool.json"},
                                                {"", "x,y,z[,px,py,pz]", "0,0,1,0,0,20"},
                                                {"--blade", "N", "2"},
                                                {"--points", "N", "100"},
                                                {"--seed", "N", "3"},
                                                {"", "MM", "20"},
                                                {"", "DEG", "5"},
                                                {"", "MM/MIN", "900"}};

/// What takes long is left out: pictures.
std::string withoutPictures(const std::string& call) {
  for (const auto& [command, option] :
       {std::pair("grind", " --no-pictures"), {"blades", " --no-picture"}, {"access", " --no-picture"}}) {
    if (call.starts_with(std::string("octoblisk ") + command)) return call + option;
  }
  return call;
}

/// What is refused is a file that is not there: so the call is a valid one, but for that.
void expectLackOfFile(const ScratchFolder& folder, const std::string& call) {
  const Outcome outcome = runScript(folder, call);
  EXPECT_EQ(outcome.exit_code, 2) << call;
  EXPECT_THAT(outcome.error, HasSubstr("missing.stl: no such file")) << call;
}

/// All options that are shown, one alternative after another; and with none but those that must be told.
/// Of commands that take long the first call is run; the others are held to lack a file, and nothing else.
TEST(Pages, SynopsesHold) {
  const ScratchFolder folder;
  makeInputs(folder);
  std::vector<std::string> calls;
  for (const CodeBlock& block : blocksOf(Kind::octoblisk)) {
    for (const std::string& synopsis : synopsesOf(block.text, "octoblisk")) {
      for (const std::string& call : fullCalls(synopsis, kPlaceholders)) calls.push_back(call);
      const auto optional = found(synopsis, R"(\[(--blisk|--blade) FILE)");
      if (optional.empty()) continue;
      expectLackOfFile(folder, leastCall(synopsis, kPlaceholders) + ' ' + optional[0] + " missing.stl");
    }
  }
  EXPECT_GE(calls.size(), 20u);
  const std::set<std::string> long_commands = {"access", "grind", "paper", "repair"};
  std::set<std::string> commands_run;
  for (const std::string& call : calls) {
    SCOPED_TRACE(call);
    const std::string command = found(call, "^octoblisk ([a-z]+)").at(0);
    if (long_commands.contains(command) && !commands_run.insert(command).second) {
      expectLackOfFile(folder, replaced(call, "small.stl", "missing.stl"));
    } else {
      expectDone(folder, withoutPictures(call));
    }
  }
}

/// An example of a whole blade, in larger steps.
TEST(Pages, ExamplesRun) {
  const ScratchFolder folder;
  for (const CodeBlock& block : blocksOf(Kind::example)) {
    expectDone(folder,
               replaced(block.text, "--step-over 1.2 --pose-step 1 ", "--step-over 60 --pose-step 100 "));
    const std::string both = contentOf(folder.path() / "both.csv"),
                      run = contentOf(folder.path() / "run/poses.csv");
    EXPECT_GT(std::ranges::count(both, '\n'), 20);
    EXPECT_EQ(std::ranges::count(run, '\n'), std::ranges::count(both, '\n'));
  }
}

/// A study among the tasks of a job array, and by mpirun: the file of one run.
TEST(Pages, StudiesAreShared) {
  const ScratchFolder folder;
  std::string poses = "x,y,z,qw,qx,qy,qz\n";
  for (int i = 0; i < 1000; ++i) poses += "0,0," + std::to_string(0.01 * i) + ",1,0,0,0\n";
  folder.write("poses.csv", poses);
  ASSERT_EQ(
      runScript(folder, "octoblisk make contact-wheel --out small.stl; octoblisk make arm --out belt.stl")
          .exit_code,
      0);
  std::string plain;
  for (const CodeBlock& block : blocksOf(Kind::octoblisk)) {
    if (block.text.starts_with("octoblisk check ")) plain = fullCalls(block.text, kPlaceholders).front();
  }
  ASSERT_NE(plain, "");
  expectDone(folder, plain);
  const std::string whole = contentOf(folder.path() / "RESULT.csv"),
                    asked = without(without(plain, " --out RESULT.csv"), "octoblisk check ");
  EXPECT_EQ(std::ranges::count(whole, '\n'), 1001);
  std::filesystem::remove(folder.path() / "RESULT.csv");
  for (const CodeBlock& block : blocksOf(Kind::study)) {
    std::istringstream lines(replaced(replaced(block.text, "/100 ", "/12 "), "…", asked));
    for (std::string line; std::getline(lines, line);) {
      SCOPED_TRACE(line);
      std::string script = line + "\n";
      if (line.find("SLURM") != std::string::npos) {
        script = "for SLURM_ARRAY_TASK_ID in $(seq 12); do " + line.substr(0, line.find('#')) +
                 "|| test $? = 1; done\n";
      }
#ifndef OCTOBLISK_WITH_MPI
      if (line.starts_with("mpirun ")) continue;
#endif
      expectDone(folder, script);
      if (line.find(" RESULT.csv") == std::string::npos) continue;
      EXPECT_EQ(contentOf(folder.path() / "RESULT.csv"), whole);
      std::filesystem::remove(folder.path() / "RESULT.csv");
    }
  }
}

}  // namespace
}  // namespace octoblisk::pages
