#include "loads_yaml.h"

#include <cmath>
#include <string>

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

bool isInTime(RelaxationMethod relaxation) {
  return relaxation == RelaxationMethod::dynamics || relaxation == RelaxationMethod::continuous;
}

/// The smallest rotation that takes the world's z axis to d3, then a roll about d3.
rod::Quaternion frameAlong(const Vector3& d3, double roll) {
  const Vector3 axis = Vector3::UnitZ().cross(d3);
  rod::Quaternion tilt = rod::Quaternion::Identity();
  if (axis.norm() > 0.0) {
    tilt = Eigen::AngleAxisd(std::atan2(axis.norm(), d3.z()), axis.stableNormalized());
  } else if (d3.z() < 0.0) {
    tilt = Eigen::AngleAxisd(M_PI, Vector3::UnitX());
  }
  return (tilt * Eigen::AngleAxisd(roll, Vector3::UnitZ())).normalized();
}

rod::Quaternion readFrame(YamlReader& in) {
  const Vector3 direction = in.direction("direction");
  return frameAlong(direction, in.quantity("roll", dimension::angle, anyNumber, 0.0));
}

mechanics::Spring readSpring(YamlReader& in) {
  mechanics::Spring spring;
  spring.label = in.number("label", above(0).upTo(1));
  spring.anchor = in.vector("anchor", dimension::length);
  spring.stiffness = in.quantity("stiffness", dimension::stiffness, above(0));
  return spring;
}

mechanics::Wall readWall(YamlReader& in, RelaxationMethod relaxation, const Vector3& base) {
  mechanics::Wall wall;
  wall.point = in.vector("point", dimension::length);
  wall.normal = in.direction("normal");
  if ((base - wall.point).dot(wall.normal) < 0.0) {
    in.addProblem(
        "normal",
        "points away from the base of the organ, which would be behind the wall; turn it round or move the wall");
  }
  wall.stiffness = in.quantity("stiffness", dimension::stiffness, above(0).orInfinity("rigid"));
  if (std::isinf(wall.stiffness) && isInTime(relaxation)) {
    in.addProblem("stiffness",
                  "'rigid' needs static relaxation: no time step is short enough for it; give a stiffness");
  }
  return wall;
}

mechanics::HeldApex readHeldApex(YamlReader& in) {
  mechanics::HeldApex apex;
  apex.position = in.vector("position", dimension::length);
  if (in.has("direction")) {
    apex.frame = readFrame(in);
  } else if (in.has("roll")) {
    in.addProblem("roll", "needs 'direction'; without both the apex turns freely");
  }
  return apex;
}

void readSurroundings(YamlReader& in, RelaxationMethod relaxation, const Vector3& base,
                      mechanics::Surroundings& surroundings) {
  in.list("springs", kOptional, [&](YamlReader& spring) { surroundings.springs.push_back(readSpring(spring)); });
  in.list("walls", kOptional,
          [&](YamlReader& wall) { surroundings.walls.push_back(readWall(wall, relaxation, base)); });
  in.section("held_apex", kOptional, [&](YamlReader& apex) { surroundings.held_apex = readHeldApex(apex); });
  if (surroundings.held_apex && isInTime(relaxation)) {
    in.addProblem("held_apex",
                  "needs static relaxation: no time step is short enough for it; tie the apex with a spring");
  }
}

}  // namespace

void readBase(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ) {
  organ.base.position = in.vector("position", dimension::length);
  organ.base.frame = readFrame(in);
  const auto support = in.choice<rod::BaseSupport>("support",
                                                   {{"clamped", rod::BaseSupport::clamped},
                                                    {"frozen_first_element", rod::BaseSupport::frozen_first_element},
                                                    {"hinged", rod::BaseSupport::hinged}},
                                                   organ.base_support);
  if (!support) return;
  organ.base_support = *support;
  if (support == rod::BaseSupport::hinged && relaxation == RelaxationMethod::kinematics) {
    in.addProblem("support",
                  "'hinged' needs forces that turn the organ, and kinematic relaxation knows none; give 'clamped'");
  }
}

void readLoads(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ) {
  mechanics::Loads& loads = organ.loads;
  loads.tip_force = in.vector("tip_force", dimension::force, loads.tip_force);
  loads.line_force = in.vector("line_force", dimension::line_force, loads.line_force);
  loads.tip_couple = in.vector("tip_couple", dimension::couple, loads.tip_couple);
  readSurroundings(in, relaxation, organ.base.position, loads.surroundings);
  if (relaxation != RelaxationMethod::kinematics) return;

  const auto refuse = [&in](const std::string& key, bool is_given) {
    if (is_given) in.addProblem(key, "has no effect with kinematic relaxation; leave it out");
  };
  refuse("tip_force", !loads.tip_force.isZero(0.0));
  refuse("line_force", !loads.line_force.isZero(0.0));
  refuse("tip_couple", !loads.tip_couple.isZero(0.0));
  refuse("springs", !loads.surroundings.springs.empty());
  refuse("walls", !loads.surroundings.walls.empty());
  refuse("held_apex", loads.surroundings.held_apex.has_value());
}

}  // namespace sensory_growth::simulation
