#include "render/diagram/svg.h"

#include "sim/base/markup.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

std::string number(double x) {
  const double rounded = std::floor(x * 10 + 0.5) / 10;
  return fmt::format("{}", rounded == 0 ? 0 : rounded); // no -0
}

std::string ink(const char* attribute, const Ink& ink) {
  if (ink.opacity <= 0) return fmt::format(" {}=\"none\"", attribute);
  std::string out = fmt::format(" {}=\"#{:06x}\"", attribute, ink.rgb);
  if (ink.opacity < 1) out += fmt::format(" {}-opacity=\"{:.2g}\"", attribute, ink.opacity);
  return out;
}

std::string text_of(const DrawnLine& line) {
  std::string dashes;
  for (double each : line.dashes) dashes += (dashes.empty() ? "" : ",") + number(each);
  return fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{} stroke-width=\"{}\"{}/>",
                     number(line.from.x), number(line.from.y), number(line.to.x), number(line.to.y),
                     ink("stroke", line.ink), number(line.width),
                     dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"");
}

std::string text_of(const DrawnCircle& circle) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}{} stroke-width=\"{}\"/>", number(circle.centre.x),
                     number(circle.centre.y), number(circle.radius), ink("fill", circle.fill),
                     ink("stroke", circle.rim), number(circle.width));
}

std::string text_of(const DrawnPolygon& polygon) {
  std::string points;
  for (const Spot& corner : polygon.corners)
    points += (points.empty() ? "" : " ") + number(corner.x) + "," + number(corner.y);
  return fmt::format("<polygon points=\"{}\"{}/>", points, ink("fill", polygon.fill));
}

std::string text_of(const DrawnText& text) {
  return fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{}{}>{}</text>", number(text.at.x),
                     number(text.at.y), number(text.size), ink("fill", text.ink),
                     text.align == DrawnText::Align::Middle ? " text-anchor=\"middle\"" : "",
                     text.bold ? " font-weight=\"bold\"" : "",
                     in_markup(printable(text.text), MarkupQuotes::Double));
}

} // namespace

std::string svg_text(const Drawing& drawing) {
  const std::string width = number(drawing.width), height = number(drawing.height);
  std::string out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                                "viewBox=\"0 0 {0} {1}\" font-family=\"Inter, Helvetica, Arial, sans-serif\">\n"
                                "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
                                width, height);
  for (const Drawn& part : drawing.parts)
    out += std::visit([](const auto& each) { return text_of(each); }, part) + "\n";
  return out + "</svg>\n";
}

} // namespace rend
