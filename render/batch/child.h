// Another rend, that runs beside this one: a failure of it is a failure of it alone.
//
// What it says is caught in memory. It has a process group of its own, so that a key of the terminal reaches
// this program alone, which passes it on; and it is asked to stop where this program is gone.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace rend {

class Child {
public:
  // Runs this very program with these arguments, and with these variables set as well. Throws UserError:
  // OutOfBudget where the system starts no more programs, CannotCreate.
  Child(const std::vector<std::string>& arguments,
        const std::vector<std::pair<std::string, std::string>>& variables);
  ~Child(); // ends it, if it runs
  Child(Child&&) noexcept;
  Child& operator=(Child&&) = delete;

  bool running(); // looks, and does not wait
  void signal(int number) const;
  std::size_t resident() const; // [bytes], now

  // Once it runs no more.
  int code() const { return code_; }         // exit code; 128 and the signal's number, where one ended it
  std::size_t peak() const { return peak_; } // [bytes], the most that was resident
  std::string out() const;                   // what it wrote to stdout
  std::string err() const;                   // and to stderr

private:
  int process_ = -1;        // its id; −1: it runs no more
  int out_ = -1, err_ = -1; // descriptors of files in memory
  int code_ = 0;
  std::size_t peak_ = 0;
};

} // namespace rend
