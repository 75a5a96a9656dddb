#include "sensory_growth/batch/progress.h"

#include <gtest/gtest.h>

#include <sstream>

namespace sensory_growth::batch {
namespace {

TEST(DescribeProgress, SaysHowFarAndHowLongStill) {
  EXPECT_EQ(describeProgress(120, 480, 7200.0, 0.5),
            "[#####               ]  25 %, step 120 of 480, 2 h of growth, 240 steps/s, 2 s left");
  EXPECT_EQ(describeProgress(480, 480, 28800.0, 2.0),
            "[####################] 100 %, step 480 of 480, 8 h of growth, 240 steps/s, 0 s left");
  EXPECT_EQ(describeProgress(0, 480, 0.0, 0.0), "[                    ]   0 %, step 0 of 480, 0 h of growth");
}

TEST(Progress, OfATerminalEndsAtTheLastStepWithALineOfItsOwn) {
  std::ostringstream out;
  {
    Progress progress(out, ProgressStyle::bar, 2);
    progress.show(2, 120.0);
  }
  EXPECT_EQ(out.str().front(), '\r');
  EXPECT_NE(out.str().find("100 %, step 2 of 2"), std::string::npos);
  EXPECT_EQ(out.str().back(), '\n');
}

TEST(Progress, IsSilentIfAsked) {
  std::ostringstream out;
  Progress(out, ProgressStyle::none, 2).show(2, 120.0);
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace sensory_growth::batch
