// Sharing out work among threads.

#include "sensory_growth/simulation/workers.h"

#include <tbb/global_control.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/checksum.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::simulation {
namespace {

/// Threads also where the machine has fewer processors.
const tbb::global_control enough_threads(tbb::global_control::max_allowed_parallelism, 8);

TEST(Workers, DoEveryPieceOnce) {
  for (const int threads : {0, 1, 2, 5}) {
    Workers workers(threads);
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<int> calls(count, 0);
      workers.forEach(count, [&](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(calls, std::vector<int>(count, 1));
    }
  }
}

TEST(Workers, WorkAtTheSameTime) {
  // Two pieces that wait for each other are both done only if two threads take them.
  Workers workers(2);
  std::mutex mutex;
  std::condition_variable all_here;
  int here = 0;
  int met = 0;
  workers.forEach(2, [&](std::size_t) {
    std::unique_lock<std::mutex> lock(mutex);
    ++here;
    all_here.notify_all();
    if (all_here.wait_for(lock, std::chrono::seconds(30), [&] { return here == 2; })) ++met;
  });
  EXPECT_EQ(met, 2);
}

TEST(Workers, FinishTheOthersAndReportTheFirstError) {
  for (const int threads : {1, 4}) {
    Workers workers(threads);
    std::vector<int> calls(100, 0);
    std::string message;
    try {
      workers.forEach(calls.size(), [&](std::size_t i) {
        ++calls[i];
        if (i % 30 == 17) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, "17");
    EXPECT_EQ(calls, std::vector<int>(100, 1));
  }
}

TEST(Workers, RefuseANegativeNumberOfThreads) { EXPECT_THROW(Workers(-1), std::invalid_argument); }

TEST(Simulations, InThreadsDoNotMeet) {
  const auto grow = [](std::uint64_t& sum) {
    Simulation simulation(loadScenario("../config/dodder_and_host.yaml"), 1);
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(simulation.step().ok);
    sum = checksum(simulation);
  };
  std::uint64_t alone = 0, first = 0, second = 0;
  grow(alone);
  std::thread other(grow, std::ref(first));
  grow(second);
  other.join();
  EXPECT_EQ(first, alone);
  EXPECT_EQ(second, alone);
}

}  // namespace
}  // namespace sensory_growth::simulation
