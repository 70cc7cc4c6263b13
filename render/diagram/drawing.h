// A drawing: lines, circles, polygons and text in the order in which they are painted, for two writers:
// svg.h, and paint.h for pictures.
//
// Units are pixels of a drawing at scale 1; x to the right, y down.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace rend {

struct Spot {
  double x = 0, y = 0; // [pixels]
  friend Spot operator+(Spot a, Spot b) { return {a.x + b.x, a.y + b.y}; }
  friend Spot operator-(Spot a, Spot b) { return {a.x - b.x, a.y - b.y}; }
  friend Spot operator*(double t, Spot a) { return {t * a.x, t * a.y}; }
};
double distance(Spot a, Spot b);

// sRGB; opacity 0 is nothing.
struct Ink {
  unsigned rgb = 0; // 0xrrggbb
  double opacity = 1;
};
inline constexpr Ink no_ink{0, 0};

struct DrawnLine {
  Spot from, to;
  double width = 1;
  Ink ink;
  std::vector<double> dashes = {}; // lengths of strokes and gaps in turn; empty: one stroke
};
struct DrawnCircle {
  Spot centre;
  double radius = 1;
  Ink fill = no_ink, rim;
  double width = 1; // of the rim
};
struct DrawnPolygon {
  std::vector<Spot> corners;
  Ink fill;
};
struct DrawnText {
  enum class Align { Left, Middle };
  Spot at; // of the baseline
  std::string text;
  double size = 12; // height of the font
  Ink ink;
  Align align = Align::Left;
  bool bold = false;
};
using Drawn = std::variant<DrawnLine, DrawnCircle, DrawnPolygon, DrawnText>;

struct Drawing {
  double width = 0, height = 0;
  std::vector<Drawn> parts;

  // Another drawing, with its upper left corner there.
  void add(const Drawing& other, Spot at);
};

// The pieces of a line that are painted.
std::vector<std::pair<Spot, Spot>> strokes(const DrawnLine& line);

// About how wide a text is, where its font is not known.
double rough_width(const std::string& text, double size);

// The text on lines that are at most about that wide.
std::vector<std::string> in_lines(const std::string& text, double size, double width);

} // namespace rend
