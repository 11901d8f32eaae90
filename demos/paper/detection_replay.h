// Table 3 as a replay: the belt along both paths, and where the paper's boxes are wrong about it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "paper/detection_experiment.h"
#include "paper/paper_model.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// The bodies and poses of an experiment; `lift` is how far off the blade the second path is held, mm.
struct DetectionScene {
  PaperModel model;
  std::shared_ptr<const ClusteredOctree> blisk, belt;
  std::vector<BeltPose> ground, lifted;  ///< at least one each
  double lift;
};

/// What the paper's improved octrees say at each pose beside what the triangles say. An offence is where the
/// two differ.
Replay detectionReplay(const DetectionScene& scene, const DetectionResult& result);

}  // namespace octoblisk::demos
