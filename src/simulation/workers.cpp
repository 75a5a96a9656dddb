#include "sensory_growth/simulation/workers.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace sensory_growth::simulation {
namespace {

/// Keeps the exception of the smallest index.
class FirstError {
 public:
  void catchFrom(std::size_t index, const std::function<void(std::size_t)>& work) {
    try {
      work(index);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (error_ && index_ < index) return;
      error_ = std::current_exception();
      index_ = index;
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
  std::size_t index_ = 0;
};

}  // namespace

#ifdef __SANITIZE_THREAD__

/// Threads of the standard library: ThreadSanitizer does not see how oneTBB, which is not compiled with it, hands over.
struct Workers::Arena {
  explicit Arena(int threads) : threads(threads == 0 ? std::thread::hardware_concurrency() : threads) {}

  void share(std::size_t count, const std::function<void(std::size_t)>& one) const {
    std::atomic<std::size_t> next = 0;
    const auto takeSome = [&] {
      for (std::size_t i = next++; i < count; i = next++) one(i);
    };
    std::vector<std::thread> others(threads - 1);
    for (std::thread& other : others) other = std::thread(takeSome);
    takeSome();
    for (std::thread& other : others) other.join();
  }

  std::size_t threads;
};

#else

struct Workers::Arena {
  explicit Arena(int threads) : arena(threads == 0 ? tbb::task_arena::automatic : threads) {}

  void share(std::size_t count, const std::function<void(std::size_t)>& one) {
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, one); });
  }

  tbb::task_arena arena;
};

#endif

Workers::Workers(int threads) {
  if (threads < 0) throw std::invalid_argument("threads is " + std::to_string(threads) + "; it must be 0 or more");
  if (threads != 1) arena_ = std::make_unique<Arena>(threads);
}
Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;
Workers& Workers::operator=(Workers&&) noexcept = default;

void Workers::forEach(std::size_t count, const std::function<void(std::size_t)>& work) {
  FirstError error;
  const auto one = [&](std::size_t i) { error.catchFrom(i, work); };
  if (!arena_ || count < 2) {
    for (std::size_t i = 0; i < count; ++i) one(i);
  } else {
    arena_->share(count, one);
  }
  error.rethrow();
}

}  // namespace sensory_growth::simulation
