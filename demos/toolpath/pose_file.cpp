#include "toolpath/pose_file.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "io/csv_table.h"
#include "io/new_file.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {
namespace {

const std::string kHeader = "x,y,z,qw,qx,qy,qz";
const std::string kHeaderWithFeed = kHeader + ",feed";
// The conversion between quaternions and matrices uses extra digits, so that a round trip loses none.
using Quaternion = Eigen::Quaternion<long double>;
constexpr double kNormTolerance = 1e-3;  ///< allows for rounding to a few digits; more is a mistake

Pose poseOf(const CsvRow& row, const std::filesystem::path& file) {
  const std::vector<double>& v = row.values;
  const Vec3 translation(v[0], v[1], v[2]);
  const Quaternion quaternion(v[3], v[4], v[5], v[6]);  // w first
  if (translation.cwiseAbs().maxCoeff() > TriangleMesh::kMaxCoordinate) {
    throw std::runtime_error(atLine(file, row.line, "the translation must be at most 1e12 mesh units long"));
  }
  const auto norm = static_cast<double>(quaternion.coeffs().stableNorm());
  if (!(std::abs(norm - 1.0) <= kNormTolerance)) {
    throw std::runtime_error(
        atLine(file, row.line,
               "the quaternion's norm is " + std::to_string(norm) + "; it must be within 0.001 of 1"));
  }
  return {quaternion.normalized().toRotationMatrix().cast<double>(), translation};
}

std::vector<CsvRow> readRows(const std::filesystem::path& file) {
  std::vector<CsvRow> rows = readCsv(file, kHeader, kHeaderWithFeed);
  if (rows.empty())
    throw std::runtime_error(file.string() + ": no poses: add at least one row below the header");
  return rows;
}

}  // namespace

void writePose(std::ostream& stream, const Pose& pose) {
  const Vec3& t = pose.translation;
  const Eigen::Quaterniond q = Quaternion(pose.rotation.cast<long double>()).normalized().cast<double>();
  stream << t.x() << ',' << t.y() << ',' << t.z() << ',' << q.w() << ',' << q.x() << ',' << q.y() << ','
         << q.z();
}

std::vector<Pose> readPoses(const std::filesystem::path& file) {
  std::vector<Pose> poses;
  for (const CsvRow& row : readRows(file)) poses.push_back(poseOf(row, file));
  return poses;
}

std::vector<MotionRow> readMotionRows(const std::filesystem::path& file) {
  std::vector<MotionRow> motions;
  for (const CsvRow& row : readRows(file)) {
    const double feed = row.values.size() > 7 ? row.values[7] : 0.0;
    if (feed < 0.0) throw std::runtime_error(atLine(file, row.line, "the feed must be at least 0 mm/min"));
    motions.push_back({{poseOf(row, file), feed}, row.line});
  }
  return motions;
}

std::vector<ToolMotion> readMotions(const std::filesystem::path& file) {
  std::vector<ToolMotion> motions;
  for (const MotionRow& row : readMotionRows(file)) motions.push_back(row.motion);
  return motions;
}

void writePoses(const std::filesystem::path& file, std::span<const Pose> poses) {
  std::ostringstream stream;
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << kHeader << '\n';
  for (const Pose& pose : poses) {
    writePose(stream, pose);
    stream << '\n';
  }
  writeFile(file, stream.str());
}

void writeMotions(const std::filesystem::path& file, std::span<const ToolMotion> motions) {
  std::ostringstream stream;
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << kHeaderWithFeed << '\n';
  for (const ToolMotion& motion : motions) {
    writePose(stream, motion.tool_in_blisk);
    stream << ',' << motion.feed << '\n';
  }
  writeFile(file, stream.str());
}

}  // namespace octoblisk::demos
