#include "sim/mesh/scanner.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace rend {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

} // namespace

void Scanner::end_in(const char* what) const {
  source_.fail(source_.bytes().size(), fmt::format("the file ends where {} is expected", what));
}

void Scanner::skip_blanks() {
  const std::string_view bytes = source_.bytes();
  while (at_ < bytes.size() && is_blank(bytes[at_])) ++at_;
}

bool Scanner::at_end() {
  skip_blanks();
  return left() == 0;
}

bool Scanner::line_ends() {
  const std::string_view bytes = source_.bytes();
  while (at_ < bytes.size() && is_blank(bytes[at_]) && bytes[at_] != '\n') ++at_;
  return at_ == bytes.size() || bytes[at_] == '\n' || bytes[at_] == '#';
}

std::string_view Scanner::token(const char* what) {
  skip_blanks();
  if (left() == 0) end_in(what);
  const std::string_view bytes = source_.bytes();
  last_ = at_;
  while (at_ < bytes.size() && !is_blank(bytes[at_])) ++at_;
  return bytes.substr(last_, at_ - last_);
}

std::string_view Scanner::rest_of_line() {
  const std::string_view bytes = source_.bytes();
  const std::size_t begin = at_, end = std::min(bytes.find('\n', at_), bytes.size());
  at_ = std::min(end + 1, bytes.size());
  const std::string_view line = bytes.substr(begin, end - begin);
  return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

void Scanner::skip_comments(char begin) {
  for (skip_blanks(); left() > 0 && source_.bytes()[at_] == begin; skip_blanks()) rest_of_line();
}

template <class T> T Scanner::parsed(const char* what) {
  const std::string_view text = token(what);
  const char *begin = text.data(), *end = begin + text.size();
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') ++begin;
  T value{};
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range && stop == end)
    fail(fmt::format("{} is expected, and {} is beyond the range of its numbers", what, in_quotes(text)));
  if (error != std::errc() || stop != end)
    fail(fmt::format("{} is expected, and {} is not one", what, in_quotes(text)));
  return value;
}

std::int64_t Scanner::integer(const char* what) {
  return parsed<std::int64_t>(what);
}

double Scanner::real(const char* what) {
  const double value = parsed<double>(what);
  check_finite(value, what);
  return value;
}

std::uint64_t Scanner::size(const char* what) {
  const std::int64_t value = integer(what);
  if (value < 0) fail(fmt::format("{} is expected, and {} is negative", what, value));
  return static_cast<std::uint64_t>(value);
}

std::int32_t Scanner::narrow(std::int64_t value, const char* what) const {
  const auto small = static_cast<std::int32_t>(value);
  if (small != value)
    fail(fmt::format("{} is expected, and {} is beyond the range of its numbers", what, value));
  return small;
}

void Scanner::check_finite(double value, const char* what) const {
  if (!std::isfinite(value)) fail(fmt::format("{} is expected, and {} is not a finite number", what, value));
}

void Scanner::check_count(std::uint64_t count, std::size_t bytes, const char* what) const {
  if (count > left() / bytes)
    fail(fmt::format("{} {} are announced, and the {} bytes that are left cannot hold them", count, what,
                     left()));
}

} // namespace rend
