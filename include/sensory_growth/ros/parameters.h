#pragma once

/// The parameters of the node: what they are, what they may be, and everything that is wrong with those given.

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <string>
#include <vector>

namespace sensory_growth::node {

/// Who owns ROS time.
enum class ClockMode {
  publish,  ///< this node publishes /clock
  follow,   ///< another node publishes /clock, and steps are taken as it goes on
  wall,     ///< nobody: ROS time is wall time
};

/// What becomes of ROS time on a reset.
enum class ResetTime {
  keep_time,  ///< it goes on
  rewind,     ///< it begins anew
};

/// What becomes of the simulation when a clock that is followed goes backwards.
enum class BackwardJump {
  reset,   ///< back to step 0
  ignore,  ///< it goes on growing
};

enum class MarkerShape { tube, line };
enum class MarkerField { curvature, growth_rate, stress, stretch, age, none };
enum class Compression { none, lz4, bz2 };

/// Private parameters of the node, with their defaults.
struct Parameters {
  std::string scenario;  ///< path; required
  std::string protocol;  ///< path of stimuli added to those of the scenario; empty: none

  std::string world_frame = "world";
  std::string frame_prefix;  ///< put before the frames of organs, so that several nodes can share /tf
  int stations = 0;          ///< frames per organ at equal fractions of arc length, between base and tip

  ClockMode clock_mode = ClockMode::publish;
  ResetTime reset_time = ResetTime::keep_time;
  BackwardJump on_backward_jump = BackwardJump::reset;
  double clock_rate = 1000.0;      ///< most messages on /clock [1/s of wall time]
  int threads = 0;                 ///< most that organs are shared out to; 0: one per processor
  double growth_time_scale = 0.0;  ///< growth seconds per ROS second [-]; required
  double real_time_factor = 1.0;   ///< ROS seconds per wall second [-]; 0: as fast as possible
  bool start_paused = false;
  bool exit_when_finished = false;
  bool progress = false;  ///< log how far an unattended run is

  bool record = false;              ///< from step 0 on
  std::string recording_directory;  ///< empty: recording is refused
  std::string recording_file;       ///< of `record`; empty: made from the scenario's name and the time
  Compression recording_compression = Compression::lz4;
  int recording_marker_every = 1;               ///< steps between recorded markers; 0: none
  double recording_split_size = 0.0;            ///< another bag begins when one has grown by this [byte]; 0: never
  double recording_minimum_free_space = 1.0e9;  ///< recording stops when the disk has less [byte]

  std::string checkpoint_directory;  ///< empty: saving and loading are refused

  double marker_rate = 20.0;  ///< [1/s of wall time]
  MarkerShape marker_style = MarkerShape::tube;
  MarkerField marker_color = MarkerField::curvature;
  double marker_color_limit = 0.0;    ///< value of the brightest colour [SI]; 0: the largest at present, rounded up
  double marker_radius_scale = 1.0;   ///< thin organs are drawn this much thicker [-]
  bool interactive_markers = true;    ///< handles for stimuli in rviz
  double marker_lamp_diameter = 0.0;  ///< [m]; 0: 0.15 of the longest organ at the start
};

struct ParameterReading {
  Parameters parameters;
  std::vector<std::string> problems;  ///< empty if all is well; each names parameter, value and what is allowed
};

/// Reads the parameters in the namespace of `node`.
ParameterReading loadParameters(const ros::NodeHandle& node);

/// The same from a tree, as the parameter server keeps it.
ParameterReading readParameters(const XmlRpc::XmlRpcValue& tree);

/// The parameters with those of the tree changed while the node runs, or as they are if there are problems.
ParameterReading changeParameters(const Parameters& parameters, const XmlRpc::XmlRpcValue& changes);

/// A parameter that may change while the node runs. The values are all bool, double or text.
struct LiveParameter {
  std::string name;
  XmlRpc::XmlRpcValue value, lowest, highest;  ///< limits of text are empty
  std::vector<std::string> choices;            ///< that a text may be; empty for others
};

/// All that may change, with their values.
std::vector<LiveParameter> liveParameters(const Parameters& parameters);

/// All parameters as YAML, numbers to the last digit.
std::string toYaml(const Parameters& parameters);

}  // namespace sensory_growth::node
