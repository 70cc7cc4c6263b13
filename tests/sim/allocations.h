// Counts memory allocations of a piece of code, by operator new and the malloc family (Eigen), on every thread.
//
// allocations.cpp replaces both for the whole test program. Allocations by oneTBB's scheduler are not counted.
// Not available under AddressSanitizer, which replaces them itself.
#pragma once

#include <functional>
#include <string>

namespace rend::allocations {

#ifdef __SANITIZE_ADDRESS__
constexpr bool counted = false;
#else
constexpr bool counted = true;
#endif

long in(const std::function<void()>& work); // the number of allocations made by work()
std::string who();                          // the call stack of the first of them, for addr2line

} // namespace rend::allocations
