#include "sensory_growth/simulation/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <regex>
#include <stdexcept>
#include <system_error>

#include <udunits2.h>

namespace sensory_growth::simulation {
namespace {

using System = std::unique_ptr<ut_system, decltype(&ut_free_system)>;
using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

constexpr const char* kBlanks = " \t";

/// Each with other base units: a stiffness is a force per length, a couple has the units of an energy.
constexpr std::array kDistinctDimensions{dimension::length,     dimension::time,      dimension::rate,
                                         dimension::angle,      dimension::curvature, dimension::acceleration,
                                         dimension::modulus,    dimension::density,   dimension::force,
                                         dimension::line_force, dimension::energy,    dimension::angle_gradient};

/// Products and quotients of named units with small powers, "1" only as the first numerator. This leaves out what
/// udunits2 also reads: factors ("mm 2"), origins ("K @ 273"), logarithms and dates.
bool isPlainUnit(const std::string& text) {
  static const std::string unit = R"((?:(?:µ|μ)?[A-Za-z_]+|%|°)(?:\^?-?[1-9])?)";
  static const std::regex plain("(?:1|" + unit + ")(?: *[/*. ] *" + unit + ")*");
  constexpr std::size_t kLongestNumber = 64;  // std::regex recurses once per character
  return text.size() <= kLongestNumber && std::regex_match(text, plain);
}

/// Null if the text is no unit.
Unit parse(ut_system* system, const std::string& text) {
  return {isPlainUnit(text) ? ut_parse(system, text.c_str(), UT_UTF8) : nullptr, ut_free};
}

System readDatabase() {
  ut_set_error_message_handler(ut_ignore);  // the callers report; the library would write to stderr
  System system(ut_read_xml(nullptr), ut_free_system);
  if (!system) {
    throw std::runtime_error(
        "udunits2 cannot read its database of units; install libudunits2-data, or check the environment variable "
        "UDUNITS2_XML_PATH if it is set");
  }
  const Unit degree = parse(system.get(), "degree");
  ut_map_name_to_unit("deg", UT_ASCII, degree.get());  // udunits2 knows "degree" and the sign, not the usual "deg"
  return system;
}

ut_system* unitSystem() {
  static const System system = readDatabase();
  return system.get();
}

/// Base units and their powers without the factor, such as "m-1.kg.s-2". Units that agree in them differ by a factor;
/// ut_are_convertible() would also let reciprocals pass, and plain numbers as angles.
std::string baseUnits(const ut_unit* unit) {
  std::array<char, 256> buffer;
  const int size = ut_format(unit, buffer.data(), buffer.size(), UT_ASCII | UT_DEFINITION);
  if (size < 0 || static_cast<std::size_t>(size) >= buffer.size()) return "?";
  const std::string definition(buffer.data(), static_cast<std::size_t>(size));
  if (!std::isdigit(static_cast<unsigned char>(definition[0]))) return definition;
  const std::size_t blank = definition.find(' ');
  return blank == std::string::npos ? "1" : definition.substr(blank + 1);
}

/// What a unit measures, for people.
std::string describe(ut_system* system, const ut_unit* unit) {
  const std::string base = baseUnits(unit);
  if (base == "1") return "a number without a dimension";
  for (const Dimension& dimension : kDistinctDimensions) {
    if (baseUnits(parse(system, dimension.unit).get()) == base) return dimension.name;
  }
  return "in units of " + base;
}

std::string request(const Dimension& dimension) {
  return std::string("; give ") + dimension.name + " such as '" + dimension.example + "'";
}

}  // namespace

double parseNumber(const std::string& text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';  // from_chars() takes no plus
  const char* begin = text.data() + (has_plus ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0.0;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ec == std::errc::invalid_argument || result.ptr != end)
    throw std::invalid_argument("is not a number without a unit");
  if (result.ec == std::errc::result_out_of_range) throw std::invalid_argument("is beyond the range of numbers");
  if (!std::isfinite(value)) throw std::invalid_argument("is not a finite number");
  return value;
}

double parseQuantity(const std::string& text, const Dimension& dimension) {
  const std::size_t number_end = std::min(text.find_first_of(kBlanks), text.size());
  const std::size_t unit_begin = std::min(text.find_first_not_of(kBlanks, number_end), text.size());
  const std::string unit_text = text.substr(unit_begin);

  double number = 0.0;
  try {
    number = parseNumber(text.substr(0, number_end));
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument("does not begin with a finite number and a blank" + request(dimension));
  }
  if (unit_text.empty()) throw std::invalid_argument("has no unit" + request(dimension));

  static std::mutex mutex;  // udunits2 does not promise to be thread-safe
  const std::lock_guard<std::mutex> lock(mutex);
  ut_system* system = unitSystem();
  const Unit unit = parse(system, unit_text);
  if (!unit) throw std::invalid_argument("has the unknown unit '" + unit_text + "'" + request(dimension));
  const Unit si_unit = parse(system, dimension.unit);
  if (baseUnits(unit.get()) != baseUnits(si_unit.get())) {
    throw std::invalid_argument("is " + describe(system, unit.get()) + request(dimension));
  }
  const Converter converter(ut_get_converter(unit.get(), si_unit.get()), cv_free);
  const double value = cv_convert_double(converter.get(), number);
  if (!std::isfinite(value)) throw std::invalid_argument("is beyond the range of numbers");
  return value;
}

}  // namespace sensory_growth::simulation
