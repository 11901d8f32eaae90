#include "models/defect_words.h"

#include <algorithm>
#include <sstream>

#include "query/simple_solid.h"

namespace octoblisk::demos {
namespace {

/// The edges of holes, the first of the lowest triangle.
void addOpenEdges(const MeshInspection& found, std::ostringstream& text) {
  const std::size_t edges = found.openEdges(GapKind::hole);
  if (edges == 0) return;
  const MeshGap* first = nullptr;
  for (const MeshGap& gap : found.gaps) {
    if (gap.kind == GapKind::hole && (!first || gap.triangle < first->triangle)) first = &gap;
  }
  text << edges << (edges == 1 ? " of its edges is open," : " of its edges are open, the first");
  const char* before = " from (";
  for (const Vec3& end : {first->outline[0], first->outline[1]}) {
    text << before << end.x() << ' ' << end.y() << ' ' << end.z() << ')';
    before = " to (";
  }
}

void addTriangles(const std::vector<DefectPlace>& places, const char* one, const char* many,
                  std::ostringstream& text) {
  const bool is_one = places.size() == 1;
  text << places.size() << " of its triangles " << (is_one ? one : many)
       << (is_one ? ", number " : ", the first number ") << places.front().triangle;
}

}  // namespace

std::string openText(const MeshInspection& found) {
  std::ostringstream text;
  addOpenEdges(found, text);
  if (const std::size_t edges = found.opposed_edges.size(); edges > 0) {
    text << (text.tellp() > 0 ? "; " : "") << "triangles face opposite ways at " << edges
         << (edges == 1 ? " of its edges, at triangle " : " of its edges, the first at triangle ")
         << found.opposed_edges.front().triangle;
  }
  if (text.tellp() == 0 && !found.sheets.empty())
    addTriangles(found.sheets, "bounds no solid", "bound no solid", text);
  return text.str();
}

std::string inwardText(const MeshInspection& found) {
  if (found.inward.empty()) return {};
  if (found.facesInward()) return "it faces inward";
  std::ostringstream text;
  addTriangles(found.inward, "faces inward", "face inward", text);
  return text.str();
}

MeshInspection defectsOf(const ClusteredOctree& tree, int threads) {
  MeshInspection whole;
  whole.triangles = tree.mesh().triangleCount();
  whole.is_closed = whole.pushes_out = true;
  whole.mass = detail::massPropertiesOfSimple(tree.mesh());
  if (!detail::isSimpleSolid(tree.mesh()) || whole.mass.faces_inward)
    return inspect(octoblisk::Surface(tree, threads));
  return whole;
}

}  // namespace octoblisk::demos
