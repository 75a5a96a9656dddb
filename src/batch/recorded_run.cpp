#include "sensory_growth/batch/recorded_run.h"

#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "sensory_growth/Checkpoint.h"
#include "sensory_growth/OrganState.h"
#include "sensory_growth/Status.h"
#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::batch {
namespace {

namespace names = node::names;

/// Calls visit(message) with every message of the topic. Throws BadInput at one of another type or version.
template <typename Content, typename Visit>
void forEach(const rosbag::Bag& bag, const std::string& topic, const Visit& visit) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<Content>();
    if (!message) {
      throw BadInput(bag.getFileName() + ": " + topic + " is a " + instance.getDataType() +
                     " of another version of sensory_growth");
    }
    visit(*message);
  }
}

/// The last text of a latched topic; empty if there is none.
std::string readText(const rosbag::Bag& bag, const std::string& topic) {
  std::string text;
  forEach<std_msgs::String>(bag, topic, [&](const std_msgs::String& message) { text = message.data; });
  return text;
}

XmlRpc::XmlRpcValue toXmlRpc(const YAML::Node& scalar) {
  const bool is_quoted = scalar.Tag() == "!";
  if (bool flag; !is_quoted && YAML::convert<bool>::decode(scalar, flag)) return XmlRpc::XmlRpcValue(flag);
  if (int count; !is_quoted && YAML::convert<int>::decode(scalar, count)) return XmlRpc::XmlRpcValue(count);
  if (double number; !is_quoted && YAML::convert<double>::decode(scalar, number)) return XmlRpc::XmlRpcValue(number);
  return XmlRpc::XmlRpcValue(scalar.as<std::string>());
}

/// The parameters as the node has described them, with its name and version.
void readParameters(const std::string& yaml, const std::string& file, RecordedRun& run) {
  XmlRpc::XmlRpcValue tree;
  tree.begin();  // makes it an empty struct
  try {
    for (const auto& entry : YAML::Load(yaml)) {
      const auto key = entry.first.as<std::string>();
      if (key == "version") {
        run.version = entry.second.as<std::string>();
      } else if (key != "node") {
        tree[key] = toXmlRpc(entry.second);
      }
    }
  } catch (const YAML::Exception& error) {
    throw BadInput(file + ": its parameters cannot be read: " + error.what());
  }
  node::ParameterReading reading = node::readParameters(tree);
  for (std::string& problem : reading.problems) problem = file + ": " + problem;
  if (!reading.problems.empty()) throw BadInput(reading.problems);
  run.parameters = reading.parameters;
}

simulation::Checkpoint readCheckpoint(const Checkpoint& message, const std::string& file) {
  try {
    return simulation::decode({message.data.begin(), message.data.end()});
  } catch (const simulation::CheckpointError& error) {
    throw BadInput(file + ": the checkpoint of epoch " + std::to_string(message.epoch) + " " + error.what());
  }
}

/// Topics of states by the id of their organ, which is fit for a file name.
std::map<std::string, std::string> stateTopics(const rosbag::Bag& bag, const std::string& node) {
  const std::string begin = node + "/" + names::kOrgans + "/";
  const std::string end = std::string("/") + names::kState;
  std::map<std::string, std::string> topics;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
    const std::string& topic = connection->topic;
    if (topic.size() <= begin.size() + end.size() || topic.compare(0, begin.size(), begin) != 0) continue;
    const std::string organ = topic.substr(begin.size(), topic.size() - begin.size() - end.size());
    if (topic == begin + organ + end && organ.find('/') == std::string::npos) topics[organ] = topic;
  }
  return topics;
}

bool isComplete(const OrganState& state) {
  const std::size_t n = state.curvature.size();
  return n > 0 && state.positions.size() == n + 1 && state.growth_rate.size() == n && state.radius.size() == n &&
         state.age.size() == n;
}

}  // namespace

rosbag::Bag openBag(const std::string& path) {
  try {
    return rosbag::Bag(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw BadInput(path + " was not closed; run: rosbag reindex '" + path + "'");
  } catch (const rosbag::BagException& error) {
    throw BadInput(path + " cannot be read as a bag: " + error.what());
  }
}

std::string nodeOf(const rosbag::Bag& bag, const std::string& wanted) {
  const std::string end = std::string("/") + names::kStatus;
  std::set<std::string> nodes;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
    const std::string& topic = connection->topic;
    const bool is_status = connection->datatype == ros::message_traits::DataType<Status>::value();
    if (is_status && topic.size() > end.size() && topic.compare(topic.size() - end.size(), end.size(), end) == 0) {
      nodes.insert(topic.substr(0, topic.size() - end.size()));
    }
  }
  if (nodes.empty()) throw BadInput(bag.getFileName() + " holds no run: no sensory_growth/Status on a topic 'status'");
  if (wanted.empty() && nodes.size() == 1) return *nodes.begin();
  if (nodes.count(wanted) == 1) return wanted;
  std::string list;
  for (const std::string& node : nodes) list += (list.empty() ? "" : ", ") + node;
  if (wanted.empty()) throw BadInput(bag.getFileName() + " holds several runs; choose one with --node: " + list);
  throw BadInput(bag.getFileName() + " holds no run of '" + wanted + "', but of " + list);
}

RecordedRun readRun(const rosbag::Bag& bag, const std::string& node) {
  const auto topic = [&](const char* name) { return node + "/" + name; };
  RecordedRun run;
  run.sources.node = node;
  run.sources.scenario = readText(bag, topic(names::kScenario));
  run.sources.protocol = readText(bag, topic(names::kProtocol));
  const std::string parameters = readText(bag, topic(names::kParameters));
  if (run.sources.scenario.empty()) throw BadInput(bag.getFileName() + " holds no " + topic(names::kScenario));
  if (parameters.empty()) throw BadInput(bag.getFileName() + " holds no " + topic(names::kParameters));
  readParameters(parameters, bag.getFileName(), run);

  forEach<Status>(bag, topic(names::kStatus), [&](const Status& status) {
    std::vector<std::uint64_t>& checksums = run.epochs[status.epoch].checksums[status.step_index];
    if (checksums.empty() || checksums.back() != status.checksum) checksums.push_back(status.checksum);
  });
  for (auto epoch = run.epochs.begin(); epoch != run.epochs.end(); ++epoch) {
    if (epoch != run.epochs.begin() && epoch->first != std::prev(epoch)->first + 1) {
      throw BadInput(bag.getFileName() + " holds no states between epochs " + std::to_string(std::prev(epoch)->first) +
                     " and " + std::to_string(epoch->first));
    }
  }
  forEach<Checkpoint>(bag, topic(names::kCheckpoint), [&](const Checkpoint& message) {
    const auto epoch = run.epochs.find(message.epoch);
    if (epoch == run.epochs.end()) return;  // the bag ends before its first state
    epoch->second.origin = readCheckpoint(message, bag.getFileName());
    if (epoch->second.beginning() > epoch->second.firstStep()) {
      throw BadInput(bag.getFileName() + ": the checkpoint of epoch " + std::to_string(message.epoch) +
                     " is of a later step than its states");
    }
  });
  forEach<AppliedCommand>(bag, topic(names::kAppliedCommands), [&](const AppliedCommand& command) {
    const auto epoch = run.epochs.find(command.epoch);
    // What falls due with a step is said before the step is; a bag may end between the two.
    if (epoch == run.epochs.end() || command.step_index > epoch->second.lastStep() + 1) {
      throw BadInput(bag.getFileName() + " holds a command at step " + std::to_string(command.step_index) +
                     " of epoch " + std::to_string(command.epoch) + ", but not that state");
    }
    epoch->second.commands[command.step_index].push_back(command);
  });
  return run;
}

std::uint64_t writeFrames(const rosbag::Bag& bag, const std::string& node, const FrameOptions& options) {
  const std::map<std::string, std::string> topics = stateTopics(bag, node);
  if (topics.empty()) throw BadInput(bag.getFileName() + " holds no states of organs of " + node);
  std::uint32_t last_epoch = 0;
  std::vector<std::string> organs;
  for (const auto& [organ, topic] : topics) {
    organs.push_back(organ);
    forEach<OrganState>(bag, topic, [&](const OrganState& state) { last_epoch = std::max(last_epoch, state.epoch); });
  }
  FrameFiles files(options, organs, last_epoch);
  std::uint64_t states = 0;
  for (const auto& [organ, topic] : topics) {
    std::optional<std::uint64_t> written;
    forEach<OrganState>(bag, topic, [&, &organ = organ](const OrganState& state) {
      if (state.epoch != last_epoch || state.step_index == written) return;  // a bag may say it twice
      if (!isComplete(state) || state.organ != organ) {
        throw BadInput(bag.getFileName() + ": the state of '" + organ + "' at step " +
                       std::to_string(state.step_index) + " is not complete");
      }
      written = state.step_index;
      ++states;
      files.write(state);
    });
  }
  files.close();
  return states;
}

}  // namespace sensory_growth::batch
