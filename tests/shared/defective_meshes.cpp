#include "shared/defective_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "shapes/grid_mesh.h"
#include "shared/block.h"
#include "shared/solids.h"

namespace octoblisk::testing {
namespace {

using Vertices = std::vector<Vec3>;
using Triangles = std::vector<TriangleMesh::Indices>;
using Polygon = std::vector<Vec3>;

SharedMesh meshFrom(Vertices vertices, Triangles triangles) {
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

Pose at(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }

// Solids without defects.

/// A box, given by the half extents and a pose.
struct Box {
  Vec3 half;
  Pose pose;

  double volume() const { return 8.0 * half.prod(); }
};

SharedMesh meshFrom(const Box& box) { return testing::moved(*boxMesh(box.half), box.pose); }

SharedMesh joinedBoxes(const std::vector<Box>& boxes) {
  SharedMesh all = meshFrom(boxes[0]);
  for (std::size_t i = 1; i < boxes.size(); ++i) all = joined(*all, *meshFrom(boxes[i]));
  return all;
}

struct Plane {
  Vec3 normal;
  double offset;
};

std::array<Plane, 6> planesOf(const Box& box) {
  std::array<Plane, 6> planes;
  for (std::size_t side = 0; side < 6; ++side) {
    const auto axis = static_cast<Eigen::Index>(side / 2);
    const Vec3 normal = (side % 2 == 0 ? 1.0 : -1.0) * box.pose.rotation.col(axis);
    planes[side] = {normal, normal.dot(box.pose.translation) + box.half[axis]};
  }
  return planes;
}

/// The boundary of the union of boxes: each face without what is in the other boxes. Where faces coincide,
/// that of the first box counts, or none if they face opposite ways.
SharedMesh unionOf(const std::vector<Box>& boxes) {
  constexpr double kNear = 1e-12;
  Vertices vertices;
  Triangles triangles;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const SharedMesh own = meshFrom(boxes[i]);
    std::vector<Polygon> pieces;
    for (std::size_t t = 0; t < own->triangleCount(); ++t) {
      const Triangle triangle = own->triangle(t);
      pieces.emplace_back(triangle.begin(), triangle.end());
    }
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (j == i) continue;
      std::vector<Polygon> outside;
      for (Polygon rest : pieces) {
        const Vec3 normal = (rest[1] - rest[0]).cross(rest[2] - rest[0]).normalized();
        for (const Plane& plane : planesOf(boxes[j])) {
          Polygon beyond, behind;
          bool is_in_plane = true;
          for (std::size_t c = 0; c < rest.size(); ++c) {
            const Vec3 &from = rest[c], &to = rest[(c + 1) % rest.size()];
            const double here = plane.normal.dot(from) - plane.offset,
                         there = plane.normal.dot(to) - plane.offset;
            is_in_plane &= std::abs(here) < kNear;
            if (here > -kNear) beyond.push_back(from);
            if (here < kNear) behind.push_back(from);
            if ((here > kNear && there < -kNear) || (here < -kNear && there > kNear)) {
              const Vec3 between = from + (to - from) * (here / (here - there));
              beyond.push_back(between);
              behind.push_back(between);
            }
          }
          const bool is_beyond = is_in_plane ? normal.dot(plane.normal) > 0.0 && i < j : behind.size() < 3;
          if (is_beyond) {
            outside.push_back(rest);
            rest.clear();
            break;
          }
          if (is_in_plane || beyond.size() < 3) continue;
          outside.push_back(beyond);
          rest = behind;
        }
      }
      pieces = std::move(outside);
    }
    for (const Polygon& piece : pieces) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(), piece.begin(), piece.end());
      for (std::uint32_t c = 2; c < piece.size(); ++c) triangles.push_back({first, first + c - 1, first + c});
    }
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

// Changes to a mesh. Those of the second group are defects.

SharedMesh with(const TriangleMesh& mesh, Triangles triangles) {
  return meshFrom(mesh.vertices(), std::move(triangles));
}

SharedMesh without(const TriangleMesh& mesh, FunctionRef<bool(std::size_t, const Triangle&)> is_left_out) {
  Triangles kept;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!is_left_out(t, mesh.triangle(t))) kept.push_back(mesh.triangles()[t]);
  }
  return with(mesh, std::move(kept));
}

/// Divides triangles at a point of one edge. The triangle across that edge stays as it is.
SharedMesh withTJunctions(const TriangleMesh& mesh) {
  std::mt19937_64 random(21);
  Vertices vertices = mesh.vertices();
  Triangles triangles = mesh.triangles();
  const std::size_t wanted = triangles.size() + triangles.size() / 3 + 4;
  while (triangles.size() < wanted) {
    const std::size_t cut = random() % triangles.size();
    const auto [a, b, c] = triangles[cut];
    const auto middle = static_cast<std::uint32_t>(vertices.size());
    vertices.emplace_back(vertices[a] + uniform(random, 0.3, 0.7) * (vertices[b] - vertices[a]));
    triangles[cut] = {middle, b, c};
    triangles.push_back({c, a, middle});
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

/// Moves a part of the triangles by a distance, away from their neighbours on one side and over those on the
/// other.
SharedMesh withCracks(const TriangleMesh& mesh, double width) {
  Vertices vertices = mesh.vertices();
  Triangles triangles = mesh.triangles();
  const double middle = mesh.bounds().center().x() + 0.1 * mesh.bounds().halfExtents().x();
  std::map<std::uint32_t, std::uint32_t> copy_of;
  for (TriangleMesh::Indices& triangle : triangles) {
    const Vec3 center = (vertices[triangle[0]] + vertices[triangle[1]] + vertices[triangle[2]]) / 3.0;
    if (center.x() < middle) continue;
    for (std::uint32_t& corner : triangle) {
      const auto [copy, is_new] = copy_of.try_emplace(corner, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.emplace_back(vertices[corner] + width * Vec3(0.6, 0.48, -0.64));
      corner = copy->second;
    }
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

/// Gives each triangle corners of its own, and moves each of these by up to a distance.
SharedMesh jittered(const TriangleMesh& mesh, double distance) {
  std::mt19937_64 random(22);
  Vertices vertices;
  Triangles triangles;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : mesh.triangle(t))
      vertices.push_back(corner + randomPoint(random, distance / std::numbers::sqrt3));
    triangles.push_back({first, first + 1, first + 2});
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

SharedMesh doubled(const TriangleMesh& mesh) { return joined(mesh, mesh); }

/// Adds copies of every n-th triangle that begin with another corner.
SharedMesh withCopies(const TriangleMesh& mesh, std::size_t every) {
  Triangles triangles = mesh.triangles();
  for (std::size_t t = 0; t < mesh.triangleCount(); t += every) {
    const auto [a, b, c] = triangles[t];
    triangles.push_back({b, c, a});
  }
  return with(mesh, std::move(triangles));
}

SharedMesh halfDoubled(const TriangleMesh& mesh) {
  Triangles triangles = mesh.triangles();
  const double middle = mesh.bounds().center().z();
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (centroidOf(mesh.triangle(t)).z() > middle) triangles.push_back(mesh.triangles()[t]);
  }
  return with(mesh, std::move(triangles));
}

SharedMesh withTwoCopies(const TriangleMesh& mesh) {
  return withCopies(*withCopies(mesh, mesh.triangleCount()), mesh.triangleCount() + 1);
}

SharedMesh withOneCopy(const TriangleMesh& mesh) { return withCopies(mesh, mesh.triangleCount()); }

/// Adds triangles that are points, that run there and back, and that lie along an edge.
SharedMesh withZeroAreas(const TriangleMesh& mesh) {
  Vertices vertices = mesh.vertices();
  Triangles triangles = mesh.triangles();
  for (std::size_t t = 0; t < mesh.triangleCount(); t += 7) {
    const auto [a, b, c] = mesh.triangles()[t];
    triangles.push_back({a, a, a});
    triangles.push_back({b, c, b});
    const auto middle = static_cast<std::uint32_t>(vertices.size());
    vertices.emplace_back(0.5 * (vertices[a] + vertices[b]));
    triangles.push_back({a, middle, b});
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

/// Divides triangles at the middle of an edge, and fills the T-junctions with triangles of no area, or hardly
/// any.
SharedMesh withSlivers(const TriangleMesh& mesh) {
  Vertices vertices = mesh.vertices();
  Triangles triangles = mesh.triangles();
  for (std::size_t t = 0; t < mesh.triangleCount(); t += 3) {
    const auto [a, b, c] = triangles[t];
    const auto middle = static_cast<std::uint32_t>(vertices.size());
    vertices.emplace_back(0.5 * (vertices[a] + vertices[b]));
    triangles[t] = {middle, b, c};
    triangles.push_back({c, a, middle});
    triangles.push_back({a, b, middle});
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

/// Divides triangles close to a corner, together with the triangle across the edge. The needles are as thin
/// as the part says.
SharedMesh withNeedles(const TriangleMesh& mesh, double part) {
  Vertices vertices = mesh.vertices();
  Triangles triangles = mesh.triangles();
  const std::size_t count = triangles.size();
  for (std::size_t t = 0; t < count; t += 5) {
    const auto [a, b, c] = triangles[t];
    const auto end = triangles.begin() + static_cast<std::ptrdiff_t>(count);
    const auto across = std::find_if(triangles.begin(), end, [&, from = b, to = a](const auto& other) {
      return (other[0] == from && other[1] == to) || (other[1] == from && other[2] == to) ||
             (other[2] == from && other[0] == to);
    });
    if (across == end) continue;
    const auto [p, q, r] = *across;
    const std::uint32_t d = p == b ? r : q == b ? p : q;
    const auto middle = static_cast<std::uint32_t>(vertices.size());
    vertices.emplace_back(vertices[a] + part * (vertices[b] - vertices[a]));
    triangles[t] = {middle, b, c};
    *across = {b, middle, d};
    triangles.push_back({a, middle, c});
    triangles.push_back({middle, a, d});
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

SharedMesh withoutFirst(const TriangleMesh& mesh) {
  return without(mesh, [](std::size_t t, const Triangle&) { return t == 0; });
}

// Bodies with defects of their own.

SharedMesh ball() {
  std::mt19937_64 random(23);
  return bumpySphere(random, 1.0, 0.15, 12);
}

const Vec3 kHalf(1.0, 0.8, 0.6);

DefectiveMesh ofBall() { return {.name = "ball", .mesh = ball(), .clean = ball(), .is_whole = true}; }

DefectiveMesh ofBlock() {
  const auto mesh = std::make_shared<const TriangleMesh>(block(kHalf, 2));
  return {.name = "block", .mesh = mesh, .clean = mesh, .is_whole = true, .volume = 8.0 * kHalf.prod()};
}

DefectiveMesh overlapping(std::string name, const std::vector<Box>& boxes, double volume) {
  return {.name = std::move(name), .mesh = joinedBoxes(boxes), .clean = unionOf(boxes), .volume = volume};
}

DefectiveMesh alignedBoxes() {
  // The tops and the bottoms lie in one plane each, and so do two of the sides.
  const std::vector<Box> boxes = {{kHalf, {}}, {{0.7, 0.5, 0.6}, at(0.9, 0.3, 0.0)}};
  return overlapping("overlapping boxes in line", boxes,
                     boxes[0].volume() + boxes[1].volume() - 0.8 * 1.0 * 1.2);
}

DefectiveMesh turnedBoxes() {
  std::mt19937_64 random(24);
  const std::vector<Box> boxes = {{kHalf, {}},
                                  {{0.7, 0.5, 0.6}, {randomRotation(random), Vec3(0.8, 0.4, 0.3)}},
                                  {{0.3, 1.2, 0.4}, {randomRotation(random), Vec3(-0.7, -0.2, 0.2)}}};
  return overlapping("overlapping boxes, turned", boxes, 0.0);
}

DefectiveMesh star() {
  // Two square blocks of one height, one turned by 45 degrees: the tops overlap in an octagon.
  const Mat3 turn = Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  const std::vector<Box> boxes = {{{1.0, 1.0, 0.5}, {}}, {{1.0, 1.0, 0.5}, {turn, Vec3::Zero()}}};
  const double octagon = 8.0 * (std::numbers::sqrt2 - 1.0);
  return overlapping("overlapping boxes of one height", boxes, 4.0 + 4.0 - octagon);
}

DefectiveMesh nested() {
  const SharedMesh outer = std::make_shared<const TriangleMesh>(block(kHalf, 2));
  const SharedMesh inner = testing::moved(*boxMesh(0.5 * kHalf), at(0.1, 0.1, 0.05));
  return {
      .name = "nested shells", .mesh = joined(*outer, *inner), .clean = outer, .volume = 8.0 * kHalf.prod()};
}

DefectiveMesh hollow() {
  const SharedMesh inner = testing::moved(*boxMesh(0.6 * kHalf), at(0.1, 0.1, 0.05));
  const SharedMesh mesh = joined(block(kHalf, 2), *insideOut(*inner));
  return {.name = "a hollow",
          .mesh = mesh,
          .clean = mesh,
          .is_whole = true,
          .volume = 8.0 * kHalf.prod() * (1.0 - 0.6 * 0.6 * 0.6)};
}

/// The boundary of the cells of a grid that are full, facing outward.
SharedMesh cells(const std::array<std::vector<double>, 3>& planes, FunctionRef<bool(const Vec3&)> isFull) {
  const auto inCell = [&](const std::array<std::size_t, 3>& cell) {
    Vec3 middle;
    for (std::size_t k = 0; k < 3; ++k) {
      if (cell[k] == 0 || cell[k] >= planes[k].size())
        return false;  // before the first plane, or behind the last
      middle[static_cast<Eigen::Index>(k)] = 0.5 * (planes[k][cell[k] - 1] + planes[k][cell[k]]);
    }
    return isFull(middle);
  };
  Vertices vertices;
  Triangles triangles;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t i = 0; i < planes[axis].size(); ++i) {
      for (std::size_t j = 1; j < planes[u].size(); ++j) {
        for (std::size_t k = 1; k < planes[v].size(); ++k) {
          std::array<std::size_t, 3> cell;
          cell[axis] = i, cell[u] = j, cell[v] = k;
          const bool below = inCell(cell);
          ++cell[axis];
          if (inCell(cell) == below) continue;
          const auto first = static_cast<std::uint32_t>(vertices.size());
          for (const auto& [du, dv] : {std::pair(1, 1), {0, 1}, {0, 0}, {1, 0}}) {
            Vec3 corner;
            corner[static_cast<Eigen::Index>(axis)] = planes[axis][i];
            corner[static_cast<Eigen::Index>(u)] = planes[u][j - static_cast<std::size_t>(du)];
            corner[static_cast<Eigen::Index>(v)] = planes[v][k - static_cast<std::size_t>(dv)];
            vertices.push_back(corner);
          }
          const std::uint32_t second = below ? 1 : 3, fourth = below ? 3 : 1;
          triangles.push_back({first, first + second, first + 2});
          triangles.push_back({first, first + 2, first + fourth});
        }
      }
    }
  }
  return meshFrom(std::move(vertices), std::move(triangles));
}

/// An inward part over an outward one: in both, the winding number is 0.
DefectiveMesh opposed() {
  const Box box{{0.7, 0.5, 0.4}, at(0.9, 0.5, 0.3)};
  const Vec3 low = box.pose.translation - box.half, high = box.pose.translation + box.half;
  const auto isInOne = [&](const Vec3& point) {
    const bool in_block = (point.cwiseAbs().array() < kHalf.array()).all();
    return in_block != ((point - box.pose.translation).cwiseAbs().array() < box.half.array()).all();
  };
  std::array<std::vector<double>, 3> planes;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    planes[k] = {-kHalf[axis], low[axis], kHalf[axis], high[axis]};
  }
  return {.name = "a part inside out over another",
          .mesh = joined(*boxMesh(kHalf), *insideOut(*meshFrom(box))),
          .clean = cells(planes, isInOne),
          .volume = 8.0 * kHalf.prod() + box.volume() - 2.0 * 0.8 * 0.8 * 0.7};
}

/// Divides a square along the other diagonal. Its two triangles follow each other in boxMesh.
void turnDiagonal(Triangles& triangles, std::size_t first) {
  const auto [a, b, c] = triangles[first];
  const std::uint32_t d = triangles[first + 1][2];
  triangles[first] = {b, c, d};
  triangles[first + 1] = {b, d, a};
}

/// A box of two triangles per face. Those of the faces towards ±x may be divided along the other diagonal.
SharedMesh cube(const Vec3& low, const Vec3& high, bool other_diagonal) {
  const Vec3 half = 0.5 * (high - low);
  const SharedMesh mesh = deformed(*boxMesh(half), [&](const Vec3& v) -> Vec3 { return v + low + half; });
  Triangles triangles = mesh->triangles();
  for (std::size_t first = 8; first < 12 && other_diagonal; first += 2) turnDiagonal(triangles, first);
  return with(*mesh, std::move(triangles));
}

DefectiveMesh commonEdge() {
  const SharedMesh mesh = joined(*cube({-1, -1, 0}, {0, 0, 1}, false), *cube({0, 0, 0}, {1, 1, 1}, false));
  return {.name = "two cubes with a common edge", .mesh = mesh, .clean = mesh, .volume = 2.0};
}

DefectiveMesh commonFace(bool other_diagonal) {
  const SharedMesh mesh =
      joined(*cube({-1, 0, 0}, {0, 1, 1}, false), *cube({0, 0, 0}, {1, 1, 1}, other_diagonal));
  return {.name = other_diagonal ? "two cubes with a common face of two diagonals"
                                 : "two cubes with a common face",
          .mesh = mesh,
          .clean = cube({-1, 0, 0}, {1, 1, 1}, false),
          .volume = 2.0};
}

DefectiveMesh standing() {
  const std::vector<Box> boxes = {{kHalf, {}}, {{0.4, 0.3, 0.5}, at(0.3, 0.1, 1.1)}};
  return overlapping("a box that stands on another", boxes, boxes[0].volume() + boxes[1].volume());
}

/// All facets are there twice, divided along different diagonals.
DefectiveMesh otherDiagonals() {
  const SharedMesh box = boxMesh(kHalf);
  Triangles triangles = box->triangles();
  for (std::size_t first = 0; first < 12; first += 2) turnDiagonal(triangles, first);
  return {.name = "facets doubled with other diagonals",
          .mesh = joined(*box, *with(*box, std::move(triangles))),
          .clean = box,
          .volume = 8.0 * kHalf.prod()};
}

/// A wall of no thickness, whose two sides are separate triangles, in the solid and beside it.
DefectiveMesh fin() {
  const SharedMesh box = boxMesh(kHalf);
  Vertices vertices = box->vertices();
  Triangles triangles = box->triangles();
  for (const double x : {0.2, 1.4}) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {Vec3(x, -0.3, -0.3), Vec3(x, 0.3, -0.2), Vec3(x + 0.1, 0.0, 0.3)});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 1});
  }
  return {.name = "a fin of two sides",
          .mesh = meshFrom(std::move(vertices), std::move(triangles)),
          .clean = box,
          .volume = 8.0 * kHalf.prod()};
}

DefectiveMesh openTube() {
  const SharedMesh whole = tube(0.5, 1.0, 0.8, 16);
  const SharedMesh mesh = without(*whole, [](std::size_t t, const Triangle&) { return t % 8 / 2 == 2; });
  return {.name = "a tube without its inner wall", .mesh = mesh, .clean = whole, .is_closed = false};
}

DefectiveMesh openRing() {
  const SharedMesh whole = torus(1.0, 0.45, 16, 10);
  const SharedMesh mesh = without(*whole, [](std::size_t, const Triangle& triangle) {
    return centroidOf(triangle).head<2>().norm() < 0.65;
  });
  return {.name = "a ring open at its bore", .mesh = mesh, .clean = whole, .is_closed = false};
}

/// The figure-8 immersion.
DefectiveMesh kleinBottle() {
  constexpr std::uint32_t kAlong = 24, kAround = 12;
  Vertices vertices;
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double u = 2.0 * std::numbers::pi * i / kAlong, v = 2.0 * std::numbers::pi * (j + 0.5) / kAround;
      const double radius = 2.0 + std::cos(0.5 * u) * std::sin(v) - std::sin(0.5 * u) * std::sin(2.0 * v);
      vertices.emplace_back(radius * std::cos(u), radius * std::sin(u),
                            std::sin(0.5 * u) * std::sin(v) + std::cos(0.5 * u) * std::sin(2.0 * v));
    }
  }
  // After one turn, v has become -v.
  const auto index = [](std::uint32_t i, std::uint32_t j) {
    j %= kAround;
    return i == kAlong ? kAround - 1 - j : i * kAround + j;
  };
  Triangles triangles;
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return {.name = "a Klein bottle",
          .mesh = meshFrom(std::move(vertices), std::move(triangles)),
          .clean = nullptr,
          .is_closed = false};
}

DefectiveMesh terrain() {
  // A deep bowl: from its bottom, the sheet fills more than half of all directions.
  const SharedMesh sheet = deformed(*waveSheet(1.0, 0.1, 12), [](const Vec3& v) -> Vec3 {
    return {v.x(), v.y(), v.z() + 1.2 * v.head<2>().squaredNorm()};
  });
  return {.name = "an open sheet", .mesh = sheet, .clean = nullptr, .is_closed = false};
}

DefectiveMesh triangleSoup() {
  std::mt19937_64 random(25);
  return {
      .name = "a triangle soup", .mesh = soup(random, 150, 1.0, 0.6), .clean = nullptr, .is_closed = false};
}

struct Defect {
  std::string name;
  SharedMesh (*add)(const TriangleMesh& mesh);
  double gap = 0.0;
  bool keeps_whole = false;
  bool keeps_closed = true;
};

constexpr const char *kWithNeedles = "needles", *kWithCornersApart = "corners apart";

const std::vector<Defect>& defects() {
  static const std::vector<Defect> kDefects = {
      {.name = "a missing facet", .add = withoutFirst, .keeps_closed = false},
      {.name = "T-junctions", .add = withTJunctions},
      {.name = kWithNeedles,
       .add = [](const TriangleMesh& m) { return withNeedles(m, 1e-9); },
       .keeps_whole = true},
      {.name = "a crack of 1e-9",
       .add = [](const TriangleMesh& m) { return withCracks(m, 1e-9); },
       .gap = 1e-9},
      {.name = "a crack of 1e-6",
       .add = [](const TriangleMesh& m) { return withCracks(m, 1e-6); },
       .gap = 1e-6},
      {.name = "a crack of 1e-3",
       .add = [](const TriangleMesh& m) { return withCracks(m, 1e-3); },
       .gap = 1e-3},
      {.name = kWithCornersApart,
       .add = [](const TriangleMesh& m) { return jittered(m, 1e-6); },
       .gap = 1e-6},
      {.name = "facets of no area", .add = withZeroAreas},
      {.name = "T-junctions filled by slivers", .add = withSlivers, .keeps_whole = true},
      {.name = "all facets doubled", .add = doubled},
      {.name = "all facets tripled", .add = [](const TriangleMesh& m) { return joined(*joined(m, m), m); }},
      {.name = "one facet doubled", .add = withOneCopy},
      {.name = "half of the facets doubled", .add = halfDoubled},
      {.name = "all inside out", .add = insideOut, .keeps_whole = true},
  };
  return kDefects;
}

DefectiveMesh with(const DefectiveMesh& base, const Defect& defect) {
  DefectiveMesh made = base;
  made.name = base.name + " with " + defect.name;
  made.mesh = defect.add(*base.mesh);
  made.is_closed = base.is_closed && defect.keeps_closed;
  made.is_whole = base.is_whole && defect.keeps_whole;
  made.gap += defect.gap;
  return made;
}

}  // namespace

bool DefectiveMesh::contains(const Vec3& point) const {
  return clean && std::abs(preciseWindingNumber(*clean, point)) > 0.5;
}

double DefectiveMesh::distanceToBoundary(const Vec3& point) const {
  return bruteForceDistance(*clean, point);
}

Moments DefectiveMesh::moments() const {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  using Matrix = Eigen::Matrix<long double, 3, 3>;
  const Vector middle = clean->bounds().center().cast<long double>();
  long double total = 0.0;
  Vector first = Vector::Zero();
  Matrix second = Matrix::Zero();
  for (std::size_t t = 0; t < clean->triangleCount(); ++t) {
    const Triangle triangle = clean->triangle(t);
    // The tetrahedron from the middle: its determinant, and the integrals over it.
    std::array<Vector, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = triangle[i].cast<long double>() - middle;
    const long double six = corner[0].dot(corner[1].cross(corner[2]));
    const Vector sum = corner[0] + corner[1] + corner[2];
    total += six / 6.0L;
    first += six / 24.0L * sum;
    for (const Vector& c : corner) second += six / 120.0L * c * c.transpose();
    second += six / 120.0L * sum * sum.transpose();
  }
  const Vector center = first / total;
  const Matrix about = second / total - center * center.transpose();
  const Matrix inertia = about.trace() * Matrix::Identity() - about;
  return {static_cast<double>(total), (middle + center).cast<double>(), inertia.cast<double>()};
}

std::vector<DefectiveMesh> defectiveMeshes() {
  std::vector<DefectiveMesh> all;
  for (const Defect& defect : defects()) {
    all.push_back(with(ofBall(), defect));
    all.push_back(with(ofBlock(), defect));
  }
  for (const DefectiveMesh& base : {ofBall(), ofBlock()})
    all.push_back(with(base, {.name = "one facet tripled", .add = withTwoCopies}));
  for (const DefectiveMesh& mesh :
       {alignedBoxes(), turnedBoxes(), star(), nested(), hollow(), opposed(), commonEdge(), commonFace(false),
        commonFace(true), standing(), otherDiagonals(), fin(), openTube(), openRing(), kleinBottle(),
        terrain(), triangleSoup()})
    all.push_back(mesh);
  return all;
}

std::vector<DefectiveMesh> twiceDefectiveMeshes() {
  std::vector<DefectiveMesh> all;
  const std::vector<Defect>& known = defects();
  for (std::size_t i = 0; i < known.size(); ++i) {
    const bool are_apart = known[i].name == kWithCornersApart;
    for (std::size_t j = i + 1; j < known.size(); ++j) {
      if (known[i].name == kWithNeedles && known[j].name == kWithCornersApart)
        continue;  // no needles are left
      all.push_back(with(with(ofBall(), known[i]), known[j]));
    }
    for (const DefectiveMesh& base :
         {alignedBoxes(), turnedBoxes(), nested(), commonFace(true), standing()}) {
      all.push_back(with(base, known[i]));
      all.back().is_faithful &= !are_apart;
    }
    for (const DefectiveMesh& base : {hollow(), opposed(), commonEdge()}) {
      // Needles divide the common edge for one of the cubes only. The edges that are left have two triangles
      // each.
      if (base.name == commonEdge().name && known[i].name == kWithNeedles) continue;
      all.push_back(with(base, known[i]));
    }
  }
  return all;
}

DefectiveMesh moved(const DefectiveMesh& mesh, const Pose& pose, double scale) {
  DefectiveMesh result = mesh;
  result.mesh = testing::moved(*mesh.mesh, pose, scale);
  if (mesh.clean) result.clean = testing::moved(*mesh.clean, pose, scale);
  result.gap *= scale;
  result.volume *= scale * scale * scale;
  return result;
}

SharedMesh withoutCopies(const TriangleMesh& mesh) {
  using Position = std::array<double, 3>;
  struct Copies {
    TriangleMesh::Indices indices;
    int count = 0;
  };
  std::map<std::array<Position, 3>, Copies> found;
  for (const TriangleMesh::Indices& indices : mesh.triangles()) {
    std::array<Position, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& vertex = mesh.vertices()[indices[i]];
      corners[i] = {vertex.x(), vertex.y(), vertex.z()};
    }
    const auto lowest = std::ranges::min_element(corners) - corners.begin();
    std::ranges::rotate(corners, corners.begin() + lowest);
    const bool is_turned = corners[2] < corners[1];
    if (is_turned) std::swap(corners[1], corners[2]);
    Copies& copies = found[corners];
    copies.count += is_turned ? -1 : 1;
    if (copies.count * (is_turned ? -1 : 1) > 0) copies.indices = indices;
  }
  std::vector<TriangleMesh::Indices> triangles;
  for (const auto& [corners, copies] : found) {
    if (copies.count != 0) triangles.push_back(copies.indices);
  }
  return std::make_shared<const TriangleMesh>(mesh.vertices(), std::move(triangles));
}

double preciseWindingNumber(const TriangleMesh& mesh, const Vec3& point) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const Vector from = point.cast<long double>();
  long double angle = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle triangle = mesh.triangle(t);
    const Vector a = triangle[0].cast<long double>() - from, b = triangle[1].cast<long double>() - from,
                 c = triangle[2].cast<long double>() - from;
    const long double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle +=
        2.0L * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<double>(angle / (4.0L * std::numbers::pi_v<long double>));
}

}  // namespace octoblisk::testing
