#include "sim/mesh/svg_shapes.h"

#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace rend {
namespace {

std::vector<double> numbers_in(SvgText& in) { // up to what is no number
  std::vector<double> numbers;
  while (const auto number = in.number()) numbers.push_back(*number);
  return numbers;
}

// A length in units of the drawing; `otherwise`: it is not given.
class Lengths {
public:
  Lengths(const SvgAttributes& given, std::string_view& attribute) : given_(given), attribute_(attribute) {}

  std::optional<double> find(std::string_view name) const {
    const std::string_view text = given_.text(name);
    if (text.empty() || text == "auto") return std::nullopt;
    attribute_ = name;
    SvgText in(text.ends_with("px") ? text.substr(0, text.size() - 2) : text);
    const auto value = in.number();
    in.skip();
    if (!value || !in.ended()) in.fail(fmt::format("{} is to be a plain number here, without a unit", name));
    return value;
  }
  double at(std::string_view name) const { return find(name).value_or(0); }

private:
  const SvgAttributes& given_;
  std::string_view& attribute_;
};

// A closed path around it, by the words of path data.
std::vector<Curve> ellipse(double x, double y, double rx, double ry) {
  if (!(rx > 0) || !(ry > 0)) return {};
  return curves_of_path(
      fmt::format("M{0} {1} A{2} {3} 0 0 1 {4} {1} A{2} {3} 0 0 1 {0} {1} Z", x - rx, y, rx, ry, x + rx));
}

std::vector<Curve> rectangle(const Lengths& given) {
  const double x = given.at("x"), y = given.at("y"), width = given.at("width"), height = given.at("height");
  if (!(width > 0) || !(height > 0)) return {};
  const auto asked_x = given.find("rx"), asked_y = given.find("ry");
  const double rx = std::clamp(asked_x.value_or(asked_y.value_or(0)), 0.0, width / 2),
               ry = std::clamp(asked_y.value_or(asked_x.value_or(0)), 0.0, height / 2);
  if (!(rx > 0) || !(ry > 0))
    return curves_of_path(fmt::format("M{} {} h{} v{} h{} Z", x, y, width, height, -width));
  const double w = width - 2 * rx, h = height - 2 * ry;
  return curves_of_path(fmt::format("M{0} {1} h{2} a{4} {5} 0 0 1 {4} {5} v{3} a{4} {5} 0 0 1 {6} {5} h{7} "
                                    "a{4} {5} 0 0 1 {6} {8} v{9} a{4} {5} 0 0 1 {4} {8} Z",
                                    x + rx, y, w, h, rx, ry, -rx, -w, -ry, -h));
}

std::vector<Curve> polygon_of(std::string_view points) {
  SvgText in(points);
  const std::vector<double> numbers = numbers_in(in);
  if (!in.ended() || numbers.size() % 2 != 0) in.fail("points are pairs of numbers");
  Curve curve;
  const auto corner = [&](std::size_t n) { return Vec2(numbers[2 * n], numbers[2 * n + 1]); };
  const std::size_t count = numbers.size() / 2;
  for (std::size_t n = 0; n < count; ++n)
    curve.push_back({corner(n), corner(n), corner((n + 1) % count), corner((n + 1) % count)});
  return count < 3 ? std::vector<Curve>{} : std::vector<Curve>{curve};
}

Eigen::Matrix2d rotation_of(double degrees) {
  Eigen::Matrix2d turn;
  turn << cosine_of_degrees(degrees), -sine_of_degrees(degrees), sine_of_degrees(degrees),
      cosine_of_degrees(degrees);
  return turn;
}

// One of them with its numbers; none: it has another number of them, or another name.
std::optional<Eigen::Affine2d> transform_by(std::string_view name, const std::vector<double>& n) {
  Eigen::Affine2d out = Eigen::Affine2d::Identity();
  const auto with = [&](std::size_t one, std::size_t other) { return n.size() == one || n.size() == other; };
  if (name == "translate" && with(1, 2)) {
    out.translation() = Vec2(n[0], n.size() > 1 ? n[1] : 0);
  } else if (name == "scale" && with(1, 2)) {
    out.linear() = Vec2(n[0], n.back()).asDiagonal();
  } else if (name == "rotate" && with(1, 3)) {
    const Vec2 centre = n.size() > 1 ? Vec2(n[1], n[2]) : Vec2(0, 0);
    out.linear() = rotation_of(n[0]);
    out.translation() = centre - out.linear() * centre;
  } else if (name == "skewX" && with(1, 1)) {
    out.linear()(0, 1) = sine_of_degrees(n[0]) / cosine_of_degrees(n[0]);
  } else if (name == "skewY" && with(1, 1)) {
    out.linear()(1, 0) = sine_of_degrees(n[0]) / cosine_of_degrees(n[0]);
  } else if (name == "matrix" && with(6, 6)) {
    out.linear() << n[0], n[2], n[1], n[3];
    out.translation() = Vec2(n[4], n[5]);
  } else {
    return std::nullopt;
  }
  return out;
}

} // namespace

std::string_view SvgAttributes::text(std::string_view name) const {
  for (const char** one = given_; *one; one += 2)
    if (name == one[0]) return one[1];
  return {};
}

bool is_svg_shape(std::string_view element) {
  constexpr std::array<std::string_view, 6> all{"path", "rect", "circle", "ellipse", "polygon", "polyline"};
  return std::ranges::find(all, element) != all.end();
}

std::vector<Curve> curves_of_shape(std::string_view element, const SvgAttributes& given,
                                   std::string_view& attribute) {
  const Lengths lengths(given, attribute);
  const auto text = [&](std::string_view name) {
    attribute = name;
    return given.text(name);
  };
  if (element == "path") return text("d").empty() ? std::vector<Curve>{} : curves_of_path(given.text("d"));
  if (element == "rect") return rectangle(lengths);
  if (element == "circle") return ellipse(lengths.at("cx"), lengths.at("cy"), lengths.at("r"), lengths.at("r"));
  if (element == "ellipse")
    return ellipse(lengths.at("cx"), lengths.at("cy"), lengths.at("rx"), lengths.at("ry"));
  return polygon_of(text("points"));
}

Eigen::Affine2d transform_of(std::string_view text) {
  Eigen::Affine2d all = Eigen::Affine2d::Identity();
  SvgText in(text);
  for (in.skip(); !in.ended(); in.skip()) {
    const SvgText start = in;
    std::string name;
    while (!in.ended() && ((in.next() >= 'a' && in.next() <= 'z') || in.next() == 'X' || in.next() == 'Y')) {
      name += in.next();
      in.take();
    }
    in.skip();
    const bool opened = !in.ended() && in.next() == '(';
    if (!opened) start.fail("a transform is written as in translate(10 20) scale(2)");
    in.take();
    const std::vector<double> numbers = numbers_in(in);
    if (in.ended() || in.next() != ')') in.fail("the numbers of a transform end with )");
    in.take();
    const auto one = transform_by(name, numbers);
    if (!one) start.fail(fmt::format("there is no transform '{}' of {} numbers", name, numbers.size()));
    all = all * *one;
  }
  return all;
}

} // namespace rend
