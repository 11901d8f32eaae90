#include "plan/free_runs.h"

#include <cstdint>
#include <map>
#include <optional>

#include "base/parallel.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// A contact of a pass, and the motion to the next one.
struct Contact {
  Pose pose;
  bool is_judged = false, is_free = false;
  std::optional<bool> free_to_next;  ///< none: unknown
};

/// Contacts by their place on the pass.
using Contacts = std::map<std::size_t, Contact>;

/// Whether the line leaves the chord between two of its places by more than an error.
bool leavesChord(const Placer& placer, const PassLine& line, std::size_t from, std::size_t to, double error) {
  const Vec3& a = placer.point(line[from]).point;
  const Vec3 chord = placer.point(line[to]).point - a;
  for (std::size_t k = from + 1; k < to; ++k) {
    const Vec3 off = placer.point(line[k]).point - a;
    const double along = off.dot(chord) / chord.squaredNorm();
    if ((off - along * chord).norm() > error) return true;
  }
  return false;
}

/// The first contacts: as few as the chord error allows, and both ends.
Contacts contactsAlong(const Placer& placer, const PassLine& line, double chord_error) {
  Contacts contacts;
  contacts[0];
  for (std::size_t from = 0; from + 1 < line.size();) {
    std::size_t to = from + 1;
    while (to + 1 < line.size() && !leavesChord(placer, line, from, to + 1, chord_error)) ++to;
    contacts[to];
    from = to;
  }
  return contacts;
}

/// All passes, refined together so that many poses are judged at once.
class Refinement {
 public:
  Refinement(Judge& judge, const Placer& placer, const std::vector<PassLine>& passes, double chord_error)
      : judge_(judge), placer_(placer), passes_(passes) {
    for (const PassLine& line : passes) contacts_.push_back(contactsAlong(placer, line, chord_error));
  }

  void run() {
    do {
      judgeContacts();
      judgeMotions();
    } while (addContacts());
  }

  std::vector<FreeRun> runs() const {
    std::vector<FreeRun> runs;
    for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
      bool goes_on = false;
      for (const auto& [place, contact] : contacts_[pass]) {
        if (contact.is_free) {
          if (!goes_on) runs.emplace_back();
          runs.back().cells.push_back(passes_[pass][place]);
          runs.back().poses.push_back(contact.pose);
        }
        goes_on = contact.is_free && contact.free_to_next.value_or(false);
      }
    }
    return runs;
  }

 private:
  void judgeContacts() {
    std::vector<Contact*> asked;
    std::vector<std::size_t> cells;
    for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
      for (auto& [place, contact] : contacts_[pass]) {
        if (contact.is_judged) continue;
        asked.push_back(&contact);
        cells.push_back(passes_[pass][place]);
      }
    }
    std::vector<Pose> poses(asked.size());
    parallelFor(poses.size(), judge_.threads(),
                [&](std::size_t i, std::size_t) { poses[i] = placer_.at(cells[i]); });
    const std::vector<PoseState> states = judge_.statesOf(poses);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      *asked[i] = {poses[i], true, !states[i].obstacle && states[i].grinds, std::nullopt};
    }
  }

  void judgeMotions() {
    std::vector<Contact*> asked;
    std::vector<MotionEnds> motions;
    for (Contacts& contacts : contacts_) {
      for (auto at = contacts.begin(), next = std::next(at); next != contacts.end(); at = next++) {
        if (!at->second.is_free || !next->second.is_free || at->second.free_to_next) continue;
        asked.push_back(&at->second);
        motions.push_back({at->second.pose, next->second.pose});
      }
    }
    const auto obstacles = judge_.obstaclesOf(motions);
    for (std::size_t i = 0; i < asked.size(); ++i) asked[i]->free_to_next = !obstacles[i];
  }

  /// Halves the distance between contacts where the tool is free at one only, or not between them.
  bool addContacts() {
    bool any = false;
    for (Contacts& contacts : contacts_) {
      for (auto at = contacts.begin(), next = std::next(at); next != contacts.end(); at = next++) {
        if (next->first == at->first + 1) continue;
        const bool both = at->second.is_free && next->second.is_free;
        const bool one = at->second.is_free != next->second.is_free;
        if (!one && !(both && !at->second.free_to_next.value())) continue;
        at->second.free_to_next.reset();
        contacts[(at->first + next->first) / 2];
        any = true;
      }
    }
    return any;
  }

  Judge& judge_;
  const Placer& placer_;
  const std::vector<PassLine>& passes_;
  std::vector<Contacts> contacts_;  // per pass
};

}  // namespace

std::vector<FreeRun> freeRuns(Judge& judge, const Placer& placer, const std::vector<PassLine>& passes,
                              double chord_error) {
  Refinement refinement(judge, placer, passes, chord_error);
  refinement.run();
  return refinement.runs();
}

}  // namespace octoblisk::demos
