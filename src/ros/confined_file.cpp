#include "sensory_growth/ros/confined_file.h"

#include <cctype>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace sensory_growth::node {
namespace {

bool isPlainName(const std::string& file) {
  for (const char c : file) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && !std::strchr("_-.", c)) return false;
  }
  return !file.empty() && file.front() != '.' && file.front() != '-';
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::string confinedPath(const Confinement& confinement, const std::string& file) {
  if (confinement.directory.empty()) {
    throw std::invalid_argument("~" + confinement.parameter + " is not set, so there is no place for files");
  }
  if (!isPlainName(file)) {
    throw std::invalid_argument("file is '" + file +
                                "'; it must be a name of letters, digits, '_', '-' and '.', without a directory");
  }
  if (!endsWith(file, confinement.extension)) {
    throw std::invalid_argument("file is '" + file + "'; it must end in " + confinement.extension);
  }
  return (std::filesystem::absolute(confinement.directory) / file).string();
}

}  // namespace sensory_growth::node
