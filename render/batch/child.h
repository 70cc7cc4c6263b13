// A child process that runs this same program: if it fails, the parent does not.
//
// Its stdout and stderr are captured in memory. It has a process group of its own, so that a key pressed on the
// terminal (Ctrl-C) signals the parent alone, which passes it on; and the kernel sends it a signal to stop if
// the parent ends.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace rend {

class Child {
public:
  // Runs this program with these arguments, and with these environment variables added. Throws UserError:
  // OutOfBudget where the system refuses to start another process, CannotCreate.
  Child(const std::vector<std::string>& arguments,
        const std::vector<std::pair<std::string, std::string>>& variables);
  ~Child(); // kills it if it still runs
  Child(Child&&) noexcept;
  Child& operator=(Child&&) = delete;

  bool running(); // polls, without waiting
  void signal(int number) const;
  std::size_t resident() const; // [bytes], now

  // Valid once it has ended.
  int code() const { return code_; }         // exit code; 128 plus the signal's number where a signal ended it
  std::size_t peak() const { return peak_; } // [bytes], peak resident size
  std::string out() const;                   // what it wrote to stdout
  std::string err() const;                   // what it wrote to stderr

private:
  int process_ = -1;        // process id; −1: it has ended
  int out_ = -1, err_ = -1; // descriptors of in-memory files
  int code_ = 0;
  std::size_t peak_ = 0;
};

} // namespace rend
