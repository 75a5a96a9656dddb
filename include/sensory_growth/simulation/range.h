#pragma once

#include <limits>
#include <string>

namespace sensory_growth::simulation {

/// Values that a number may take, in SI. NaN is in no range; infinity only after orInfinity(), which says how to write
/// it.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool includes_low = true;
  bool includes_high = true;
  const char* infinity = nullptr;  ///< the word for it; null if it is out of range

  constexpr Range upTo(double value) const { return {low, value, includes_low, true, infinity}; }
  constexpr Range below(double value) const { return {low, value, includes_low, false, infinity}; }
  constexpr Range orInfinity(const char* word = "inf") const { return {low, high, includes_low, includes_high, word}; }

  bool contains(double value) const;
  std::string describe(const char* unit) const;  ///< such as "must be > 0 m or inf"
};

inline constexpr Range anyNumber{};
constexpr Range above(double value) { return {value, anyNumber.high, false, true, nullptr}; }
constexpr Range atLeast(double value) { return {value, anyNumber.high, true, true, nullptr}; }

}  // namespace sensory_growth::simulation
