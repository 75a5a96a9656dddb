#pragma once

/// Throws of the dice, and how they are written in YAML.

#include <cmath>
#include <cstddef>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace sensory_growth::support {

/// The same throws for the same seed.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double logBetween(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  template <typename Value>
  const Value& pick(const std::vector<Value>& values) {
    return values[static_cast<std::size_t>(count(0, static_cast<int>(values.size()) - 1))];
  }

 private:
  std::mt19937 random_;
};

/// A number with its unit in YAML.
inline std::string si(double value, const std::string& unit) {
  std::ostringstream text;
  text.precision(9);
  text << value << (unit.empty() ? "" : " ") << unit;
  return text.str();
}

inline std::string vectorOf(Dice& dice, double largest, const std::string& unit) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += (i ? ", " : "[") + si(dice.between(-largest, largest), unit);
  return text + "]";
}

/// Nowhere near zero length.
inline std::string directionOf(Dice& dice) {
  return "[" + si(dice.between(-1.0, 1.0), "") + ", " + si(dice.between(-1.0, 1.0), "") + ", " +
         si(dice.pick<double>({-1.0, 1.0}), "") + "]";
}

/// A sequence of numbers of one unit.
inline std::string list(const std::vector<double>& values, const std::string& unit) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + si(value, unit);
  return text + "]";
}

/// 1 to 4 numbers that rise from `first` by steps of up to `step`.
inline std::vector<double> rising(Dice& dice, double first, double step, int fewest = 1) {
  std::vector<double> values{first};
  while (static_cast<int>(values.size()) < fewest || dice.chance(0.5)) {
    values.push_back(values.back() + step * dice.between(0.1, 1.0));
    if (values.size() == 4) break;
  }
  return values;
}

inline std::vector<double> numbers(Dice& dice, std::size_t count, double low, double high) {
  std::vector<double> values(count);
  for (double& value : values) value = dice.between(low, high);
  return values;
}

}  // namespace sensory_growth::support
