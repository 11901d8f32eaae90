// A fixture that runs octoblisk check over many poses, in parts and in several processes.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "demos/check_command.h"
#include "shared/meshes.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {

class CheckParts : public CheckCommand {
 protected:
  static constexpr int kPoses = 500;

  /// A ring, and a box that moves past and into it in small steps.
  void SetUp() override {
    writeMesh(folder_.path() / "ring.obj", *octoblisk::testing::torus(1.0, 0.4, 40, 20));
    writeMesh(folder_.path() / "box.obj", *octoblisk::testing::boxMesh({0.3, 0.2, 0.4}));
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    std::vector<Pose> poses;
    Vec3 place(1.3, 0.0, 0.0);
    double angle = 0.0;
    for (int i = 0; i < kPoses; ++i) {
      place += 0.1 * Vec3{part(random), part(random), part(random)};
      if (place.norm() > 2.4 || place.norm() < 1.1) place = 1.7 * place.normalized();
      angle += 0.1 * part(random);
      poses.push_back({Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix(), place});
    }
    writePoses(folder_.path() / "poses.csv", poses);
  }

  /// Repeats the poses this many times, so that a run takes a while.
  void repeatPoses(int times) {
    const std::string once = content("poses.csv");
    const std::string lines = once.substr(once.find('\n') + 1);
    std::string repeated = once;
    for (int i = 1; i < times; ++i) repeated += lines;
    folder_.write("poses.csv", repeated);
  }

  std::string content(const std::string& name) const { return contentOf(folder_.path() / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }

  /// Waits until the unfinished result has answers; false if that does not happen.
  bool waitForAnswers(const std::string& result) const {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point latest = Clock::now() + std::chrono::minutes(2);
    while (content(result + ".partial").find("# checksum") == std::string::npos) {
      if (exists(result) || Clock::now() > latest) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  /// A summary without its times.
  static std::string withoutTimes(const std::string& summary) {
    const std::size_t time = summary.find("; "), line_end = summary.find('\n');
    return time < line_end ? summary.substr(0, time) + summary.substr(line_end) : summary;
  }

  const std::string check_ = "check --fixed ring.obj --moving box.obj --poses poses.csv ";
  const std::string all_columns_ = "--clearance --depth --signed --continuous ";
};

}  // namespace octoblisk::demos
