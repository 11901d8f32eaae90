#include "gallery/gallery.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "gallery/belt_on_blade.h"
#include "gallery/gallery_scene.h"
#include "io/new_file.h"
#include "io/whole_files.h"
#include "render/contact_sheet.h"

namespace octoblisk::gallery {
namespace {

constexpr int kRows = 40;  // of a table, roughly

std::string secondsText(double time) {
  std::ostringstream text;
  text << time << " s";
  return text.str();
}

void addRow(std::ostream& table, double time, const std::vector<Number>& numbers) {
  table << time;
  for (const Number& number : numbers) table << ',' << number.value;
  table << '\n';
}

}  // namespace

const std::vector<Exhibit>& exhibits() {
  static const std::vector<Exhibit> all = {
      {"hello-shape",
       "A ring falls over a peg",
       "Its convex hull would lie on top of the peg",
       1.0 / 240.0,
       {0.0, 0.35, 2.0},
       makeHelloShape},
      {"chain-of-tori",
       "A chain of rings",
       "Only contacts link them; the top ring swings back and forth",
       1.0 / 120.0,
       {0.0, 1.0, 2.0},
       [](const BuildOptions& tree) { return makeChainOfTori(8, tree); }},
      {"pile",
       "A pile of 200 concave parts",
       "Rings, gears, channels and lumps; each is a ClusteredOctreeShape",
       1.0 / 60.0,
       {0.0, 1.0, 5.0},
       [](const BuildOptions& tree) { return makePile(200, tree); }},
      {"tower",
       "A tower of five cylinders",
       "The cylinders and the floor are meshes; no cylinder may sleep",
       1.0 / 60.0,
       {0.0, 20.0},
       [](const BuildOptions& tree) { return makeTower(5, tree); }},
      {"cloth-beside-gimpact",
       "A cloth on our channel and on GImpact's",
       "Our channel (left) holds the cloth; it falls through GImpact's",
       1.0 / 240.0,
       {0.0, 1.5},
       makeClothBesideGimpact,
       1,
       900,
       330},
      {"gear-train",
       "A gear train",
       "A motor drives the first gear; the teeth drive the others",
       1.0 / 240.0,
       {0.0, 0.5, 1.0},
       makeGearTrain},
      {"nut-on-bolt",
       "A nut on a bolt",
       "An M16 nut runs down by its weight, without friction; only the threads guide it",
       1.0 / 240.0,
       {0.0, 0.6, 1.2},
       makeNutOnBolt},
      {"blisk-and-debris",
       "A blisk on a spindle, hit by debris",
       "Parts fly through the channels and slow it down; a line on the hub shows how far it has turned",
       1.0 / 960.0,
       {0.0, 0.2, 0.5},
       [](const BuildOptions& tree) { return makeBliskAndDebris(60, tree); },
       3,
       360,
       400},
      {"soft-belt",
       "A grinding belt as a soft body",
       "Driven by its wheels, pressed on the convex side of a blade",
       BeltOnBlade::kTimeStep,
       {0.0, 0.4},
       [](const BuildOptions& tree) {
         return std::make_unique<BeltOnBlade>(BeltOnBladeOptions{.tree = tree});
       },
       1,
       1000,
       340},
  };
  return all;
}

std::vector<Number> show(const Exhibit& exhibit, const std::filesystem::path& folder,
                         const BuildOptions& tree) {
  const std::unique_ptr<GalleryScene> scene = exhibit.make(tree);
  const auto stepAt = [&](double time) { return std::lround(time / exhibit.time_step); };
  const long end = stepAt(exhibit.shown.back()), interval = std::max(1l, end / kRows);
  std::vector<Number> numbers = scene->numbers();
  std::ostringstream table;
  table << "time_s";
  for (const Number& number : numbers) table << ',' << number.name;
  table << '\n';

  std::vector<demos::SheetFrame> frames;
  for (long step = 0;; ++step) {
    const double time = static_cast<double>(step) * exhibit.time_step;
    if (step % interval == 0 || step == end) addRow(table, time, numbers = scene->numbers());
    for (const double shown : exhibit.shown) {
      if (stepAt(shown) == step) frames.push_back({secondsText(shown), scene->picture()});
    }
    if (step == end) break;
    scene->step();
  }
  demos::WholeFiles files;
  demos::writeFile(files.add(folder / (exhibit.name + ".csv")), table.str());
  demos::writePng(demos::contactSheet(frames, exhibit.title, exhibit.caption, exhibit.columns,
                                      exhibit.frame_width, exhibit.frame_height),
                  files.add(folder / (exhibit.name + ".png")).string());
  files.finish();
  return numbers;
}

}  // namespace octoblisk::gallery
