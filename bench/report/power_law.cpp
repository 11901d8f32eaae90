#include "report/power_law.h"

#include <cmath>
#include <stdexcept>

namespace octoblisk::bench {

PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw std::invalid_argument("a power law needs as many x values as y values");
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(x[k] > 0.0) || !(y[k] > 0.0)) throw std::invalid_argument("a power law needs numbers above 0");
    mean_x += std::log(x[k]) / count;
    mean_y += std::log(y[k]) / count;
  }
  double spread = 0.0, common = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = std::log(x[k]) - mean_x;
    spread += off * off;
    common += off * (std::log(y[k]) - mean_y);
  }
  if (!(spread > 1e-20)) throw std::invalid_argument("a power law needs two different x values");
  const double exponent = common / spread;
  return {std::exp(mean_y - exponent * mean_x), exponent};
}

}  // namespace octoblisk::bench
