#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "sensory_growth/batch/commands.h"

namespace sensory_growth::node::testing {

/// Whether running the bag again gives the same, bit for bit.
inline bool replays(const std::string& bag) {
  batch::ReplayOptions options;
  options.recorded = bag;
  options.quiet = true;
  std::ostringstream out, err;
  const batch::ExitCode code = batch::replay(options, {out, err, [] { return false; }});
  EXPECT_EQ(err.str(), "");
  return code == batch::kOk;
}

}  // namespace sensory_growth::node::testing
