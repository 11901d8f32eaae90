#include "shared/triangle_pairs.h"

#include <algorithm>
#include <cmath>

#include "shared/meshes.h"

namespace octoblisk::testing {
namespace {

int below(std::mt19937_64& random, int end) {
  return static_cast<int>(random() % static_cast<unsigned>(end));
}

bool oneIn(std::mt19937_64& random, int cases) { return below(random, cases) == 0; }

Vec3 onEdge(std::mt19937_64& random, const Triangle& t) {
  return t[0] + uniform(random, 0.0, 1.0) * (t[1] - t[0]);
}

Vec3 onFace(std::mt19937_64& random, const Triangle& t) {
  const double u = uniform(random, 0.0, 1.0), v = uniform(random, 0.0, 1.0 - u);
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

/// A point exactly in the plane x + y + z = 0. Its coordinates are multiples of 2^-20.
Vec3 inSkewPlane(std::mt19937_64& random, double half_size) {
  const Vec3 p = (randomPoint(random, half_size) * 0x1p20).array().round() * 0x1p-20;
  return {p.x(), p.y() - p.x(), -p.y()};
}

Triangle sliver(std::mt19937_64& random) {
  Triangle t = randomTriangle(random, 1);
  const double width = std::pow(10.0, uniform(random, -18.0, -6.0));
  t[2] = t[0] + uniform(random, -0.3, 1.3) * (t[1] - t[0]);
  t[2] += randomPoint(random, width);
  return t;
}

void flatten(std::mt19937_64& random, Triangle& t) {
  switch (below(random, 4)) {
    case 0:
      t[2] = t[1];
      break;
    case 1:
      t[2] = 0.5 * (t[0] + t[1]);  // collinear except for rounding
      break;
    case 2:
      t[2] = 2.0 * t[1] - t[0];
      break;
    default:
      t[1] = t[2] = t[0];
  }
}

void flattenToMeet(std::mt19937_64& random, Triangle& a, Triangle& b) {
  a = randomTriangle(random, 1);
  b = randomTriangle(random, 1);
  for (Triangle* t : {&a, &b}) {
    for (Vec3& corner : *t) corner = (corner * 4.0).array().round();  // then segments and points often meet
  }
  if (!oneIn(random, 3)) {  // through a corner, the middle of an edge or the middle of the triangle
    const Vec3 meeting = oneIn(random, 2) ? a[0] : 0.5 * (a[0] + a[1]);
    b[0] = meeting;
    if (oneIn(random, 2)) b[1] = 2.0 * meeting - b[2];
  }
  flatten(random, b);
  if (oneIn(random, 2)) flatten(random, a);
}

void nudge(std::mt19937_64& random, Triangle& t) {
  for (Vec3& corner : t) {
    for (int k = 0; k < 3; ++k) {
      if (oneIn(random, 2)) corner[k] = std::nextafter(corner[k], oneIn(random, 2) ? 1e300 : -1e300);
    }
  }
}

TrianglePairSample touching(std::mt19937_64& random, PairKind kind) {
  Triangle a = randomTriangle(random, 1), b = randomTriangle(random, 1);
  switch (kind) {
    case PairKind::random: {
      const double radius = uniform(random, 0.3, 1.0);  // around the centre of b
      for (Vec3& corner : a) corner = radius * corner + centroidOf(b);
      break;
    }
    case PairKind::grid:
      for (Triangle* t : {&a, &b}) {
        for (Vec3& corner : *t) corner = (corner * 3.0).array().round();
      }
      break;
    case PairKind::coplanar: {
      const Vec3 offset = inSkewPlane(random, 0.7);
      for (Vec3& corner : a) corner = inSkewPlane(random, 1);
      for (Vec3& corner : b) corner = inSkewPlane(random, 1) + offset;
      break;
    }
    case PairKind::sharedVertex:
      b[0] = a[0];
      break;
    case PairKind::sharedEdge:
      b[0] = a[0];
      b[1] = a[1];
      break;
    case PairKind::edgeOnEdge: {
      const Vec3 meeting = onEdge(random, a), away = meeting - a[2];
      const Vec3 along = b[1] - b[0];
      b[0] = meeting + uniform(random, 0.1, 1.0) * along;
      b[1] = meeting - uniform(random, 0.1, 1.0) * along;
      b[2] = meeting + away + randomPoint(random, 0.2);
      break;
    }
    case PairKind::vertexOnFace: {
      b[0] = onFace(random, a);
      const Vec3 up = unitNormal(a);
      for (int i = 1; i < 3; ++i) {
        Vec3& corner = b[static_cast<std::size_t>(i)];
        corner = b[0] + corner - up * (up.dot(corner) - std::abs(up.dot(corner)));
      }
      break;
    }
    case PairKind::slivers: {
      a = sliver(random);
      b = sliver(random);
      const Vec3 from = onEdge(random, b), to = onEdge(random, a);
      for (Vec3& corner : b) corner += to - from;
      break;
    }
    case PairKind::degenerate:
      flattenToMeet(random, a, b);
      break;
  }
  return {a, b, kind};
}

void shuffle(std::mt19937_64& random, TrianglePairSample& pair) {
  for (Triangle* t : {&pair.a, &pair.b}) {
    std::rotate(t->begin(), t->begin() + below(random, 3), t->end());
    if (oneIn(random, 2)) std::swap((*t)[0], (*t)[1]);
  }
  if (oneIn(random, 2)) std::swap(pair.a, pair.b);
}

/// Whether to move an exact touch by one ulp. The other kinds are already mixed.
bool toBeNudged(std::mt19937_64& random, PairKind kind) {
  const bool touches_always = kind == PairKind::sharedVertex || kind == PairKind::sharedEdge;
  return touches_always ? !oneIn(random, 20) : oneIn(random, 4);
}

}  // namespace

const char* nameOf(PairKind kind) {
  constexpr const char* kNames[kPairKinds] = {"random",       "grid",       "coplanar",
                                              "sharedVertex", "sharedEdge", "edgeOnEdge",
                                              "vertexOnFace", "slivers",    "degenerate"};
  return kNames[static_cast<int>(kind)];
}

TrianglePairSample hardPairOfUnitSize(std::mt19937_64& random, PairKind kind) {
  TrianglePairSample pair = touching(random, kind);
  if (toBeNudged(random, kind)) nudge(random, pair.b);
  shuffle(random, pair);
  return pair;
}

TrianglePairSample hardPair(std::mt19937_64& random, PairKind kind) {
  TrianglePairSample pair = touching(random, kind);
  const int exponent = oneIn(random, 8) ? below(random, 1000) - 1060 : below(random, 218) - 182;
  const double scale = oneIn(random, 2) ? 1.0 : std::ldexp(1.0, exponent);
  const bool far = oneIn(random, 4);
  const Vec3 offset = randomPoint(random, std::pow(10.0, uniform(random, 0.0, 7.0)) * std::min(scale, 1e4));
  for (Triangle* t : {&pair.a, &pair.b}) {
    for (Vec3& corner : *t) corner = scale * corner + (far ? offset : Vec3(0, 0, 0));
  }
  if (toBeNudged(random, kind)) nudge(random, pair.b);
  shuffle(random, pair);
  return pair;
}

}  // namespace octoblisk::testing
