#pragma once

/// What is in bags, and bags that somebody has changed.

#include <gtest/gtest.h>
#include <ros/message_event.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros/bag_contents.h"
#include "sensory_growth/AppliedCommand.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::batch::testing {

using node::testing::readTopic;

struct TopicContents {
  std::string type;
  std::string latching;
  std::vector<std::pair<ros::Time, std::string>> messages;  // stamps and bytes

  bool operator==(const TopicContents& other) const {
    return type == other.type && latching == other.latching && messages == other.messages;
  }
};

/// Everything but what depends on who recorded where and how fast: status and parameters.
inline std::map<std::string, TopicContents> contentsOf(const std::string& path) {
  std::map<std::string, TopicContents> contents;
  const rosbag::Bag bag(path);
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& message : view) {
    const std::string topic = message.getTopic();
    if (topic == "/sensory_growth/status" || topic == "/sensory_growth/parameters") continue;
    TopicContents& content = contents[topic];
    content.type = message.getDataType();
    content.latching = (*message.getConnectionHeader())["latching"];
    std::string bytes(message.size(), '\0');
    ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()), message.size());
    message.write(stream);
    content.messages.emplace_back(message.getTime(), bytes);
  }
  return contents;
}

/// Copies a bag with its commands changed.
inline void copyChanged(const std::string& from, const std::string& to,
                        const std::function<void(AppliedCommand& command, std::size_t index)>& change) {
  const rosbag::Bag original(from);
  rosbag::Bag copy(to, rosbag::bagmode::Write);
  rosbag::View view(original);
  std::size_t index = 0;
  for (const rosbag::MessageInstance& message : view) {
    if (const auto command = message.instantiate<AppliedCommand>()) {
      change(*command, index++);
      copy.write(message.getTopic(), message.getTime(), *command, message.getConnectionHeader());
    } else {
      copy.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
    }
  }
}

/// Changes the lowest bit.
inline void flipLastBit(double& value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  bits ^= 1;
  std::memcpy(&value, &bits, sizeof bits);
}

}  // namespace sensory_growth::batch::testing
