#include "plan/tool_posture.h"

#include <cmath>
#include <cstdlib>

#include "models/radians.h"
#include "toolpath/path_arm.h"

namespace octoblisk::demos {

bool ToolPosture::grindsTowardsTip() const {
  return std::abs(std::cos(radians(lead))) >= std::abs(std::sin(radians(lead)));
}

std::vector<ToolPosture> posturesOf(double belt_width) {
  constexpr int kLeadStep = 15, kHalfTurn = 180;
  constexpr double kLeastTilt = 4.0, kGreatestTilt = 64.0;
  constexpr double kNearEdge = 0.45;  // of the width: the belt's edge overhangs the contact a little
  std::vector<ToolPosture> postures;
  for (int turn = 0; turn <= kHalfTurn; turn += kLeadStep) {
    for (double tilt = kLeastTilt; tilt <= kGreatestTilt; tilt *= 2.0) {
      for (const double slide : {0.0, kNearEdge * belt_width, -kNearEdge * belt_width}) {
        postures.push_back({static_cast<double>(turn), tilt, slide});
        if (turn > 0 && turn < kHalfTurn) postures.push_back({-static_cast<double>(turn), tilt, slide});
      }
    }
  }
  return postures;
}

Pose poseAt(const SurfacePoint& at, const ToolPosture& posture, double wheel_radius) {
  const double lead = radians(posture.lead);
  const Vec3 arm = std::cos(lead) * at.to_tip + std::sin(lead) * at.normal.cross(at.to_tip);
  Pose pose = beltAt(at.point, at.normal, arm, radians(posture.tilt), wheel_radius);
  pose.translation += posture.slide * pose.rotation.col(2);
  return pose;
}

}  // namespace octoblisk::demos
