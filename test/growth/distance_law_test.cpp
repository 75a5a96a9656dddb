#include "sensory_growth/growth/distance_law.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace sensory_growth::growth {
namespace {

TEST(DistanceLaw, HasTheClosedFormsOfTheModel) {
  EXPECT_EQ(factor(ConstantPull{}, 7.0), 1.0);
  EXPECT_NEAR(factor(InversePowerPull{0.1, 2.0}, 0.4), 1.0 / 16.0, 1e-16);
  EXPECT_NEAR(factor(InversePowerPull{0.1, 0.0}, 0.4), 1.0, 1e-16);
  EXPECT_NEAR(factor(ExponentialPull{0.2}, 0.4), 0.13533528323661270, 1e-16);
  EXPECT_NEAR(factor(GaussianPull{0.2}, 0.4), 0.13533528323661270, 1e-16);
  EXPECT_NEAR(factor(GaussianPull{0.2}, 0.2), 0.60653065971263342, 1e-16);
}

TEST(DistanceLaw, IsLinearBetweenSamplesAndConstantOutside) {
  const SampledPull pull{{0.1, 0.3, 0.4}, {1.0, 0.5, -0.5}};
  EXPECT_EQ(factor(pull, 0.0), 1.0);
  EXPECT_EQ(factor(pull, 0.1), 1.0);
  EXPECT_NEAR(factor(pull, 0.25), 0.625, 1e-15);
  EXPECT_NEAR(factor(pull, 0.35), 0.0, 1e-15);
  EXPECT_EQ(factor(pull, 0.4), -0.5);
  EXPECT_EQ(factor(pull, 9.0), -0.5);
  EXPECT_EQ(factor(SampledPull{{0.2}, {0.7}}, 0.1), 0.7);
  EXPECT_EQ(factor(SampledPull{{0.2}, {0.7}}, 0.3), 0.7);
}

TEST(DistanceLaw, FarAwayFactorsAreFinite) {
  for (const DistanceLaw& law : {DistanceLaw(InversePowerPull{1e-9, 10.0}), DistanceLaw(ExponentialPull{1e-9}),
                                 DistanceLaw(GaussianPull{1e-9})}) {
    EXPECT_EQ(factor(law, 1e300), 0.0);
  }
}

TEST(DistanceLaw, RefusesWhatWouldNotBeFinite) {
  const double nan = std::nan("");
  EXPECT_FALSE(findFault(ConstantPull{}, 0.0));
  EXPECT_FALSE(findFault(InversePowerPull{0.1, 2.0}, 1e-3));
  EXPECT_TRUE(findFault(InversePowerPull{0.1, 2.0}, 0.0));
  EXPECT_TRUE(findFault(InversePowerPull{0.1, 2.0}, 0.9e-4));  // 1.2e6 times as strong near the source
  EXPECT_FALSE(findFault(InversePowerPull{0.1, 2.0}, 1.1e-4));
  EXPECT_TRUE(findFault(InversePowerPull{0.1, -1.0}, 1e-3));
  EXPECT_TRUE(findFault(InversePowerPull{nan, 1.0}, 1e-3));
  EXPECT_TRUE(findFault(ExponentialPull{0.0}, 0.0));
  EXPECT_TRUE(findFault(GaussianPull{std::numeric_limits<double>::infinity()}, 0.0));
  EXPECT_TRUE(findFault(SampledPull{{}, {}}, 0.0));
  EXPECT_TRUE(findFault(SampledPull{{1.0, 2.0}, {1.0}}, 0.0));
  EXPECT_TRUE(findFault(SampledPull{{2.0, 1.0}, {1.0, 1.0}}, 0.0));
  EXPECT_TRUE(findFault(SampledPull{{1.0, nan}, {1.0, 1.0}}, 0.0));
  EXPECT_FALSE(findFault(SampledPull{{1.0, 2.0}, {1.0, -1.0}}, 0.0));
}

}  // namespace
}  // namespace sensory_growth::growth
