// Reads any bytes as a table of poses. It is refused with a one-line message, or its poses survive writing
// and reading.
#include "fuzz/fuzz_input.h"
#include "toolpath/pose_file.h"

using namespace octoblisk;
using namespace octoblisk::demos;

namespace {

void requireRigid(const Pose& pose) {
  const Mat3 product = pose.rotation.transpose() * pose.rotation;
  if (!((product - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-14)) fuzz::fail("no rotation");
  if (!pose.translation.allFinite()) fuzz::fail("no translation");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFolder folder;
  const std::filesystem::path file = folder.write("poses.csv", fuzz::textOf(data, size));
  std::vector<ToolMotion> motions;
  try {
    motions = readMotions(file);
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, file);
    return 0;
  }
  const std::filesystem::path copy = folder.path() / "written.csv";
  writeMotions(copy, motions);
  const std::vector<ToolMotion> again = readMotions(copy);
  if (again.size() != motions.size()) fuzz::fail("moves were lost");
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const Pose &pose = motions[k].tool_in_blisk, &read = again[k].tool_in_blisk;
    requireRigid(pose);
    if (read.translation != pose.translation || again[k].feed != motions[k].feed)
      fuzz::fail("a move changed");
    if (!((read.rotation - pose.rotation).cwiseAbs().maxCoeff() <= 2e-15)) fuzz::fail("a rotation changed");
  }
  return 0;
}
