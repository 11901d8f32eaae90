// A nut that runs down a bolt without friction: the parts, the closed form of the motion, and how far a
// simulated nut is from it. Knows no physics engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "octoblisk/mass_properties.h"
#include "shapes/threads.h"

namespace octoblisk::gallery {

/// Lengths in m, angles in rad. The bolt stands on its head. The nut starts in phase with it, at rest.
class NutRun {
 public:
  static constexpr double kTimeStep = 1.0 / 240.0;  ///< s
  static constexpr double kMass = 0.03;             ///< kg, of the nut

  /// `pitches`: the height of the nut's lower side over the head at the start.
  NutRun(const shapes::Thread& thread, int pitches) : pitch_(thread.pitch) {
    const double height = 0.8 * thread.diameter, low = pitches * pitch_;
    bolt_mesh_ = shapes::bolt(thread, low + height + 3.0 * pitch_);
    nut_mesh_ = shapes::moved(*shapes::nut(thread, height), Vec3(0, 0, -0.5 * height));
    moments_ = kMass * massProperties(*nut_mesh_).inertia.diagonal();
    start_ = low + 0.5 * height;
    const double lead = pitch_ / kTurn;
    acceleration_ = kGravity / (1.0 + moments_.z() / (kMass * lead * lead));
  }

  const shapes::SharedMesh& boltMesh() const { return bolt_mesh_; }
  const shapes::SharedMesh& nutMesh() const { return nut_mesh_; }  ///< around the centre of mass
  const Vec3& moments() const { return moments_; }                 ///< of inertia of the nut, kg m²

  /// m/s², along the axis, without friction or play: the weight of the nut moves and spins it.
  double acceleration() const { return acceleration_; }

  /// The pose of the nut in the bolt by the closed form, midway between the flanks, after a time in s.
  Pose poseAt(double time) const {
    const double sunk = 0.5 * acceleration_ * time * time;
    return {Eigen::AngleAxisd(-kTurn * sunk / pitch_, Vec3::UnitZ()).toRotationMatrix(),
            Vec3(0, 0, start_ - sunk)};
  }

  /// Call this after each step, with the pose of the simulated nut in the bolt. The nut must turn by less
  /// than half a turn in a step.
  void notice(const Pose& nut_in_bolt) {
    const Mat3& axes = nut_in_bolt.rotation;
    turned_ += std::remainder(std::atan2(axes(1, 0), axes(0, 0)) - turned_, kTurn);
    sunk_ = start_ - nut_in_bolt.translation.z();
    tilt_ = std::acos(std::min(1.0, axes(2, 2)));
  }
  /// Call this when the nut is back at its start.
  void noticeRestart() { turned_ = sunk_ = tilt_ = 0.0; }

  double turned() const { return turned_; }  ///< less than 0 if the nut runs down
  double sunk() const { return sunk_; }
  /// How far the nut is above or below the helix, on which it has turned as far.
  double offHelix() const { return std::abs(sunk_ + pitch_ * turned_ / kTurn); }
  double tilt() const { return tilt_; }

 private:
  static constexpr double kTurn = 2.0 * std::numbers::pi, kGravity = 9.81;

  double pitch_, start_, acceleration_;
  shapes::SharedMesh bolt_mesh_, nut_mesh_;
  Vec3 moments_;
  double turned_ = 0.0, sunk_ = 0.0, tilt_ = 0.0;
};

}  // namespace octoblisk::gallery
