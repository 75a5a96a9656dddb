#include "sensory_growth/simulation/scenario_error.h"

#include <algorithm>
#include <utility>

namespace sensory_growth::simulation {
namespace {

std::vector<Problem> sortedByLine(std::vector<Problem> problems) {
  std::stable_sort(problems.begin(), problems.end(),
                   [](const Problem& a, const Problem& b) { return a.line < b.line; });
  return problems;
}

std::string listOf(const std::string& source, const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += source + ":";
    if (problem.line > 0) text += std::to_string(problem.line) + ":";
    if (!problem.key.empty()) text += " " + problem.key + ":";
    text += " " + problem.message;
  }
  return text;
}

}  // namespace

ScenarioError::ScenarioError(const std::string& source, std::vector<Problem> problems)
    : std::runtime_error(listOf(source, sortedByLine(problems))), problems_(sortedByLine(std::move(problems))) {}

}  // namespace sensory_growth::simulation
