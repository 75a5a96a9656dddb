#pragma once

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <string>
#include <vector>

namespace sensory_growth::node::testing {

/// All messages of one topic of a closed bag, in the order of writing within equal times.
template <typename Message>
std::vector<Message> readTopic(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<Message> messages;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<Message>();
    EXPECT_TRUE(message) << topic << " holds " << instance.getDataType();
    if (message) messages.push_back(*message);
  }
  return messages;
}

}  // namespace sensory_growth::node::testing
