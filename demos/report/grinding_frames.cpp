#include "report/grinding_frames.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "render/contact_sheet.h"
#include "report/grinding_pictures.h"

namespace octoblisk::demos {
namespace {

constexpr int kSheetFrameWidth = 480, kSheetFrameHeight = 400;  // pixels

std::string frameName(std::size_t frame) {
  std::ostringstream name;
  name << std::setw(4) << std::setfill('0') << frame << ".png";
  return name.str();
}

}  // namespace

std::vector<std::size_t> posesOfFrames(std::size_t poses, std::size_t count) {
  std::vector<std::size_t> chosen;
  count = std::min(count, poses);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : (i * (poses - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

void writeFrames(const GrindingRun& run, std::size_t count, const std::filesystem::path& folder,
                 WholeFiles& files, const DrawPicture& draw) {
  const std::filesystem::path frames = folder / "frames";
  std::error_code error;
  std::filesystem::create_directories(frames, error);
  if (error) throw std::runtime_error(frames.string() + ": cannot create the folder: " + error.message());
  const Camera camera = overviewOf(run).camera;
  std::vector<SheetFrame> sheet;
  for (const std::size_t pose : posesOfFrames(run.poses.size(), count)) {
    Picture picture = overviewOf(run, pose);
    picture.camera = camera;
    draw(picture, files.add(frames / frameName(sheet.size())).string());
    sheet.push_back({"Pose " + std::to_string(pose) + ": " + nameOf(run.poses[pose].verdict), picture});
  }
  if (sheet.empty()) return;
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(sheet.size()))));
  writePng(contactSheet(sheet, "Poses along the path", sheet.front().picture.annotation.subtitle, columns,
                        kSheetFrameWidth, kSheetFrameHeight),
           files.add(folder / "contact_sheet.png").string());
}

}  // namespace octoblisk::demos
