#include "senses_yaml.h"

#include <cmath>
#include <vector>

namespace sensory_growth::simulation {
namespace {

double readLength(YamlReader& in, const std::string& key = "length") {
  return in.quantity(key, dimension::length, above(0));
}

growth::DistanceLaw readConstant(YamlReader&) { return growth::ConstantPull{}; }

growth::DistanceLaw readInversePower(YamlReader& in) {
  return growth::InversePowerPull{readLength(in), in.number("exponent", atLeast(0))};
}

growth::DistanceLaw readExponentialPull(YamlReader& in) { return growth::ExponentialPull{readLength(in)}; }

growth::DistanceLaw readGaussian(YamlReader& in) { return growth::GaussianPull{readLength(in)}; }

growth::DistanceLaw readSampledPull(YamlReader& in) {
  return growth::SampledPull{in.quantities("distances", dimension::length, atLeast(0)),
                             in.numbers("factors", anyNumber)};
}

growth::DistanceLaw readDistanceLaw(YamlReader& in) {
  using ReadLaw = growth::DistanceLaw (*)(YamlReader&);
  const auto read = in.choice<ReadLaw>("law", {{"constant", readConstant},
                                               {"inverse_power", readInversePower},
                                               {"exponential", readExponentialPull},
                                               {"gaussian", readGaussian},
                                               {"sampled", readSampledPull}});
  if (read) return (*read)(in);
  in.ignoreOtherKeys();
  return growth::ConstantPull{};
}

void readSensitivities(YamlReader& in, growth::Senses& senses) {
  senses.gravity = in.number("gravity", anyNumber);
  senses.light_direction = in.number("light_direction", anyNumber);
  senses.point_source = in.number("point_source", anyNumber);
  if (std::abs(senses.point_source) > 0.0 || in.has("softening_length")) {
    senses.softening_length = in.quantity("softening_length", dimension::length, atLeast(0));
  }
  senses.intensity_exponent = in.number("intensity_exponent", above(0).upTo(10), senses.intensity_exponent);
  in.section("distance", kOptional, [&](YamlReader& law) { senses.distance = readDistanceLaw(law); });
  if (!in.faultless()) return;  // the law as a whole is judged by numbers that are read
  if (const auto fault = growth::findFault(senses.distance, senses.softening_length)) in.addProblem("distance", *fault);
}

/// Negative ones turn the other way.
double readPeriod(YamlReader& in) {
  const double period = in.quantity("period", dimension::time, anyNumber);
  if (period == 0.0) in.addProblem("period", "'" + in.text("period") + "' is no period; must not be 0 s");
  return period;
}

void readOscillator(YamlReader& in, OrganScenario& organ) {
  growth::Oscillator& oscillator = organ.senses.oscillator;
  oscillator.amplitude = in.number("amplitude", atLeast(0));
  oscillator.period = readPeriod(in);
  oscillator.phase = in.quantity("phase", dimension::angle, anyNumber, oscillator.phase);
  oscillator.phase_gradient =
      in.quantity("phase_gradient", dimension::angle_gradient, anyNumber, oscillator.phase_gradient);
}

void readRotation(YamlReader& in, OrganScenario& organ) {
  growth::RestRotation rotation;
  rotation.period = readPeriod(in);
  rotation.gate = in.number("gate", atLeast(0).below(1), rotation.gate);
  organ.bending.rotation = rotation;
}

void readCircumnutation(YamlReader& in, OrganScenario& organ) {
  using ReadForm = void (*)(YamlReader&, OrganScenario&);
  const auto read = in.choice<ReadForm>("form", {{"oscillator", readOscillator}, {"rotation", readRotation}});
  if (!read) return in.ignoreOtherKeys();
  (*read)(in, organ);
}

void readProprioception(YamlReader& in, growth::Proprioception& proprioception) {
  if (!in.has("intrinsic_length") && !in.has("actual_length") && !in.has("relaxation_length")) {
    in.addProblem("intrinsic_length", "is missing; give it, 'actual_length' or 'relaxation_length', or several");
  }
  const auto readOr0 = [&](const std::string& key) { return in.quantity(key, dimension::length, atLeast(0), 0.0); };
  proprioception.intrinsic_length = readOr0("intrinsic_length");
  proprioception.actual_length = readOr0("actual_length");
  proprioception.relaxation_length = readOr0("relaxation_length");
  if (!in.has("set_point")) return;
  const std::vector<double> curvatures = in.quantities("set_point", dimension::curvature, anyNumber);
  if (curvatures.size() == 2) {
    proprioception.set_point = {curvatures[0], curvatures[1]};
  } else {
    in.addProblem("set_point", "has " + std::to_string(curvatures.size()) + " components; give two, about d1 and d2");
  }
}

}  // namespace

void readSenses(YamlReader& in, OrganScenario& organ) {
  in.section("sensitivities", kRequired, [&](YamlReader& senses) { readSensitivities(senses, organ.senses); });
  in.section("circumnutation", kOptional,
             [&](YamlReader& circumnutation) { readCircumnutation(circumnutation, organ); });
  in.section("proprioception", kRequired,
             [&](YamlReader& proprioception) { readProprioception(proprioception, organ.bending.proprioception); });
  organ.bending.saturation = in.flag("saturation", organ.bending.saturation);
}

}  // namespace sensory_growth::simulation
