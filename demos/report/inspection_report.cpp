#include "report/inspection_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ranges>
#include <sstream>
#include <utility>

#include "io/number_text.h"

namespace octoblisk::demos {
namespace {

constexpr std::size_t kMost = 10;  // of one kind are named

/// How the text and the JSON name a kind of defect that is a list of places.
struct Kind {
  const char* key;
  const char* name;
  std::vector<DefectPlace> MeshInspection::*places;
};

/// Because of these, triangles bound no solid, or face into it.
constexpr Kind kBad[] = {
    {"opposed_edges", "edges of triangles that face opposite ways", &MeshInspection::opposed_edges},
    {"sheets", "sheets (triangles that bound no solid)", &MeshInspection::sheets},
    {"inward", "triangles that face inward", &MeshInspection::inward},
};

constexpr Kind kHarmless[] = {
    {"t_junctions", "T-junctions", &MeshInspection::t_junctions},
    {"copies", "copies of other triangles", &MeshInspection::copies},
    {"zero_area", "triangles without area", &MeshInspection::zero_area},
    {"shared_edges", "edges of more than two triangles", &MeshInspection::shared_edges},
    {"intersecting", "triangles that intersect or overlap", &MeshInspection::intersecting},
    {"folded", "triangles folded over onto others", &MeshInspection::folded},
    {"inner", "triangles inside the solid", &MeshInspection::inner},
};

double roundedNearZero(double value, double size) { return std::abs(value) > 1e-9 * size ? value : 0.0; }

std::string pointText(const Vec3& v) {
  std::ostringstream text;
  const char* before = "(";
  for (const double value : v) {
    text << before << roundedNearZero(value, v.norm());
    before = " ";
  }
  return text.str() + ')';
}

std::string countText(std::size_t count, const char* one, const char* many) {
  return count == 1 ? std::string(one) : std::to_string(count) + ' ' + many;
}

/// The lines of a list: a name, a number and a remark.
class Lines {
 public:
  void add(const std::string& name, std::size_t count, const std::string& remark) {
    constexpr std::size_t kName = 48, kNumber = 9;
    const std::string number = std::to_string(count);
    text_ += "  " + name + std::string(name.size() < kName ? kName - name.size() : 1, ' ');
    text_ += std::string(number.size() < kNumber ? kNumber - number.size() : 0, ' ') + number + "  " +
             remark + '\n';
  }

  void add(const Kind& kind, const MeshInspection& found) {
    const std::vector<DefectPlace>& places = found.*kind.places;
    if (places.empty()) return;
    add(kind.name, places.size(),
        "triangle " + std::to_string(places.front().triangle) + " at " + pointText(places.front().position));
  }

  std::string under(const std::string& heading) const { return text_.empty() ? "" : heading + '\n' + text_; }

 private:
  std::string text_;
};

const MeshGap* firstOf(GapKind kind, const MeshInspection& found) {
  const auto first = std::ranges::find(found.gaps, kind, &MeshGap::kind);
  return first != found.gaps.end() ? &*first : nullptr;
}

double widestCrack(const MeshInspection& found) {
  double widest = 0.0;
  for (const MeshGap& gap : found.gaps) {
    if (gap.kind == GapKind::crack) widest = std::max(widest, gap.width);
  }
  return widest;
}

std::string unitAfter(const InspectionReport& report, const char* power = "") {
  return report.unit.empty() ? "" : ' ' + report.unit + power;
}

std::string badText(const InspectionReport& report) {
  const MeshInspection& found = report.found;
  Lines lines;
  std::size_t holes = 0;
  for (const MeshGap& gap : found.gaps) {
    if (gap.kind != GapKind::hole || ++holes > kMost) continue;
    lines.add("open edges around a hole", gap.edges,
              "beside triangle " + std::to_string(gap.triangle) + " at " + pointText(gap.center) +
                  (gap.is_planar ? ", planar, area " + shortText(gap.area) + unitAfter(report, "²")
                                 : ", not planar: corners are up to " + shortText(gap.off_plane) +
                                       unitAfter(report) + " off its plane"));
  }
  if (holes > kMost) lines.add("more holes", holes - kMost, "");
  for (const Kind& kind : kBad) lines.add(kind, found);
  return lines.under("Defects:");
}

std::string harmlessText(const InspectionReport& report) {
  const MeshInspection& found = report.found;
  Lines lines;
  if (const MeshGap* const first = firstOf(GapKind::crack, found)) {
    lines.add("cracks", found.count(GapKind::crack),
              "up to " + shortText(widestCrack(found)) + unitAfter(report) + " wide; triangle " +
                  std::to_string(first->triangle) + " at " + pointText(first->center));
  }
  if (const MeshGap* const first = firstOf(GapKind::inner, found)) {
    lines.add("gaps inside the solid", found.count(GapKind::inner),
              "triangle " + std::to_string(first->triangle) + " at " + pointText(first->center));
  }
  for (const Kind& kind : kHarmless) lines.add(kind, found);
  return lines.under("Of no consequence:");
}

std::string stateText(const MeshInspection& found) {
  const std::size_t holes = found.count(GapKind::hole);
  if (!found.isAnywhereSolid()) {
    return holes > 0
               ? "is an open surface with " + countText(holes, "a hole", "holes") + ": it bounds no solid"
               : "bounds no solid: it encloses no volume";
  }
  std::string text = found.facesInward()    ? "bounds a solid and faces inward"
                     : found.inward.empty() ? "bounds a solid and faces outward"
                                            : "bounds a solid and faces inward in parts";
  if (holes > 0) {
    text += ", except around " + countText(holes, "a hole", "holes") + ": the triangles there are sheets";
  } else if (!found.sheets.empty()) {
    text += found.opposed_edges.empty() ? ", but some triangles bound none"
                                        : ", except where triangles face opposite ways";
  }
  return text;
}

std::string partsText(const MeshInspection& found) {
  std::string text = countedText(found.components, "component", "components");
  if (found.shells + found.hollows > 0) text += ": " + countedText(found.shells, "shell", "shells");
  if (found.hollows > 0) text += ", " + countedText(found.hollows, "hollow", "hollows");
  return text;
}

/// What follows for depth, inertia and the margin in Bullet.
std::string consequencesText(const InspectionReport& report) {
  const MeshInspection& found = report.found;
  const bool is_solid = found.isSolid(), bounds_none = !found.isAnywhereSolid();
  std::string text = "Depth:   ";
  text += bounds_none            ? "none: nothing is inside the mesh\n"
          : found.sheets.empty() ? "known everywhere\n"
                                 : "unknown at the sheets, known elsewhere\n";
  text += "Inertia: ";
  text += found.mass.is_solid
              ? "exact; volume " + shortText(found.mass.volume) + unitAfter(report, "³") + '\n'
              : "that of the bounding box\n";
  text += "Margin:  ";
  text += bounds_none           ? "0 in Bullet: bodies are pushed back to the side that they came from\n"
          : found.facesInward() ? "0 in Bullet: a mesh that faces inward does not push bodies out\n"
          : !found.pushes_out   ? "0 in Bullet: the holes are large, so the whole mesh is a surface\n"
          : is_solid            ? "in Bullet, bodies rest on a thin margin and are pushed out of the solid\n"
          : found.inward.empty()
              ? "in Bullet, bodies are pushed out of the solid, but not near holes and at sheets\n"
              : "in Bullet, bodies are pushed out of the solid, but not near holes, at sheets, and where "
                "triangles face inward\n";
  return text;
}

std::string closedText(const ClosedReport& closed) {
  std::string text;
  const auto edgesText = [](std::size_t edges) { return countedText(edges, "edge", "edges"); };
  for (const HoleCap& cap : closed.added) {
    text += (cap.outlines == 1 ? "Closed: the hole with " + edgesText(cap.edges)
                               : "Closed: the hole between " + std::to_string(cap.outlines) +
                                     " outlines with " + edgesText(cap.edges)) +
            " at " + pointText(cap.center) + ", by " + countedText(cap.triangles, "triangle", "triangles") +
            '\n';
  }
  for (const MeshGap& gap : closed.refused | std::views::take(kMost)) {
    text += "Refused: the hole with " + edgesText(gap.edges) + " at " + pointText(gap.center) +
            (gap.is_planar ? std::string(": its outline crosses itself")
                           : ": it is not planar, its corners are up to " + shortText(gap.off_plane) +
                                 " off its plane") +
            '\n';
  }
  if (closed.refused.size() > kMost)
    text += "Refused: " + countedText(closed.refused.size() - kMost, "more hole", "more holes") + '\n';
  if (closed.added.empty() && closed.refused.empty()) text += "No holes: nothing was added\n";
  return text + closed.file.string() + ": the new mesh " + stateText(closed.found) + '\n';
}

nlohmann::json jsonOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::json jsonOf(const DefectPlace& place) {
  return {{"triangle", place.triangle}, {"position", jsonOf(place.position)}};
}

nlohmann::json jsonOf(const MeshGap& gap) {
  return {{"edges", gap.edges},
          {"length", gap.length},
          {"triangle", gap.triangle},
          {"center", jsonOf(gap.center)},
          {"is_planar", gap.is_planar},
          {"off_plane", gap.off_plane},
          {"area", gap.area}};
}

nlohmann::json jsonOf(const MeshInspection& found) {
  nlohmann::json json = {{"state", stateText(found)},
                         {"why_not_solid", whyNotSolid(found)},
                         {"is_solid", found.isSolid()},
                         {"is_closed", found.is_closed},
                         {"is_anywhere_solid", found.isAnywhereSolid()},
                         {"faces_inward", found.facesInward()},
                         {"triangles", found.triangles},
                         {"components", found.components},
                         {"shells", found.shells},
                         {"hollows", found.hollows}};
  json["volume"] = found.mass.is_solid ? nlohmann::json(found.mass.volume) : nlohmann::json();
  json["center_of_mass"] = found.mass.is_solid ? jsonOf(found.mass.center_of_mass) : nlohmann::json();
  const auto gapsOf = [&](GapKind kind, std::size_t most) {
    nlohmann::json gaps = nlohmann::json::array();
    for (const MeshGap& gap : found.gaps) {
      if (gap.kind == kind && gaps.size() < most) gaps.push_back(jsonOf(gap));
    }
    return gaps;
  };
  const std::size_t holes = found.count(GapKind::hole);
  json["open_edges"] = found.openEdges(GapKind::hole);
  json["holes"] = gapsOf(GapKind::hole, holes);
  json["cracks"] = {{"count", found.count(GapKind::crack)},
                    {"widest", widestCrack(found)},
                    {"first", gapsOf(GapKind::crack, kMost)}};
  json["inner_gaps"] = {{"count", found.count(GapKind::inner)}, {"first", gapsOf(GapKind::inner, kMost)}};
  const auto add = [&](const Kind& kind) {
    const std::vector<DefectPlace>& places = found.*kind.places;
    nlohmann::json first = nlohmann::json::array();
    for (std::size_t i = 0; i < std::min(kMost, places.size()); ++i) first.push_back(jsonOf(places[i]));
    json[kind.key] = {{"count", places.size()}, {"first", std::move(first)}};
  };
  std::ranges::for_each(kBad, add);
  std::ranges::for_each(kHarmless, add);
  return json;
}

}  // namespace

std::string inspectionText(const InspectionReport& report) {
  const MeshInspection& found = report.found;
  std::string text = report.file.string() + ": " + std::to_string(found.triangles) + " triangles in " +
                     partsText(found) + "; " + shortText(report.size.x()) + " x " +
                     shortText(report.size.y()) + " x " + shortText(report.size.z()) + unitAfter(report) +
                     "\nThe mesh " + stateText(found) + '\n';
  text += badText(report) + harmlessText(report) + consequencesText(report);
  if (report.closed) text += closedText(*report.closed);
  return text;
}

std::string inspectionJson(const InspectionReport& report) {
  nlohmann::json json = jsonOf(report.found);
  json["file"] = report.file.string();
  json["unit"] = report.unit.empty() ? nlohmann::json() : nlohmann::json(report.unit);
  json["size"] = jsonOf(report.size);
  if (report.closed) {
    nlohmann::json& closed = json["closed"] = jsonOf(report.closed->found);
    closed["file"] = report.closed->file.string();
    closed["added"] = closed["refused"] = nlohmann::json::array();
    for (const HoleCap& cap : report.closed->added) {
      closed["added"].push_back({{"outlines", cap.outlines},
                                 {"edges", cap.edges},
                                 {"triangles", cap.triangles},
                                 {"triangle", cap.triangle},
                                 {"center", jsonOf(cap.center)},
                                 {"area", cap.area}});
    }
    for (const MeshGap& gap : report.closed->refused) closed["refused"].push_back(jsonOf(gap));
  }
  return json.dump(2) + '\n';
}

}  // namespace octoblisk::demos
