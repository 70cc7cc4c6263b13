// Work over index ranges, on one thread or several. Results never depend on the number of threads.
#pragma once

#include <cstddef>

namespace rend {

// A non-owning reference to the function that is run for each range. A std::function would allocate memory in
// every step.
class RangeFunction {
public:
  template <class F>
  RangeFunction(const F& work)
      : work_(&work), call_([](const void* it, std::size_t begin, std::size_t end) {
          (*static_cast<const F*>(it))(begin, end);
        }) {}
  void operator()(std::size_t begin, std::size_t end) const { call_(work_, begin, end); }

private:
  const void* work_;
  void (*call_)(const void* work, std::size_t begin, std::size_t end);
};

// Splits [0, count) into `parts` ranges and calls work(begin, end) for each, on that many threads (oneTBB) or
// as many as the machine has; one part runs on the calling thread. Returns when all are done.
void parallel_ranges(int parts, std::size_t count, RangeFunction work);

int hardware_threads();

} // namespace rend
