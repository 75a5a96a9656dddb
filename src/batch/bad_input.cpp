#include "sensory_growth/batch/bad_input.h"

#include <algorithm>

namespace sensory_growth::batch {
namespace {

std::string lines(const std::vector<std::string>& problems) {
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + asOption(problem);
  return text;
}

}  // namespace

BadInput::BadInput(const std::vector<std::string>& problems) : std::runtime_error(lines(problems)) {}

std::string asOption(std::string problem) {
  if (problem.empty() || problem.front() != '~') return problem;
  const auto name_end = std::find(problem.begin(), problem.end(), ' ');
  std::replace(problem.begin(), name_end, '_', '-');
  return problem.replace(0, 1, "--");
}

}  // namespace sensory_growth::batch
