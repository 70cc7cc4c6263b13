// A limit of the time that a command takes, whatever it does.
//
// Its parts ask how much time is left. Where one goes on beyond it (a long file is being read, say), a thread
// ends the program a moment later, with exit code 75 and without temporary files.
#pragma once

#include <string>
#include <thread>

namespace rend {

class TimeLimit {
public:
  // From now on. `what` takes the time, such as "filling"; `hint`: what would take less.
  TimeLimit(double seconds, const std::string& what, std::string hint);

  double left() const;            // [s], below 0 once it is over
  [[noreturn]] void fail() const; // UserError (OutOfBudget)
  void check() const;             // fails once it is over

private:
  void watch(const std::stop_token& over) const;

  double end_; // [s], of wall_clock()
  std::string what_, hint_;
  std::jthread watch_;
};

} // namespace rend
