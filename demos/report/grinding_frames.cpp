#include "report/grinding_frames.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "report/contact_sheet.h"
#include "report/grinding_pictures.h"

namespace octoblisk::demos {
namespace {

std::string fileName(std::size_t pose) {
  std::ostringstream name;
  name << "frame_" << std::setw(5) << std::setfill('0') << pose << ".png";
  return name.str();
}

}  // namespace

std::vector<std::size_t> posesOfFrames(std::size_t pose_count, std::size_t frames) {
  const std::size_t count = std::min(pose_count, frames);
  std::vector<std::size_t> poses;
  for (std::size_t f = 0; f < count; ++f) {
    poses.push_back(count > 1 ? (f * (pose_count - 1) + (count - 1) / 2) / (count - 1) : pose_count / 2);
  }
  return poses;
}

void writeFrames(const GrindingRun& run, std::size_t frames, const std::filesystem::path& folder,
                 WholeFiles& files) {
  std::vector<SheetFrame> sheet;
  for (const std::size_t pose : posesOfFrames(run.poses.size(), frames)) {
    const Picture picture = overviewAt(run, pose);
    writePng(picture, files.add(folder / fileName(pose)).string());
    sheet.push_back({"Pose " + std::to_string(pose) + ": " + nameOf(run.poses[pose].verdict), picture});
  }
  // The legend of the sheet is that of a frame that has the most.
  const auto fullest = std::ranges::max_element(
      sheet, {}, [](const SheetFrame& frame) { return frame.picture.annotation.legend.size(); });
  sheet.front().picture.annotation.legend = fullest->picture.annotation.legend;
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(sheet.size())))));
  writePng(contactSheet(sheet, "Poses along the path", sheet.front().picture.annotation.subtitle, columns,
                        480, 400),
           files.add(folder / "frames.png").string());
}

}  // namespace octoblisk::demos
