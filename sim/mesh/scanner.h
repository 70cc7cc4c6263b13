// Reads a mesh file front to back, as text or as binary numbers, and never past its end.
//
// Counts are checked against the bytes that are left before memory is allocated for them, so that memory stays
// proportional to the size of the file.
#pragma once

#include "sim/mesh/source.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace rend {

class Scanner {
public:
  explicit Scanner(const MeshSource& source) : source_(source) {}

  const MeshSource& source() const { return source_; }
  std::size_t offset() const { return at_; } // where the next read starts
  std::size_t last() const { return last_; } // where the last token or number started
  std::size_t left() const { return source_.bytes().size() - at_; }
  void go_to(std::size_t offset) { at_ = offset; }
  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
    source_.fail(last_, what, hint); // at the last token
  }

  // Text. Blanks are spaces, tabs, carriage returns and line ends.
  bool at_end();                            // skips blanks
  bool line_ends();                         // skips blanks; a comment also ends a line
  std::string_view token(const char* what); // fails at the end of the file
  std::string_view rest_of_line();          // without the line end, which is skipped
  void skip_comments(char begin);           // and blanks; a comment is a line that starts with `begin`
  std::int64_t integer(const char* what);
  double real(const char* what);        // finite
  std::uint64_t size(const char* what); // an integer of at least 0

  // Binary, in the byte order of this machine or, with `swapped`, the other.
  template <class T> T raw(const char* what) {
    last_ = at_;
    if (left() < sizeof(T)) end_in(what);
    char bytes[sizeof(T)];
    for (std::size_t n = 0; n < sizeof(T); ++n)
      bytes[swapped ? sizeof(T) - 1 - n : n] = source_.bytes()[at_ + n];
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  bool swapped = false;
  bool binary = false; // number() reads binary numbers

  // T from text or binary: std::int32_t, std::uint64_t or a finite double.
  template <class T> T number(const char* what) {
    if constexpr (std::is_same_v<T, double>) {
      if (!binary) return real(what);
      const double value = raw<double>(what);
      check_finite(value, what);
      return value;
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
      return binary ? raw<std::uint64_t>(what) : size(what);
    } else {
      return binary ? raw<T>(what) : narrow(integer(what), what);
    }
  }

  // Fails at the last number unless `count` items of at least `bytes` each fit into the rest of the file.
  void check_count(std::uint64_t count, std::size_t bytes, const char* what) const;

private:
  void skip_blanks();
  std::int32_t narrow(std::int64_t value, const char* what) const;
  void check_finite(double value, const char* what) const;
  template <class T> T parsed(const char* what);
  [[noreturn]] void end_in(const char* what) const;

  const MeshSource& source_;
  std::size_t at_ = 0, last_ = 0;
};

} // namespace rend
