#include "gallery/soft_belt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/belt_path.h"
#include "models/blisk_axis.h"
#include "models/orientation.h"
#include "models/require.h"
#include "octoblisk_bullet/convert.h"
#include "shapes/bodies.h"
#include "shapes/grid_mesh.h"

namespace octoblisk::gallery {
namespace {

/// The line at the middle of the belt's thickness.
demos::BeltPath middleOf(demos::BeltParameters sizes) {
  sizes.contact_wheel_radius += 0.5 * sizes.thickness;
  sizes.drive_wheel_radius += 0.5 * sizes.thickness;
  return demos::BeltPath(sizes);
}

/// A disk with three holes.
TriangleMesh wheelMesh(double radius, double half_width) {
  std::vector<Eigen::Vector2d> outer, inner;
  constexpr int kSegments = 96;
  for (int i = 0; i < kSegments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSegments;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const double lobe = std::pow(std::max(0.0, std::cos(1.5 * angle) * std::cos(1.5 * angle)), 2.0);
    outer.push_back(radius * direction);
    inner.push_back(radius * (0.25 + 0.45 * lobe) * direction);
  }
  return *shapes::extrudedBand(outer, inner, true, half_width);
}

}  // namespace

SoftBelt::SoftBelt(btSoftRigidDynamicsWorld& world, const SoftBeltOptions& options, const Pose& tool_in_world)
    : world_(world), options_(options), tool_in_world_(tool_in_world) {
  const demos::BeltParameters& sizes = options.sizes;
  demos::require(sizes.width > 0.0 && sizes.thickness > 0.0,
                 "the belt's width and thickness must be above 0");
  demos::require(
      sizes.wheel_distance > sizes.contact_wheel_radius + sizes.drive_wheel_radius + 2.0 * sizes.thickness,
      "the wheel distance must be large enough to keep the wheels apart");
  demos::require(options.stations >= 32 && options.nodes_across >= 3,
                 "the belt needs at least 32 stations of 3 nodes");
  demos::require(options.strain > 0.0 && options.strain < 0.5,
                 "the belt's strain must be above 0 and below 0.5");

  // A cell of the distance field is four voxels wide: small compared with the belt's thickness.
  btSoftBodyWorldInfo& info = world.getWorldInfo();
  info.m_gravity.setZero();
  info.m_sparsesdf.setDefaultVoxelsz(btScalar(0.25 * sizes.thickness));
  info.m_sparsesdf.Reset();
  wheels_ = {{Vec3::Zero(), sizes.contact_wheel_radius},
             {Vec3(sizes.wheel_distance, 0.0, 0.0), sizes.drive_wheel_radius}};
  makeBelt();
}

SoftBelt::~SoftBelt() { world_.removeSoftBody(belt_.get()); }

void SoftBelt::makeBelt() {
  const auto& [sizes, stations, across, strain, speed, mass, iterations] = options_;
  const demos::BeltPath path = middleOf(sizes);
  std::vector<btVector3> places, velocities;
  for (int station = 0; station < stations; ++station) {
    const auto [point, normal] = path.atLength(path.length() * station / stations);
    const Vec3 ahead(normal.y(), -normal.x(), 0.0);
    for (int k = 0; k < across; ++k) {
      const Vec3 place = point + Vec3(0.0, 0.0, sizes.width * (static_cast<double>(k) / (across - 1) - 0.5));
      places.push_back(toBullet(tool_in_world_ * place));
      velocities.push_back(toBullet(tool_in_world_.rotation * (speed * ahead)));
    }
  }
  belt_ = std::make_unique<btSoftBody>(&world_.getWorldInfo(), static_cast<int>(places.size()), places.data(),
                                       nullptr);
  btSoftBody& belt = *belt_;
  for (int n = 0; n < belt.m_nodes.size(); ++n) belt.m_nodes[n].m_v = velocities[static_cast<std::size_t>(n)];

  // Stiff along and across, softer in shear and bending.
  btSoftBody::Material* const stiff = belt.m_materials[0];
  stiff->m_kLST = 1;
  btSoftBody::Material* const shear = belt.appendMaterial();
  shear->m_kLST = btScalar(0.3);
  btSoftBody::Material* const bending = belt.appendMaterial();
  bending->m_kLST = btScalar(0.02);
  for (int station = 0; station < stations; ++station) {
    for (int k = 0; k < across; ++k) belt.appendLink(index(station, k), index(station + 1, k), stiff);
    for (int k = 0; k + 1 < across; ++k) {
      const int a = index(station, k), b = index(station, k + 1), c = index(station + 1, k),
                d = index(station + 1, k + 1);
      belt.appendLink(a, b, stiff);
      belt.appendLink(a, d, shear);
      belt.appendLink(b, c, shear);
      belt.appendFace(a, c, b);
      belt.appendFace(b, c, d);
    }
    for (int k = 0; k < across; ++k) belt.appendLink(index(station, k), index(station + 2, k), bending);
  }
  belt.setTotalMass(btScalar(mass));
  belt.updateConstants();
  // If this were true, the first step would take the rest lengths from the tensioned belt.
  belt.m_bUpdateRtCst = false;
  for (int l = 0; l < belt.m_links.size(); ++l) {
    btSoftBody::Link& link = belt.m_links[l];
    const int steps = std::abs(static_cast<int>(link.m_n[0] - link.m_n[1]));
    const bool is_across = steps == 1;
    link.m_rl /= is_across ? btScalar(1) : btScalar(1 + strain);
    link.m_c1 = link.m_rl * link.m_rl;
  }

  // Contacts are solved after links, and hard, so that no link pulls a node into an obstacle.
  belt.m_cfg.piterations = iterations;
  belt.m_cfg.m_psequence.resize(0);
  belt.m_cfg.m_psequence.push_back(btSoftBody::ePSolver::Linear);
  belt.m_cfg.m_psequence.push_back(btSoftBody::ePSolver::RContacts);
  belt.m_cfg.kKHR = 1;
  belt.m_cfg.kDF = 1;
  belt.m_cfg.kDP = btScalar(0.002);
  belt.getCollisionShape()->setMargin(btScalar(0.5 * sizes.thickness));
  belt.setActivationState(DISABLE_DEACTIVATION);
  world_.addSoftBody(&belt);
}

Pose SoftBelt::poseOf(const Wheel& wheel) const {
  const double turned = -travelled_ / rollingRadius(wheel);
  return tool_in_world_ * Pose{Eigen::AngleAxisd(turned, Vec3::UnitZ()).toRotationMatrix(), wheel.centre};
}

void SoftBelt::step(const Pose& tool_in_world, double time_step) {
  const Pose before = tool_in_world_;
  tool_in_world_ = tool_in_world;
  travelled_ += options_.speed * time_step;
  world_.stepSimulation(btScalar(time_step), 0);
  for (const Wheel& wheel : wheels_) holdOn(wheel, before, time_step);
}

void SoftBelt::holdOn(const Wheel& wheel, const Pose& tool_before, double time_step) {
  const Vec3 centre = tool_in_world_ * wheel.centre, axis = tool_in_world_.rotation.col(2);
  const Vec3 moving = (centre - tool_before * wheel.centre) / time_step;
  const double radius = rollingRadius(wheel);
  for (int n = 0; n < belt_->m_nodes.size(); ++n) {
    btSoftBody::Node& node = belt_->m_nodes[n];
    const Vec3 from_centre = fromBullet(node.m_x) - centre;
    const Vec3 off_axis = from_centre - from_centre.dot(axis) * axis;
    const double distance = off_axis.norm();
    if (distance >= radius || distance == 0.0) continue;
    const Vec3 normal = off_axis / distance;
    const Vec3 wheel_velocity = moving - options_.speed * axis.cross(normal);
    const double leaving = std::max(0.0, normal.dot(fromBullet(node.m_v) - wheel_velocity));
    node.m_x += toBullet((radius - distance) * normal);
    node.m_v = toBullet(wheel_velocity + leaving * normal);
  }
}

Vec3 SoftBelt::node(int station, int across) const {
  return fromBullet(belt_->m_nodes[index(station, across)].m_x);
}

SoftBelt::Strain SoftBelt::strain() const {
  Strain strain{0.0, std::numeric_limits<double>::infinity()};
  const auto& links = belt_->m_links;
  std::vector<double> now(static_cast<std::size_t>(options_.stations)), rest = now;
  for (int l = 0; l < links.size(); ++l) {
    const auto a = static_cast<int>(links[l].m_n[0] - &belt_->m_nodes[0]);
    const auto b = static_cast<int>(links[l].m_n[1] - &belt_->m_nodes[0]);
    const auto station = a / options_.nodes_across;
    if (b != index(station + 1, a % options_.nodes_across)) continue;
    now[static_cast<std::size_t>(station)] += double((links[l].m_n[0]->m_x - links[l].m_n[1]->m_x).length());
    rest[static_cast<std::size_t>(station)] += double(links[l].m_rl);
  }
  double now_all = 0.0, rest_all = 0.0;
  for (std::size_t s = 0; s < now.size(); ++s) {
    strain.least = std::min(strain.least, now[s] / rest[s] - 1.0);
    now_all += now[s];
    rest_all += rest[s];
  }
  strain.mean = now_all / rest_all - 1.0;
  return strain;
}

std::vector<Vec3> SoftBelt::contactsWith(const btCollisionObject& object) const {
  std::vector<const btSoftBody::Node*> nodes;
  for (int c = 0; c < belt_->m_rcontacts.size(); ++c) {
    const btSoftBody::RContact& contact = belt_->m_rcontacts[c];
    if (contact.m_cti.m_colObj == &object) nodes.push_back(contact.m_node);
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vec3> places;
  for (const btSoftBody::Node* node : nodes) places.push_back(fromBullet(node->m_x));
  return places;
}

double SoftBelt::meanSpeed() const {
  double sum = 0.0;
  for (int station = 0; station < options_.stations; ++station) {
    for (int k = 0; k < options_.nodes_across; ++k) {
      const Vec3 ahead = (node(station + 1, k) - node(station - 1, k)).normalized();
      sum += ahead.dot(fromBullet(belt_->m_nodes[index(station, k)].m_v));
    }
  }
  return sum / (options_.stations * options_.nodes_across);
}

TriangleMesh SoftBelt::mesh() const {
  const int across = options_.nodes_across;
  const auto point_at = [&](int station, int i) -> Vec3 {
    const double side = i < across ? 0.5 : -0.5;
    const int k = i < across ? i : 2 * across - 1 - i;
    const Vec3 along = node(station + 1, k) - node(station - 1, k);
    const Vec3 width = node(station, across - 1) - node(station, 0);
    const Vec3 outward = width.cross(along).normalized();
    return node(station, k) + side * options_.sizes.thickness * outward;
  };
  return demos::turned(*shapes::gridMesh(options_.stations, 2 * across, true, true, point_at));
}

std::vector<TriangleMesh> SoftBelt::wheelMeshes() const {
  std::vector<TriangleMesh> meshes;
  for (const Wheel& wheel : wheels_) {
    meshes.push_back(demos::moved(wheelMesh(wheel.radius, 0.6 * options_.sizes.width), poseOf(wheel)));
  }
  return meshes;
}

}  // namespace octoblisk::gallery
