#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace sensory_growth::simulation {

/// One thing wrong with a file.
struct Problem {
  std::string key;      ///< path of the value, such as "organs[0].growth.rate"; empty for the file as a whole
  int line = 0;         ///< from 1; 0 if there is no line to show
  std::string message;  ///< names the value and what is allowed
};

/// All problems of a file at once, in order of line; what() lists them, a line each, as "file:line: key: message".
class ScenarioError : public std::runtime_error {
 public:
  /// `source` names the file.
  ScenarioError(const std::string& source, std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace sensory_growth::simulation
