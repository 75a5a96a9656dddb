/// Cases that no scenario can hold, on the library itself. Prints the measured figure and nothing else.

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <limits>

#include "sensory_growth/mechanics/static_equilibrium.h"

namespace {

using namespace sensory_growth;

/// V7: a unit cantilever along x that is sixteen times as stiff up to its middle, under a force of 0.05 N at its tip.
/// Height of the tip [m].
double steppedCantilever(std::size_t elements) {
  constexpr double kRadius = 0.05;
  const double unit_modulus = 4.0 / (M_PI * std::pow(kRadius, 4));  // E I = 1
  rod::Section section{kRadius, unit_modulus, unit_modulus / 3.0, 1.0};
  section.inextensible = true;
  const rod::Pose base{rod::Vector3::Zero(),
                       rod::Quaternion::FromTwoVectors(rod::Vector3::UnitZ(), rod::Vector3::UnitX())};
  rod::Rod rod = rod::straightRod(base, 1.0, elements, section);
  for (std::size_t e = 0; e < elements / 2; ++e) rod.elements[e].section.young_modulus *= 16.0;
  mechanics::Loads loads;
  loads.tip_force = {0.0, 0.0, -0.05};
  mechanics::StaticEquilibrium().relax(rod, loads);
  return rod.vertices.back().position.z();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Cases of docs/validation.md that no scenario can hold, on the library itself.");
  app.require_subcommand(1);
  std::size_t elements = 0;
  CLI::App* stepped = app.add_subcommand("stepped_cantilever", "V7: height of the tip [m]");
  stepped->add_option("elements", elements, "even, so that the jump is at a vertex")
      ->required()
      ->check(CLI::Range(2, 100000));
  CLI11_PARSE(app, argc, argv);
  std::cout << std::setprecision(std::numeric_limits<double>::max_digits10) << steppedCantilever(elements) << '\n';
  return EXIT_SUCCESS;
}
