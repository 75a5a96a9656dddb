#include <ros/init.h>

#include "sensory_growth/ros/node.h"
#include "sensory_growth/ros/signals.h"

int main(int argc, char** argv) {
  const sensory_growth::node::Signals signals;  // before ros::init, which starts threads
  ros::init(argc, argv, "sensory_growth", ros::init_options::NoSigintHandler);
  const int exit_code = sensory_growth::node::runNode(signals);
  ros::shutdown();
  return exit_code;
}
