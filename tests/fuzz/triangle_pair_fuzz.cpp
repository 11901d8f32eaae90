// Tests two triangles with any coordinates that a mesh may have. The verdict does not depend on the order of
// triangles and corners. A contact is finite and agrees with the verdict.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fuzz/bytes.h"
#include "geometry/triangle_pair.h"

namespace {

using octoblisk::Contact;
using octoblisk::Triangle;
using octoblisk::TriangleMesh;
using octoblisk::Vec3;
using octoblisk::detail::contactOf;
using octoblisk::detail::intersects;

class Coordinates {
 public:
  explicit Coordinates(octoblisk::fuzz::Bytes bytes) : bytes_(bytes) {}

  /// A small integer, a double already seen, its neighbour, or any double that a mesh may have.
  double next() {
    const std::uint8_t kind = bytes_.byte();
    double value = 0.0;
    switch (kind & 3) {
      case 0:
        value = static_cast<std::int8_t>(bytes_.byte());
        break;
      case 1:
        value = seen_count_ == 0 ? 0.0 : seen_[bytes_.byte() % seen_count_];
        if (kind & 4) value = std::nextafter(value, kind & 8 ? 1e300 : -1e300);
        break;
      default:
        value = bytes_.any<double>();
    }
    if (!(std::abs(value) <= TriangleMesh::kMaxCoordinate)) value = 0.0;
    seen_[seen_count_++] = value;
    return value;
  }

  Triangle triangle() {
    Triangle t;
    for (Vec3& corner : t) {
      for (int k = 0; k < 3; ++k) corner[k] = next();
    }
    return t;
  }

 private:
  octoblisk::fuzz::Bytes bytes_;
  double seen_[18] = {};
  std::size_t seen_count_ = 0;
};

void require(bool holds, const char* what, const Triangle& a, const Triangle& b) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what);
  for (const Triangle* t : {&a, &b}) {
    for (const Vec3& corner : *t) {
      std::fprintf(stderr, "  %a %a %a (%g %g %g)\n", corner.x(), corner.y(), corner.z(), corner.x(),
                   corner.y(), corner.z());
    }
  }
  std::abort();
}

Triangle turned(const Triangle& t) { return {t[1], t[2], t[0]}; }
Triangle reversed(const Triangle& t) { return {t[1], t[0], t[2]}; }

void checkVerdict(const Triangle& a, const Triangle& b, bool meet) {
  Triangle in_a = a, in_b = b;
  for (int i = 0; i < 3; ++i) {
    require(intersects(in_a, in_b) == meet, "the verdict depends on the order of corners", in_a, in_b);
    require(intersects(in_b, in_a) == meet, "the verdict depends on the order of triangles", in_b, in_a);
    require(intersects(reversed(in_a), in_b) == meet, "the verdict depends on a's orientation", in_a, in_b);
    in_a = turned(in_a);
    if (i % 2) in_b = turned(in_b);
  }
  require(!meet || intersects(a, a), "a triangle does not meet itself", a, a);
  for (const Vec3& corner : a)
    require(intersects(a, {corner, corner, corner}), "a corner is not on it", a, b);
}

constexpr double kUnderflow = 1e-70;  // products of four smaller lengths underflow

void checkContact(const Triangle& a, const Triangle& b, bool meet) {
  const Contact contact = contactOf(a, b);
  require(contact.point_on_a.allFinite() && contact.point_on_b.allFinite(), "a point is not finite", a, b);
  require(std::abs(contact.normal.norm() - 1.0) < 1e-12, "the normal is no unit vector", a, b);
  require(std::isfinite(contact.distance), "the distance is not finite", a, b);
  require((contact.distance > 0.0) == !meet, "the distance contradicts the verdict", a, b);
  double size = 0.0;
  for (const Triangle* t : {&a, &b}) {
    for (const Vec3& corner : *t) size = std::max(size, corner.cwiseAbs().maxCoeff());
  }
  const double reach = (contact.point_on_a - contact.point_on_b).norm();
  require(std::abs(reach - std::abs(contact.distance)) <= 1e-14 * size + kUnderflow,
          "the points are not the distance apart", a, b);
  require(meet || std::abs(contactOf(b, a).distance - contact.distance) <= 1e-13 * size + kUnderflow,
          "the distance depends on the order of triangles", a, b);
  for (const Vec3& point : {contact.point_on_a, contact.point_on_b}) {
    require(point.cwiseAbs().maxCoeff() <= 4.0 * size + kUnderflow, "a point is beyond the triangles", a, b);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Coordinates coordinates({data, size});
  const Triangle a = coordinates.triangle(), b = coordinates.triangle();
  const bool meet = intersects(a, b);
  checkVerdict(a, b, meet);
  checkContact(a, b, meet);
  return 0;
}
