#pragma once

/// How cereal takes the parts of a state: field by field, in a fixed order, each number as it is in memory. A change
/// here is a change of the format (kCheckpointFormat).

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <cereal/cereal.hpp>

#include "sensory_growth/simulation/simulation_state.h"

namespace cereal {

namespace rod = sensory_growth::rod;
namespace growth = sensory_growth::growth;
namespace mechanics = sensory_growth::mechanics;
namespace simulation = sensory_growth::simulation;

/// As a byte, because not every byte is a bool.
template <typename Archive>
void archiveFlag(Archive& archive, bool& flag) {
  std::uint8_t byte = flag ? 1 : 0;
  archive(byte);
  if constexpr (Archive::is_loading::value) flag = byte != 0;
}

template <typename Archive, typename Items>
void saveItems(Archive& archive, const Items& items) {
  archive(static_cast<std::uint64_t>(items.size()));
  for (const auto& item : items) archive(item);
}

/// Takes memory only as the items come, so that a count that is not true ends with the bytes.
template <typename Archive, typename Items>
void loadItems(Archive& archive, Items& items) {
  std::uint64_t count = 0;
  archive(count);
  items.clear();
  for (; count > 0; --count) {
    typename Items::value_type item{};
    archive(item);
    items.push_back(std::move(item));
  }
}

template <typename Archive>
void save(Archive& archive, const std::string& text) {
  saveItems(archive, text);
}

template <typename Archive>
void load(Archive& archive, std::string& text) {
  loadItems(archive, text);
}

template <typename Archive, typename Item>
void save(Archive& archive, const std::vector<Item>& items) {
  saveItems(archive, items);
}

template <typename Archive, typename Item>
void load(Archive& archive, std::vector<Item>& items) {
  loadItems(archive, items);
}

template <typename Archive>
void serialize(Archive& archive, Eigen::Vector2d& vector) {
  archive(vector.x(), vector.y());
}

template <typename Archive>
void serialize(Archive& archive, rod::Vector3& vector) {
  archive(vector.x(), vector.y(), vector.z());
}

template <typename Archive>
void serialize(Archive& archive, rod::Quaternion& q) {
  archive(q.w(), q.x(), q.y(), q.z());
}

template <typename Archive>
void serialize(Archive& archive, rod::Pose& pose) {
  archive(pose.position, pose.frame);
}

template <typename Archive>
void serialize(Archive& archive, rod::Section& section) {
  archive(section.radius, section.young_modulus, section.shear_modulus, section.density, section.shear_correction);
  archiveFlag(archive, section.inextensible);
}

template <typename Archive>
void serialize(Archive& archive, rod::Element& element) {
  archive(element.rest_length, element.reference_length, element.section, element.age, element.strain,
          element.rest_strain, element.frame, element.angular_velocity);
}

template <typename Archive>
void serialize(Archive& archive, rod::Bend& bend) {
  archive(bend.curvature, bend.rest_curvature);
}

template <typename Archive>
void serialize(Archive& archive, rod::Vertex& vertex) {
  archive(vertex.position, vertex.label, vertex.velocity);
}

template <typename Archive>
void serialize(Archive& archive, rod::Rod& rod) {
  archive(rod.base, rod.base_support, rod.elements, rod.bends, rod.vertices);
}

template <typename Archive>
void serialize(Archive& archive, growth::MemorySample& sample) {
  archive(sample.time, sample.labels, sample.sensed, sample.states);
}

template <typename Archive>
void serialize(Archive& archive, growth::PointSource& source) {
  archive(source.id, source.position, source.strength, source.velocity);
}

template <typename Archive>
void serialize(Archive& archive, growth::LightDirection& light) {
  archive(light.id, light.towards, light.strength);
}

template <typename Archive>
void serialize(Archive& archive, simulation::StimulusTiming& timing) {
  archive(timing.start, timing.duration, timing.period);
}

template <typename Archive>
void serialize(Archive& archive, simulation::StimulusCommand& command) {
  archive(command.kind, command.operation, command.id, command.vector, command.strength, command.timing);
}

template <typename Archive>
void serialize(Archive& archive, simulation::ScheduledStimulus& scheduled) {
  archive(scheduled.stimulus, scheduled.begin, scheduled.switches);
}

template <typename Archive>
void serialize(Archive& archive, simulation::Birth& birth) {
  archive(birth.id, birth.organ, birth.gravity);
}

/// An eigenvalue that was not measured is NaN.
template <typename Archive>
void archiveEigenvalue(Archive& archive, std::optional<double>& eigenvalue) {
  double value = eigenvalue.value_or(std::numeric_limits<double>::quiet_NaN());
  archive(value);
  if constexpr (Archive::is_loading::value)
    eigenvalue = std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

template <typename Archive>
void serialize(Archive& archive, mechanics::RelaxationReport& report) {
  archive(report.reason, report.iterations, report.residual);
  archiveEigenvalue(archive, report.lowest_eigenvalue);
  archive(report.worst_element, report.branch_switches, report.load_steps, report.largest_bend);
  archiveFlag(archive, report.in_time);
  archive(report.time, report.kinetic_energy);
}

template <typename Archive>
void serialize(Archive& archive, simulation::OrganReport& report) {
  archive(report.fault, report.relaxation, report.substeps, report.retries, report.iterations, report.branch_switches,
          report.divisions, report.largest_differential_growth);
}

template <typename Archive>
void save(Archive& archive, const simulation::ElasticResponse& response) {
  archive(response.trend(), response.amplification());
}

template <typename Archive>
void load(Archive& archive, simulation::ElasticResponse& response) {
  std::vector<rod::Vector3> trend;
  double amplification = 0.0;
  archive(trend, amplification);
  response = simulation::ElasticResponse(std::move(trend), amplification);
}

template <typename Archive>
void serialize(Archive& archive, simulation::OrganMoment& moment) {
  archive(moment.rod, moment.response);
  archiveFlag(archive, moment.weight_changed);
  archive(moment.report);
}

template <typename Archive>
void serialize(Archive& archive, simulation::ParameterValue& parameter) {
  archive(parameter.name, parameter.value);
}

template <typename Archive>
void serialize(Archive& archive, simulation::OrganState& organ) {
  archive(organ.id, organ.moment, organ.memories, organ.parameters);
}

template <typename Archive>
void serialize(Archive& archive, simulation::SimulationState& state) {
  archive(state.step_index, state.gravity);
  archiveFlag(archive, state.gravity_changed);
  archive(state.point_sources, state.light_directions, state.scheduled, state.organs, state.births,
          state.source_velocities);
}

}  // namespace cereal
