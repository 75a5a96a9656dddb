#pragma once

/// Snapshots built by hand, so that what is expected of a message can be written down.

#include <memory>
#include <string>

#include "sensory_growth/ros/snapshot.h"

namespace sensory_growth::node::testing {

/// A straight organ of 4 elements, 0.04 m long and 0.001 m thick, from (1, 2, 3) along +z, turned by `turn` about z.
inline OrganSnapshot straightOrgan(const std::string& id, double turn = 0.0) {
  OrganSnapshot organ;
  organ.id = id;
  rod::Section section;
  section.radius = 1e-3;
  section.young_modulus = 1e7;
  section.shear_modulus = 1e7 / 3.0;
  section.density = 1000.0;
  const rod::Quaternion frame(Eigen::AngleAxisd(turn, rod::Vector3::UnitZ()));
  organ.rod = rod::straightRod({rod::Vector3(1.0, 2.0, 3.0), frame}, 0.04, 4, section);
  organ.growth_rates = {0.0, 1e-6, 2e-6, 4e-6};
  double size = 0.0;
  for (growth::SectionField& cue : organ.cues) cue.assign(4, Eigen::Vector2d(size += 0.125, -0.25));
  organ.energy = {1.0, 2.0, -3.0};
  return organ;
}

inline std::shared_ptr<Snapshot> snapshotOf(const std::string& organ) {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->stamp = ros::Time(7, 500000000);
  snapshot->step_index = 6;
  snapshot->growth_time = 360.0;
  snapshot->organs = {straightOrgan(organ)};
  return snapshot;
}

}  // namespace sensory_growth::node::testing
