/// The table of parameters in docs/node_api.md says what the node takes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "sensory_growth/ros/parameters.h"

namespace sensory_growth::node {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using XmlRpc::XmlRpcValue;

struct Row {
  std::string name, type, default_value, range;
};

std::vector<Row> readTable() {
  std::ifstream file("../docs/node_api.md");
  std::vector<Row> rows;
  const std::regex row(R"(\| `~(\w+)` \| (str|bool|int|double) \| [^|]+ \| ([^|]+) \| ([^|]+) \| .+ \|)");
  std::smatch cells;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_match(line, cells, row)) rows.push_back({cells[1], cells[2], cells[3], cells[4]});
  }
  return rows;
}

XmlRpcValue minimal() {
  XmlRpcValue tree;
  tree["scenario"] = "/some/where.yaml";
  tree["growth_time_scale"] = 60.0;
  return tree;
}

/// What is wrong with this parameter alone.
std::vector<std::string> problemsOf(const Row& row, const XmlRpcValue& value) {
  XmlRpcValue tree = minimal();
  tree[row.name] = value;
  std::vector<std::string> problems;
  for (const std::string& problem : readParameters(tree).problems) {
    if (problem.rfind("~" + row.name + " ", 0) == 0) problems.push_back(problem);
  }
  return problems;
}

XmlRpcValue number(const Row& row, double value) {
  return row.type == "int" ? XmlRpcValue(static_cast<int>(value)) : XmlRpcValue(value);
}

TEST(ParameterTable, HasEveryParameterAndNoOther) {
  std::map<std::string, std::string> in_docs, in_code;
  for (const Row& row : readTable()) in_docs[row.name] = row.default_value;
  for (const auto& entry : YAML::Load(toYaml(Parameters()))) {
    const auto name = entry.first.as<std::string>();
    const auto value = entry.second.as<std::string>();
    // Whether 1e9 or 1000000000 is written does not matter, nor what stands where the user has to give a value.
    double written = 0.0;
    const bool is_required = in_docs[name] == "required";
    const bool is_number = YAML::convert<double>::decode(YAML::Node(in_docs[name]), written);
    const bool is_same_number = is_number && entry.second.as<double>() == written;
    in_code[name] = is_required || is_same_number ? in_docs[name] : value.empty() ? "empty" : value;
  }
  EXPECT_EQ(in_docs, in_code);
}

TEST(ParameterTable, SaysWhatIsRequired) {
  XmlRpcValue nothing;
  nothing.begin();
  const std::vector<std::string> problems = readParameters(nothing).problems;
  for (const Row& row : readTable()) {
    const auto complaint = Contains("~" + row.name + " is required and was not given");
    if (row.default_value == "required") {
      EXPECT_THAT(problems, complaint);
    } else {
      EXPECT_THAT(problems, Not(complaint));
    }
  }
}

TEST(ParameterTable, SaysTheTypes) {
  const std::map<std::string, XmlRpcValue> wrong = {{"str", 1}, {"bool", 1}, {"int", 1.5}, {"double", "much"}};
  for (const Row& row : readTable()) {
    EXPECT_THAT(problemsOf(row, wrong.at(row.type)), Contains(StartsWith("~" + row.name))) << row.type;
  }
}

TEST(ParameterTable, SaysTheRanges) {
  const std::regex range(R"((?:0, or )?(\S+) to (\S+))");
  int checked = 0;
  for (const Row& row : readTable()) {
    std::smatch limits;
    if (!std::regex_match(row.range, limits, range)) continue;
    SCOPED_TRACE(row.name);
    const double lowest = std::stod(limits[1]), highest = std::stod(limits[2]);
    EXPECT_THAT(problemsOf(row, number(row, lowest)), IsEmpty());
    EXPECT_THAT(problemsOf(row, number(row, highest)), IsEmpty());
    const bool is_int = row.type == "int";
    EXPECT_THAT(problemsOf(row, number(row, is_int ? lowest - 1 : lowest - 0.01 * (lowest + 1e-6))), Not(IsEmpty()));
    EXPECT_THAT(problemsOf(row, number(row, is_int ? highest + 1 : 1.01 * highest)), Not(IsEmpty()));
    ++checked;
  }
  EXPECT_GT(checked, 5);
}

TEST(ParameterTable, SaysTheChoices) {
  int checked = 0;
  for (const Row& row : readTable()) {
    if (row.type != "str" || row.range == "-") continue;
    SCOPED_TRACE(row.name);
    std::istringstream choices(row.range);
    for (std::string choice; std::getline(choices >> std::ws, choice, ',');) {
      EXPECT_THAT(problemsOf(row, choice), IsEmpty()) << choice;
    }
    EXPECT_THAT(problemsOf(row, "other"), Contains("~" + row.name + " is 'other'; it must be one of " + row.range));
    ++checked;
  }
  EXPECT_GT(checked, 2);
}

}  // namespace
}  // namespace sensory_growth::node
