#include "shapes/seeded.h"

namespace octoblisk::shapes {

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Vec3 randomPoint(std::mt19937_64& random, double half_size) {
  const double x = uniform(random, -half_size, half_size), y = uniform(random, -half_size, half_size);
  return {x, y, uniform(random, -half_size, half_size)};
}

Mat3 randomRotation(std::mt19937_64& random) {
  Eigen::Vector4d q;
  do {
    for (int k = 0; k < 4; ++k) q[k] = uniform(random, -1.0, 1.0);
  } while (q.squaredNorm() > 1.0 || q.squaredNorm() < 0.01);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

}  // namespace octoblisk::shapes
