// The numbers printed in the paper's Tables 1–4.
#pragma once

#include <vector>

#include "paper/method_table.h"

namespace octoblisk::demos {

/// Table 1: TNON.
inline constexpr MethodTable<int> kPublishedNodes = {{
    {11809, 5553, 3209, 2425, 2017, 1633, 1313, 1137, 985, 881},
    {11718, 4842, 3154, 2402, 1954, 1506, 1298, 1130, 1026, 970},
    {12131, 5315, 3371, 2451, 1995, 1555, 1283, 1131, 963, 899},
    {12052, 5324, 3444, 2340, 1820, 1500, 1308, 1092, 948, 828},
    {11933, 5205, 3317, 2317, 1853, 1549, 1317, 1101, 989, 813},
    {12238, 5326, 3486, 2382, 1846, 1534, 1358, 1166, 1006, 862},
    {12151, 5407, 3479, 2351, 1879, 1575, 1255, 1111, 1015, 829},
    {12304, 5256, 3440, 2286, 1904, 1568, 1264, 1064, 896, 832},
}};

/// Table 2: the split time, s.
inline constexpr MethodTable<double> kPublishedSeconds = {{
    {17.11, 11.79, 4.55, 3.48, 3.06, 2.47, 2.02, 1.88, 1.64, 1.50},
    {17.07, 6.97, 4.65, 4.13, 3.29, 2.56, 2.37, 1.87, 1.76, 1.68},
    {14.35, 6.95, 4.50, 3.75, 2.83, 2.28, 1.84, 1.70, 1.53, 1.57},
    {20.15, 10.02, 6.37, 4.34, 3.50, 3.08, 2.75, 2.33, 2.06, 1.93},
    {25.42, 11.25, 7.28, 5.06, 4.42, 3.63, 3.17, 2.79, 2.57, 2.03},
    {16.70, 8.69, 5.65, 4.26, 3.29, 2.94, 2.68, 2.37, 2.09, 1.95},
    {16.17, 8.53, 5.41, 4.17, 3.30, 2.89, 2.58, 2.31, 2.18, 1.98},
    {19.37, 9.43, 7.11, 5.35, 4.47, 3.86, 3.32, 2.89, 2.59, 2.44},
}};

/// The numbers of a method in Tables 3 and 4.
struct DetectionNumbers {
  double range = 0.0;           ///< the collision detection range, mm³
  std::vector<double> seconds;  ///< the detection time of each run over the path; the paper has three
};

struct DetectionTable {
  DetectionNumbers traditional, improved;
};

/// The ranges are the same in every row of both tables.
inline constexpr double kPublishedTraditionalRange = 4608.00e4, kPublishedImprovedRange = 2534.40e4;

inline const DetectionTable kPublishedTable3 = {
    .traditional = {.range = kPublishedTraditionalRange, .seconds = {469.24, 471.35, 470.62}},
    .improved = {.range = kPublishedImprovedRange, .seconds = {382.36, 383.41, 382.94}}};

/// The same detection with a robot.
inline const DetectionTable kPublishedTable4 = {
    .traditional = {.range = kPublishedTraditionalRange, .seconds = {475.36, 476.29, 475.99}},
    .improved = {.range = kPublishedImprovedRange, .seconds = {387.96, 388.45, 388.04}}};

}  // namespace octoblisk::demos
