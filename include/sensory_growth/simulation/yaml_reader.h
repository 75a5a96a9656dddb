#pragma once

/// Strict reading of YAML mappings: every key is asked for once, with its type, unit and range; what is wrong, and what
/// was never asked for, is collected.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "sensory_growth/rod/rotations.h"
#include "sensory_growth/simulation/range.h"
#include "sensory_growth/simulation/scenario_error.h"
#include "sensory_growth/simulation/units.h"

namespace sensory_growth::simulation {

enum class Presence { required, optional };
inline constexpr auto kRequired = Presence::required;
inline constexpr auto kOptional = Presence::optional;

/// Named values that a key, or a choice of keys, stands for.
template <typename Value>
using Options = std::vector<std::pair<std::string, Value>>;

/// The keys of one mapping. A key is required if it is read without a fallback. Where a value is wrong or missing, the
/// problem is noted and a value is returned that has no meaning (numbers are NaN, text is empty), so that reading goes
/// on and finds the other problems.
class YamlReader {
 public:
  using Body = std::function<void(YamlReader&)>;
  using Lines = std::map<std::string, int>;  ///< of words, where each stood first

  YamlReader(const YAML::Node& mapping, std::string path, std::vector<Problem>& problems);

  std::string text(const std::string& key, const std::optional<std::string>& fallback = {});
  std::string identifier(const std::string& key);  ///< a letter, then letters, digits, '_'

  /// The same, refused if it is among those `given` before.
  std::string uniqueIdentifier(const std::string& key, Lines& given);

  bool flag(const std::string& key, std::optional<bool> fallback = {});
  int count(const std::string& key, int low, int high, std::optional<int> fallback = {});
  double number(const std::string& key, const Range& range, std::optional<double> fallback = {});
  double quantity(const std::string& key, const Dimension& dimension, const Range& range,
                  std::optional<double> fallback = {});                     ///< in SI
  std::vector<double> numbers(const std::string& key, const Range& range);  ///< one or more
  std::vector<double> quantities(const std::string& key, const Dimension& dimension,
                                 const Range& range);                                           ///< one or more, in SI
  std::vector<std::vector<double>> matrix(const std::string& key, const Dimension& dimension);  ///< rows, in SI
  rod::Vector3 vector(const std::string& key, const Dimension& dimension,
                      std::optional<rod::Vector3> fallback = {});  ///< in SI
  rod::Vector3 direction(const std::string& key);                  ///< of unit length

  /// The value of the option that the key names; nothing if it names none.
  template <typename Value>
  std::optional<Value> choice(const std::string& key, const Options<Value>& options,
                              std::optional<Value> fallback = {}) {
    if (fallback && !has(key)) return fallback;
    const std::optional<std::size_t> i = indexOfChoice(key, names(options));
    return i ? std::optional<Value>(options[*i].second) : std::nullopt;
  }

  /// The values of the options that a sequence names, one or more; without those that are not known.
  template <typename Value>
  std::vector<Value> choices(const std::string& key, const Options<Value>& options) {
    std::vector<Value> values;
    for (const std::size_t i : indicesOfChoices(key, names(options))) values.push_back(options[i].second);
    return values;
  }

  /// The value of the one option whose name is a key of this mapping; nothing, and a problem, if none or several are.
  template <typename Value>
  std::optional<Value> exactlyOneOf(const Options<Value>& options) {
    const std::optional<std::size_t> i = indexOfOnlyKey(names(options));
    return i ? std::optional<Value>(options[*i].second) : std::nullopt;
  }

  void section(const std::string& key, Presence presence, const Body& body);  ///< a mapping
  void list(const std::string& key, Presence presence, const Body& body);     ///< of mappings; if required, not empty

  bool has(const std::string& key);                     ///< also makes the key a known one
  int line(const std::string& key) const;               ///< of its value, or of the mapping if there is none
  bool faultless() const { return problems_.empty(); }  ///< nothing wrong with the whole file so far

  /// Notes what is wrong with the value of the key.
  void addProblem(const std::string& key, const std::string& message);

  /// For a mapping of unknown kind, whose other keys cannot be judged.
  void ignoreOtherKeys();

  /// Ends the reading of this mapping. section(), list() and readYaml() call it.
  void reportUnknownKeys();

 private:
  struct Entry {
    std::string key;
    int line;
    YAML::Node value;
  };

  template <typename Value>
  static std::vector<std::string> names(const Options<Value>& options) {
    std::vector<std::string> names;
    for (const auto& option : options) names.push_back(option.first);
    return names;
  }

  std::optional<std::size_t> indexOfChoice(const std::string& key, const std::vector<std::string>& names);
  std::vector<std::size_t> indicesOfChoices(const std::string& key, const std::vector<std::string>& names);
  std::optional<std::size_t> indexOfOnlyKey(const std::vector<std::string>& names);

  const Entry* entry(const std::string& key) const;
  const Entry* find(const std::string& key, Presence presence, const std::string& request);
  std::optional<std::string> scalar(const std::string& key, Presence presence, const std::string& request);
  using Parse = std::function<double(const std::string&)>;
  double convert(const std::string& key, int line, const std::string& text, const Parse& parse);
  const Entry* findSequence(const std::string& key, const std::string& request);
  double component(const YAML::Node& sequence, std::size_t i, const std::string& key, const std::string& request,
                   const Parse& parse);
  std::vector<double> components(const YAML::Node& sequence, const std::string& key, const std::string& request,
                                 const Parse& parse);
  std::vector<double> sequence(const std::string& key, const std::string& component_request, const Parse& parse);
  rod::Vector3 triple(const std::string& key, const std::string& component_request, const Parse& parse);
  void readMapping(const YAML::Node& node, const std::string& key, int line, const Body& body);
  std::string pathOf(const std::string& key) const;

  std::string path_;
  int line_;
  std::vector<Entry> entries_;
  std::vector<std::string> known_keys_;
  bool ignores_other_keys_ = false;
  std::vector<Problem>& problems_;
};

/// Reads a text that holds one YAML document, a mapping. Adds to `problems`; never throws for what the text holds.
void readYaml(const std::string& text, std::vector<Problem>& problems, const YamlReader::Body& body);

}  // namespace sensory_growth::simulation
