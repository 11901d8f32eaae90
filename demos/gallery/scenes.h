// The scenes of the gallery, one a file, each of which begins with what it shows.
#pragma once

#include "gallery/gallery_scene.h"

namespace octoblisk::gallery {

std::unique_ptr<GalleryScene> makeHelloShape();
std::unique_ptr<GalleryScene> makeChainOfTori(int links);
std::unique_ptr<GalleryScene> makePile(int bodies);
std::unique_ptr<GalleryScene> makeClothBesideGimpact();
std::unique_ptr<GalleryScene> makeGearTrain();
std::unique_ptr<GalleryScene> makeBliskAndDebris(int bodies);

}  // namespace octoblisk::gallery
