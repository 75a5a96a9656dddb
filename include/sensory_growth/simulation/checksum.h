#pragma once

/// One number that stands for the state of a simulation, so that two runs can be compared step by step.

#include <cstdint>
#include <string>

#include "sensory_growth/growth/environment.h"
#include "sensory_growth/rod/rod.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::simulation {

/// Every bit of what is added counts, in its order: 64 bits of XXH3. The same on all machines that store the lowest
/// byte first.
class Checksum {
 public:
  void add(double value) { addBytes(&value, sizeof value); }
  void add(std::uint64_t value) { addBytes(&value, sizeof value); }
  void add(const std::string& text);
  void add(const rod::Vector3& vector) { addBytes(vector.data(), 3 * sizeof(double)); }
  void add(const rod::Quaternion& quaternion) { addBytes(quaternion.coeffs().data(), 4 * sizeof(double)); }

  /// All fields of all its parts.
  void add(const rod::Rod& rod);
  void add(const growth::Environment& environment);

  std::uint64_t value() const;

 private:
  void addBytes(const void* bytes, std::size_t count) { bytes_.append(static_cast<const char*>(bytes), count); }
  void add(const rod::Section& section);

  std::string bytes_;
};

/// Of the step index, gravity, what all organs sense, and of every organ its rod and the values of the parameters that
/// may change while it grows. What organs remember of their cues shows in the steps that follow.
std::uint64_t checksum(const Simulation& simulation);

}  // namespace sensory_growth::simulation
