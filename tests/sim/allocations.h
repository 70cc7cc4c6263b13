// Counts what asks for memory while it is looked at: operator new and the malloc family (Eigen), on every
// thread.
//
// allocations.cpp replaces both for the whole test program. What oneTBB asks for to hand out tasks is its own
// affair and not counted. Not under AddressSanitizer, which replaces them itself.
#pragma once

#include <functional>
#include <string>

namespace rend::allocations {

#ifdef __SANITIZE_ADDRESS__
constexpr bool counted = false;
#else
constexpr bool counted = true;
#endif

long in(const std::function<void()>& work); // how often memory is asked for in work()
std::string who();                          // asked first in it: the calls that led there, for addr2line

} // namespace rend::allocations
