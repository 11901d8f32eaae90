// A pile of concave parts: rings, gears, channels and lumps dropped on a wavy floor.
#include "gallery/concave_pile.h"
#include "gallery/gallery_scene.h"

namespace octoblisk::gallery {
namespace {

constexpr int kLayerSide = 6;

class Pile final : public GalleryScene {
 public:
  Pile(int bodies, const BuildOptions& tree)
      : pile_(
            bodies, 1, [&](const SharedMesh& mesh) { return makeOurShape(mesh, tree); }, kLayerSide) {
    for (std::size_t i = 0; i < pile_.size(); ++i) pile_.body(i).setActivationState(DISABLE_DEACTIVATION);
  }

  void step() override { pile_.step(); }

  demos::Picture picture() const override {
    const demos::Color colors[] = {demos::palette::kOrange, demos::palette::kSky, demos::palette::kGreen,
                                   demos::palette::kPurple};
    demos::Picture picture;
    picture.scene.addMesh(pile_.floor(), {}, demos::palette::kSteel);
    for (std::size_t i = 0; i < pile_.size(); ++i) {
      picture.scene.addMesh(pile_.mesh(i), fromBullet(pile_.body(i).getWorldTransform()),
                            colors[pile_.kind(i)]);
    }
    const Aabb seen{Vec3(-4.4, -4.4, 0.0), Vec3(4.4, 4.4, 4.0)};
    picture.camera = demos::frame(seen, {-0.15, 1.0, -1.1}, Vec3::UnitZ());
    return picture;
  }

  std::vector<Number> numbers() const override {
    const ConcavePile::Depths depths = pile_.depths();
    return {{"kinetic_energy_j", pile_.kineticEnergy()},
            {"depth_in_floor_mm", 1e3 * depths.in_floor},
            {"depth_in_bodies_mm", 1e3 * depths.in_bodies},
            {"bodies_fallen", static_cast<double>(pile_.fallen())}};
  }

 private:
  ConcavePile pile_;
};

}  // namespace

std::unique_ptr<GalleryScene> makePile(int bodies, const BuildOptions& tree) {
  return std::make_unique<Pile>(bodies, tree);
}

}  // namespace octoblisk::gallery
