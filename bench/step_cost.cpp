#include "step_cost.h"

#include <deque>
#include <vector>

// Found before the library's own: see counting/.
#include "kernels/lanes.h"
#include "kernels/motion_kernels.inc"

namespace sensory_growth::bench {
namespace {

using namespace mechanics::kernels;

constexpr std::size_t kElements = 1000;

/// Room for the columns of a rod whose numbers do not matter, but are finite.
class Room {
 public:
  double* column() { return columns_.emplace_back(kElements + 2 * kPacket, 0.1).data(); }
  Columns3 columns3() { return {{column(), column(), column()}}; }
  Columns4 columns4() { return {{column(), column(), column(), column()}}; }

 private:
  std::deque<std::vector<double>> columns_;
};

/// Per element, of one pass over the rod.
template <typename Pass>
StepCost count(const Pass& pass) {
  tally = {};
  pass();
  const auto n = static_cast<double>(kElements);
  return {static_cast<double>(tally.flops) / n,
          static_cast<double>(sizeof(double) * (tally.fetched.size() + tally.put.size())) / n};
}

}  // namespace

StepCost countStep() {
  Room room;
  MotionView rod;
  rod.size = kElements;
  rod.rest_length = room.column();
  rod.inverse_length = room.column();
  rod.inverse_voronoi = room.column();
  rod.inverse_mass = room.column();
  rod.inverse_inertia = room.column();
  rod.stretch_stiffness = room.columns3();
  rod.rest_stretch = room.columns3();
  rod.bend_stiffness = room.columns3();
  rod.rest_curvature = room.columns3();
  rod.applied_force = room.columns3();
  rod.applied_couple = room.columns3();
  rod.position = room.columns3();
  rod.frame = room.columns4();
  rod.velocity = room.columns3();
  rod.angular_velocity = room.columns3();
  rod.force = room.columns3();
  rod.couple = room.columns3();
  rod.lower_couple = room.columns3();
  rod.current_length = room.column();

  const StepCost forces = count([&] { evaluate(rod); });
  const StepCost motion = count([&] { kickAndDrift(rod, {1e-3, 0.99, 1e-3}, 1e-3); });
  return {forces.flops + motion.flops, forces.bytes + motion.bytes};
}

}  // namespace sensory_growth::bench
