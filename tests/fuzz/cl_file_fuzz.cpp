// Reads any bytes as a CL file. It is refused with a one-line message, or its poses have perpendicular unit
// axes and survive writing and reading.
#include "fuzz/fuzz_input.h"
#include "shared/meshes.h"
#include "toolpath/cl_motions.h"

using namespace octoblisk;
using namespace octoblisk::demos;

namespace {

void requireSame(const std::vector<ToolMotion>& motions, const std::vector<ToolMotion>& again) {
  if (again.size() != motions.size()) fuzz::fail("moves were lost");
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const Pose &pose = motions[k].tool_in_blisk, &read = again[k].tool_in_blisk;
    const Mat3 product = pose.rotation.transpose() * pose.rotation;
    if (!((product - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-13)) fuzz::fail("no rotation");
    if (read.translation != pose.translation || again[k].feed != motions[k].feed)
      fuzz::fail("a move changed");
    if (!((read.rotation - pose.rotation).cwiseAbs().maxCoeff() <= 1e-14)) fuzz::fail("a rotation changed");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFolder folder;
  static const ClusteredOctree blisk = ClusteredOctree::build(testing::torus(2, 0.7, 12, 6));
  const std::filesystem::path file = folder.write("path.cl", fuzz::textOf(data, size));
  ClFile read;
  try {
    read = readClFile(file);
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, file);
    return 0;
  }
  const std::vector<ToolMotion> motions = toolMotionsOf(read, blisk);
  const std::filesystem::path copy = folder.path() / "written.cl";
  writeClFile(copy, motions);
  requireSame(motions, toolMotionsOf(readClFile(copy)));
  return 0;
}
