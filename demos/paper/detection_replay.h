// Shows Table 3 as a replay: the belt along both paths, and the wrong verdicts of the paper's boxes.
#pragma once

#include <memory>
#include <vector>

#include "paper/detection_experiment.h"
#include "paper/paper_model.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// The bodies and poses of an experiment; `lift` is the height of the lifted path off the blade, mm.
struct DetectionScene {
  PaperModel model;
  std::shared_ptr<const ClusteredOctree> blisk, belt;
  std::vector<BeltPose> ground, lifted;  ///< at least one each
  double lift;
};

/// The verdict of the paper's improved octrees at each pose, compared with that of the triangles. A finding
/// is a difference between the two.
Replay detectionReplay(const DetectionScene& scene, const DetectionResult& result);

}  // namespace octoblisk::demos
