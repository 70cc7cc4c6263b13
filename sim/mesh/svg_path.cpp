#include "sim/mesh/svg_path.h"

#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rend {
namespace {

// Reads the data of a path, command by command.
class PathReader {
public:
  explicit PathReader(std::string_view text) : in_(text) {}

  std::vector<Curve> read() {
    in_.skip();
    if (in_.ended()) in_.fail("the path is empty");
    while (!in_.ended()) read_command();
    close();
    return std::move(curves_);
  }

private:
  void read_command() {
    const char given = in_.next();
    const bool letter = (given >= 'a' && given <= 'z') || (given >= 'A' && given <= 'Z');
    if (letter) {
      in_.take();
      command_ = given;
    } else if (command_ == 0 || command_ == 'z' || command_ == 'Z') {
      in_.fail("a path goes on with a command: M L H V C S Q T A or Z");
    }
    const char kind = command_ >= 'a' ? static_cast<char>(command_ - 'a' + 'A') : command_;
    relative_ = command_ >= 'a';
    if (!started_ && kind != 'M') in_.fail("a path begins with M, and where it begins");
    draw(kind);
    last_ = kind;
    if (kind == 'M') command_ = relative_ ? 'l' : 'L'; // further pairs are lines
    in_.skip();
  }

  void draw(char kind) {
    switch (kind) {
    case 'M':
      move(point());
      return;
    case 'L':
      return line(point());
    case 'H':
      return line({number() + (relative_ ? here_.x() : 0), here_.y()});
    case 'V':
      return line({here_.x(), number() + (relative_ ? here_.y() : 0)});
    case 'C': {
      const Vec2 one = point(), two = point();
      return curve(one, two, point());
    }
    case 'S': {
      const Vec2 one = last_ == 'C' || last_ == 'S' ? Vec2(2 * here_ - handle_) : here_, two = point();
      return curve(one, two, point());
    }
    case 'Q': {
      const Vec2 middle = point();
      return quadratic(middle, point());
    }
    case 'T': {
      const Vec2 middle = last_ == 'Q' || last_ == 'T' ? Vec2(2 * here_ - handle_) : here_;
      return quadratic(middle, point());
    }
    case 'A':
      return arc();
    case 'Z':
      return close();
    default:
      in_.step_back();
      in_.fail(fmt::format("'{}' is no command of a path: M L H V C S Q T A or Z", command_));
    }
  }

  void move(const Vec2& to) {
    close();
    here_ = begin_ = to;
    started_ = true;
  }

  void line(const Vec2& to) { add({here_, here_, to, to}); }

  void curve(const Vec2& one, const Vec2& two, const Vec2& to) {
    handle_ = two;
    add({here_, one, two, to});
  }

  void quadratic(const Vec2& middle, const Vec2& to) {
    handle_ = middle;
    add({here_, (here_ + 2 * middle) / 3, (to + 2 * middle) / 3, to});
  }

  void add(const Cubic& cubic) {
    if (ring_.empty()) begin_ = here_;
    ring_.push_back(cubic);
    here_ = cubic[3];
  }

  void close() {
    if (ring_.empty()) return;
    if (here_ != begin_) line(begin_);
    curves_.push_back(std::move(ring_));
    ring_.clear();
    here_ = begin_;
  }

  // From the ends to the centre (SVG 2, B.2.4), then in parts of at most a quarter turn.
  void arc() {
    const double rx = number(), ry = number(); // in this order, which arguments would not have
    Vec2 radius(rx, ry);
    const double degrees = number();
    const bool large = flag(), sweep = flag();
    const Vec2 to = point();
    radius = radius.cwiseAbs();
    if (to == here_) return;
    if (!(radius.minCoeff() > 1e-9 * (to - here_).norm())) return line(to); // as SVG has it for 0
    Eigen::Matrix2d turn;
    turn << cosine_of_degrees(degrees), -sine_of_degrees(degrees), sine_of_degrees(degrees),
        cosine_of_degrees(degrees);
    const Vec2 half = (turn.transpose() * ((here_ - to) / 2)).cwiseQuotient(radius);
    radius *= std::max(1.0, half.norm());
    const Vec2 one =
        (turn.transpose() * ((here_ - to) / 2)).cwiseQuotient(radius); // on the unit circle's chord
    const double away = std::sqrt(std::max(0.0, 1 / one.squaredNorm() - 1)) * (large == sweep ? -1 : 1);
    const Vec2 centre = away * Vec2(one.y(), -one.x());
    const double from = arc_tangent(one.y() - centre.y(), one.x() - centre.x());
    double angle = arc_tangent(-one.y() - centre.y(), -one.x() - centre.x()) - from;
    if (sweep && angle < 0) angle += 2 * pi;
    if (!sweep && angle > 0) angle -= 2 * pi;
    const Vec2 middle = (here_ + to) / 2 + turn * centre.cwiseProduct(radius);
    const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (pi / 2) - 1e-9)));
    const double step = angle / parts, pull = 4.0 / 3.0 * tangent(step / 4);
    for (int n = 0; n < parts; ++n) {
      const double a = from + n * step, b = from + (n + 1) * step;
      const auto place = [&](const Vec2& unit) { return Vec2(middle + turn * unit.cwiseProduct(radius)); };
      const Vec2 ua(cosine(a), sine(a)), ub(cosine(b), sine(b));
      add({here_, place(ua + pull * Vec2(-ua.y(), ua.x())), place(ub - pull * Vec2(-ub.y(), ub.x())),
           n + 1 == parts ? to : place(ub)});
    }
  }

  double number() {
    if (const auto value = in_.number()) return *value;
    in_.fail(in_.ended() ? fmt::format("the path ends within its command {}", command_)
                         : fmt::format("command {} of the path needs a number here", command_));
  }

  bool flag() { // a single digit, also without a blank after it
    in_.skip();
    const char digit = in_.ended() ? ' ' : in_.next();
    if (digit != '0' && digit != '1') in_.fail("the flags of an arc are 0 or 1");
    in_.take();
    return digit == '1';
  }

  Vec2 point() {
    const double x = number(), y = number();
    return relative_ ? Vec2(here_ + Vec2(x, y)) : Vec2(x, y);
  }

  SvgText in_;
  std::vector<Curve> curves_; // in the units and axes of the path
  Curve ring_;
  Vec2 here_ = Vec2::Zero(), begin_ = Vec2::Zero(), handle_ = Vec2::Zero();
  char command_ = 0, last_ = 0;
  bool relative_ = false, started_ = false;
};

} // namespace

void SvgText::skip() {
  while (at_ < text_.size() && std::string_view(" \t\r\n,").find(text_[at_]) != std::string_view::npos) ++at_;
}

std::optional<double> SvgText::number() {
  skip();
  const char* begin = text_.data() + at_;
  const char* const end = text_.data() + text_.size();
  const char* const digits = begin < end && *begin == '+' ? begin + 1 : begin;
  double value = 0;
  const auto [past, error] = std::from_chars(digits, end, value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  if (std::abs(value) > 1e9) fail("numbers are at most 1e9");
  at_ += static_cast<std::size_t>(past - begin);
  return value;
}

std::vector<Curve> curves_of_path(std::string_view path) {
  return PathReader(path).read();
}

} // namespace rend
