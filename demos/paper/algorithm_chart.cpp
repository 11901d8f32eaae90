#include "paper/algorithm_chart.h"

namespace octoblisk::demos {

FlowChart algorithmChart() {
  enum : std::size_t {
    kBelt,
    kBlisk,
    kParts,
    kBeltBox,
    kClusters,
    kOctrees,
    kCells,
    kOverlap,
    kClear,
    kCall,
    kTriangles,
    kTouch,
    kFalseAlarm,
    kContact
  };
  FlowChart chart;
  chart.boxes = {{0.0, 0, "Points of the abrasive belt"},
                 {1.0, 0, "Points of the blisk"},
                 {1.0, 1, "Parts: each blade, the hub"},
                 {0.0, 2, "One box along the belt's principal axes (eq. 1–3)"},
                 {1.0, 2, "k-means: k clusters of each part (eq. 4, 5)"},
                 {1.0, 3, "An octree over each cluster: a cell with more points than FNOP is divided"},
                 {0.5, 4,
                  "At each pose: test the belt's box against the cells, from the roots down, with separating "
                  "axes (eq. 11)"},
                 {0.5, 5, "Does a leaf cell with points overlap it?", FlowShape::question},
                 {0.0, 6, "No collision"},
                 {1.0, 6, "Collision: the paper stops here"},
                 {1.0, 7, "Not in the paper: the exact test of the triangles"},
                 {1.0, 8, "Do two triangles touch?", FlowShape::question},
                 {0.5, 9, "False positive"},
                 {1.5, 9, "Contact"}};
  chart.arrows = {{kBelt, kBeltBox},        {kBlisk, kParts},         {kParts, kClusters},
                  {kClusters, kOctrees},    {kBeltBox, kCells},       {kOctrees, kCells},
                  {kCells, kOverlap},       {kOverlap, kClear, "no"}, {kOverlap, kCall, "yes"},
                  {kCall, kTriangles},      {kTriangles, kTouch},     {kTouch, kFalseAlarm, "no"},
                  {kTouch, kContact, "yes"}};
  return chart;
}

}  // namespace octoblisk::demos
