#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace sensory_growth::batch {

/// What was asked for cannot be begun: everything that is wrong with it.
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(const std::string& problem) : BadInput(std::vector<std::string>{problem}) {}

  /// what() lists the problems, a line each; at least one.
  explicit BadInput(const std::vector<std::string>& problems);
};

/// A problem with a parameter of the node ("~growth_time_scale is ...") in terms of the command line
/// ("--growth-time-scale is ..."); others as they are.
std::string asOption(std::string problem);

}  // namespace sensory_growth::batch
