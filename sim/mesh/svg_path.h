// Closed curves in the plane, from the path data of SVG 2 ("M 0 0 h 2 q 1 1 0 2 h -2 z"): commands M L H V C S
// Q T A Z, small ones relative. A subpath that does not end with Z is closed by a line. Arcs become cubic
// curves, each a quarter turn at most: W3C, Scalable Vector Graphics 2, appendix B.2.
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

using Vec2 = Eigen::Vector2d;
using Cubic = std::array<Vec2, 4>; // control points of a Bézier curve; a line has its ends twice
using Curve = std::vector<Cubic>;  // closed: each begins where the one before ends

// Where a text of SVG cannot be read, and why.
struct PathFault : std::invalid_argument {
  PathFault(std::size_t at_, const std::string& what) : std::invalid_argument(what), at(at_) {}
  std::size_t at; // character, from 0
};

// A text in which numbers may follow each other without a blank, as in "1-2.5.5".
class SvgText {
public:
  explicit SvgText(std::string_view text) : text_(text) {}

  bool ended() const { return at_ == text_.size(); }
  char next() const { return text_[at_]; } // if it has not ended
  void take() { ++at_; }
  void step_back() { --at_; }
  void skip();                    // blanks and commas
  std::optional<double> number(); // none there; PathFault: it is too large
  [[noreturn]] void fail(const std::string& what) const { throw PathFault(at_, what); }

private:
  std::string_view text_;
  std::size_t at_ = 0;
};

std::vector<Curve> curves_of_path(std::string_view path); // none: it encloses nothing. PathFault

} // namespace rend
