// A short run of bench/pose_soak: every pair of hard meshes, every kind of tree.
#include "shared/pose_soak.h"

#include <gtest/gtest.h>

namespace octoblisk {
namespace {

TEST(PoseSoak, hardMeshes_vs_exactKernel) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr std::uint64_t kScenes = 36;
#else
  constexpr std::uint64_t kScenes = 180;  // 36 pairs of meshes, 5 kinds of trees
#endif
  testing::SoakTally all;
  for (std::uint64_t scene = 0; scene < kScenes; ++scene) all += testing::soak(scene, 4);
  EXPECT_TRUE(all.agrees());
  for (const std::string& finding : all.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(all.poses, 4 * kScenes);
  EXPECT_GT(all.hits, all.poses * 3 / 10);
  EXPECT_LT(all.hits, all.poses * 7 / 10);
  EXPECT_GT(all.distances, kScenes / 5);
  EXPECT_GT(all.pairs, all.hits);
}

}  // namespace
}  // namespace octoblisk
