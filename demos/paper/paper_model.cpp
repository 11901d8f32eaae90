#include "paper/paper_model.h"

#include <algorithm>
#include <cmath>

#include "models/embedded_assets.h"
#include "paper/surface_points.h"

namespace octoblisk::demos {

PaperModel paperModel(std::string name, TriangleMesh mesh) {
  PaperModel model;
  model.name = std::move(name);
  model.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  model.blades = findBlades(*model.mesh);
  model.blade =
      model.isBlisk()
          ? std::make_shared<const TriangleMesh>(partOf(*model.mesh, model.blades.blade_of_triangle, 1))
          : model.mesh;
  return model;
}

std::vector<Points> partClouds(const PaperModel& model, std::size_t count, std::uint64_t seed) {
  std::vector<Points> clouds = {evenPoints(*model.blade, count, seed)};
  if (!model.isBlisk()) return clouds;
  const std::vector<int>& part = model.blades.blade_of_triangle;
  for (int blade = 2; blade <= model.blades.count; ++blade) {
    clouds.push_back(evenPoints(partOf(*model.mesh, part, blade), count, seed));
  }
  if (std::ranges::find(part, 0) == part.end()) return clouds;
  const TriangleMesh hub = partOf(*model.mesh, part, 0);
  constexpr double kMostOfHub = 4.0;
  const double share = std::min(kMostOfHub, surfaceArea(hub) / surfaceArea(*model.blade));
  const auto hub_count = static_cast<std::size_t>(std::ceil(share * static_cast<double>(count)));
  clouds.push_back(evenPoints(hub, hub_count, seed));
  return clouds;
}

std::shared_ptr<const TriangleMesh> paperBelt() {
  return std::make_shared<const TriangleMesh>(std::move(embeddedBeltGrinder().front().mesh));
}

}  // namespace octoblisk::demos
