#include "sim/mesh/outline.h"

#include "sim/base/check.h"
#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace rend {
namespace {

using Cubic = std::array<Vec2, 4>; // control points of a Bézier curve; a line has its ends twice

constexpr double flatness = 1e-4; // of the larger side of the box

struct Curves {
  std::vector<std::vector<Cubic>> rings;
};

// Reads the data of a path, command by command.
class PathReader {
public:
  explicit PathReader(std::string_view text) : text_(text) {}

  Curves read() {
    skip();
    if (at_ == text_.size()) fail("the path is empty");
    while (at_ < text_.size()) read_command();
    close();
    if (curves_.rings.empty()) throw PathFault(0, "the path encloses nothing");
    return std::move(curves_);
  }

private:
  [[noreturn]] void fail(const std::string& what) const { throw PathFault(at_, what); }

  void read_command() {
    const char given = text_[at_];
    const bool letter = (given >= 'a' && given <= 'z') || (given >= 'A' && given <= 'Z');
    if (letter) {
      ++at_;
      command_ = given;
    } else if (command_ == 0 || command_ == 'z' || command_ == 'Z') {
      fail("a path goes on with a command: M L H V C S Q T A or Z");
    }
    const char kind = command_ >= 'a' ? static_cast<char>(command_ - 'a' + 'A') : command_;
    relative_ = command_ >= 'a';
    if (!started_ && kind != 'M') fail("a path begins with M, and where it begins");
    draw(kind);
    last_ = kind;
    if (kind == 'M') command_ = relative_ ? 'l' : 'L'; // further pairs are lines
    skip();
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
      --at_;
      fail(fmt::format("'{}' is no command of a path: M L H V C S Q T A or Z", command_));
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
    curves_.rings.push_back(std::move(ring_));
    ring_.clear();
    here_ = begin_;
  }

  // From the ends to the centre (SVG 2, B.2.4), then in parts of at most a quarter turn.
  void arc() {
    Vec2 radius(number(), number());
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

  // Numbers may follow each other without a blank, as in "1-2.5.5".
  double number() {
    skip();
    const char* begin = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    const char* const digits = begin < end && *begin == '+' ? begin + 1 : begin;
    double value = 0;
    const auto [past, error] = std::from_chars(digits, end, value);
    if (error != std::errc() || !std::isfinite(value))
      fail(at_ == text_.size() ? fmt::format("the path ends within its command {}", command_)
                               : fmt::format("command {} of the path needs a number here", command_));
    if (std::abs(value) > 1e9) fail("numbers of a path are at most 1e9");
    at_ += static_cast<std::size_t>(past - begin);
    return value;
  }

  bool flag() { // a single digit, also without a blank after it
    skip();
    if (at_ == text_.size() || (text_[at_] != '0' && text_[at_] != '1')) fail("the flags of an arc are 0 or 1");
    return text_[at_++] == '1';
  }

  Vec2 point() {
    const double x = number(), y = number();
    return relative_ ? Vec2(here_ + Vec2(x, y)) : Vec2(x, y);
  }

  void skip() { // blanks and commas
    while (at_ < text_.size() && std::string_view(" \t\r\n,").find(text_[at_]) != std::string_view::npos) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Curves curves_;
  std::vector<Cubic> ring_;
  Vec2 here_ = Vec2::Zero(), begin_ = Vec2::Zero(), handle_ = Vec2::Zero();
  char command_ = 0, last_ = 0;
  bool relative_ = false, started_ = false;
};

double larger_side(const Eigen::AlignedBox2d& box) {
  return box.sizes().maxCoeff();
}

// Divided evenly. A part of n lies within 6/8 · M/n² of its chord, M: the larger of the second differences of
// the control points (the second derivative is at most 6 M, and a chord departs from a curve by h²/8 of it).
void flatten(const Cubic& c, double tolerance, Contour& ring) {
  const double bend = std::max((c[0] - 2 * c[1] + c[2]).norm(), (c[1] - 2 * c[2] + c[3]).norm()) * 6.0 / 8.0;
  const bool straight = c[0] == c[1] && c[2] == c[3];
  const int parts =
      straight ? 1 : std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / tolerance))), 1, 1000);
  for (int n = 1; n <= parts; ++n) {
    const double t = static_cast<double>(n) / parts, s = 1 - t;
    const Vec2 point =
        n == parts ? c[3]
                   : Vec2(s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3]);
    if (ring.empty() || point != ring.back()) ring.push_back(point);
  }
}

Outline flattened(const Curves& curves) {
  Eigen::AlignedBox2d box;
  for (const auto& ring : curves.rings)
    for (const Cubic& cubic : ring)
      for (const Vec2& point : cubic) box.extend(point);
  Outline outline;
  for (const auto& cubics : curves.rings) {
    Contour ring;
    for (const Cubic& cubic : cubics) flatten(cubic, flatness * larger_side(box), ring);
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() >= 3) outline.rings.push_back(std::move(ring));
  }
  if (outline.rings.empty()) throw PathFault(0, "the path encloses nothing");
  return outline;
}

// A star or a gear: corners at the radii in turn, evenly around from the top.
std::string path_around(int count, std::initializer_list<std::pair<double, double>> corners) { // radius, share
  std::string path;
  for (int n = 0; n < count; ++n)
    for (const auto& [radius, share] : corners) {
      const double degrees = 90 - 360 * (n + share) / count;
      path += fmt::format("{} {} {} ", path.empty() ? "M" : "L", radius * cosine_of_degrees(degrees),
                          radius * sine_of_degrees(degrees));
    }
  return path + "Z";
}

std::string path_of(OutlineName name) {
  switch (name) {
  case OutlineName::Path:
    CHECK(false);
  case OutlineName::Heart:
    return "M0,-0.95 C-0.3,-0.55 -1,-0.2 -1,0.38 C-1,0.72 -0.75,0.95 -0.47,0.95 C-0.25,0.95 -0.08,0.82 0,0.6 "
           "C0.08,0.82 0.25,0.95 0.47,0.95 C0.75,0.95 1,0.72 1,0.38 C1,-0.2 0.3,-0.55 0,-0.95 Z";
  case OutlineName::Star:
    return path_around(5, {{1, 0}, {0.45, 0.5}});
  case OutlineName::Disc:
    return "M1,0 A1,1 0 0 1 -1,0 A1,1 0 0 1 1,0 Z";
  case OutlineName::Ring:
    return "M1,0 A1,1 0 0 1 -1,0 A1,1 0 0 1 1,0 Z M0.6,0 A0.6,0.6 0 0 1 -0.6,0 A0.6,0.6 0 0 1 0.6,0 Z";
  case OutlineName::Drop:
    return "M0,1 C0.12,0.6 0.6,0.15 0.6,-0.4 A0.6,0.6 0 0 0 -0.6,-0.4 C-0.6,0.15 -0.12,0.6 0,1 Z";
  case OutlineName::Gear:
    return path_around(10, {{1, -0.18}, {1, 0.18}, {0.78, 0.28}, {0.78, 0.72}}) +
           " M0.3,0 A0.3,0.3 0 0 1 -0.3,0 A0.3,0.3 0 0 1 0.3,0 Z";
  }
  return {};
}

} // namespace

Eigen::AlignedBox2d Outline::box() const {
  Eigen::AlignedBox2d all;
  for (const Contour& ring : rings)
    for (const Vec2& point : ring) all.extend(point);
  return all;
}

bool Outline::contains(const Vec2& point) const {
  bool inside = false;
  for (const Contour& ring : rings)
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const Vec2 &a = ring[n], &b = ring[(n + 1) % ring.size()];
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      if (point.x() < a.x() + (b.x() - a.x()) * ((point.y() - a.y()) / (b.y() - a.y()))) inside = !inside;
    }
  return inside;
}

double Outline::area() const {
  constexpr int lines = 2000;
  const Eigen::AlignedBox2d all = box();
  double sum = 0;
  std::vector<double> crossings;
  for (int line = 0; line < lines; ++line) {
    const double y = all.min().y() + all.sizes().y() * (line + 0.5) / lines;
    crossings.clear();
    for (const Contour& ring : rings)
      for (std::size_t n = 0; n < ring.size(); ++n) {
        const Vec2 &a = ring[n], &b = ring[(n + 1) % ring.size()];
        if ((a.y() > y) != (b.y() > y))
          crossings.push_back(a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
      }
    std::ranges::sort(crossings);
    for (std::size_t n = 1; n < crossings.size(); n += 2) sum += crossings[n] - crossings[n - 1];
  }
  return sum * all.sizes().y() / lines;
}

Outline outline_of_path(std::string_view path) {
  return flattened(PathReader(path).read());
}

Outline named_outline(OutlineName name) {
  return outline_of_path(path_of(name));
}

Outline fitted(Outline outline, double size) {
  const Eigen::AlignedBox2d box = outline.box();
  const double scale = size / larger_side(box);
  const Vec2 middle = box.center();
  for (Contour& ring : outline.rings)
    for (Vec2& point : ring) point = (point - middle) * scale;
  return outline;
}

} // namespace rend
