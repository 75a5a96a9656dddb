#include "sensory_growth/ros/parameters.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <sstream>
#include <utility>

#include "sensory_growth/ros/pacer.h"
#include "sensory_growth/simulation/spelling.h"

namespace sensory_growth::node {
namespace {

constexpr double kSmallestPart =
    1e6;  // of a recording [byte]; smaller ones would hold little but what each begins with

enum class Need {
  optional,
  required,
  live,  ///< optional, and may change while the node runs
};

/// Allowed values of a number, limits included.
struct Range {
  double lowest;
  double highest;
};

template <typename Choice>
using Choices = std::initializer_list<std::pair<const char*, Choice>>;

/// The one list of all parameters; what happens to each is up to the visitor.
template <typename Visitor>
void visit(Parameters& p, Visitor& parameter) {
  constexpr double kTiny = 1e-9;
  constexpr double kHuge = 1e12;
  parameter.text("scenario", p.scenario, Need::required);
  parameter.text("protocol", p.protocol);
  parameter.text("world_frame", p.world_frame);
  parameter.text("frame_prefix", p.frame_prefix);
  parameter.count("stations", p.stations, {0, 100});
  parameter.choice("clock_mode", p.clock_mode,
                   {{"publish", ClockMode::publish}, {"follow", ClockMode::follow}, {"wall", ClockMode::wall}});
  parameter.choice("reset_time", p.reset_time, {{"keep_time", ResetTime::keep_time}, {"rewind", ResetTime::rewind}});
  parameter.choice("on_backward_jump", p.on_backward_jump,
                   {{"reset", BackwardJump::reset}, {"ignore", BackwardJump::ignore}});
  parameter.number("clock_rate", p.clock_rate, {1.0, 1e5});
  parameter.count("threads", p.threads, {0, 1024});
  parameter.number("growth_time_scale", p.growth_time_scale, {kTiny, kHuge}, Need::required);
  parameter.number("real_time_factor", p.real_time_factor, {0.0, kHighestRealTimeFactor}, Need::live);
  parameter.flag("start_paused", p.start_paused);
  parameter.flag("exit_when_finished", p.exit_when_finished);
  parameter.flag("progress", p.progress, Need::live);
  parameter.flag("record", p.record);
  parameter.text("recording_directory", p.recording_directory);
  parameter.text("recording_file", p.recording_file);
  parameter.choice("recording_compression", p.recording_compression,
                   {{"none", Compression::none}, {"lz4", Compression::lz4}, {"bz2", Compression::bz2}});
  parameter.count("recording_marker_every", p.recording_marker_every, {0, 1000000});
  parameter.number("recording_split_size", p.recording_split_size, {0.0, 1e18});
  parameter.number("recording_minimum_free_space", p.recording_minimum_free_space, {0.0, 1e18});
  parameter.text("checkpoint_directory", p.checkpoint_directory);
  parameter.number("marker_rate", p.marker_rate, {0.1, 100.0}, Need::live);
  parameter.choice("marker_style", p.marker_style, {{"tube", MarkerShape::tube}, {"line", MarkerShape::line}},
                   Need::live);
  parameter.choice("marker_color", p.marker_color,
                   {{"curvature", MarkerField::curvature},
                    {"growth_rate", MarkerField::growth_rate},
                    {"stress", MarkerField::stress},
                    {"stretch", MarkerField::stretch},
                    {"age", MarkerField::age},
                    {"none", MarkerField::none}},
                   Need::live);
  parameter.number("marker_color_limit", p.marker_color_limit, {0.0, kHuge}, Need::live);
  parameter.number("marker_radius_scale", p.marker_radius_scale, {1e-3, 1e3}, Need::live);
  parameter.flag("interactive_markers", p.interactive_markers);
  parameter.number("marker_lamp_diameter", p.marker_lamp_diameter, {0.0, 1e3}, Need::live);
}

std::string shown(XmlRpc::XmlRpcValue value) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeString) {
    text << '\'' << static_cast<std::string&>(value) << '\'';
  } else {
    value.write(text);
  }
  return text.str();
}

/// When parameters are read.
enum class When { at_start, while_running };

class Reader {
 public:
  Reader(const XmlRpc::XmlRpcValue& tree, When when) : tree_(tree), when_(when) {}

  void text(const std::string& key, std::string& value, Need need = Need::optional) {
    if (!find(key, need)) return;
    XmlRpc::XmlRpcValue& given = tree_[key];
    if (given.getType() != XmlRpc::XmlRpcValue::TypeString) return wrongType(key, "text");
    value = static_cast<std::string&>(given);
    if (value.empty() && need == Need::required) problem(key, "is empty");
  }

  void flag(const std::string& key, bool& value, Need need = Need::optional) {
    if (!find(key, need)) return;
    XmlRpc::XmlRpcValue& given = tree_[key];
    if (given.getType() != XmlRpc::XmlRpcValue::TypeBoolean) return wrongType(key, "true or false");
    value = static_cast<bool&>(given);
  }

  void count(const std::string& key, int& value, Range range) {
    if (!find(key, Need::optional)) return;
    XmlRpc::XmlRpcValue& given = tree_[key];
    if (given.getType() != XmlRpc::XmlRpcValue::TypeInt) return wrongType(key, "a whole number");
    if (inRange(key, static_cast<int&>(given), range)) value = static_cast<int&>(given);
  }

  void number(const std::string& key, double& value, Range range, Need need = Need::optional) {
    if (!find(key, need)) return;
    XmlRpc::XmlRpcValue& given = tree_[key];
    const bool is_whole = given.getType() == XmlRpc::XmlRpcValue::TypeInt;
    if (!is_whole && given.getType() != XmlRpc::XmlRpcValue::TypeDouble) return wrongType(key, "a number");
    const double number = is_whole ? static_cast<int&>(given) : static_cast<double&>(given);
    if (inRange(key, number, range)) value = number;
  }

  template <typename Choice>
  void choice(const std::string& key, Choice& value, Choices<Choice> choices, Need need = Need::optional) {
    if (!find(key, need)) return;
    XmlRpc::XmlRpcValue& given = tree_[key];
    std::string names;
    for (const auto& [name, meaning] : choices) {
      if (given.getType() == XmlRpc::XmlRpcValue::TypeString && static_cast<std::string&>(given) == name) {
        value = meaning;
        return;
      }
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
    problem(key, "is " + shown(given) + "; it must be one of " + names);
  }

  void problem(const std::string& key, const std::string& what) { problems_.push_back("~" + key + " " + what); }

  void refuseUnknownKeys() {
    for (const auto& entry : tree_) {
      const std::string& key = entry.first;
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      const std::string* meant = simulation::nearestName(key, known_);
      problem(key, "is not a parameter of this node" + (meant ? "; did you mean ~" + *meant + "?" : std::string()));
    }
  }

  std::vector<std::string> takeProblems() { return std::move(problems_); }

 private:
  bool find(const std::string& key, Need need) {
    known_.push_back(key);
    const bool is_given = tree_.hasMember(key);
    if (when_ == When::while_running) {
      if (is_given && need != Need::live) problem(key, "cannot change while the node runs; start it again");
      return is_given && need == Need::live;
    }
    if (!is_given && need == Need::required) problem(key, "is required and was not given");
    return is_given;
  }

  void wrongType(const std::string& key, const std::string& expected) {
    problem(key, "is " + shown(tree_[key]) + "; it must be " + expected);
  }

  bool inRange(const std::string& key, double value, Range range) {
    if (std::isfinite(value) && value >= range.lowest && value <= range.highest) return true;
    std::ostringstream text;
    text << "is " << value << "; it must be " << (std::isfinite(value) ? "" : "finite and ") << "from " << range.lowest
         << " to " << range.highest;
    problem(key, text.str());
    return false;
  }

  XmlRpc::XmlRpcValue tree_;
  const When when_;
  std::vector<std::string> known_;
  std::vector<std::string> problems_;
};

class Writer {
 public:
  Writer() { text_.precision(std::numeric_limits<double>::max_digits10); }

  void text(const char* key, const std::string& value, Need = Need::optional) {
    text_ << key << ": '";
    for (const char c : value) text_ << (c == '\'' ? "''" : std::string(1, c));
    text_ << "'\n";
  }
  void flag(const char* key, bool value, Need = Need::optional) {
    text_ << key << ": " << (value ? "true" : "false") << '\n';
  }
  void count(const char* key, int value, Range) { text_ << key << ": " << value << '\n'; }
  void number(const char* key, double value, Range, Need = Need::optional) { text_ << key << ": " << value << '\n'; }

  template <typename Choice>
  void choice(const char* key, Choice value, Choices<Choice> choices, Need = Need::optional) {
    for (const auto& [name, meaning] : choices) {
      if (meaning == value) text_ << key << ": " << name << '\n';
    }
  }

  std::string str() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

/// Lists those that may change while the node runs.
class Lister {
 public:
  void text(const char*, const std::string&, Need = Need::optional) {}
  void count(const char*, int, Range) {}

  void flag(const char* key, bool value, Need need = Need::optional) {
    if (need == Need::live) live_.push_back({key, value, false, true, {}});
  }

  void number(const char* key, double value, Range range, Need need = Need::optional) {
    if (need == Need::live) live_.push_back({key, value, range.lowest, range.highest, {}});
  }

  template <typename Choice>
  void choice(const char* key, Choice value, Choices<Choice> choices, Need need = Need::optional) {
    if (need != Need::live) return;
    LiveParameter& parameter = live_.emplace_back();
    parameter.name = key;
    parameter.lowest = parameter.highest = std::string();
    for (const auto& [name, meaning] : choices) {
      if (meaning == value) parameter.value = std::string(name);
      parameter.choices.push_back(name);
    }
  }

  std::vector<LiveParameter> take() { return std::move(live_); }

 private:
  std::vector<LiveParameter> live_;
};

bool startsWithSlash(const std::string& frame) { return !frame.empty() && frame.front() == '/'; }

void checkTogether(const Parameters& p, Reader& reader) {
  if (p.real_time_factor > 0.0 && p.real_time_factor < kLowestRealTimeFactor) {
    reader.problem("real_time_factor", "is below 1e-6 but not 0; at 0 the simulation runs as fast as it can");
  }
  if (p.reset_time == ResetTime::rewind && p.clock_mode != ClockMode::publish) {
    reader.problem("reset_time", "is rewind, which needs ~clock_mode to be publish: this node does not own ROS time");
  }
  if (p.recording_split_size > 0.0 && p.recording_split_size < kSmallestPart) {
    reader.problem("recording_split_size", "is below 1e6 but not 0; at 0 a recording is never split");
  }
  if (p.world_frame.empty()) reader.problem("world_frame", "is empty");
  if (startsWithSlash(p.world_frame)) reader.problem("world_frame", "must not begin with a slash");
  if (startsWithSlash(p.frame_prefix)) reader.problem("frame_prefix", "must not begin with a slash");
  if (p.record && p.recording_directory.empty()) {
    reader.problem("recording_directory", "is required because ~record is true");
  }
}

ParameterReading read(const Parameters& parameters, Reader reader) {
  ParameterReading reading{parameters, {}};
  visit(reading.parameters, reader);
  checkTogether(reading.parameters, reader);
  reader.refuseUnknownKeys();
  reading.problems = reader.takeProblems();
  return reading;
}

}  // namespace

ParameterReading readParameters(const XmlRpc::XmlRpcValue& tree) { return read({}, Reader(tree, When::at_start)); }

ParameterReading changeParameters(const Parameters& parameters, const XmlRpc::XmlRpcValue& changes) {
  ParameterReading reading = read(parameters, Reader(changes, When::while_running));
  if (!reading.problems.empty()) reading.parameters = parameters;
  return reading;
}

std::vector<LiveParameter> liveParameters(const Parameters& parameters) {
  Lister lister;
  Parameters copy = parameters;  // visit serves reading too, so it takes what it visits mutably
  visit(copy, lister);
  return lister.take();
}

ParameterReading loadParameters(const ros::NodeHandle& node) {
  XmlRpc::XmlRpcValue tree;
  node.getParam(node.getNamespace(), tree);
  if (tree.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    tree = XmlRpc::XmlRpcValue();
    tree.begin();  // makes it an empty struct
  }
  return readParameters(tree);
}

std::string toYaml(const Parameters& parameters) {
  Writer writer;
  Parameters copy = parameters;  // as above
  visit(copy, writer);
  return writer.str();
}

}  // namespace sensory_growth::node
