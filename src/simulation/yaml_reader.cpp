#include "sensory_growth/simulation/yaml_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "sensory_growth/simulation/spelling.h"

namespace sensory_growth::simulation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

int lineOf(const YAML::Mark& mark, int otherwise) { return mark.is_null() ? otherwise : mark.line + 1; }

/// The mark of an empty value lies behind it, maybe on a later line.
int lineOf(const YAML::Node& node, int otherwise) { return node.IsNull() ? otherwise : lineOf(node.Mark(), otherwise); }

std::string quote(const std::string& text) {
  constexpr std::size_t kLongestQuote = 60;
  return "'" + (text.size() > kLongestQuote ? text.substr(0, kLongestQuote) + "..." : text) + "'";
}

std::string describeNode(const YAML::Node& node) {
  if (node.IsScalar()) return "is " + quote(node.Scalar());
  if (node.IsSequence()) return "is a sequence";
  if (node.IsMap()) return "is a mapping";
  return "is empty";
}

std::string join(const std::vector<std::string>& names, const std::string& last_separator) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? last_separator : ", ";
    text += "'" + names[i] + "'";
  }
  return text;
}

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

bool isIdentifier(const std::string& text) {
  return !text.empty() && isLetter(text[0]) &&
         std::all_of(text.begin(), text.end(), [](char c) { return isLetter(c) || isDigit(c) || c == '_'; });
}

template <typename Value>
Presence presence(const std::optional<Value>& fallback) {
  return fallback ? kOptional : kRequired;
}

double inRange(double value, const Range& range, const char* unit) {
  if (!range.contains(value)) throw std::invalid_argument("is out of range; " + range.describe(unit));
  return value;
}

std::string example(const Dimension& dimension) {
  return std::string(dimension.name) + " such as '" + dimension.example + "'";
}

/// Infinity if the text is the word for it. Another word is refused: `request` says what is wanted.
std::optional<double> readInfinity(const std::string& text, const Range& range, const std::string& request) {
  if (!range.infinity || text.empty() || !isLetter(text[0])) return std::nullopt;
  if (text != range.infinity) throw std::invalid_argument("is not known; " + request);
  return kInfinity;
}

std::string orInfinity(const Range& range) { return range.infinity ? " or '" + std::string(range.infinity) + "'" : ""; }

}  // namespace

YamlReader::YamlReader(const YAML::Node& mapping, std::string path, std::vector<Problem>& problems)
    : path_(std::move(path)), line_(lineOf(mapping, 0)), problems_(problems) {
  for (const auto& item : mapping) {
    const YAML::Node& key = item.first;
    const int line = lineOf(key, line_);
    if (!key.IsScalar()) {
      problems_.push_back({path_, line, "has a key that " + describeNode(key) + "; keys are plain words"});
    } else if (const Entry* first = entry(key.Scalar())) {
      problems_.push_back({pathOf(first->key), line, "is given twice, first on line " + std::to_string(first->line)});
    } else {
      entries_.push_back({key.Scalar(), line, item.second});
    }
  }
}

std::string YamlReader::text(const std::string& key, const std::optional<std::string>& fallback) {
  return scalar(key, presence(fallback), "give a text").value_or(fallback.value_or(""));
}

std::string YamlReader::identifier(const std::string& key) {
  const std::string request = "give a letter followed by letters, digits and '_'";
  const std::optional<std::string> text = scalar(key, kRequired, request);
  if (!text) return "";
  if (!isIdentifier(*text)) addProblem(key, quote(*text) + " is not a valid name; " + request);
  return *text;
}

std::string YamlReader::uniqueIdentifier(const std::string& key, Lines& given) {
  const std::string word = identifier(key);
  const auto [first, is_new] = given.emplace(word, line(key));
  if (!is_new && !word.empty()) {
    addProblem(key, "'" + word + "' is already used on line " + std::to_string(first->second) + "; ids are unique");
  }
  return word;
}

bool YamlReader::flag(const std::string& key, std::optional<bool> fallback) {
  const std::string request = "give true or false";
  const std::optional<std::string> text = scalar(key, presence(fallback), request);
  if (!text) return fallback.value_or(false);
  if (*text != "true" && *text != "false") addProblem(key, quote(*text) + " is not a truth value; " + request);
  return *text == "true";
}

int YamlReader::count(const std::string& key, int low, int high, std::optional<int> fallback) {
  const std::optional<std::string> text = scalar(key, presence(fallback), "give a whole number");
  if (!text) return fallback.value_or(0);
  const char* end = text->data() + text->size();
  int value = 0;
  const std::from_chars_result result = std::from_chars(text->data(), end, value);
  const bool is_whole = result.ptr == end && result.ec != std::errc::invalid_argument;
  const Range range = atLeast(low).upTo(high);
  if (!is_whole) {
    addProblem(key, quote(*text) + " is not a whole number");
  } else if (result.ec == std::errc::result_out_of_range || !range.contains(value)) {
    addProblem(key, quote(*text) + " is out of range; " + range.describe(""));
  }
  return value;
}

double YamlReader::number(const std::string& key, const Range& range, std::optional<double> fallback) {
  const std::string request = "give a number without a unit" + orInfinity(range);
  const std::optional<std::string> text = scalar(key, presence(fallback), request);
  if (!text) return fallback.value_or(kNan);
  return convert(key, line(key), *text, [&](const std::string& number) {
    const std::optional<double> infinity = readInfinity(number, range, request);
    return infinity ? *infinity : inRange(parseNumber(number), range, "");
  });
}

double YamlReader::quantity(const std::string& key, const Dimension& dimension, const Range& range,
                            std::optional<double> fallback) {
  const std::string request = "give " + example(dimension) + orInfinity(range);
  const std::optional<std::string> text = scalar(key, presence(fallback), request);
  if (!text) return fallback.value_or(kNan);
  return convert(key, line(key), *text, [&](const std::string& quantity) {
    const std::optional<double> infinity = readInfinity(quantity, range, request);
    return infinity ? *infinity : inRange(parseQuantity(quantity, dimension), range, dimension.unit);
  });
}

std::vector<double> YamlReader::numbers(const std::string& key, const Range& range) {
  return sequence(key, "a number without a unit",
                  [&](const std::string& text) { return inRange(parseNumber(text), range, ""); });
}

std::vector<double> YamlReader::quantities(const std::string& key, const Dimension& dimension, const Range& range) {
  return sequence(key, example(dimension), [&](const std::string& text) {
    return inRange(parseQuantity(text, dimension), range, dimension.unit);
  });
}

std::vector<std::vector<double>> YamlReader::matrix(const std::string& key, const Dimension& dimension) {
  const std::string request = "give a sequence of rows, each a sequence of numbers like " + example(dimension);
  std::vector<std::vector<double>> rows;
  const Entry* e = findSequence(key, request);
  if (!e) return rows;
  for (std::size_t i = 0; i < e->value.size(); ++i) {
    const YAML::Node row = e->value[i];
    const std::string row_key = key + "[" + std::to_string(i) + "]";
    if (row.IsSequence()) {
      rows.push_back(components(row, row_key, example(dimension),
                                [&](const std::string& text) { return parseQuantity(text, dimension); }));
    } else {
      problems_.push_back({pathOf(row_key), lineOf(row, line(key)), describeNode(row) + "; " + request});
    }
  }
  return rows;
}

rod::Vector3 YamlReader::vector(const std::string& key, const Dimension& dimension,
                                std::optional<rod::Vector3> fallback) {
  if (fallback && !has(key)) return *fallback;
  return triple(key, example(dimension), [&](const std::string& text) { return parseQuantity(text, dimension); });
}

rod::Vector3 YamlReader::direction(const std::string& key) {
  const rod::Vector3 value = triple(key, "a number without a unit", parseNumber);
  if (value == rod::Vector3::Zero()) addProblem(key, "has zero length; a direction needs a component that is not 0");
  return value.stableNormalized();
}

void YamlReader::section(const std::string& key, Presence presence, const Body& body) {
  const Entry* section = find(key, presence, "give a mapping");
  if (section) readMapping(section->value, key, line(key), body);
}

void YamlReader::list(const std::string& key, Presence presence, const Body& body) {
  const std::string request = "give a sequence of mappings";
  const Entry* list = find(key, presence, request);
  if (!list) return;
  if (!list->value.IsSequence()) return addProblem(key, describeNode(list->value) + "; " + request);
  if (presence == kRequired && list->value.size() == 0) addProblem(key, "is empty; give one entry at least");
  for (std::size_t i = 0; i < list->value.size(); ++i) {
    const YAML::Node item = list->value[i];
    readMapping(item, key + "[" + std::to_string(i) + "]", lineOf(item, line(key)), body);
  }
}

bool YamlReader::has(const std::string& key) {
  if (std::find(known_keys_.begin(), known_keys_.end(), key) == known_keys_.end()) known_keys_.push_back(key);
  return entry(key) != nullptr;
}

int YamlReader::line(const std::string& key) const {
  const Entry* e = entry(key);
  return e ? lineOf(e->value, e->line) : line_;
}

void YamlReader::addProblem(const std::string& key, const std::string& message) {
  problems_.push_back({pathOf(key), line(key), message});
}

void YamlReader::ignoreOtherKeys() { ignores_other_keys_ = true; }

void YamlReader::reportUnknownKeys() {
  if (ignores_other_keys_) return;
  for (const Entry& e : entries_) {
    if (std::find(known_keys_.begin(), known_keys_.end(), e.key) != known_keys_.end()) continue;
    const std::string* meant = nearestName(e.key, known_keys_);
    problems_.push_back({pathOf(e.key), e.line,
                         meant ? "is an unknown key; did you mean '" + *meant + "'?"
                               : "is an unknown key; known here are " + join(known_keys_, " and ")});
  }
}

std::optional<std::size_t> YamlReader::indexOfChoice(const std::string& key, const std::vector<std::string>& names) {
  const std::string request = "give " + join(names, " or ");
  const std::optional<std::string> text = scalar(key, kRequired, request);
  if (!text) return std::nullopt;
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found != names.end()) return found - names.begin();
  addProblem(key, quote(*text) + " is not known; " + request);
  return std::nullopt;
}

std::vector<std::size_t> YamlReader::indicesOfChoices(const std::string& key, const std::vector<std::string>& names) {
  const std::string request = "give one or more of " + join(names, " and ") + ", each once";
  std::vector<std::size_t> indices;
  const Entry* e = findSequence(key, request);
  if (!e) return indices;
  for (std::size_t i = 0; i < e->value.size(); ++i) {
    const YAML::Node item = e->value[i];
    const auto found = std::find(names.begin(), names.end(), item.IsScalar() ? item.Scalar() : "");
    const auto index = static_cast<std::size_t>(found - names.begin());
    const bool is_new = std::find(indices.begin(), indices.end(), index) == indices.end();
    if (found != names.end() && is_new) {
      indices.push_back(index);
    } else {
      problems_.push_back({pathOf(key + "[" + std::to_string(i) + "]"), lineOf(item, line(key)),
                           describeNode(item) + (is_new ? "" : " again") + "; " + request});
    }
  }
  return indices;
}

std::optional<std::size_t> YamlReader::indexOfOnlyKey(const std::vector<std::string>& names) {
  std::vector<std::size_t> present;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (has(names[i])) present.push_back(i);
  }
  if (present.size() == 1) return present[0];
  problems_.push_back({path_, line_, "needs exactly one of " + join(names, " and ")});
  return std::nullopt;
}

const YamlReader::Entry* YamlReader::entry(const std::string& key) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

const YamlReader::Entry* YamlReader::find(const std::string& key, Presence presence, const std::string& request) {
  if (!has(key) && presence == kRequired) addProblem(key, "is missing; " + request);
  return entry(key);
}

std::optional<std::string> YamlReader::scalar(const std::string& key, Presence presence, const std::string& request) {
  const Entry* e = find(key, presence, request);
  if (!e) return std::nullopt;
  if (e->value.IsScalar()) return e->value.Scalar();
  addProblem(key, describeNode(e->value) + "; " + request);
  return std::nullopt;
}

double YamlReader::convert(const std::string& key, int line, const std::string& text, const Parse& parse) {
  try {
    return parse(text);
  } catch (const std::invalid_argument& fault) {
    problems_.push_back({pathOf(key), line, quote(text) + " " + fault.what()});
    return kNan;
  }
}

/// The entry of a key whose value is a sequence and not empty.
const YamlReader::Entry* YamlReader::findSequence(const std::string& key, const std::string& request) {
  const Entry* e = find(key, kRequired, request);
  if (!e) return nullptr;
  if (e->value.IsSequence() && e->value.size() > 0) return e;
  addProblem(key, (e->value.IsSequence() ? std::string("is empty") : describeNode(e->value)) + "; " + request);
  return nullptr;
}

std::vector<double> YamlReader::components(const YAML::Node& sequence, const std::string& key,
                                           const std::string& request, const Parse& parse) {
  std::vector<double> values;
  for (std::size_t i = 0; i < sequence.size(); ++i) values.push_back(component(sequence, i, key, request, parse));
  return values;
}

std::vector<double> YamlReader::sequence(const std::string& key, const std::string& component_request,
                                         const Parse& parse) {
  const Entry* e = findSequence(key, "give a sequence, each " + component_request);
  return e ? components(e->value, key, component_request, parse) : std::vector<double>();
}

rod::Vector3 YamlReader::triple(const std::string& key, const std::string& component_request, const Parse& parse) {
  const std::string request = "give a sequence of three, each " + component_request;
  rod::Vector3 value = rod::Vector3::Constant(kNan);
  const Entry* e = find(key, kRequired, request);
  if (!e) return value;
  if (!e->value.IsSequence()) {
    addProblem(key, describeNode(e->value) + "; " + request);
  } else if (e->value.size() != 3) {
    addProblem(key, "has " + std::to_string(e->value.size()) + " components; " + request);
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      value[static_cast<Eigen::Index>(i)] = component(e->value, i, key, component_request, parse);
    }
  }
  return value;
}

/// One number of a sequence.
double YamlReader::component(const YAML::Node& sequence, std::size_t i, const std::string& key,
                             const std::string& request, const Parse& parse) {
  const YAML::Node item = sequence[i];
  const std::string item_key = key + "[" + std::to_string(i) + "]";
  const int item_line = lineOf(item, line(key));
  if (item.IsScalar()) return convert(item_key, item_line, item.Scalar(), parse);
  problems_.push_back({pathOf(item_key), item_line, describeNode(item) + "; give " + request});
  return kNan;
}

void YamlReader::readMapping(const YAML::Node& node, const std::string& key, int line, const Body& body) {
  if (!node.IsMap()) {
    problems_.push_back({pathOf(key), line, describeNode(node) + "; give a mapping of keys to values"});
    return;
  }
  YamlReader reader(node, pathOf(key), problems_);
  body(reader);
  reader.reportUnknownKeys();
}

std::string YamlReader::pathOf(const std::string& key) const {
  return path_.empty() || key.empty() ? path_ + key : path_ + "." + key;
}

void readYaml(const std::string& text, std::vector<Problem>& problems, const YamlReader::Body& body) {
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
  } catch (const YAML::Exception& fault) {
    problems.push_back({"", lineOf(fault.mark, 0), "not valid YAML: " + fault.msg});
    return;
  }
  if (documents.empty() || (documents.size() == 1 && documents[0].IsNull())) {
    problems.push_back({"", 0, "is empty"});
  } else if (documents.size() > 1) {
    problems.push_back({"", lineOf(documents[1].Mark(), 0), "a second document begins here; give one"});
  } else if (!documents[0].IsMap()) {
    problems.push_back({"", lineOf(documents[0], 0), describeNode(documents[0]) + "; give a mapping"});
  } else {
    YamlReader reader(documents[0], "", problems);
    body(reader);
    reader.reportUnknownKeys();
  }
}

}  // namespace sensory_growth::simulation
