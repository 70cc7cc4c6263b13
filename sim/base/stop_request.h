// A request to stop: made by a signal handler, and asked for by everything that can take long: Newton's method,
// linear solves, substeps, repetitions of the guard, rounds of rules, building.
//
// Work that ends within the grace is completed, so that a run usually stops between two steps. What takes
// longer throws StopRequested, which only the makers of runs and the program itself catch.
#pragma once

namespace rend {

struct StopRequested {};

constexpr double stop_grace = 1; // [s]

// grace [s]. May be called from a signal handler; further calls change nothing.
void request_stop(double grace = stop_grace) noexcept;
void withdraw_stop() noexcept; // for tests
bool stop_is_due() noexcept;   // whether the grace of a request is over
void throw_if_stop_is_due();   // StopRequested. Without a request it costs a load

} // namespace rend
