// Runs every call of octoblisk on the pages, unchanged or with smaller inputs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "pages/page_test.h"
#include "pages/synopsis.h"

namespace octoblisk::pages {
namespace {

using demos::contentOf;
using demos::Outcome;
using demos::ScratchFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string without(const std::string& text, const std::string& part) { return replaced(text, part, ""); }

/// Expects exit code 0, or 1 if the last call of octoblisk may find interference.
void expectDone(const ScratchFolder& folder, const std::string& script) {
  const std::set<std::string> studies = {"access", "check", "grind", "merge", "repair"};
  const std::vector<std::string> commands = found(script, "octoblisk ([a-z]+)");
  const demos::ExitCode exit_code = runScript(folder, script).exit_code;
  EXPECT_TRUE(exit_code == 0 || (exit_code == 1 && !commands.empty() && studies.contains(commands.back())))
      << script << "\nexit code " << exit_code;
}

/// Small models, and a short path.
void makeInputs(const ScratchFolder& folder) {
  const std::string path = "octoblisk path --blisk small.stl --step-over 60 --pose-step 30 --out ";
  ASSERT_EQ(runScript(folder,
                      "octoblisk make blisk --triangles 10000 --out small.stl\n"
                      "octoblisk make belt --stations 200 --out belt.stl\n" +
                          path + "poses.csv\n")
                .exit_code,
            0);
}

const std::vector<Placeholder> kPlaceholders = {{"", "DIR", "out"},
                                                {"--out", "FILE", "out.stl"},
                                                {"--blisk", "FILE", "small.stl"},
                                                {"--blade", "FILE", "small.stl"},
                                                {"", "A", "small.stl"},
                                                {"", "B", "belt.stl"},
                                                {"", "POSES.csv", "poses.csv"},
                                                {"", "RESULT.csv", "RESULT.csv"},
                                                {"--points", "N", "100"},
                                                {"--starts", "N", "2"},
                                                {"--seed", "N", "3"}};

/// Removes pictures from the call, because they take long.
std::string withoutPictures(const std::string& call) {
  for (const auto& [command, option] :
       {std::pair("grind", " --no-pictures"), {"blades", " --no-picture"}, {"access", " --no-picture"}}) {
    if (call.starts_with(std::string("octoblisk ") + command)) return call + option;
  }
  return call;
}

/// Expects the call to be refused only because a file is missing, so the call itself is valid.
void expectLackOfFile(const ScratchFolder& folder, const std::string& call) {
  const Outcome outcome = runScript(folder, call);
  EXPECT_EQ(outcome.exit_code, 2) << call;
  EXPECT_THAT(outcome.error, HasSubstr("missing.stl: no such file")) << call;
}

/// Runs synopses with all options, one alternative after another, and with only the required ones. Of
/// commands that take long, only the first call runs. The others must fail only because a file is missing.
TEST(Pages, synopsesHold) {
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
  EXPECT_GE(calls.size(), 10u);
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

/// Runs from a path to a clean one, and compares the text below with the results.
TEST(Pages, theStoryEndsClean) {
  const ScratchFolder folder;
  ASSERT_EQ(blocksOf(Kind::story).size(), 1u);
  std::istringstream lines(blocksOf(Kind::story).front().text);
  std::vector<Outcome> outcomes;
  for (std::string line; std::getline(lines, line);) {
    const bool has_report = line.starts_with("octoblisk grind") || line.starts_with("octoblisk repair");
    outcomes.push_back(runScript(folder, withoutPictures(line) + (has_report ? " --no-report" : "")));
  }
  ASSERT_EQ(outcomes.size(), 4u);
  EXPECT_EQ(outcomes[0].exit_code, 0);
  EXPECT_THAT(outcomes[0].out, HasSubstr("793 poses, 13 transversal passes on the convex side"));
  EXPECT_EQ(outcomes[1].exit_code, 1);
  EXPECT_THAT(outcomes[1].out, HasSubstr(" 46 interference\n"));
  EXPECT_THAT(outcomes[1].out, HasSubstr(", belt on blade 1, 0.75 mm deep\n"));
  EXPECT_EQ(outcomes[2].exit_code, 0);
  EXPECT_THAT(
      outcomes[2].out,
      HasSubstr("Changed: 46 poses, tilt up to 2 degrees, slide up to 2 mm, retraction up to 0.05 mm\n"));
  EXPECT_EQ(outcomes[3].exit_code, 0);
  EXPECT_THAT(outcomes[3].out, HasSubstr(" 0 interference\n"));
}

/// Runs every step of the tutorial on the files of the previous steps, with a path of larger steps. The steps
/// on Rotor 67, whose mesh is not in the repository, must be the same calls.
TEST(Pages, theTutorialRuns) {
  const ScratchFolder folder;
  std::map<std::string, bool> is_clean;
  std::set<std::string> calls;
  for (const CodeBlock& block : blocksOf(Kind::tutorial)) {
    SCOPED_TRACE(block.place());
    std::string call = block.text.substr(0, block.text.find('\n'));
    if (call.find("rotor67.stl") != std::string::npos) {
      EXPECT_TRUE(calls.contains(replaced(call, "rotor67.stl", "blisk.stl"))) << call;
      continue;
    }
    calls.insert(call);
    const std::string command = found(call, "^octoblisk ([a-z]+)").at(0);
    const std::string out = found(call, "--out ([a-z.]+)").at(0);
    if (command == "path") call += " --step-over 20 --pose-step 8";
    if (command == "access") call += " --rows 5 --columns 5 --tilt-step 10";
    if (command == "grind" || command == "repair" || command == "access") call += " --no-report";
    const Outcome outcome = runScript(folder, withoutPictures(call));
    is_clean[out] = outcome.exit_code == 0;
    EXPECT_TRUE(is_clean[out] || outcome.exit_code == 1) << outcome.error;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / out));
  }
  EXPECT_EQ(is_clean.size(), 10u);
  EXPECT_FALSE(is_clean["first"]);
  EXPECT_TRUE(is_clean["clean"]);
  EXPECT_TRUE(is_clean["planned"]);
}

/// A study in a job array, and one by mpirun, give the same file as a single run.
TEST(Pages, studiesAreShared) {
  const ScratchFolder folder;
  std::string poses = "x,y,z,qw,qx,qy,qz\n";
  for (int i = 0; i < 1000; ++i) poses += std::to_string(-0.01 * i) + ",0,0,1,0,0,0\n";
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
  EXPECT_THAT(whole, AllOf(HasSubstr(",0,"), HasSubstr(",1,")));
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
