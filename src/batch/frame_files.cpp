#include "sensory_growth/batch/frame_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <variant>

#include "sensory_growth/batch/bad_input.h"

namespace sensory_growth::batch {
namespace {

namespace fs = std::filesystem;

void append(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text.append(digits, end);
}

void append(std::string& text, const geometry_msgs::Point& point, char separator) {
  append(text, point.x);
  text += separator;
  append(text, point.y);
  text += separator;
  append(text, point.z);
  text += '\n';
}

void appendScalars(std::string& text, std::string_view name, const std::vector<double>& values) {
  text.append("SCALARS ").append(name).append(" double 1\nLOOKUP_TABLE default\n");
  for (const double value : values) {
    append(text, value);
    text += '\n';
  }
}

std::vector<double> atVertices(const std::vector<double>& of_elements) {
  std::vector<double> values;
  const std::size_t n = of_elements.size();
  for (std::size_t i = 0; i <= n; ++i) {
    values.push_back(0.5 * (of_elements[std::max<std::size_t>(i, 1) - 1] + of_elements[std::min(i, n - 1)]));
  }
  return values;
}

void makeFolder(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw BadInput(folder + ": cannot be created: " + failure.message());
}

void refuseExisting(const std::string& path) {
  if (fs::exists(path)) throw BadInput(path + " exists already");
}

void writeWhole(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

VertexFields vertexFields(const OrganState& state) {
  VertexFields fields;
  for (const geometry_msgs::Vector3& curvature : state.curvature) {
    fields.curvature.push_back(std::hypot(curvature.x, curvature.y));
  }
  fields.curvature.push_back(fields.curvature.back());
  fields.growth_rate = atVertices(state.growth_rate);
  fields.radius = atVertices(state.radius);
  fields.age = atVertices(state.age);
  return fields;
}

std::string toVtk(const OrganState& state) {
  const std::string count = std::to_string(state.positions.size());
  std::string text = "# vtk DataFile Version 3.0\n" + state.organ + ", step " + std::to_string(state.step_index) +
                     ", growth time [s] ";
  append(text, state.growth_time);
  text += "\nASCII\nDATASET POLYDATA\nPOINTS " + count + " double\n";
  for (const geometry_msgs::Point& position : state.positions) append(text, position, ' ');
  text += "LINES 1 " + std::to_string(state.positions.size() + 1) + "\n" + count;
  for (std::size_t i = 0; i < state.positions.size(); ++i) text += ' ' + std::to_string(i);
  text += "\nPOINT_DATA " + count + '\n';
  const VertexFields fields = vertexFields(state);
  appendScalars(text, "curvature", fields.curvature);
  appendScalars(text, "growth_rate", fields.growth_rate);
  appendScalars(text, "radius", fields.radius);
  appendScalars(text, "age", fields.age);
  return text;
}

FrameFiles::FrameFiles(const FrameOptions& options, const std::vector<std::string>& organs, std::uint32_t epoch)
    : options_(options), epoch_(epoch) {
  makeFolder(options_.csv);
  makeFolder(options_.vtk);
  for (const std::string& organ : organs) {
    if (organs_.insert(organ).second) refuseFilesOf(organ);
  }
}

void FrameFiles::refuseFilesOf(const std::string& organ) const {
  if (!options_.vtk.empty()) refuseExisting(seriesPath(organ));
  if (!options_.csv.empty()) refuseExisting(tablePath(organ));
}

void FrameFiles::write(const OrganState& state) {
  if (state.epoch != epoch_ || state.step_index % options_.every != 0) return;
  if (organs_.insert(state.organ).second) refuseFilesOf(state.organ);
  if (!options_.csv.empty()) writeTable(state);
  if (!options_.vtk.empty()) writeVtk(state);
}

void FrameFiles::take(const node::Message& message) {
  if (const auto* state = std::get_if<boost::shared_ptr<const OrganState>>(&message)) write(**state);
}

void FrameFiles::close() {
  for (auto& [organ, table] : tables_) {
    table.close();
    if (!table) throw std::runtime_error(tablePath(organ) + ": cannot be written");
  }
  for (const auto& [organ, frames] : series_) {
    std::string text = "{\"file-series-version\": \"1.0\", \"files\": [";
    for (const Frame& frame : frames) {
      text += (&frame == &frames.front() ? "\n" : ",\n");
      text += "{\"name\": \"" + frame.file + "\", \"time\": ";
      append(text, frame.growth_time);
      text += '}';
    }
    writeWhole(seriesPath(organ), text + "\n]}\n");
  }
}

void FrameFiles::writeTable(const OrganState& state) {
  const std::string frame = std::to_string(state.step_index) + ',';
  std::string text;
  for (const geometry_msgs::Point& position : state.positions) {
    text += frame;
    append(text, position, ',');
  }
  std::ofstream& table = tables_[state.organ];
  if (!table.is_open()) {
    refuseExisting(tablePath(state.organ));  // of an organ that came later
    table.open(tablePath(state.organ), std::ios::binary);
    table << "frame,x,y,z\n";
  }
  table << text;
  if (!table) throw std::runtime_error(tablePath(state.organ) + ": cannot be written");
}

void FrameFiles::writeVtk(const OrganState& state) {
  char number[32];
  std::snprintf(number, sizeof number, "%06llu", static_cast<unsigned long long>(state.step_index));
  const std::string file = state.organ + "_" + number + ".vtk";
  writeWhole(fs::path(options_.vtk) / file, toVtk(state));
  if (series_.count(state.organ) == 0) refuseExisting(seriesPath(state.organ));  // of an organ that came later
  series_[state.organ].push_back({file, state.growth_time});
}

std::string FrameFiles::tablePath(const std::string& organ) const { return fs::path(options_.csv) / (organ + ".csv"); }

std::string FrameFiles::seriesPath(const std::string& organ) const {
  return fs::path(options_.vtk) / (organ + ".vtk.series");
}

}  // namespace sensory_growth::batch
