#include "report/vtk_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "demos/small_replay.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

float bigEndianFloat(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word = word << 8 | static_cast<unsigned char>(bytes[at + k]);
  return std::bit_cast<float>(word);
}

TEST(VtkFile, holdsContactsAndPath) {
  const Replay replay = smallReplay("a part\nof two lines");
  const std::string contacts = contactsVtk(replay);
  EXPECT_THAT(contacts, StartsWith("# vtk DataFile Version 3.0\noctoblisk contacts, mm; verdict: 0 clear, 1 "
                                   "interference; part: 0 a part?of two lines\nBINARY\nDATASET POLYDATA\n"
                                   "POINTS 2 float\n"));
  const std::string head = "POINTS 2 float\n";
  const std::size_t first = contacts.find(head) + head.size();
  EXPECT_EQ(bigEndianFloat(contacts, first + 4), 2.0f);
  EXPECT_EQ(bigEndianFloat(contacts, first + 20), 6.0f);
  EXPECT_THAT(contacts, HasSubstr("\nVERTICES 2 4\n"));
  const std::string depth = "SCALARS depth_mm float 1\nLOOKUP_TABLE default\n";
  EXPECT_EQ(bigEndianFloat(contacts, contacts.find(depth) + depth.size()), 0.25f);
  const std::string path = pathVtk(replay);
  EXPECT_THAT(path, HasSubstr("\nLINES 1 4\n"));
  const std::string clearance = "SCALARS clearance_mm float 1\nLOOKUP_TABLE default\n";
  EXPECT_EQ(bigEndianFloat(path, path.find(clearance) + clearance.size()), 1.0f);
  EXPECT_TRUE(std::isnan(bigEndianFloat(path, path.find(clearance) + clearance.size() + 8)));
}

TEST(VtkFile, writesUnitsInWords) {
  Replay replay = smallReplay("part");
  replay.verdicts.front().name = "free over 30°";
  replay.tracks.front().series.front().name = "tilt, after";
  replay.tracks.front().series.front().unit = "°";
  const std::string path = pathVtk(replay);
  EXPECT_THAT(path, HasSubstr("verdict: 0 free over 30 degrees, 1 "));
  EXPECT_THAT(path, HasSubstr("\nSCALARS tilt_after_degrees float 1\n"));
}

}  // namespace
}  // namespace octoblisk::demos
