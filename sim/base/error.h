// Errors of the user or of the machine, and their exit codes.
//
// A message reads "file:line:column: what is wrong", and below it "hint: what would work". The codes are those
// of sysexits(3) where one fits.
#pragma once

#include <stdexcept>
#include <string>

namespace rend {

enum class Exit : int {
  Done = 0,
  CheckFailed = 1,   // the answer is no: pictures differ, a check failed
  DiffError = 2,     // `diff` only
  Usage = 64,        // the command line
  BadInput = 65,     // a preset or mesh
  NoInput = 66,      // no such file
  Bug = 70,          // a bug in rend
  CannotCreate = 73, // the output
  ReadWrite = 74,    // failed, such as a full disk
  OutOfBudget = 75,  // --max-time, --max-memory: resume can finish it
  Unstable = 76,     // the simulation was stopped
  Interrupted = 130,
  Terminated = 143,
};

// A place in a user's file. Line 0 stands for the file as a whole (or the command line).
struct Place {
  std::string file;
  int line = 0;             // from 1
  int column = 0;           // from 1
  std::string text() const; // "file:3:14", "file" or ""
};

// An error whose message is shown to the user as it is.
struct UserError : std::runtime_error {
  UserError(Exit code, const Place& place, const std::string& what, const std::string& hint = {});
  Exit code;
  std::string hint; // may be empty
};

} // namespace rend
