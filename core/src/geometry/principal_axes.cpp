#include "geometry/principal_axes.h"

#include <Eigen/Eigenvalues>

namespace octoblisk::detail {

Mat3 principalAxes(const Mat3& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(symmetric);  // ascending eigenvalues
  Mat3 axes;
  for (int k = 0; k < 2; ++k) {
    const Vec3 axis = solver.eigenvectors().col(2 - k);
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    axes.col(k) = axis[largest] < 0.0 ? Vec3(-axis) : axis;
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

}  // namespace octoblisk::detail
