#pragma once

#include <string>

namespace sensory_growth::node {

/// Files that services may name: they stay in one directory.
struct Confinement {
  std::string parameter;  ///< that names the directory, without '~'
  std::string directory;  ///< empty: nothing may be named
  std::string extension;  ///< of every file, such as ".bag"
};

/// Path of `file` in the directory. Throws std::invalid_argument unless `file` is a plain name with the extension.
std::string confinedPath(const Confinement& confinement, const std::string& file);

}  // namespace sensory_growth::node
