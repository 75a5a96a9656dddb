#include "sensory_growth/ros/snapshot.h"

#include <cstddef>

#include "sensory_growth/simulation/checksum.h"

namespace sensory_growth::node {

SnapshotPtr takeSnapshot(const simulation::Simulation& simulation, const ros::Time& stamp, std::uint32_t epoch) {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->stamp = stamp;
  snapshot->step_index = simulation.stepIndex();
  snapshot->epoch = epoch;
  snapshot->growth_time = simulation.time();
  snapshot->checksum = simulation::checksum(simulation);
  snapshot->gravity = simulation.gravity();
  snapshot->environment = simulation.environment();
  snapshot->scheduled = simulation.schedule().entries();
  snapshot->organs.reserve(simulation.organs().size());
  for (std::size_t i = 0; i < simulation.organs().size(); ++i) {
    const simulation::Organ& organ = simulation.organs()[i];
    snapshot->organs.push_back({organ.scenario().id, organ.rod(), organ.growthRates(), organ.cues(simulation.seenBy(i)),
                                organ.energy(), organ.scenario().loads.surroundings, organ.report()});
    snapshot->organs.back().report.relaxation.lowest_eigenvalue = organ.lowestEigenvalue();
  }
  return snapshot;
}

}  // namespace sensory_growth::node
