#pragma once

/// A running node as a test sees it: its services, its topics, and waiting for them under deadlines of wall time.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "ros/service_call.h"
#include "ros/wait.h"
#include "sensory_growth/AppliedCommand.h"
#include "sensory_growth/Command.h"
#include "sensory_growth/LightDirection.h"
#include "sensory_growth/OrganState.h"
#include "sensory_growth/PointSource.h"
#include "sensory_growth/SetGravity.h"
#include "sensory_growth/SetParameter.h"
#include "sensory_growth/SetRealTimeFactor.h"
#include "sensory_growth/SplitRecording.h"
#include "sensory_growth/StartRecording.h"
#include "sensory_growth/Status.h"
#include "sensory_growth/Step.h"
#include "sensory_growth/Stimuli.h"
#include "sensory_growth/StopRecording.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::node::testing {

/// The scenario that the launch file gives to the node and, in /test_scenario, to the test.
inline std::string scenarioFile() { return ros::param::param<std::string>("/test_scenario", ""); }

inline simulation::Simulation simulationAlone() {
  return simulation::Simulation(simulation::loadScenario(scenarioFile()));
}

class NodeUnderTest {
 public:
  explicit NodeUnderTest(const std::string& name = "/sensory_growth", const std::string& organ = "shoot")
      : node_(name) {
    // First what is not latched: when the others have come, it is connected, too.
    subscribe<AppliedCommand>("applied_commands",
                              [this](const AppliedCommand& command) { applied_.push_back(command); });
    subscribe<Stimuli>("stimuli", [this](const Stimuli& stimuli) { stimuli_ = stimuli; });
    subscribe<Status>("status", [this](const Status& status) { status_ = status; });
    subscribe<OrganState>("organs/" + organ + "/state", [this](const OrganState& state) {
      states_[{epoch_, state.step_index}] = state;
    });
    for (const ros::Subscriber& subscriber : subscribers_) {
      lookUntil("a publisher of " + subscriber.getTopic(), [&] { return subscriber.getNumPublishers() > 0; });
    }
    waitForStatus("first status", [](const Status& status) { return status.mode != Status::UNKNOWN; });
    wait("a first state", [this] { return !states_.empty(); });
  }

  ros::NodeHandle& handle() { return node_; }

  /// Calls a service that must exist; what it answers is up to the test.
  template <typename Service>
  typename Service::Response call(const std::string& name, const typename Service::Request& request = {}) {
    Service service;
    service.request = request;
    const std::string resolved = node_.resolveName(name);
    EXPECT_TRUE(ros::service::waitForService(resolved, ros::Duration(kPatience.count()))) << name;
    EXPECT_TRUE(callService(resolved, service)) << name;
    return service.response;
  }

  sensory_growth::Command::Response command(const std::string& name) { return call<sensory_growth::Command>(name); }

  Step::Response step(std::uint32_t steps) {
    Step::Request request;
    request.steps = steps;
    return call<Step>("step", request);
  }

  SetParameter::Response setParameter(const std::string& organ, const std::string& name, double value) {
    SetParameter::Request request;
    request.organ = organ;
    request.name = name;
    request.value = value;
    return call<SetParameter>("set_parameter", request);
  }

  SetGravity::Response setGravity(const rod::Vector3& acceleration) {
    SetGravity::Request request;
    request.acceleration.x = acceleration.x();
    request.acceleration.y = acceleration.y();
    request.acceleration.z = acceleration.z();
    return call<SetGravity>("set_gravity", request);
  }

  SetRealTimeFactor::Response setRealTimeFactor(double factor) {
    SetRealTimeFactor::Request request;
    request.factor = factor;
    return call<SetRealTimeFactor>("set_real_time_factor", request);
  }

  /// Takes steps, expects it to succeed, and returns the state after the last.
  OrganState stepTo(std::uint64_t wanted, std::uint64_t from) {
    const Step::Response response = step(static_cast<std::uint32_t>(wanted - from));
    EXPECT_TRUE(response.success) << response.message;
    EXPECT_EQ(response.step_index, wanted);
    return state(wanted);
  }

  /// The state of a step; waits until it has arrived.
  OrganState state(std::uint64_t step) {
    OrganState found;
    wait("the state of step " + std::to_string(step), [&] {
      const auto state = states_.find({epoch_, step});
      if (state == states_.end()) return false;
      found = state->second;
      return true;
    });
    return found;
  }

  /// To be called after a reset: states are kept apart by what came before and after.
  void countReset() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++epoch_;
  }

  template <typename Predicate>
  Status waitForStatus(const std::string& what, const Predicate& holds) {
    Status found;
    wait(what, [&] {
      found = status_;
      return holds(status_);
    });
    return found;
  }

  template <typename Predicate>
  Stimuli waitForStimuli(const std::string& what, const Predicate& holds) {
    Stimuli found;
    wait(what, [&] {
      found = stimuli_;
      return holds(stimuli_);
    });
    return found;
  }

  /// The command number `index` (from 0) that was taken at a step boundary.
  AppliedCommand applied(std::size_t index) {
    AppliedCommand found;
    wait("applied command " + std::to_string(index), [&] {
      if (applied_.size() <= index) return false;
      found = applied_[index];
      return true;
    });
    return found;
  }

  std::size_t appliedCount() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return applied_.size();
  }

  /// Waits until `stimulus` is known to have been taken.
  template <typename Message>
  AppliedCommand send(ros::Publisher& publisher, const Message& stimulus) {
    const std::size_t before = appliedCount();
    publish(publisher, stimulus);
    return applied(before);
  }

  template <typename Message>
  void publish(ros::Publisher& publisher, const Message& message) {
    lookUntil("a subscriber of " + publisher.getTopic(), [&] { return publisher.getNumSubscribers() > 0; });
    publisher.publish(message);
  }

 private:
  template <typename Message, typename Keep>
  void subscribe(const std::string& topic, const Keep& keep) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, keep](const boost::shared_ptr<const Message>& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          keep(*message);
          changed_.notify_all();
        };
    subscribers_.push_back(node_.subscribe<Message>(topic, 1000, callback));
  }

  template <typename Predicate>
  void wait(const std::string& what, const Predicate& holds) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!changed_.wait_for(lock, kPatience, holds)) FAIL() << "waited in vain for " << what;
  }

  ros::NodeHandle node_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::uint32_t epoch_ = 0;
  std::map<std::pair<std::uint32_t, std::uint64_t>, OrganState> states_;
  Status status_;
  Stimuli stimuli_;
  std::vector<AppliedCommand> applied_;

  std::vector<ros::Subscriber> subscribers_;  // last, so that callbacks end before what they touch
};

/// Expects the positions of the message to be those of the first organ, bit for bit.
inline void expectSame(const OrganState& state, const simulation::Simulation& alone) {
  const rod::Rod& rod = alone.organs().front().rod();
  EXPECT_EQ(state.step_index, alone.stepIndex());
  EXPECT_EQ(state.growth_time, alone.time());
  ASSERT_EQ(state.positions.size(), rod.vertices.size());
  for (std::size_t i = 0; i < rod.vertices.size(); ++i) {
    EXPECT_EQ(state.positions[i].x, rod.vertices[i].position.x()) << "vertex " << i;
    EXPECT_EQ(state.positions[i].y, rod.vertices[i].position.y()) << "vertex " << i;
    EXPECT_EQ(state.positions[i].z, rod.vertices[i].position.z()) << "vertex " << i;
  }
  ASSERT_EQ(state.curvature.size(), rod.bends.size());
  for (std::size_t j = 0; j < rod.bends.size(); ++j) {
    EXPECT_EQ(state.curvature[j].x, rod.bends[j].curvature.x()) << "bend " << j;
    EXPECT_EQ(state.rest_curvature[j].y, rod.bends[j].rest_curvature.y()) << "bend " << j;
  }
}

/// Unit tangent at the tip: z of its frame.
inline rod::Vector3 tipDirection(const OrganState& state) {
  const auto& q = state.tip.orientation;
  return rod::Quaternion(q.w, q.x, q.y, q.z) * rod::Vector3::UnitZ();
}

inline rod::Vector3 tipPosition(const OrganState& state) {
  return {state.tip.position.x, state.tip.position.y, state.tip.position.z};
}

inline PointSource lamp(std::uint8_t operation, const std::string& id, const rod::Vector3& position,
                        double strength = 1.0) {
  PointSource message;
  message.operation = operation;
  message.id = id;
  message.position.x = position.x();
  message.position.y = position.y();
  message.position.z = position.z();
  message.strength = strength;
  return message;
}

inline LightDirection light(std::uint8_t operation, const std::string& id, const rod::Vector3& towards,
                            double strength = 1.0) {
  LightDirection message;
  message.operation = operation;
  message.id = id;
  message.towards.x = towards.x();
  message.towards.y = towards.y();
  message.towards.z = towards.z();
  message.strength = strength;
  return message;
}

}  // namespace sensory_growth::node::testing
