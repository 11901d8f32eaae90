// The scenes of the gallery, one per file; each file begins with a description. `tree` has the build
// options of their shapes.
#pragma once

#include "gallery/gallery_scene.h"

namespace octoblisk::gallery {

std::unique_ptr<GalleryScene> makeHelloShape(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeChainOfTori(int links, const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makePile(int bodies, const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeTower(int cylinders, const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeClothBesideGimpact(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeGearTrain(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeNutOnBolt(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeBliskAndDebris(int bodies, const BuildOptions& tree = {});

}  // namespace octoblisk::gallery
