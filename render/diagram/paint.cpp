#include "render/diagram/paint.h"

#include "render/diagram/glyphs.h"
#include "sim/base/error.h"
#include "sim/base/math.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr int lines_per_pixel = 5;
constexpr double most_side = 8192; // [pixels], as of pictures of a scene

// Before memory is taken for them: a name in the drawing may be as long as its file.
void check_size(double width, double height) {
  if (width <= most_side && height <= most_side) return;
  throw UserError(
      Exit::BadInput, {},
      fmt::format("the drawing would have {:.0f} x {:.0f} pixels; at most {:.0f} a side are allowed", width,
                  height, most_side),
      "an .svg file has no pixels; or use shorter names");
}

std::vector<Spot> regular_polygon(Spot centre, double radius) {
  constexpr int sides = 64;
  std::vector<Spot> out;
  for (int n = 0; n < sides; ++n)
    out.push_back(centre +
                  radius * Spot{cosine_of_degrees(360.0 * n / sides), sine_of_degrees(360.0 * n / sides)});
  return out;
}

class Painter {
public:
  Painter(Image& image, double scale) : image_(image), scale_(scale) {}

  void paint(const DrawnLine& line) {
    for (const auto& [from, to] : strokes(line)) {
      const double length = distance(from, to);
      if (length == 0) continue;
      const Spot along = 0.5 * line.width / length * (to - from), across{-along.y, along.x};
      fill({{from + across, to + across, to - across, from - across}}, line.ink);
    }
  }

  void paint(const DrawnCircle& circle) {
    const double half = circle.rim.opacity > 0 ? circle.width / 2 : 0;
    if (circle.fill.opacity > 0) fill({regular_polygon(circle.centre, circle.radius)}, circle.fill);
    if (half == 0) return;
    std::vector<Spot> inside = regular_polygon(circle.centre, std::max(0.0, circle.radius - half));
    std::reverse(inside.begin(), inside.end()); // a hole
    fill({regular_polygon(circle.centre, circle.radius + half), std::move(inside)}, circle.rim);
  }

  void paint(const DrawnPolygon& polygon) { fill({polygon.corners}, polygon.fill); }

  void paint(const DrawnText& text) {
    const std::string words = printable(text.text);
    double x = text.at.x;
    if (text.align == DrawnText::Align::Middle) x -= width_of_glyphs(words, text.size, text.bold) / 2;
    for (const Contours& glyph : glyphs_of(words, text.size, text.bold, {x, text.at.y})) fill(glyph, text.ink);
  }

private:
  struct Crossing {
    double x;
    int turn; // 1: downwards, -1: upwards
  };

  // What lies within the contours, a contour of the other sense being a hole.
  void fill(const Contours& contours, const Ink& ink) {
    if (ink.opacity <= 0) return;
    double low = image_.height, high = 0;
    for (const auto& contour : contours)
      for (const Spot& at : contour) {
        low = std::min(low, at.y * scale_);
        high = std::max(high, at.y * scale_);
      }
    const int first = std::max(0, static_cast<int>(std::floor(low)));
    const int last = std::min(image_.height - 1, static_cast<int>(std::floor(high)));
    for (int y = first; y <= last; ++y) fill_row(contours, ink, y);
  }

  void fill_row(const Contours& contours, const Ink& ink, int y) {
    share_.assign(static_cast<std::size_t>(image_.width), 0.0);
    for (int n = 0; n < lines_per_pixel; ++n) {
      find_crossings(contours, y + (n + 0.5) / lines_per_pixel);
      int winding = 0;
      for (std::size_t c = 0; c + 1 < crossings_.size(); ++c) {
        winding += crossings_[c].turn;
        if (winding != 0) add_span(crossings_[c].x, crossings_[c + 1].x);
      }
    }
    for (int x = 0; x < image_.width; ++x) {
      const double part = share_[static_cast<std::size_t>(x)];
      if (part > 0)
        mix(image_.row(y) + static_cast<std::size_t>(x) * 3, ink, std::min(1.0, part) * ink.opacity);
    }
  }

  void find_crossings(const Contours& contours, double y) {
    crossings_.clear();
    for (const auto& contour : contours)
      for (std::size_t n = 0; n < contour.size(); ++n) {
        const Spot a = scale_ * contour[n], b = scale_ * contour[(n + 1) % contour.size()];
        if ((a.y <= y) == (b.y <= y)) continue;
        crossings_.push_back({a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), a.y <= y ? 1 : -1});
      }
    std::stable_sort(crossings_.begin(), crossings_.end(),
                     [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
  }

  void add_span(double from, double to) {
    from = std::clamp(from, 0.0, static_cast<double>(image_.width));
    to = std::clamp(to, 0.0, static_cast<double>(image_.width));
    for (int x = static_cast<int>(from); x < to; ++x)
      share_[static_cast<std::size_t>(x)] +=
          (std::min(to, x + 1.0) - std::max(from, 1.0 * x)) / lines_per_pixel;
  }

  static void mix(std::uint8_t* pixel, const Ink& ink, double part) {
    for (int channel = 0; channel < 3; ++channel) {
      const double colour = ink.rgb >> (16 - 8 * channel) & 0xff;
      pixel[channel] = static_cast<std::uint8_t>(pixel[channel] + part * (colour - pixel[channel]) + 0.5);
    }
  }

  Image& image_;
  double scale_;
  std::vector<double> share_; // of a row's pixels
  std::vector<Crossing> crossings_;
};

} // namespace

Image paint(const Drawing& drawing, double scale) {
  require_glyphs();
  const double width = std::ceil(drawing.width * scale), height = std::ceil(drawing.height * scale);
  check_size(width, height);
  Image image(static_cast<int>(width), static_cast<int>(height));
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{255});
  Painter painter(image, scale);
  for (const Drawn& part : drawing.parts) std::visit([&](const auto& each) { painter.paint(each); }, part);
  return image;
}

} // namespace rend
