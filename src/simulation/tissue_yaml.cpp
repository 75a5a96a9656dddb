#include "tissue_yaml.h"

#include <string>

namespace sensory_growth::simulation {
namespace {

double readRate(YamlReader& in) { return in.quantity("rate", dimension::rate, atLeast(0)); }
double readZoneLength(YamlReader& in) { return in.quantity("zone_length", dimension::length, above(0)); }

growth::Profile readLogistic(YamlReader& in) {
  return growth::LogisticProfile{readRate(in), readZoneLength(in), in.number("steepness", above(0))};
}

growth::Profile readUniform(YamlReader& in) { return growth::UniformProfile{readRate(in)}; }

growth::Profile readApicalFlat(YamlReader& in) { return growth::ApicalFlatProfile{readRate(in), readZoneLength(in)}; }

}  // namespace

void readMaterial(YamlReader& in, RelaxationMethod relaxation, rod::Section& section) {
  section.young_modulus = in.quantity("young_modulus", dimension::modulus, above(0));
  enum class Given { poisson_ratio, shear_modulus };
  const auto given =
      in.exactlyOneOf<Given>({{"poisson_ratio", Given::poisson_ratio}, {"shear_modulus", Given::shear_modulus}});
  if (given == Given::poisson_ratio) {
    section.shear_modulus = section.young_modulus / (2.0 * (1.0 + in.number("poisson_ratio", above(-1).upTo(0.5))));
  } else if (given == Given::shear_modulus) {
    section.shear_modulus = in.quantity("shear_modulus", dimension::modulus, above(0));
  }
  section.density = in.quantity("density", dimension::density, above(0));
  section.shear_correction = in.number("shear_correction", above(0).upTo(1), section.shear_correction);
  section.inextensible = in.flag("inextensible", section.inextensible);
  const bool in_time = relaxation == RelaxationMethod::dynamics || relaxation == RelaxationMethod::continuous;
  if (section.inextensible && in_time) {
    in.addProblem("inextensible", "'true' needs static relaxation: no time step is short enough for it; give false");
  }
}

void readGrowth(YamlReader& in, OrganScenario& organ) {
  organ.elongation = in.flag("elongation", organ.elongation);
  using ReadProfile = growth::Profile (*)(YamlReader&);
  const auto read = in.choice<ReadProfile>(
      "profile", {{"logistic", readLogistic}, {"uniform", readUniform}, {"apical_flat", readApicalFlat}});
  if (!read) return in.ignoreOtherKeys();
  organ.profile = (*read)(in);
}

void readDivision(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ) {
  organ.longest_element = in.quantity("longest_element", dimension::length, above(0).orInfinity());
  if (organ.length / organ.longest_element > kMostElements) {
    in.addProblem("longest_element", "would divide the organ into more than " + std::to_string(kMostElements) +
                                         " elements; give a longer one");
  }
  const auto mode = in.choice<rod::DivisionMode>(
      "mode", {{"keep_strain", rod::DivisionMode::keep_strain}, {"keep_positions", rod::DivisionMode::keep_positions}},
      organ.division);
  if (!mode) return;
  organ.division = *mode;
  if (mode == rod::DivisionMode::keep_positions && relaxation == RelaxationMethod::kinematics) {
    in.addProblem(
        "mode", "'keep_positions' leaves a strain defect that kinematic relaxation never removes; give 'keep_strain'");
  }
}

}  // namespace sensory_growth::simulation
