// What a user may get wrong about the surroundings.

#include "sensory_growth/mechanics/surroundings.h"

#include <limits>

#include <gmock/gmock.h>

#include "sensory_growth/mechanics/energy.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using testing::AllOf;
using testing::HasSubstr;
using testing::Optional;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::optional<std::string> faultOf(const Spring& spring) { return findFault(Surroundings{{{}, spring}, {}, {}}); }
std::optional<std::string> faultOf(const Wall& wall) { return findFault(Surroundings{{}, {{}, wall}, {}}); }
std::optional<std::string> faultOf(const HeldApex& apex) { return findFault(Surroundings{{}, {}, apex}); }

TEST(FindFault, FindsNoneInWhatMakesSense) {
  EXPECT_EQ(findFault(Surroundings()), std::nullopt);
  EXPECT_EQ(faultOf(Spring{0.3, Vector3::Ones(), 12.0}), std::nullopt);
  EXPECT_EQ(faultOf(Wall{Vector3::Ones(), Vector3(0.6, 0.0, -0.8), 1e3}), std::nullopt);
  EXPECT_EQ(faultOf(HeldApex{Vector3::Ones(), rod::exp({1.0, 2.0, 0.0})}), std::nullopt);
}

TEST(FindFault, NamesFieldValueAndRule) {
  EXPECT_THAT(faultOf(Spring{1.5, Vector3::Zero(), 1.0}),
              Optional(std::string("springs[1].label is 1.5; it must lie in [0, 1]")));
  EXPECT_THAT(faultOf(Spring{kNan, Vector3::Zero(), 1.0}), Optional(HasSubstr("springs[1].label")));
  EXPECT_THAT(faultOf(Spring{0.5, Vector3::Zero(), -2.0}),
              Optional(AllOf(HasSubstr("springs[1].stiffness is -2"), HasSubstr("not negative"))));
  EXPECT_THAT(faultOf(Spring{0.5, Vector3::Zero(), kInfinity}), Optional(HasSubstr("finite")));
  EXPECT_THAT(faultOf(Spring{0.5, Vector3(0.0, kNan, 0.0), 1.0}), Optional(HasSubstr("springs[1].anchor")));
  EXPECT_THAT(faultOf(Wall{Vector3::Zero(), Vector3(0.0, 0.0, 2.0), 1.0}),
              Optional(std::string("walls[1].normal is (0, 0, 2); it must be a unit vector")));
  EXPECT_THAT(faultOf(Wall{Vector3::Zero(), Vector3::Constant(kNan), 1.0}), Optional(HasSubstr("walls[1].normal")));
  EXPECT_THAT(faultOf(Wall{Vector3::Zero(), Vector3::UnitX(), 0.0}), Optional(HasSubstr("walls[1].stiffness is 0")));
  EXPECT_THAT(faultOf(Wall{Vector3::Zero(), Vector3::UnitX(), kNan}), Optional(HasSubstr("walls[1].stiffness")));
  EXPECT_THAT(faultOf(Wall{Vector3(kInfinity, 0.0, 0.0), Vector3::UnitX(), 1.0}),
              Optional(HasSubstr("walls[1].point")));
  EXPECT_THAT(faultOf(HeldApex{Vector3(kNan, 0.0, 0.0), {}}), Optional(HasSubstr("held_apex.position")));
  EXPECT_THAT(faultOf(HeldApex{Vector3::Zero(), rod::Quaternion(2.0, 0.0, 0.0, 0.0)}),
              Optional(AllOf(HasSubstr("held_apex.frame"), HasSubstr("norm 1"))));
}

TEST(Energy, CountsWhatYieldsAndNotWhatIsRigid) {
  const rod::Rod rod =
      rod::straightRod({{5.0, 0.0, 0.0}, rod::Quaternion::Identity()}, 1.0, 2, support::section(0.05, 1.0, 0.0));
  Loads loads;
  loads.surroundings.springs.push_back({0.5, {5.0, 0.2, 0.5}, 3.0});                   // 3 / 2 0.2^2
  loads.surroundings.walls.push_back({{0.0, 0.0, 0.7}, -rod::Vector3::UnitZ(), 8.0});  // 8 / 2 0.3^2 of the apex
  loads.surroundings.walls.push_back({{0.0, 0.0, 0.9}, -rod::Vector3::UnitZ()});
  EXPECT_NEAR(energy(rod, loads).surroundings, 0.06 + 0.36, 1e-15);
  EXPECT_NEAR(energy(rod, loads).total(), 0.42, 1e-15);
}

}  // namespace
}  // namespace sensory_growth::mechanics
