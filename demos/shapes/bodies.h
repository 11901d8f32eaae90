// Concave bodies that interlock and pile up: closed forms, all closed meshes that face outward.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::shapes {

using SharedMesh = std::shared_ptr<const TriangleMesh>;

/// The mesh `factor` times as large, about the origin.
SharedMesh scaled(const TriangleMesh& mesh, double factor);
SharedMesh moved(const TriangleMesh& mesh, const Vec3& by);

/// A torus around the z axis.
SharedMesh torus(double major_radius, double minor_radius, int major_segments, int minor_segments);

/// A box with its 12 triangles.
SharedMesh boxMesh(const Vec3& half_extents);

/// The band between two paths with equal numbers of points, the outer path to the right of its direction,
/// extruded by twice the half height along z. The ends of open paths are closed. Vertices 4 i to 4 i + 7 are
/// the corners of the i-th segment.
SharedMesh extrudedBand(const std::vector<Eigen::Vector2d>& outer, const std::vector<Eigen::Vector2d>& inner,
                        bool is_ring, double half_height);

/// A spur gear with a bore, around the z axis.
SharedMesh gear(int teeth, double root_radius, double tip_radius, double bore_radius, double half_height);

/// A U of three walls along z; it opens towards y.
SharedMesh uProfile(double half_width, double half_depth, double wall, double half_length);

/// Star-shaped about the origin: a sphere with random bumps of the given height.
SharedMesh bumpySphere(std::mt19937_64& random, double radius, double bump, int segments);

/// Its vertices lie on the ellipsoid, so it is convex.
SharedMesh ellipsoid(const Vec3& radii, int segments);

/// Star-shaped about the origin: a smooth body with a head, ears, a nose, arms and legs, about as high as the
/// size.
SharedMesh teddy(double size, int segments);

/// A tube along (sin t + 2 sin 2t, cos t − 2 cos 2t, −sin 3t), scaled. The tube must be thinner than the
/// scale, or it intersects itself.
SharedMesh trefoilKnot(double scale, double tube_radius, int segments, int tube_segments);

/// Three square bars along the axes that cross at the origin: 60 triangles. Vertices 8 k to 8 k + 7 from 8 on
/// are the corners of the k-th bar.
SharedMesh jack(double half_length, double half_width);

/// A prism with this number of sides around the z axis.
SharedMesh cylinder(double radius, double half_height, int segments);

}  // namespace octoblisk::shapes
