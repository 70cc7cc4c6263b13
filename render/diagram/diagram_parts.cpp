#include "render/diagram/diagram_parts.h"

#include "render/diagram/map_picture.h"

namespace rend::diagram {
namespace {

constexpr double gap = 60; // between drawings in a row

void arrow(Drawing& drawing, Spot from, double length) {
  const Spot to = from + Spot{length, 0};
  drawing.parts.push_back(DrawnLine{from, to, 2, faint});
  drawing.parts.push_back(DrawnPolygon{{to + Spot{7, 0}, to + Spot{-3, -5}, to + Spot{-3, 5}}, faint});
}

} // namespace

double add_heading(Drawing& page, const std::string& name, const std::string& about) {
  page.parts.push_back(DrawnText{{20, 30}, name, 17, text_ink, DrawnText::Align::Left, true});
  double y = 50;
  for (const std::string& line : in_lines(about, 12, page.width - 40)) {
    page.parts.push_back(DrawnText{{20, y}, line, 12, faint});
    y += 17;
  }
  return y;
}

double width_of_heading(const std::string& name) {
  return rough_width(name, 17) + 40;
}

double width_of_row(const std::vector<Drawing>& row) {
  double width = gap * static_cast<double>(row.size() - 1);
  for (const Drawing& each : row) width += each.width;
  return width;
}

void add_row(Drawing& page, const std::vector<Drawing>& row, double top, double height) {
  double x = (page.width - width_of_row(row)) / 2;
  for (const Drawing& each : row) {
    if (&each != &row.front()) {
      arrow(page, {x + 12, top + height / 2}, gap - 30);
      x += gap;
    }
    page.add(each, {x, top + (height - each.height) / 2});
    x += each.width;
  }
}

double width_of_maps(std::size_t count) {
  return static_cast<double>(count) * map_side + static_cast<double>(count - 1) * gap;
}

double add_maps(Drawing& page, const std::vector<const EmbeddedMap*>& maps, const std::vector<Dart>& marked,
                double top) {
  const MapView view = MapView::of(maps);
  std::vector<Drawing> row;
  for (const EmbeddedMap* map : maps)
    row.push_back(picture_of(*map, view, row.empty() ? marked : std::vector<Dart>(), map_side));
  add_row(page, row, top, view.height(map_side));
  return top + view.height(map_side) + 10;
}

void add_caption(Drawing& page, const std::string& text, double y) {
  page.parts.push_back(DrawnText{{page.width / 2, y}, text, 11, faint, DrawnText::Align::Middle});
}

} // namespace rend::diagram
