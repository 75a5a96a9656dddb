#pragma once

/// What an organ carries from one step to the next.

#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/growth/memory.h"
#include "sensory_growth/rod/rod.h"
#include "sensory_growth/simulation/elastic_response.h"
#include "sensory_growth/simulation/organ_report.h"

namespace sensory_growth::simulation {

/// What a step changes of an organ, and what is put back when it fails.
struct OrganMoment {
  rod::Rod rod;
  ElasticResponse response;
  bool weight_changed = false;  ///< since the last relaxation
  OrganReport report;           ///< of the step that led here
};

/// Why no organ is ever like this between two steps, or nothing.
std::optional<std::string> findFault(const OrganMoment& moment);

/// A parameter that may change while the organ grows, with the value it has.
struct ParameterValue {
  std::string name;    ///< one of parameters() (simulation/parameters.h)
  double value = 0.0;  ///< in SI
};

/// All that decides how an organ goes on, beside its scenario and what it senses.
struct OrganState {
  std::string id;
  OrganMoment moment;
  std::vector<growth::History> memories;   ///< of its perception
  std::vector<ParameterValue> parameters;  ///< of those that it has, in the order of parameters()
};

}  // namespace sensory_growth::simulation
