#pragma once

#include <string>

namespace sensory_growth::growth {

/// What is wrong with one field of a struct.
struct Fault {
  std::string field;
  std::string reason;  ///< continues a sentence that begins with the field, such as "must rise"
};

}  // namespace sensory_growth::growth
