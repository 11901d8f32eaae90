#include "paper/paper_model.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
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
  if (!model.isBlisk()) return {evenPoints(*model.blade, count, seed)};
  const std::vector<int>& part = model.blades.blade_of_triangle;
  const auto blades = static_cast<std::size_t>(model.blades.count);
  const bool has_hub = std::ranges::find(part, 0) != part.end();
  std::vector<Points> clouds(blades + has_hub);
  // The hub takes longest, so it comes first.
  detail::parallelFor(clouds.size(), 0, [&](std::size_t index, std::size_t) {
    const std::size_t i = clouds.size() - 1 - index;
    const TriangleMesh mesh = partOf(*model.mesh, part, i < blades ? static_cast<int>(i) + 1 : 0);
    constexpr double kMaxOfHub = 4.0;
    const double share =
        i < blades ? 1.0 : std::min(kMaxOfHub, surfaceArea(mesh) / surfaceArea(*model.blade));
    clouds[i] =
        evenPoints(mesh, static_cast<std::size_t>(std::ceil(share * static_cast<double>(count))), seed);
  });
  return clouds;
}

std::shared_ptr<const TriangleMesh> paperBelt() {
  return std::make_shared<const TriangleMesh>(std::move(embeddedBeltGrinder().front().mesh));
}

}  // namespace octoblisk::demos
