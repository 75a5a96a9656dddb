// Kernels of memory against closed forms of their convolutions, and histories against what happens to an organ.

#include "sensory_growth/growth/memory.h"

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/rods.h"

namespace sensory_growth::growth {
namespace {

using support::order;

using Signal = std::function<double(double)>;

constexpr double kDuration = 5.0;

/// Rising times from 0 to kDuration, at irregular distances around the mean one.
std::vector<double> irregularTimes(int steps, unsigned seed = 7) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  std::vector<double> times{0.0};
  for (int i = 0; i < steps; ++i) times.push_back(times.back() + uniform(generator));
  for (double& time : times) time *= kDuration / times.back();
  return times;
}

/// What is perceived at the last of the times.
double perceived(const MemoryKernel& kernel, BeforeStart before, const std::vector<double>& times,
                 const Signal& signal) {
  Memory memory(kernel, before);
  double value = 0.0;
  for (const double t : times) value = memory.remember(t, {0.0}, {{signal(t), -2.0 * signal(t)}})[0].x();
  return value;
}

/// The error at kDuration for sin(3 t), by `steps` irregular steps that are halved with every level.
double errorOfSine(const MemoryKernel& kernel, int level, double expected) {
  std::vector<double> times = irregularTimes(40);
  for (int i = 0; i < level; ++i) {
    std::vector<double> halved{0.0};
    for (std::size_t k = 1; k < times.size(); ++k) {
      halved.push_back(0.5 * (times[k - 1] + times[k]));
      halved.push_back(times[k]);
    }
    times = halved;
  }
  return perceived(kernel, BeforeStart::zero, times, [](double t) { return std::sin(3.0 * t); }) - expected;
}

void expectSecondOrder(const MemoryKernel& kernel, double expected) {
  EXPECT_LT(std::abs(errorOfSine(kernel, 3, expected)), 2e-4);
  EXPECT_NEAR(order(errorOfSine(kernel, 2, expected), errorOfSine(kernel, 3, expected)), 2.0, 0.1);
  EXPECT_NEAR(order(errorOfSine(kernel, 3, expected), errorOfSine(kernel, 4, expected)), 2.0, 0.1);
}

const Signal kStep = [](double) { return 1.0; };
const Signal kRamp = [](double t) { return t; };

// --- Closed forms
// -----------------------------------------------------------------------------------------------------

TEST(ExponentialMemory, IsExactForWhatIsLinearHoweverTimeIsCut) {
  for (const int steps : {1, 3, 50}) {
    const std::vector<double> times = irregularTimes(steps);
    const double fading = std::exp(-kDuration / 0.7);
    EXPECT_NEAR(perceived(exponentialKernel(0.7), BeforeStart::zero, times, kStep), 1.0 - fading, 1e-13);
    EXPECT_NEAR(perceived(exponentialKernel(0.7), BeforeStart::zero, times, kRamp), kDuration - 0.7 * (1.0 - fading),
                1e-13);
    EXPECT_NEAR(perceived(exponentialKernel(0.7), BeforeStart::constant, times, kStep), 1.0, 1e-14);
  }
}

TEST(ExponentialMemory, IsSecondOrderForASine) {
  const double T = 0.7, w = 3.0, t = kDuration;
  const double expected =
      (std::sin(w * t) - w * T * std::cos(w * t) + w * T * std::exp(-t / T)) / (1.0 + w * w * T * T);
  expectSecondOrder(exponentialKernel(T), expected);
}

TEST(LinearOdeMemory, IsExactForWhatIsLinearHoweverTimeIsCut) {
  const double T = 1.3;
  for (const int steps : {1, 3, 50}) {
    const std::vector<double> times = irregularTimes(steps);
    const auto answer = [&](double delay, const std::vector<double>& coefficients, const Signal& signal) {
      return perceived(LinearOde{delay, T, coefficients}, BeforeStart::zero, times, signal);
    };
    const double x = kDuration / T;
    // Critically damped.
    EXPECT_NEAR(answer(0.0, {2.0, 1.0}, kStep), 1.0 - (1.0 + x) * std::exp(-x), 1e-13);
    EXPECT_NEAR(answer(0.0, {2.0, 1.0}, kRamp), kDuration - 2.0 * T + (kDuration + 2.0 * T) * std::exp(-x), 1e-13);
    // Damped by half.
    const double w = std::sqrt(0.75);
    EXPECT_NEAR(answer(0.0, {1.0, 1.0}, kStep),
                1.0 - std::exp(-0.5 * x) * (std::cos(w * x) + 0.5 / w * std::sin(w * x)), 1e-13);
    // Three lags in a row.
    EXPECT_NEAR(answer(0.0, {3.0, 3.0, 1.0}, kStep), 1.0 - std::exp(-x) * (1.0 + x + 0.5 * x * x), 1e-13);
    // After a delay.
    const double y = (kDuration - 1.1) / T;
    EXPECT_NEAR(answer(1.1, {2.0, 1.0}, kStep), 1.0 - (1.0 + y) * std::exp(-y), 1e-13);
    EXPECT_NEAR(answer(1.1, {2.0, 1.0}, kRamp), kDuration - 1.1 - 2.0 * T + (kDuration - 1.1 + 2.0 * T) * std::exp(-y),
                1e-13);
  }
}

TEST(LinearOdeMemory, IsSecondOrderForASine) {
  // (1 + T d/dt)^2 y = sin(w (t - delay)) from rest: the real and imaginary parts of exp(i w t) / (1 + i w T)^2.
  const double T = 0.4, w = 3.0, t = kDuration - 0.6;
  const double D = 1.0 + w * w * T * T;
  const double a = (1.0 - w * w * T * T) / (D * D), b = -2.0 * w * T / (D * D);  // y -> a sin + b cos
  const double steady = a * std::sin(w * t) + b * std::cos(w * t);
  const double transient = std::exp(-t / T) * (-b - (a * w + b / T) * t);
  expectSecondOrder(LinearOde{0.6, T, {2.0, 1.0}}, steady + transient);
}

TEST(LinearOdeMemory, IsFiniteAndAtRestAfterStepsThatAreVeryLong) {
  for (const double duration : {5.0, 5e4, 5e8}) {
    const LinearOde ode{0.0, kShortestTimeConstant, {2.0, 1.5, 0.5}};
    const double value = perceived(ode, BeforeStart::zero, {0.0, 0.5 * duration, duration}, kRamp);
    EXPECT_NEAR(value / duration, 1.0 - 2.0 * ode.time_constant / duration, 1e-15 * duration / ode.time_constant);
  }
}

TEST(DelayedMemory, PerceivesWhatWas) {
  for (const int steps : {1, 3, 50}) {
    const std::vector<double> times = irregularTimes(steps);
    EXPECT_NEAR(perceived(Delay{1.7}, BeforeStart::zero, times, kRamp), kDuration - 1.7, 1e-10);
    EXPECT_NEAR(perceived(Delay{0.0}, BeforeStart::zero, times, kRamp), kDuration, 0.0);
  }
}

TEST(DelayedMemory, IsSecondOrderForASine) {
  // On equal steps a third of the way between two samples: so it is again when they are halved.
  const double delay = 1.75 - 0.125 / 3.0;
  const auto error = [&](int steps) {
    std::vector<double> times;
    for (int i = 0; i <= steps; ++i) times.push_back(kDuration * i / steps);
    return perceived(Delay{delay}, BeforeStart::zero, times, [](double t) { return std::sin(3.0 * t); }) -
           std::sin(3.0 * (kDuration - delay));
  };
  EXPECT_NEAR(order(error(80), error(160)), 2.0, 0.1);
  EXPECT_NEAR(order(error(160), error(320)), 2.0, 0.1);
}

TEST(DelayedMemory, KnowsWhenWhatJumpedArrives) {
  const std::vector<double> label{0.0};
  const auto at = [](double value) { return SectionField{Eigen::Vector2d(value, 0.0)}; };
  for (const BeforeStart before : {BeforeStart::constant, BeforeStart::zero}) {
    Memory memory(Delay{0.7}, before);
    memory.remember(1.0, label, at(2.0));
    memory.remember(1.5, label, at(3.0));
    memory.remember(2.0, label, at(4.0));
    memory.remember(2.0, label, at(5.0));
    memory.remember(2.5, label, at(5.0));
    EXPECT_DOUBLE_EQ(memory.nextJump(1.6), before == BeforeStart::zero ? 1.7 : 2.7);
    EXPECT_DOUBLE_EQ(memory.nextJump(1.7), 2.7);
    EXPECT_EQ(memory.nextJump(2.7), HUGE_VAL);
  }
  Memory smooth(exponentialKernel(0.7), BeforeStart::zero);
  smooth.remember(1.0, label, at(2.0));
  EXPECT_EQ(smooth.nextJump(1.0), HUGE_VAL);
}

TEST(DelayedMemory, BeginsAsItIsTold) {
  EXPECT_EQ(perceived(Delay{6.0}, BeforeStart::zero, irregularTimes(9), [](double t) { return 3.0 + t; }), 0.0);
  EXPECT_EQ(perceived(Delay{6.0}, BeforeStart::constant, irregularTimes(9), [](double t) { return 3.0 + t; }), 3.0);
}

TEST(SampledMemory, IsExactForWhatIsLinearHoweverTimeIsCut) {
  // A triangle of area 1.5 with its centroid at 4/3.
  const SampledKernel triangle{{0.0, 1.0, 3.0}, {0.0, 1.0, 0.0}};
  for (const int steps : {1, 3, 50}) {
    const std::vector<double> times = irregularTimes(steps);
    EXPECT_NEAR(perceived(triangle, BeforeStart::zero, times, kStep), 1.5, 1e-13);
    EXPECT_NEAR(perceived(triangle, BeforeStart::zero, times, kRamp), 1.5 * kDuration - 2.0, 1e-13);
  }
}

TEST(SampledMemory, CountsWhatWasBeforeTheStartOnlyIfTold) {
  const SampledKernel box{{4.0, 8.0}, {0.25, 0.25}};
  EXPECT_NEAR(perceived(box, BeforeStart::zero, irregularTimes(9), kStep), 0.25, 1e-13);
  EXPECT_NEAR(perceived(box, BeforeStart::constant, irregularTimes(9), kStep), 1.0, 1e-13);
}

TEST(SampledMemory, IsSecondOrderForASine) {
  const SampledKernel box{{1.0, 3.0}, {0.5, 0.5}};
  const double w = 3.0;
  expectSecondOrder(box, 0.5 / w * (std::cos(w * (kDuration - 3.0)) - std::cos(w * (kDuration - 1.0))));
}

// --- Histories
// ------------------------------------------------------------------------------------------------------

TEST(Memory, TakesTwoSamplesAtOneTimeForAJump) {
  // On from 1 to 2: the difference of two step responses, with nothing lost in the steps where it switches.
  Memory memory(exponentialKernel(0.7), BeforeStart::zero);
  for (const auto& [t, u] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}, {2.0, 0.0}}) {
    memory.remember(t, {0.0}, {{u, 0.0}});
  }
  EXPECT_NEAR(memory.expect(3.0, {0.0}, {{0.0, 0.0}})[0].x(), std::exp(-1.0 / 0.7) - std::exp(-2.0 / 0.7), 1e-14);
}

TEST(Memory, PerceivesADelayedJumpFromTheSideOfTheStepThatAsks) {
  Memory memory(Delay{2.0}, BeforeStart::zero);
  for (const auto& [t, u] : {std::pair(0.0, 1.0), {1.0, 1.0}, {1.0, 5.0}, {2.0, 5.0}})
    memory.remember(t, {0.0}, {{u, 0.0}});
  EXPECT_NEAR(memory.expect(3.0, {0.0}, {{0.0, 0.0}})[0].x(), 1.0, 1e-10);
  EXPECT_NEAR(memory.remember(3.0, {0.0}, {{0.0, 0.0}})[0].x(), 5.0, 1e-10);
}

/// Kernels of every kind.
std::vector<MemoryKernel> allKernels() {
  return {Delay{},
          Delay{0.5},
          exponentialKernel(0.7),
          LinearOde{0.5, 0.3, {1.9, 1.0}},
          LinearOde{0.0, 0.3, {3.0, 3.0, 1.0}},
          SampledKernel{{0.0, 0.2, 0.9}, {1.0, 1.5, 0.0}}};
}

SectionField randomField(std::mt19937& generator, std::size_t size) {
  SectionField field;
  for (std::size_t i = 0; i < size; ++i) field.push_back(support::randomVector(generator, 1.0).head<2>());
  return field;
}

TEST(Memory, ForgettingTheOldAndTakingBackChangeNoBit) {
  const std::vector<double> labels{0.0, 0.5, 1.0};
  for (const MemoryKernel& kernel : allKernels()) {
    Memory plain(kernel, BeforeStart::zero);
    Memory used(kernel, BeforeStart::zero);
    std::mt19937 generator(3);
    std::size_t most = 0;
    for (int i = 0; i < 200; ++i) {
      const double time = 0.05 * i;
      const SectionField sensed = randomField(generator, 3);
      used.forgetTheOld();
      const std::size_t mark = used.size();
      used.remember(time, labels, randomField(generator, 3));  // a step that fails
      used.remember(time + 0.03, labels, randomField(generator, 3));
      used.expect(time + 0.04, labels, randomField(generator, 3));
      used.takeBack(mark);
      EXPECT_EQ(plain.remember(time, labels, sensed), used.remember(time, labels, sensed));
      EXPECT_EQ(plain.expect(time + 0.02, labels, sensed), used.expect(time + 0.02, labels, sensed));
      most = std::max(most, used.size());
    }
    EXPECT_EQ(plain.size(), 200u);
    EXPECT_LE(most, 22u) << kernel.index();
  }
}

TEST(Memory, RepeatedSamplesAreKeptOnce) {
  for (const MemoryKernel& kernel : allKernels()) {
    Memory memory(kernel, BeforeStart::constant);
    memory.remember(0.0, {0.0, 1.0}, {{1.0, 0.0}, {2.0, 0.0}});
    const SectionField once = memory.remember(0.2, {0.0, 1.0}, {{3.0, 0.0}, {5.0, 0.0}});
    const SectionField again = memory.remember(0.2, {0.0, 1.0}, {{3.0, 0.0}, {5.0, 0.0}});
    EXPECT_EQ(once, again);
    EXPECT_EQ(memory.size(), 2u);
  }
}

TEST(Memory, TissueThatIsBornLaterHasThePastOfWhereItComesFrom) {
  // A field that is linear along the organ at every time stays exact under any division.
  const auto field = [](const std::vector<double>& labels, double t) {
    SectionField values;
    for (const double label : labels) values.push_back({std::sin(t) * (1.0 - 3.0 * label), label * t * t});
    return values;
  };
  const std::vector<double> undivided{0.0, 0.25, 0.5, 0.75, 1.0};
  for (const MemoryKernel& kernel : allKernels()) {
    Memory plain(kernel, BeforeStart::zero);
    Memory divided(kernel, BeforeStart::zero);
    std::vector<double> labels = undivided;
    SectionField expected, actual;
    for (int i = 0; i <= 40; ++i) {
      const double t = 0.05 * i;
      expected = plain.remember(t, undivided, field(undivided, t));
      actual = divided.remember(t, labels, field(labels, t));
      if (i % 10 == 9) {  // the last element and another one divide
        labels.insert(labels.end() - 1, 0.5 * (labels.end()[-2] + 1.0));
        labels.insert(labels.begin() + 1, 0.5 * labels[1]);
      }
    }
    ASSERT_EQ(labels.size(), 13u);
    std::size_t of_old = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == undivided[of_old]) {
        EXPECT_LT((actual[i] - expected[of_old]).norm(), 1e-14);
        ++of_old;
      }
      const Eigen::Vector2d on_line = (1.0 - labels[i]) * actual.front() + labels[i] * actual.back();
      EXPECT_LT((actual[i] - on_line).norm(), 1e-14) << kernel.index() << " at " << labels[i];
    }
    EXPECT_EQ(of_old, undivided.size());
  }
}

TEST(MemoryKernel, RefusesWhatCannotBeComputed) {
  using testing::HasSubstr;
  const auto fault = [](const MemoryKernel& kernel) {
    const std::optional<Fault> found = findFault(kernel);
    return found ? found->field + " " + found->reason : "none";
  };
  for (const MemoryKernel& kernel : allKernels()) EXPECT_EQ(fault(kernel), "none");
  EXPECT_THAT(fault(Delay{-1.0}), HasSubstr("delay must be >= 0 s"));
  EXPECT_THAT(fault(LinearOde{std::nan(""), 1.0, {1.0}}), HasSubstr("delay must be >= 0 s"));
  EXPECT_THAT(fault(LinearOde{0.0, 9e-4, {1.0}}), HasSubstr("time_constant must be >= 1 ms"));
  EXPECT_THAT(fault(LinearOde{0.0, 1.0, {}}), HasSubstr("coefficients must be 1 to 8"));
  EXPECT_THAT(fault(LinearOde{0.0, 1.0, std::vector<double>(9, 1.0)}), HasSubstr("coefficients must be 1 to 8"));
  EXPECT_THAT(fault(LinearOde{0.0, 1.0, {-2.0, 1.0}}), HasSubstr("does not come to rest"));
  // Routh: (1 + x)(1 + x^2 - x / 2) and the like; c1 c2 must exceed c3.
  EXPECT_THAT(fault(LinearOde{0.0, 1.0, {1.0, 1.0, 1.01}}), HasSubstr("does not come to rest"));
  EXPECT_EQ(fault(LinearOde{0.0, 1.0, {1.0, 1.0, 0.99}}), "none");
  EXPECT_THAT(fault(SampledKernel{{0.0}, {1.0}}), HasSubstr("times must be two at least"));
  EXPECT_THAT(fault(SampledKernel{{0.0, 1.0}, {1.0}}), HasSubstr("densities must be as many as times"));
  EXPECT_THAT(fault(SampledKernel{{0.0, 0.0}, {1.0, 1.0}}), HasSubstr("times must rise"));
  EXPECT_THAT(fault(SampledKernel{{-1.0, 0.0}, {1.0, 1.0}}), HasSubstr("times must be >= 0 s"));
  EXPECT_THAT(fault(SampledKernel{{0.0, 1.0}, {1.0, std::nan("")}}), HasSubstr("densities must be finite"));
  EXPECT_THROW(Memory(Delay{-1.0}, BeforeStart::zero), std::invalid_argument);
}

}  // namespace
}  // namespace sensory_growth::growth
