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
    case RelaxationReason::no_time_step:
      return "no_time_step";
  }
  return "?";
}

namespace {

/// What a person can do about it.
const char* advice(const RelaxationReport& report) {
  switch (report.reason) {
    case RelaxationReason::converged:
      return "";
    case RelaxationReason::too_many_iterations:
      return report.in_time ? "; allow more periods, or take a damping nearer to critical"
                            : "; allow more iterations or take shorter steps";
    case RelaxationReason::line_search_failed:
      return "; take shorter steps";
    case RelaxationReason::unstable:
      return report.in_time ? "; a rod in exact balance never leaves it: let the base or the loads lean a little"
                            : "; take shorter steps or allow more branch switches";
    case RelaxationReason::unresolved_bend:
      return "; use shorter elements";
    case RelaxationReason::out_of_reach:
      return "; the rod cannot meet its rigid walls or the place where its apex is held";
    case RelaxationReason::not_finite:
      return report.in_time ? "; a length, force or curvature is not a number, or the time step is too long"
                            : "; a length, force or curvature is not a number";
    case RelaxationReason::no_time_step:
      return "; elements that are inextensible or have no mass need static relaxation";
  }
  return "";
}

}  // namespace

std::string describe(const RelaxationReport& report) {
  std::ostringstream out;
  out << name(report.reason) << " after " << report.iterations;
  if (report.in_time) {
    out << " time steps (" << report.time << " s), kinetic energy " << report.kinetic_energy << " J";
  } else {
    out << " Newton iterations";
  }
  out << ", scaled residual " << report.residual;
  if (!report.ok()) out << " at element " << report.worst_element;
  out << ", ";
  if (report.lowest_eigenvalue) out << "lowest eigenvalue " << *report.lowest_eigenvalue << " N m, ";
  out << report.branch_switches << " branch switches, "
      << (report.load_steps > 0 ? std::to_string(report.load_steps) + " load steps, " : "")
      << "largest turn between elements " << report.largest_bend << " rad" << advice(report);
  return out.str();
}

}  // namespace sensory_growth::mechanics
