#include "sensory_growth/mechanics/relaxation.h"

#include <sstream>

namespace sensory_growth::mechanics {

const char* name(RelaxationReason reason) {
  switch (reason) {
    case RelaxationReason::converged:
      return "converged";
    case RelaxationReason::too_many_iterations:
      return "too_many_iterations";
    case RelaxationReason::line_search_failed:
      return "line_search_failed";
    case RelaxationReason::unstable:
      return "unstable";
    case RelaxationReason::unresolved_bend:
      return "unresolved_bend";
    case RelaxationReason::out_of_reach:
      return "out_of_reach";
    case RelaxationReason::not_finite:
      return "not_finite";
  }
  return "?";
}

namespace {

/// What a person can do about it.
const char* advice(RelaxationReason reason) {
  switch (reason) {
    case RelaxationReason::converged:
      return "";
    case RelaxationReason::too_many_iterations:
      return "; allow more iterations or take shorter steps";
    case RelaxationReason::line_search_failed:
      return "; take shorter steps";
    case RelaxationReason::unstable:
      return "; take shorter steps or allow more branch switches";
    case RelaxationReason::unresolved_bend:
      return "; use shorter elements";
    case RelaxationReason::out_of_reach:
      return "; the rod cannot meet its rigid walls or the place where its apex is held";
    case RelaxationReason::not_finite:
      return "; a length, force or curvature is not a number";
  }
  return "";
}

}  // namespace

std::string describe(const RelaxationReport& report) {
  std::ostringstream out;
  out << name(report.reason) << " after " << report.iterations << " Newton iterations, scaled residual "
      << report.residual << ", lowest eigenvalue " << report.lowest_eigenvalue << " N m, " << report.branch_switches
      << " branch switches, " << (report.load_steps > 0 ? std::to_string(report.load_steps) + " load steps, " : "")
      << "largest turn between elements " << report.largest_bend << " rad" << advice(report.reason);
  return out.str();
}

}  // namespace sensory_growth::mechanics
