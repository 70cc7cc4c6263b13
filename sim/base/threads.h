// Work over ranges of vertices, on one thread or several. What is computed never depends on how many.
#pragma once

#include <cstddef>

namespace rend {

// Refers to what is to be done for a range; it has to outlive the reference. A std::function would ask for
// memory in every step.
class PartWork {
public:
  template <class F>
  PartWork(const F& work)
      : work_(&work), call_([](const void* it, std::size_t begin, std::size_t end) {
          (*static_cast<const F*>(it))(begin, end);
        }) {}
  void operator()(std::size_t begin, std::size_t end) const { call_(work_, begin, end); }

private:
  const void* work_;
  void (*call_)(const void* work, std::size_t begin, std::size_t end);
};

// Calls work(begin, end) for `parts` ranges that together are [0, count), on as many threads (oneTBB) or as
// many as the machine has; with one part directly. Returns when all are done.
void in_parts(int parts, std::size_t count, PartWork work);

int hardware_threads();

} // namespace rend
