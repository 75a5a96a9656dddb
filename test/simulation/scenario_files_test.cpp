// Files: unreadable, spoilt and shipped ones, and the keys that the documentation names.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <random>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "sensory_growth/simulation/parameters.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "support/scenario_texts.h"

namespace sensory_growth::simulation {
namespace {

using support::bad;
using support::contentOf;
using support::good;
using support::list;
using support::problemsOf;
using testing::ContainsRegex;
using testing::HasSubstr;

struct BadFile {
  const char* name;
  const char* message;
};

void PrintTo(const BadFile& file, std::ostream* out) { *out << file.name; }

class UnreadableFile : public testing::TestWithParam<BadFile> {};

TEST_P(UnreadableFile, IsRefusedByName) {
  const std::string file = bad + GetParam().name;
  const std::string problems = list(problemsOf([&] { loadScenario(file); }));
  EXPECT_THAT(problems, ContainsRegex(std::string("^test") + GetParam().message));
  EXPECT_EQ(problems, list(problemsOf([&] { loadProtocol(file); })));
  try {
    loadScenario(file);
  } catch (const ScenarioError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(file + ":"));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, UnreadableFile,
                         testing::Values(BadFile{"absent.yaml", ": cannot be read: No such file or directory$"},
                                         BadFile{"", ": cannot be read: Is a directory$"},
                                         BadFile{"empty.yaml", ": is empty$"},
                                         BadFile{"only_a_comment.yaml", ": is empty$"},
                                         BadFile{"a_sequence.yaml", ":1: is a sequence; give a mapping$"},
                                         BadFile{"two_documents.yaml", ":4: a second document begins here; give one$"},
                                         BadFile{"not_yaml.yaml", ":3: not valid YAML: "}));

std::vector<std::string> yamlFiles(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  }
  return files;
}

TEST(ShippedFiles, AreValid) {
  const std::vector<std::string> scenarios = yamlFiles("../config");
  const std::vector<std::string> protocols = yamlFiles("../config/stimuli");
  EXPECT_FALSE(scenarios.empty());
  EXPECT_FALSE(protocols.empty());
  for (const std::string& file : scenarios) EXPECT_NO_THROW(loadScenario(file)) << file;
  for (const std::string& file : protocols) EXPECT_NO_THROW(loadProtocol(file)) << file;
}

TEST(ShippedFiles, AreNamedWhereOneLooksForThem) {
  const std::string readme = contentOf("../README.md"), docs = contentOf("../docs/scenario.md");
  for (const std::string& file : yamlFiles("../config")) {
    const std::string name = std::filesystem::path(file).stem();
    EXPECT_THAT(readme, HasSubstr("| `" + name + "` |"));
    EXPECT_THAT(docs, ContainsRegex("[ `]" + name + "[ ,`]"));
    EXPECT_EQ(loadScenario(file).name, name);
  }
  for (const std::string& file : yamlFiles("../config/stimuli")) {
    EXPECT_THAT(readme, HasSubstr("`" + std::filesystem::path(file).stem().string() + "`"));
  }
}

TEST(ShippedFiles, TakeStepsThatTheLaunchFilesAllow) {
  for (const char* launch : {"../launch/sim.launch", "../launch/demo.launch"}) {
    const std::string text = contentOf(launch);
    std::smatch scale;
    ASSERT_TRUE(std::regex_search(text, scale, std::regex("name=\"growth_time_scale\" default=\"([0-9]+)\"")));
    for (const std::string& file : yamlFiles("../config")) {
      EXPECT_LE(loadScenario(file).stepping.step, std::stod(scale[1])) << file;  // within a second of ROS time
    }
  }
}

/// Key paths in the first column of the tables of docs/scenario.md.
std::set<std::string> documentedKeys() {
  std::set<std::string> keys;
  std::ifstream in("../docs/scenario.md");
  const std::regex row(R"(^\| `([a-z_.\[\]]+)` \|.*)");
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_match(line, match, row)) keys.insert(match[1]);
  }
  return keys;
}

/// Paths of the values in a file, down to the first that is documented.
void collectKeys(const YAML::Node& node, const std::string& path, const std::set<std::string>& documented,
                 std::set<std::string>& keys) {
  if (documented.count(path) > 0 || node.IsScalar()) {
    keys.insert(path);
  } else if (node.IsMap()) {
    for (const auto& item : node) {
      collectKeys(item.second, path + (path.empty() ? "" : ".") + item.first.Scalar(), documented, keys);
    }
  } else {
    for (const auto& item : node) collectKeys(item, path + "[]", documented, keys);
  }
}

TEST(Documentation, NamesExactlyTheKeysOfTheGoodFiles) {
  const std::set<std::string> documented = documentedKeys();
  std::set<std::string> used;
  for (const std::string& file : yamlFiles(good)) collectKeys(YAML::LoadFile(file), "", documented, used);
  EXPECT_THAT(used, testing::ContainerEq(documented));
}

/// The table of the parameters that may change, name and type.
std::vector<std::pair<std::string, std::string>> documentedParameters() {
  std::vector<std::pair<std::string, std::string>> rows;
  std::ifstream in("../docs/scenario.md");
  std::string line;
  while (std::getline(in, line) && line != "| parameter | type | of organs with |") continue;
  const std::regex row(R"(^\| ([a-z_.]+) \| ([^|]+) \|.*)");
  std::smatch match;
  std::getline(in, line);
  while (std::getline(in, line) && std::regex_match(line, match, row)) rows.emplace_back(match[1], match[2]);
  return rows;
}

TEST(Documentation, NamesExactlyTheParametersThatMayChange) {
  std::vector<std::pair<std::string, std::string>> known;
  for (const Parameter& parameter : parameters()) {
    const std::string type = parameter.dimension ? parameter.dimension->name : "a –";
    known.emplace_back(parameter.name, type.substr(type.find(' ') + 1));
    EXPECT_EQ(documentedKeys().count("organs[]." + parameter.name), 1u) << parameter.name;
  }
  EXPECT_THAT(documentedParameters(), testing::ContainerEq(known));
}

/// Spoils a text in one of the ways that people and disks do.
std::string mutate(std::string text, std::mt19937& random) {
  static const std::vector<std::string> snippets = {"inf",
                                                    "nan",
                                                    "-",
                                                    "[",
                                                    "]",
                                                    "{",
                                                    "}",
                                                    ": ",
                                                    "\n",
                                                    "\t",
                                                    "'",
                                                    "\"",
                                                    "&a ",
                                                    "*a",
                                                    "---",
                                                    "- ",
                                                    "#",
                                                    "? ",
                                                    "1e999",
                                                    "<<: ",
                                                    "!!",
                                                    "|",
                                                    ">",
                                                    "%",
                                                    std::string(1, '\0'),
                                                    "\xff",
                                                    "\xc2",
                                                    "mm",
                                                    "1 ",
                                                    "~ ",
                                                    ", ",
                                                    "id: a",
                                                    "0x1",
                                                    "...",
                                                    "@",
                                                    "^",
                                                    "-9 ",
                                                    "s ",
                                                    "99999999999999999999"};
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
    const std::size_t at = below(text.size()), size = below(1 + std::min<std::size_t>(12, text.size() - at));
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, size);
        break;
      case 2:
        text.insert(at, snippets[below(snippets.size())]);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, size));
        break;
      case 4:
        text.replace(at, size, snippets[below(snippets.size())]);
        break;
    }
    if (text.empty()) text = " ";
  }
  return text;
}

TEST(ScenarioYaml, SpoiltTextIsReadOrRefusedButNothingElse) {
  const std::string originals[] = {contentOf(good + "all_keys.yaml"), contentOf(good + "loads.yaml"),
                                   contentOf(good + "senses.yaml")};
  std::mt19937 random(20);
  int refused = 0;
  constexpr int trials = 1500;
  for (int i = 0; i < trials; ++i) {
    const std::string text = mutate(originals[i % 3], random);
    try {
      const Scenario scenario = parseScenario(text, "test");
      EXPECT_GT(scenario.stepping.step, 0.0) << text;
      EXPECT_FALSE(scenario.organs.empty()) << text;
      for (const OrganScenario& organ : scenario.organs) {
        EXPECT_TRUE(std::isfinite(organ.length) && organ.length > 0.0) << text;
        EXPECT_TRUE(organ.base.position.allFinite() && organ.base.frame.coeffs().allFinite()) << text;
        EXPECT_GT(organ.section.shear_modulus, 0.0) << text;
        EXPECT_EQ(mechanics::findFault(organ.loads.surroundings), std::nullopt) << text;
        EXPECT_EQ(growth::findFault(organ.senses), std::nullopt) << text;
        EXPECT_EQ(growth::findFault(organ.bending), std::nullopt) << text;
      }
    } catch (const ScenarioError& error) {
      ++refused;
      EXPECT_FALSE(error.problems().empty());
    }
  }
  EXPECT_GT(refused, trials / 2);
  EXPECT_LT(refused, trials);
}

}  // namespace
}  // namespace sensory_growth::simulation
