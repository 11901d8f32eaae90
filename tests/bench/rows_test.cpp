#include "report/rows.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace octoblisk::bench {
namespace {

namespace fs = std::filesystem;

class RowFiles : public ::testing::Test {
 protected:
  RowFiles() { fs::create_directories(folder_); }
  ~RowFiles() override { fs::remove_all(folder_); }

  fs::path fileOf(const std::string& text) const {
    const fs::path file = folder_ / "rows.json";
    std::ofstream(file) << text;
    return file;
  }
  std::string refusalOf(const std::string& text) const {
    try {
      readRows(fileOf(text));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ = fs::temp_directory_path() / ("octoblisk_rows_" + std::to_string(getpid()));
};

Row row(const char* task, const char* scene, const char* contender, double mean) {
  return {{"task", task}, {"scene", scene}, {"contender", contender}, {"mean_us", mean}};
}

TEST_F(RowFiles, areReadAsTheyWereWritten) {
  const fs::path file = folder_ / "rows.json";
  const Rows rows = {row("ray", "50k", "octoblisk", 0.1), row("ray", "50k", "fcl", 1.0 / 3.0)};
  writeRows(file, rows);
  EXPECT_EQ(readRows(file), rows);
  std::ifstream in(file);
  std::string line;
  int lines = 0;
  while (std::getline(in, line)) ++lines;
  EXPECT_EQ(lines, 4);  // two brackets, and one line for each row
  EXPECT_EQ(readRows(folder_ / "none.json"), Rows());
}

TEST_F(RowFiles, nameTheFileThatIsNone) {
  EXPECT_NE(refusalOf("{}").find("rows.json: is not a JSON array"), std::string::npos);
  EXPECT_NE(refusalOf("[{\"task\": ").find("rows.json: is not"), std::string::npos);
  EXPECT_NE(refusalOf(R"([{"task":"ray","scene":"50k"},{"task":"ray"}])").find("row 1 has no scene"),
            std::string::npos);
  EXPECT_NE(refusalOf("[7]").find("row 0 has no task"), std::string::npos);
  EXPECT_THROW(writeRows(folder_ / "no" / "rows.json", {}), std::runtime_error);
}

TEST_F(RowFiles, ofAFolderAreThoseOfItsFilesByName) {
  const Rows first = {row("build", "50k", "fcl", 1)}, second = {row("ray", "50k", "fcl", 2)};
  writeRows(folder_ / "ray.json", second);
  writeRows(folder_ / "build.json", first);
  std::ofstream(folder_ / "machine.json") << "{}";
  std::ofstream(folder_ / "README.md") << "no rows";
  const Rows expected = {first[0], second[0]};
  EXPECT_EQ(readAllRows(folder_), expected);
}

// Ratios of one run cannot be compared with means of another.
TEST_F(RowFiles, ofASceneAreOfOneRun) {
  const fs::path file = folder_ / "rows.json";
  const Rows before = {row("ray", "50k", "octoblisk", 1), row("ray", "50k", "fcl", 2),
                       row("ray", "300k", "octoblisk", 3), row("build", "50k", "octoblisk", 4)};
  Row anew = row("ray", "50k", "octoblisk", 5);
  writeRows(file, before);
  addRows(file, {anew});
  anew["commit"] = commit();
  EXPECT_EQ(readRows(file), (Rows{before[2], before[3], anew}));
  addRows(file, {});
  EXPECT_EQ(readRows(file).size(), 3u);
}

}  // namespace
}  // namespace octoblisk::bench
