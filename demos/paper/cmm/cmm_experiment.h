// Simulates the paper's measurement of a blade before and after grinding (Table 5, figs. 13-14).
#pragma once

#include <vector>

#include "paper/cmm/blade_strip.h"
#include "paper/cmm/grinding_pass.h"
#include "paper/cmm/stock.h"
#include "paper/cmm/virtual_cmm.h"

namespace octoblisk::demos {

/// The method that plans the pass's dwells.
enum class PassPlan {
  measured,  ///< point by point from the errors measured before, to remove all of them
  even,      ///< one feed for all poses, to remove the mean error measured before
};

struct CmmExperimentOptions {
  int blade = 1;
  BladeStripOptions strip;
  StockOptions stock;
  GrindingProcess process;
  ProcessErrors errors;
  CmmOptions cmm;  ///< of the first measurement; the second one has the next seed
  PassPlan plan = PassPlan::measured;
};

/// A point measured before and after.
struct MeasuredPoint {
  std::size_t row = 0;  ///< of the strip's grid
  std::size_t station = 0;
  BladeArea area = BladeArea::leading_edge;
  double before = 0.0;  ///< deviation along the nominal normal, mm
  double after = 0.0;
};

/// The values of a pass. Forces in N, feeds in mm/s, time in s.
struct PassSummary {
  double indentation = 0.0;         ///< mm
  double contact_half_width = 0.0;  ///< across the section on a flat, mm
  double peak_pressure = 0.0;       ///< MPa
  double least_force = 0.0, greatest_force = 0.0;
  double least_feed = 0.0, greatest_feed = 0.0;
  std::size_t strokes = 0;
  double time = 0.0;
};

struct CmmExperiment {
  BladeStrip strip;
  std::vector<double> stock{};          ///< error of each point of the strip's grid before, mm
  std::vector<double> ground{};         ///< the same after
  std::vector<MeasuredPoint> points{};  ///< section by section, starting at the leading edge
  AreaStatistics stock_at_points{};     ///< of the stock itself, without the CMM: exactly as requested
  AreaStatistics before{}, after{};     ///< as measured
  PassSummary pass{};
};

/// Makes a stock on a blade of any blisk, measures it, plans a pass from the measurements, grinds, and
/// measures again. Deterministic. Throws std::invalid_argument as its steps do.
CmmExperiment runCmmExperiment(const TriangleMesh& blisk, const BladesFound& blades,
                               const CmmExperimentOptions& options = {});

}  // namespace octoblisk::demos
