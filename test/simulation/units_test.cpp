#include "sensory_growth/simulation/units.h"

#include <cstdio>
#include <cstdlib>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sensory_growth::simulation {
namespace {

struct Given {
  const char* text;
  Dimension dimension;
  double value;
};

void PrintTo(const Given& given, std::ostream* out) { *out << given.text; }

class GoodQuantity : public testing::TestWithParam<Given> {};

TEST_P(GoodQuantity, IsTurnedIntoSi) {
  const Given& given = GetParam();
  EXPECT_DOUBLE_EQ(parseQuantity(given.text, given.dimension), given.value) << given.text;
}

constexpr double pi = 3.14159265358979323846;

INSTANTIATE_TEST_SUITE_P(
    Units, GoodQuantity,
    testing::Values(Given{"0.8 mm", dimension::length, 8e-4}, Given{"65 um", dimension::length, 6.5e-5},
                    Given{"65 µm", dimension::length, 6.5e-5}, Given{"10 cm", dimension::length, 0.1},
                    Given{"2 m", dimension::length, 2.0}, Given{"1e-3 m", dimension::length, 1e-3},
                    Given{"-.5 m", dimension::length, -0.5}, Given{"+5. m", dimension::length, 5.0},
                    Given{"3 \t km", dimension::length, 3000.0}, Given{"1 in", dimension::length, 0.0254},
                    Given{"7 s", dimension::time, 7.0}, Given{"5 min", dimension::time, 300.0},
                    Given{"2 h", dimension::time, 7200.0}, Given{"1.5 d", dimension::time, 129600.0},
                    Given{"3 minutes", dimension::time, 180.0}, Given{"0.36 1/h", dimension::rate, 1e-4},
                    Given{"36 %/h", dimension::rate, 1e-4}, Given{"0.36 h-1", dimension::rate, 1e-4},
                    Given{"0.36 h^-1", dimension::rate, 1e-4}, Given{"1.2 1/min", dimension::rate, 0.02},
                    Given{"8.64 1/d", dimension::rate, 1e-4}, Given{"180 deg", dimension::angle, pi},
                    Given{"90 degree", dimension::angle, pi / 2}, Given{"90 °", dimension::angle, pi / 2},
                    Given{"0.1 rad", dimension::angle, 0.1}, Given{"5 1/m", dimension::curvature, 5.0},
                    Given{"5 1/mm", dimension::curvature, 5000.0}, Given{"9.81 m/s^2", dimension::acceleration, 9.81},
                    Given{"9.81 m/s2", dimension::acceleration, 9.81},
                    Given{"9.81 m s-2", dimension::acceleration, 9.81},
                    Given{"2 gravity", dimension::acceleration, 19.6133}, Given{"10 MPa", dimension::modulus, 1e7},
                    Given{"1 GPa", dimension::modulus, 1e9}, Given{"3 N/mm^2", dimension::modulus, 3e6},
                    Given{"5 kPa", dimension::modulus, 5e3}, Given{"1000 kg/m^3", dimension::density, 1000.0},
                    Given{"1.1 g/cm^3", dimension::density, 1100.0}, Given{"2 mN", dimension::force, 2e-3},
                    Given{"-3 uN", dimension::force, -3e-6}, Given{"2 uN/mm", dimension::line_force, 2e-3},
                    Given{"4 mN/mm", dimension::stiffness, 4.0}, Given{"2 kg/s^2", dimension::stiffness, 2.0},
                    Given{"3 mN mm", dimension::couple, 3e-6}, Given{"-3 uN.m", dimension::couple, -3e-6},
                    Given{"1 N*m", dimension::couple, 1.0}));

struct Bad {
  const char* text;
  Dimension dimension;
  const char* message;
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.text; }

class BadQuantity : public testing::TestWithParam<Bad> {};

TEST_P(BadQuantity, IsRefused) {
  const Bad& bad = GetParam();
  try {
    const double value = parseQuantity(bad.text, bad.dimension);
    FAIL() << "'" << bad.text << "' was read as " << value;
  } catch (const std::invalid_argument& refusal) {
    EXPECT_THAT(refusal.what(), testing::HasSubstr(bad.message)) << bad.text;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Units, BadQuantity,
    testing::Values(
        Bad{"0.8", dimension::length, "has no unit; give a length such as '0.8 mm'"},
        Bad{"0.8 ", dimension::length, "has no unit"}, Bad{"", dimension::length, "does not begin with"},
        Bad{"mm", dimension::length, "does not begin with"}, Bad{" 1 mm", dimension::length, "does not begin with"},
        Bad{"1,5 mm", dimension::length, "does not begin with"}, Bad{"1_000 mm", dimension::length, "does not begin"},
        Bad{"0x10 m", dimension::length, "does not begin with"}, Bad{"2h", dimension::time, "does not begin with"},
        Bad{"+-1 m", dimension::length, "does not begin with"}, Bad{"--1 m", dimension::length, "does not begin with"},
        Bad{"inf m", dimension::length, "does not begin with"}, Bad{"nan m", dimension::length, "does not begin with"},
        Bad{"1e999 m", dimension::length, "does not begin with"},
        Bad{"1e308 km", dimension::length, "beyond the range"}, Bad{"1 2 mm", dimension::length, "unknown unit '2 mm'"},
        Bad{"1 mm 2", dimension::length, "unknown unit 'mm 2'"},
        Bad{"1 smoot", dimension::length, "unknown unit 'smoot'"}, Bad{"1 mm\xff", dimension::length, "unknown unit"},
        Bad{"1 m @ 5", dimension::length, "unknown unit"}, Bad{"1 m from 5", dimension::length, "unknown unit"},
        Bad{"1 (m)", dimension::length, "unknown unit"}, Bad{"1 s since 2000", dimension::time, "unknown unit"},
        Bad{"1 s", dimension::length, "is a time; give a length"},
        Bad{"20 h", dimension::rate, "is a time; give a rate"}, Bad{"1 Hz", dimension::time, "is a rate; give a time"},
        Bad{"1 C", dimension::angle, "in units of s.A"}, Bad{"1 rad/h", dimension::rate, "in units of s-1.rad"},
        Bad{"1 degC", dimension::length, "in units of K"},
        Bad{"3 %", dimension::angle, "a number without a dimension; give an angle"},
        Bad{"9.81 m/s", dimension::acceleration, "in units of m.s-1; give an acceleration such as '9.81 m/s^2'"},
        Bad{"10 N", dimension::modulus, "is a force; give an elastic modulus such as '10 MPa'"},
        Bad{"10 N", dimension::stiffness, "is a force; give a stiffness such as '20 N/m'"},
        Bad{"10 N/m", dimension::couple, "is a force per length; give a couple such as '3 uN.m'"},
        Bad{"10 Pa", dimension::line_force, "is an elastic modulus; give a force per length such as '5 mN/m'"},
        Bad{"1 g", dimension::acceleration, "in units of kg"}));

TEST(Quantity, VeryLongUnitIsRefused) {
  EXPECT_THROW(parseQuantity("1 " + std::string(1000000, 'm'), dimension::length), std::invalid_argument);
}

TEST(Number, TakesDecimalNumbersOnly) {
  EXPECT_EQ(parseNumber("-1e-3"), -1e-3);
  EXPECT_EQ(parseNumber("+2"), 2.0);
  for (const char* text : {"", "1 m", "1,5", "0x10", "1e", "inf", "-inf", "nan", "1e999", "1 ", " 1", "one", "1.2.3"}) {
    EXPECT_THROW(parseNumber(text), std::invalid_argument) << text;
  }
}

TEST(Quantity, IsReadByManyThreadsAtOnce) {
  std::vector<double> sums(4, 0.0);
  std::vector<std::thread> threads;
  for (double& sum : sums) {
    threads.emplace_back([&sum] {
      for (int i = 0; i < 500; ++i) sum += parseQuantity("1 min", dimension::time);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(sums, testing::Each(30000.0));
}

TEST(QuantityDeathTest, MissingDatabaseIsExplained) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a fresh process, which has not read the database yet
  const auto read = [] {
    setenv("UDUNITS2_XML_PATH", "/nonexistent.xml", 1);
    try {
      parseQuantity("1 m", dimension::length);
    } catch (const std::runtime_error& error) {
      std::fputs(error.what(), stderr);
      std::exit(3);
    }
  };
  EXPECT_EXIT(read(), testing::ExitedWithCode(3), "udunits2 cannot read its database.*UDUNITS2_XML_PATH");
}

}  // namespace
}  // namespace sensory_growth::simulation
