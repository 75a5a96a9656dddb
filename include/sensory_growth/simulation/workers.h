#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace sensory_growth::simulation {

/// Threads that share out pieces of work that do not depend on each other.
class Workers {
 public:
  /// At most `threads` at a time, the calling one among them; 0: as many as there are processors. Throws
  /// std::invalid_argument if negative.
  explicit Workers(int threads);
  ~Workers();
  Workers(Workers&&) noexcept;
  Workers& operator=(Workers&&) noexcept;

  /// Calls work(0) to work(count - 1), in any order, and returns when all are done. What `work` throws does not keep
  /// the others from running; of several exceptions that of the smallest index is rethrown.
  void forEach(std::size_t count, const std::function<void(std::size_t)>& work);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;  ///< none if there is one thread
};

}  // namespace sensory_growth::simulation
