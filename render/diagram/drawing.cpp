#include "render/diagram/drawing.h"

#include <algorithm>
#include <cmath>

namespace rend {

double distance(Spot a, Spot b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

namespace {

void shift(DrawnLine& line, Spot by) {
  line.from = line.from + by;
  line.to = line.to + by;
}
void shift(DrawnCircle& circle, Spot by) {
  circle.centre = circle.centre + by;
}
void shift(DrawnPolygon& polygon, Spot by) {
  for (Spot& corner : polygon.corners) corner = corner + by;
}
void shift(DrawnText& text, Spot by) {
  text.at = text.at + by;
}

} // namespace

void Drawing::add(const Drawing& other, Spot at) {
  for (Drawn part : other.parts) {
    std::visit([&](auto& each) { shift(each, at); }, part);
    parts.push_back(std::move(part));
  }
}

std::vector<std::pair<Spot, Spot>> strokes(const DrawnLine& line) {
  const double length = distance(line.from, line.to);
  if (line.dashes.empty() || length == 0) return {{line.from, line.to}};
  const auto point = [&](double at) { return line.from + at / length * (line.to - line.from); };
  std::vector<std::pair<Spot, Spot>> out;
  double at = 0;
  for (std::size_t n = 0; at < length; ++n) {
    const double end = std::min(length, at + std::max(0.5, line.dashes[n % line.dashes.size()]));
    if (n % 2 == 0) out.emplace_back(point(at), point(end));
    at = end;
  }
  return out;
}

double rough_width(const std::string& text, double size) {
  const auto letters = std::count_if(text.begin(), text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; });
  return 0.54 * size * static_cast<double>(letters);
}

std::vector<std::string> in_lines(const std::string& text, double size, double width) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    if (!lines.empty() && rough_width(lines.back() + " " + word, size) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

} // namespace rend
