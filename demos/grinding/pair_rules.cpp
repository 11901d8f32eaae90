#include "grinding/pair_rules.h"

namespace octoblisk::demos {

bool BladeChoice::includes(int blade, int ground_blade) const {
  switch (kind) {
    case Kind::any:
      return true;
    case Kind::hub:
      return blade == 0;
    case Kind::ground:
      return blade != 0 && blade == ground_blade;
    case Kind::number:
      return blade == number;
  }
  return false;
}

}  // namespace octoblisk::demos
