// Random blisks in random positions, with known blades and axes.
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <string>

#include "models/blade_sections.h"
#include "models/blisk.h"
#include "models/blisk_axis.h"

namespace octoblisk::demos {

struct RandomBlisk {
  BladeSections sections;
  Blisk blisk;  ///< about Z
  Pose blisk_in_mesh = {};
  TriangleMesh mesh;  ///< the same blisk in its position
  std::string name;
};

inline RandomBlisk randomBlisk(unsigned seed, bool shroud, std::size_t triangles = 20'000) {
  std::mt19937 random(seed);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  BladeParameters blade;
  blade.tip_radius = uniform(190.0, 250.0);
  blade.chord_hub = uniform(70.0, 110.0);
  blade.chord_tip = uniform(60.0, 100.0);
  blade.stagger_hub = uniform(-10.0, 35.0);
  blade.stagger_tip = blade.stagger_hub + uniform(5.0, 25.0);
  blade.camber_hub = uniform(4.0, 9.0);
  blade.camber_tip = uniform(2.0, 5.0);
  blade.lean = uniform(-4.0, 4.0);
  BliskOptions options;
  options.blade_count = std::uniform_int_distribution<int>(5, 24)(random);
  options.target_triangles = triangles;
  options.shroud = shroud;
  BladeSections sections = makeBladeSections(blade);
  Blisk blisk = makeBlisk(sections, cylinderProfile(blade.hub_radius, 100.0), options);
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond{normal(random), normal(random), normal(random), normal(random)}.normalized();
  const Pose pose{turn.toRotationMatrix(),
                  {uniform(-500.0, 500.0), uniform(-500.0, 500.0), uniform(-500.0, 500.0)}};
  TriangleMesh mesh = moved(blisk.mesh, pose);
  return {std::move(sections), std::move(blisk), pose, std::move(mesh),
          "seed " + std::to_string(seed) + (shroud ? ", shrouded" : "")};
}

}  // namespace octoblisk::demos
