// The command line of octoblisk as a whole: names, sizes, help, version.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "demos/check_command.h"
#include "demos/refusal.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using CommandLine = CheckCommand;

TEST_F(CommandLine, anUnknownSubcommandIsNamedWithTheNearest) {
  const auto refusal = [&](const std::string& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    return outcome.error;
  };
  EXPECT_EQ(refusal("chek --fixed a"),
            "octoblisk: 'chek' is not a subcommand; did you mean 'check'? The subcommands are: grind, "
            "blades, path, "
            "access, repair, plan, make, check, inspect, merge, paper, gallery\n");
  EXPECT_THAT(refusal("make contact_wheel"), HasSubstr("did you mean 'contact-wheel'?"));
  EXPECT_EQ(refusal("polish"),
            "octoblisk: 'polish' is not a subcommand; the subcommands are: grind, blades, path, access, "
            "repair, plan, make, "
            "check, inspect, merge, paper, gallery\n");
}

TEST_F(CommandLine, sizesAreBoundedAndTheMessageIsShort) {
  const std::pair<std::string, std::string> cases[] = {
      {"make belt --stations 2e9", "--stations: '2e9' is not a whole number from 16 to 100000"},
      {"make belt --stations 2000000000", "--stations: '2000000000' is not a whole number from 16 to 100000"},
      {"make arm --stations 100000 --points-per-station 100000", "stations times points"},
      {"make belt --width nan", "--width: 'nan' is not a number from -100000 to 100000"},
      {"make blisk --section-count 1000000",
       "--section-count: '1000000' is not a whole number from 2 to 1000"},
      {"make blisk --triangles 100000000",
       "--triangles: '100000000' is not a whole number from 1 to 10000000"},
      {"make blisk --tip-radius 1e300", "--tip-radius: '1e300' is not a number"},
      {"make blisk --shroud-thickness 3", "--shroud-thickness needs --shroud"},
      {"make blisk --shroud-overhang 3", "--shroud-overhang needs --shroud"}};
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = run(arguments + " --out made.stl");
    expectRefusal(outcome, "octoblisk: " + message);
    EXPECT_LT(outcome.error.size(), 120u) << outcome.error;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "made.stl")) << arguments;
  }
  EXPECT_THAT(run("make arm --out ''").error, StartsWith("octoblisk: --out: the name is empty"));
  make("blisk --triangles 20000 --shroud --shroud-thickness 3 --lean=-1 --out made.stl");
}

TEST_F(CommandLine, wrongOptionsAreReportedInOneLine) {
  expectRefusal(run(""), "a subcommand is required; see octoblisk --help");
  expectRefusal(run("grind"), "--out is required; see octoblisk grind --help");
  expectRefusal(run("make belt"), "--out is required; see octoblisk make belt --help");
  expectRefusal(run("make belt --out belt.stl --colour red"), "--colour");
  expectRefusal(run("grind --convex 'a\nb' --out run"), "a?b");
  expectRefusal(run("grind --blisk 'a\nb.stl' --out run"), "a?b.stl: ");
}

TEST_F(CommandLine, helps) {
  for (const std::string arguments : {"--help", "check --help", "make blisk --help"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments;
    EXPECT_EQ(outcome.error, "") << arguments;
    EXPECT_NE(outcome.out, "") << arguments;
  }
  EXPECT_THAT(run("check --help").out, HasSubstr("mesh units"));
  EXPECT_THAT(run("check --help").out, HasSubstr("rounded to 32-bit floats"));
  EXPECT_THAT(run("grind --help").out, HasSubstr("--no-pictures  "));
}

TEST_F(CommandLine, printsItsVersion) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, ::testing::MatchesRegex("octoblisk [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(CommandLine, aFileThatCannotBeMadeIsNamedOnce) {
  EXPECT_EQ(run("make arm --out nowhere/arm.stl").error,
            "octoblisk: nowhere/arm.stl: cannot be written: the folder nowhere does not exist: create it\n");
}

}  // namespace
}  // namespace octoblisk::demos
