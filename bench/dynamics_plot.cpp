// The pile of concave bodies of the tests, of our shapes and of GImpact's: energy and penetration over time.
//
//   dynamics_plot [name = dynamics] [seconds = 10]  ->  name.csv, name.svg
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "contenders/gimpact_shape.h"
#include "gallery/concave_pile.h"

namespace octoblisk::bench {
namespace {

using gallery::ConcavePile;

struct Sample {
  double time = 0.0;    ///< s
  double energy = 0.0;  ///< J
  ConcavePile::Depths depths;
  int fallen = 0;
  int points = 0;
  double step_ms = 0.0;  ///< processor time of a step, on average since the sample before
};

std::vector<Sample> drop(ConcavePile& pile, double seconds) {
  constexpr int kStepsASample = 6;
  for (std::size_t i = 0; i < pile.size(); ++i) pile.body(i).setActivationState(DISABLE_DEACTIVATION);
  std::vector<Sample> samples;
  for (int step = 0; step * ConcavePile::kTimeStep < seconds; step += kStepsASample) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < kStepsASample; ++i) pile.step();
    const double spent = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    Sample sample{(step + kStepsASample) * ConcavePile::kTimeStep,
                  pile.kineticEnergy(),
                  pile.depths(),
                  pile.fallen(),
                  0,
                  spent / kStepsASample};
    const btCollisionDispatcher& dispatcher = pile.world().dispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m)
      sample.points += dispatcher.getManifoldByIndexInternal(m)->getNumContacts();
    samples.push_back(sample);
  }
  return samples;
}

std::vector<Sample> dropOurs(double seconds) {
  ConcavePile pile(64, 1);
  return drop(pile, seconds);
}

std::vector<Sample> dropGimpact(double seconds) {
  std::vector<std::unique_ptr<gallery::BulletMesh>> meshes;
  ConcavePile pile(64, 1, [&](const gallery::SharedMesh& mesh) {
    meshes.push_back(std::make_unique<gallery::BulletMesh>(*mesh));
    return gimpactShape(*meshes.back(), ConcavePile::kMargin);
  });
  btGImpactCollisionAlgorithm::registerAlgorithm(&pile.world().dispatcher());
  return drop(pile, seconds);
}

struct Contender {
  const char* name;
  const char* color;
  std::vector<Sample> samples;
};

void writeCsv(const std::string& path, const std::vector<Contender>& contenders) {
  std::ofstream file(path);
  file << "contender,time_s,kinetic_energy_j,depth_in_floor_m,depth_in_bodies_m,fallen,points,step_ms\n";
  for (const Contender& contender : contenders) {
    for (const Sample& s : contender.samples) {
      file << contender.name << ',' << s.time << ',' << s.energy << ',' << s.depths.in_floor << ','
           << s.depths.in_bodies << ',' << s.fallen << ',' << s.points << ',' << s.step_ms << '\n';
    }
  }
}

/// One diagram below the other, all of the same width; values are on a logarithmic scale.
class Diagrams {
 public:
  Diagrams(const std::string& path, int count, double seconds) : file_(path), seconds_(seconds) {
    file_ << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kWidth + 90 << "' height='"
          << count * kPitch + 20 << "' font-family='sans-serif' font-size='12'>\n"
          << "<rect width='100%' height='100%' fill='white'/>\n";
  }
  ~Diagrams() { file_ << "</svg>\n"; }
  Diagrams(const Diagrams&) = delete;
  Diagrams& operator=(const Diagrams&) = delete;

  /// Decades from 10^low to 10^high.
  template <typename Value>
  void add(const char* title, int low, int high, const std::vector<Contender>& contenders, Value&& value) {
    const double top = kPitch * count_++ + 30;
    const auto y = [&](double v) {
      return top + kHeight * (high - std::clamp(std::log10(v), 1.0 * low, 1.0 * high)) / (high - low);
    };
    text(60, top - 10, title, "black");
    for (int decade = low; decade <= high; ++decade) {
      const double line = y(std::pow(10.0, decade));
      file_ << "<path d='M60 " << line << "h" << kWidth << "' stroke='#ddd'/>\n";
      text(8, line + 4, "1e" + std::to_string(decade), "black");
    }
    for (int second = 0; second <= static_cast<int>(seconds_); ++second)
      text(55 + kWidth * second / seconds_, top + kHeight + 15, std::to_string(second) + " s", "black");
    double legend = kWidth - 120;
    for (const Contender& contender : contenders) {
      text(legend, top - 10, contender.name, contender.color);
      legend += 100;
      file_ << "<polyline fill='none' stroke-width='1.5' stroke='" << contender.color << "' points='";
      for (const Sample& s : contender.samples)
        file_ << 60 + kWidth * s.time / seconds_ << ',' << y(value(s)) << ' ';
      file_ << "'/>\n";
    }
  }

 private:
  static constexpr double kWidth = 760, kHeight = 170, kPitch = 230;

  void text(double x, double y, const std::string& words, const char* color) {
    file_ << "<text x='" << x << "' y='" << y << "' fill='" << color << "'>" << words << "</text>\n";
  }

  std::ofstream file_;
  double seconds_;
  int count_ = 0;
};

void plot(const std::string& name, double seconds) {
  const std::vector<Contender> contenders = {{"octoblisk", "#0072b2", dropOurs(seconds)},
                                             {"gimpact", "#d55e00", dropGimpact(seconds)}};
  writeCsv(name + ".csv", contenders);
  Diagrams diagrams(name + ".svg", 3, seconds);
  diagrams.add("kinetic energy of 64 bodies of 1 kg, J", -4, 3, contenders,
               [](const Sample& s) { return s.energy; });
  diagrams.add("greatest depth of a body in the floor or another body, m", -5, 0, contenders,
               [](const Sample& s) { return std::max(s.depths.in_floor, s.depths.in_bodies); });
  diagrams.add("processor time of a step, ms", -1, 3, contenders, [](const Sample& s) { return s.step_ms; });
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10.0;
  if (!(seconds > 0.0)) {
    std::fprintf(stderr, "usage: dynamics_plot [name] [seconds]\n");
    return 2;
  }
  octoblisk::bench::plot(argc > 1 ? argv[1] : "dynamics", seconds);
}
