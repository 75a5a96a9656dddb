#include "tissue_yaml.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensory_growth::simulation {
namespace {

double readRate(YamlReader& in) { return in.quantity("rate", dimension::rate, atLeast(0)); }
double readZoneLength(YamlReader& in) { return in.quantity("zone_length", dimension::length, above(0)); }

growth::Profile readLogistic(YamlReader& in) {
  return growth::LogisticProfile{readRate(in), readZoneLength(in), in.number("steepness", above(0))};
}

growth::Profile readUniform(YamlReader& in) { return growth::UniformProfile{readRate(in)}; }

growth::Profile readApicalFlat(YamlReader& in) { return growth::ApicalFlatProfile{readRate(in), readZoneLength(in)}; }

growth::Profile readApicalGaussian(YamlReader& in) {
  return growth::ApicalGaussianProfile{readRate(in), readZoneLength(in)};
}

growth::Profile readSampledProfile(YamlReader& in) {
  const std::vector<double> distances = in.quantities("distances", dimension::length, atLeast(0));
  const std::vector<double> rates = in.quantities("rates", dimension::rate, atLeast(0));
  const auto is_read = [](const std::vector<double>& values) {
    return !values.empty() && std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
  };
  if (!is_read(distances) || !is_read(rates)) return growth::UniformProfile{};
  try {
    return growth::SampledProfile(distances, rates);
  } catch (const std::invalid_argument& fault) {
    in.addProblem("distances", fault.what());
    return growth::UniformProfile{};
  }
}

growth::StressCoupling readStressCoupling(YamlReader& in) {
  growth::StressCoupling coupling;
  coupling.yield_margin = in.quantity("yield_margin", dimension::stress, above(0));
  coupling.largest_factor = in.number("largest_factor", atLeast(1).orInfinity(), coupling.largest_factor);
  coupling.sign = in.choice<double>("lockhart_sign", {{"1", 1.0}, {"-1", -1.0}}, coupling.sign).value_or(1.0);
  return coupling;
}

growth::Maturation readMaturation(YamlReader& in, const std::string& mature, const Dimension& dimension) {
  growth::Maturation maturation;
  maturation.mature = in.quantity(mature, dimension, above(0));
  maturation.time = in.quantity("time", dimension::time, above(0));
  return maturation;
}

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

void readGrowth(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ) {
  organ.elongation = in.flag("elongation", organ.elongation);
  using growth::TwistTransport;
  organ.twist_transport =
      in.choice<TwistTransport>("twist_transport", {{"angle", TwistTransport::angle}, {"rate", TwistTransport::rate}},
                                organ.twist_transport)
          .value_or(organ.twist_transport);
  in.section("stress_coupling", kOptional,
             [&](YamlReader& coupling) { organ.stress_coupling = readStressCoupling(coupling); });
  if (organ.stress_coupling && relaxation == RelaxationMethod::kinematics) {
    in.addProblem("stress_coupling", "has no effect with kinematic relaxation, which knows no stress; leave it out");
  }
  if (organ.stress_coupling && organ.section.inextensible) {
    in.addProblem("stress_coupling", "needs tissue that stretches under stress; give material.inextensible false");
  }
  using ReadProfile = growth::Profile (*)(YamlReader&);
  const auto read = in.choice<ReadProfile>("profile", {{"logistic", readLogistic},
                                                       {"uniform", readUniform},
                                                       {"apical_flat", readApicalFlat},
                                                       {"apical_gaussian", readApicalGaussian},
                                                       {"sampled", readSampledProfile}});
  if (!read) return in.ignoreOtherKeys();
  organ.profile = (*read)(in);
}

growth::Aging readAging(YamlReader& in, RelaxationMethod relaxation) {
  using growth::AgingClock;
  growth::Aging aging;
  aging.clock = in.choice<AgingClock>("clock", {{"maturation", AgingClock::maturation}, {"time", AgingClock::time}})
                    .value_or(aging.clock);
  in.section("stiffening", kOptional, [&](YamlReader& stiffening) {
    aging.young_modulus = readMaturation(stiffening, "mature_modulus", dimension::modulus);
  });
  in.section("thickening", kOptional, [&](YamlReader& thickening) {
    aging.radius = readMaturation(thickening, "mature_radius", dimension::length);
  });
  if (!in.has("stiffening") && !in.has("thickening")) {
    in.addProblem("stiffening", "is missing, and so is 'thickening'; give one of them or leave 'aging' out");
  }
  if (aging.young_modulus && relaxation == RelaxationMethod::kinematics) {
    in.addProblem("stiffening", "has no effect with kinematic relaxation, which knows no stiffness; leave it out");
  }
  return aging;
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
