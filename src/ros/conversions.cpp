#include "sensory_growth/ros/conversions.h"

#include <variant>

#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

using mechanics::RelaxationReason;
using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;

std::uint8_t toConstant(RelaxationReason reason) {
  switch (reason) {
    case RelaxationReason::converged:
      return Relaxation::CONVERGED;
    case RelaxationReason::too_many_iterations:
      return Relaxation::TOO_MANY_ITERATIONS;
    case RelaxationReason::line_search_failed:
      return Relaxation::LINE_SEARCH_FAILED;
    case RelaxationReason::unstable:
      return Relaxation::UNSTABLE;
    case RelaxationReason::unresolved_bend:
      return Relaxation::UNRESOLVED_BEND;
    case RelaxationReason::out_of_reach:
      return Relaxation::OUT_OF_REACH;
    case RelaxationReason::not_finite:
      return Relaxation::NOT_FINITE;
    case RelaxationReason::no_time_step:
      return Relaxation::NO_TIME_STEP;
  }
  return Relaxation::NOT_FINITE;
}

std::uint8_t toConstant(StimulusKind kind) {
  return kind == StimulusKind::point_source ? AppliedCommand::POINT_SOURCE : AppliedCommand::LIGHT_DIRECTION;
}

std::uint8_t toConstant(StimulusOperation operation) {
  switch (operation) {
    case StimulusOperation::add:
      return AppliedCommand::ADD;
    case StimulusOperation::change:
      return AppliedCommand::CHANGE;
    case StimulusOperation::remove:
      return AppliedCommand::REMOVE;
  }
  return AppliedCommand::ADD;
}

/// PointSource, LightDirection and AppliedCommand number their operations alike.
std::optional<StimulusOperation> toOperation(std::uint8_t constant) {
  static_assert(static_cast<int>(PointSource::ADD) == static_cast<int>(AppliedCommand::ADD));
  static_assert(static_cast<int>(PointSource::CHANGE) == static_cast<int>(AppliedCommand::CHANGE));
  static_assert(static_cast<int>(PointSource::REMOVE) == static_cast<int>(AppliedCommand::REMOVE));
  static_assert(static_cast<int>(PointSource::ADD) == static_cast<int>(LightDirection::ADD));
  static_assert(static_cast<int>(PointSource::CHANGE) == static_cast<int>(LightDirection::CHANGE));
  static_assert(static_cast<int>(PointSource::REMOVE) == static_cast<int>(LightDirection::REMOVE));
  switch (constant) {
    case PointSource::ADD:
      return StimulusOperation::add;
    case PointSource::CHANGE:
      return StimulusOperation::change;
    case PointSource::REMOVE:
      return StimulusOperation::remove;
    default:
      return std::nullopt;
  }
}

void fill(AppliedCommand& message, const StimulusCommand& command) {
  message.kind = toConstant(command.kind);
  message.operation = toConstant(command.operation);
  message.id = command.id;
  message.vector = toVector(command.vector);
  message.strength = command.strength;
  message.start = command.timing.start;
  message.duration = command.timing.duration;
  message.period = command.timing.period;
}

void fill(AppliedCommand& message, const simulation::ParameterCommand& command) {
  message.kind = AppliedCommand::PARAMETER;
  message.id = command.organ;
  message.parameter = command.name;
  message.value = command.value;
}

void fill(AppliedCommand& message, const simulation::GravityCommand& command) {
  message.kind = AppliedCommand::GRAVITY;
  message.vector = toVector(command.acceleration);
}

void fill(AppliedCommand& message, const simulation::SpawnCommand& command) {
  message.kind = AppliedCommand::SPAWN_ORGAN;
  message.organ = command.organ;
}

void fill(AppliedCommand& message, const simulation::RemoveCommand& command) {
  message.kind = AppliedCommand::REMOVE_ORGAN;
  message.id = command.organ;
}

template <typename Xyz>
rod::Vector3 toEigen(const Xyz& v) {
  return {v.x, v.y, v.z};
}

/// PointSource, LightDirection and AppliedCommand name what they have in common alike.
template <typename Content>
std::optional<StimulusCommand> makeCommand(StimulusKind kind, const Content& message, const rod::Vector3& vector) {
  const std::optional<StimulusOperation> known = toOperation(message.operation);
  if (!known) return std::nullopt;
  // What is documented as ignored must not be refused either.
  if (*known == StimulusOperation::remove) return StimulusCommand{kind, *known, message.id, {0.0, 0.0, 0.0}, 0.0, {}};
  return StimulusCommand{kind,   *known,           message.id,
                         vector, message.strength, {message.start, message.duration, message.period}};
}

std::vector<geometry_msgs::Vector3> toVectors(const growth::CueFields& cues, growth::Cue cue) {
  std::vector<geometry_msgs::Vector3> vectors;
  for (const Eigen::Vector2d& section : cues[static_cast<std::size_t>(cue)]) {
    vectors.push_back(toVector({section.x(), section.y(), 0.0}));
  }
  return vectors;
}

}  // namespace

geometry_msgs::Point toPoint(const rod::Vector3& v) {
  geometry_msgs::Point point;
  point.x = v.x();
  point.y = v.y();
  point.z = v.z();
  return point;
}

geometry_msgs::Vector3 toVector(const rod::Vector3& v) {
  geometry_msgs::Vector3 vector;
  vector.x = v.x();
  vector.y = v.y();
  vector.z = v.z();
  return vector;
}

geometry_msgs::Quaternion toQuaternion(const rod::Quaternion& q) {
  geometry_msgs::Quaternion quaternion;
  quaternion.x = q.x();
  quaternion.y = q.y();
  quaternion.z = q.z();
  quaternion.w = q.w();
  return quaternion;
}

geometry_msgs::Pose toPose(const rod::Pose& pose) {
  geometry_msgs::Pose message;
  message.position = toPoint(pose.position);
  message.orientation = toQuaternion(pose.frame.normalized());
  return message;
}

std_msgs::Header makeHeader(const Snapshot& snapshot, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = snapshot.stamp;
  header.frame_id = frame;
  return header;
}

Relaxation toMessage(const simulation::OrganReport& report) {
  Relaxation message;
  message.reason = toConstant(report.relaxation.reason);
  message.iterations = static_cast<std::uint32_t>(report.relaxation.iterations);
  message.step_iterations = static_cast<std::uint32_t>(report.iterations);
  message.residual = report.relaxation.residual;
  message.lowest_eigenvalue = report.relaxation.lowest_eigenvalue.value_or(0.0);
  message.largest_bend = report.relaxation.largest_bend;
  message.branch_switches = static_cast<std::uint32_t>(report.branch_switches);
  message.substeps = static_cast<std::uint32_t>(report.substeps);
  message.retries = static_cast<std::uint32_t>(report.retries);
  message.divisions = static_cast<std::uint32_t>(report.divisions);
  return message;
}

Checkpoint toMessage(const simulation::Checkpoint& checkpoint, const Snapshot& snapshot, const std::string& frame) {
  Checkpoint message;
  message.header = makeHeader(snapshot, frame);
  message.step_index = snapshot.step_index;
  message.epoch = snapshot.epoch;
  const std::string bytes = simulation::encode(checkpoint);
  message.data.assign(bytes.begin(), bytes.end());
  return message;
}

OrganState toMessage(const OrganSnapshot& organ, const Snapshot& snapshot, const std::string& frame) {
  const rod::Rod& rod = organ.rod;
  OrganState message;
  message.header = makeHeader(snapshot, frame);
  message.organ = organ.id;
  message.step_index = snapshot.step_index;
  message.epoch = snapshot.epoch;
  message.growth_time = snapshot.growth_time;

  message.positions.reserve(rod.vertices.size());
  for (const rod::Vertex& vertex : rod.vertices) message.positions.push_back(toPoint(vertex.position));

  message.rest_arc_length.reserve(rod.vertices.size());
  message.rest_arc_length.push_back(0.0);
  for (const rod::Element& element : rod.elements) {
    message.rest_arc_length.push_back(message.rest_arc_length.back() + element.rest_length);
    message.frames.push_back(toQuaternion(element.frame));
    message.radius.push_back(element.section.radius);
    message.age.push_back(element.age);
    message.strain.push_back(toVector(element.strain));
  }
  message.growth_rate = organ.growth_rates;

  for (const rod::Bend& bend : rod.bends) {
    message.curvature.push_back(toVector(bend.curvature));
    message.rest_curvature.push_back(toVector(bend.rest_curvature));
  }

  message.gravity_cue = toVectors(organ.cues, growth::Cue::gravity);
  message.light_direction_cue = toVectors(organ.cues, growth::Cue::light_direction);
  message.point_source_cue = toVectors(organ.cues, growth::Cue::point_source);
  message.oscillator_cue = toVectors(organ.cues, growth::Cue::oscillator);

  message.tip = toPose(rod.apex());
  message.rest_length = rod.restLength();
  message.length = rod.length();
  message.largest_differential_growth = organ.report.largest_differential_growth;

  message.bending_energy = organ.energy.bending;
  message.stretching_energy = organ.energy.stretching;
  message.load_energy = organ.energy.load;
  message.relaxation = toMessage(organ.report);
  return message;
}

ScheduledStimulus toMessage(const simulation::ScheduledStimulus& scheduled) {
  static_assert(static_cast<int>(ScheduledStimulus::POINT_SOURCE) == static_cast<int>(AppliedCommand::POINT_SOURCE));
  static_assert(static_cast<int>(ScheduledStimulus::LIGHT_DIRECTION) ==
                static_cast<int>(AppliedCommand::LIGHT_DIRECTION));
  const StimulusCommand& stimulus = scheduled.stimulus;
  ScheduledStimulus message;
  message.kind = toConstant(stimulus.kind);
  message.id = stimulus.id;
  message.vector = toVector(stimulus.vector);
  message.strength = stimulus.strength;
  message.begin = scheduled.begin;
  message.duration = stimulus.timing.duration;
  message.period = stimulus.timing.period;
  message.is_on = scheduled.isOn();
  message.next_switch = scheduled.nextSwitch();
  return message;
}

Stimuli toStimuli(const Snapshot& snapshot, const std::string& frame) {
  Stimuli message;
  message.header = makeHeader(snapshot, frame);
  message.step_index = snapshot.step_index;
  message.epoch = snapshot.epoch;
  message.gravity = toVector(snapshot.gravity);
  for (const growth::PointSource& source : snapshot.environment.point_sources) {
    PointSource& lamp = message.point_sources.emplace_back();
    lamp.header = message.header;
    lamp.operation = PointSource::ADD;
    lamp.id = source.id;
    lamp.position = toPoint(source.position);
    lamp.strength = source.strength;
  }
  for (const growth::LightDirection& direction : snapshot.environment.light_directions) {
    LightDirection& light = message.light_directions.emplace_back();
    light.header = message.header;
    light.operation = LightDirection::ADD;
    light.id = direction.id;
    light.towards = toVector(direction.towards);
    light.strength = direction.strength;
  }
  for (const simulation::ScheduledStimulus& scheduled : snapshot.scheduled) {
    message.scheduled.push_back(toMessage(scheduled));
  }
  return message;
}

AppliedCommand toMessage(const simulation::AppliedCommand& applied, const Snapshot& snapshot,
                         const std::string& frame) {
  AppliedCommand message;
  message.header = makeHeader(snapshot, frame);
  message.step_index = applied.step;
  message.epoch = snapshot.epoch;
  std::visit([&message](const auto& command) { fill(message, command); }, applied.command);
  message.accepted = applied.refusal.empty();
  message.refusal = applied.refusal;
  return message;
}

std::optional<StimulusCommand> toCommand(const PointSource& message) {
  return makeCommand(StimulusKind::point_source, message, toEigen(message.position));
}

std::optional<StimulusCommand> toCommand(const LightDirection& message) {
  return makeCommand(StimulusKind::light_direction, message, toEigen(message.towards));
}

StimulusCommand toCommand(const geometry_msgs::PointStamped& message, int number) {
  return {StimulusKind::point_source, StimulusOperation::add, names::kClickedLamp + std::to_string(number),
          toEigen(message.point), 1.0};
}

StimulusCommand toCommand(const geometry_msgs::Vector3Stamped& message) {
  return {StimulusKind::light_direction, StimulusOperation::add, names::kSunLight, toEigen(message.vector), 1.0};
}

std::optional<simulation::Command> toCommand(const AppliedCommand& message) {
  const rod::Vector3 vector = toEigen(message.vector);
  const auto stimulus = [&](StimulusKind kind) -> std::optional<simulation::Command> {
    return makeCommand(kind, message, vector);
  };
  switch (message.kind) {
    case AppliedCommand::POINT_SOURCE:
      return stimulus(StimulusKind::point_source);
    case AppliedCommand::LIGHT_DIRECTION:
      return stimulus(StimulusKind::light_direction);
    case AppliedCommand::PARAMETER:
      return simulation::ParameterCommand{message.id, message.parameter, message.value};
    case AppliedCommand::GRAVITY:
      return simulation::GravityCommand{vector};
    case AppliedCommand::SPAWN_ORGAN:
      return simulation::SpawnCommand{message.organ};
    case AppliedCommand::REMOVE_ORGAN:
      return simulation::RemoveCommand{message.id};
    default:
      return std::nullopt;
  }
}

simulation::ParameterCommand toCommand(const SetParameter::Request& request) {
  return {request.organ, request.name, request.value};
}

simulation::GravityCommand toCommand(const SetGravity::Request& request) { return {toEigen(request.acceleration)}; }

simulation::SpawnCommand toCommand(const SpawnOrgan::Request& request) { return {request.organ}; }

simulation::RemoveCommand toCommand(const RemoveOrgan::Request& request) { return {request.id}; }

}  // namespace sensory_growth::node
