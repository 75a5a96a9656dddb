#include "sensory_growth/ros/stimulus_services.h"

#include <thread>
#include <utility>

#include "sensory_growth/ListStimuli.h"
#include "sensory_growth/SetLightDirection.h"
#include "sensory_growth/SetPointSource.h"
#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"
#include "serve.h"

namespace sensory_growth::node {

using std::chrono::steady_clock;

StimulusServices::StimulusServices(ros::NodeHandle private_node, std::string world_frame, const WorldFrame& world,
                                   SimulationLoop& loop, StimulusCounters& counters)
    : world_(world), loop_(loop), counters_(counters), spinner_(1, &queue_) {
  services_ = {serve<SetPointSource>(private_node, names::kSetPointSource, queue_,
                                     [this](auto& q, auto& r) { fill(set(toCommand(q.source), q.source.header), r); }),
               serve<SetLightDirection>(private_node, names::kSetLightDirection, queue_,
                                        [this](auto& q, auto& r) { fill(set(toCommand(q.light), q.light.header), r); }),
               serve<ListStimuli>(private_node, names::kListStimuli, queue_,
                                  [this, frame = std::move(world_frame)](auto&, auto& r) {
                                    const SnapshotPtr snapshot = loop_.snapshot();
                                    fill({true, "listed", snapshot->step_index, snapshot->stamp}, r);
                                    r.stimuli = toStimuli(*snapshot, frame);
                                  })};
}

Answer StimulusServices::set(const std::optional<simulation::StimulusCommand>& command,
                             const std_msgs::Header& header) {
  if (!command) return refuse(StimulusFate::unknown_operation, kNoOperation);
  if (const auto fault = findFault(*command)) return refuse(StimulusFate::malformed, *fault);
  simulation::StimulusCommand in_world = *command;
  const auto deadline = steady_clock::now() + WorldFrame::kPatience;
  while (const auto why_not = world_.transform(in_world, header, steady_clock::now() >= deadline)) {
    if (steady_clock::now() >= deadline) return refuse(StimulusFate::no_transform, *why_not);
    std::this_thread::sleep_for(WorldFrame::kRetryInterval);
  }
  return loop_.apply(in_world);
}

Answer StimulusServices::refuse(StimulusFate fate, const std::string& why) {
  counters_.count(fate);
  return loop_.atBoundary([&why](const Snapshot&) { return std::optional<std::string>(why); });
}

}  // namespace sensory_growth::node
