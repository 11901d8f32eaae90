#include "paper/split_run.h"

#include "io/number_text.h"
#include "paper/published.h"

namespace octoblisk::demos {

Table splitCells(const SplitRun& run) {
  Table table{.name = "split_cells",
              .caption = "All cells of Tables 1 and 2",
              .columns = {"frame", "k", "fnop", "tnon", "paper_tnon", "paper_tnon_possible", "split_ms",
                          "paper_split_s", "leaf_volume_mm3", "false_positives", "clear_poses",
                          "false_negatives", "touching_poses"},
              .rows = {}};
  for (const bool principal : {false, true}) {
    const MethodTable<SplitCell>& cells = principal ? run.result.principal : run.result.cubes;
    for (std::size_t m = 0; m < kMethods; ++m) {
      for (std::size_t c = 0; c < kFnops; ++c) {
        const SplitCell& cell = cells[m][c];
        const int published = kPublishedNodes[m][c];
        table.rows.push_back(
            {principal ? "principal box" : "cube", std::to_string(clustersOfMethod(m)),
             std::to_string(fnopOf(c)), std::to_string(cell.nodes), std::to_string(published),
             canBeNodeCount(published, clustersOfMethod(m)) ? "1" : "0", fixedText(cell.split_ms, 4),
             fixedText(kPublishedSeconds[m][c], 2), fixedText(cell.leaf_volume, 1),
             std::to_string(cell.false_positives), std::to_string(run.result.clear),
             std::to_string(cell.false_negatives), std::to_string(run.result.touching)});
      }
    }
  }
  return table;
}

}  // namespace octoblisk::demos
