#include "render/diagram/map_picture.h"

#include "render/diagram/rule_colours.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double map_margin = 16, shrunk_face = 0.88, shrunk_volume = 0.8;

struct Face {
  std::vector<Dart> darts; // one a corner, in turn; of an open face: one of each edge
  bool closed = false;
  double depth = 0; // how far away
};

class MapPicture {
public:
  MapPicture(const EmbeddedMap& map, const MapView& view, double side)
      : body_(map), map_(map.map()), view_(view), side_(side), scale_(view.scale(side)) {
    drawing_.width = side;
    drawing_.height = view.height(side);
  }

  Drawing run(const std::vector<Dart>& marked) {
    find_middles();
    for (const Face& face : faces()) draw(face);
    map_.for_each_dart([&](Dart d) { links(d); });
    map_.for_each_dart([&](Dart d) {
      if (smallest_dart(map_, map_.dimension() == 2 ? Orbit{1} : Orbit{1, 2}, d) == d)
        drawing_.parts.push_back(DrawnCircle{spot(d), 2, dark, no_ink, 0});
    });
    for (Dart d : marked) mark(d);
    return std::move(drawing_);
  }

private:
  Orbit element() const { return map_.dimension() == 2 ? Orbit{0, 1} : Orbit{0, 1, 2}; }

  // Of the element of each dart: the mean of its corners.
  void find_middles() {
    middle_.assign(map_.capacity(), Vec3::Zero());
    std::vector<bool> done(map_.capacity());
    map_.for_each_dart([&](Dart d) {
      if (done[d.value]) return;
      const std::vector<Dart> darts = darts_of(map_, element(), d);
      Vec3 sum = Vec3::Zero();
      for (Dart e : darts) sum += body_.position_of(e);
      for (Dart e : darts) {
        middle_[e.value] = sum / static_cast<double>(darts.size());
        done[e.value] = true;
      }
    });
  }

  // Where the corner of d is drawn: moved towards the middle of its element.
  Vec3 place(Dart d) const {
    const double keep = map_.dimension() == 2 ? shrunk_face : shrunk_volume;
    return middle_[d.value] + keep * (body_.position_of(d) - middle_[d.value]);
  }
  Spot spot(const Vec3& x) const {
    const Spot at = view_.project(x);
    const Spot middle = 0.5 * (view_.low + view_.high);
    return {side_ / 2 + scale_ * (at.x - middle.x), drawing_.height / 2 - scale_ * (at.y - middle.y)};
  }
  Spot spot(Dart d) const { return spot(place(d)); }

  // Those far away first; of one volume together.
  std::vector<Face> faces() const {
    std::vector<Face> all;
    std::vector<bool> done(map_.capacity());
    map_.for_each_dart([&](Dart d) {
      if (done[d.value]) return;
      Face face;
      face.closed = sides_of_face(map_, d) > 0;
      Vec3 sum = Vec3::Zero();
      const std::vector<Dart> darts = darts_of(map_, {0, 1}, d);
      for (Dart e : darts) {
        done[e.value] = true;
        sum += place(e);
        if (!face.closed && e <= map_.alpha(0, e)) face.darts.push_back(e);
      }
      if (face.closed)
        for (Dart e = d; face.darts.empty() || e != d; e = map_.follow(e, std::string_view("01")))
          face.darts.push_back(e);
      face.depth = 1000 * middle_[d.value].y() + sum.y() / static_cast<double>(darts.size());
      all.push_back(std::move(face));
    });
    std::stable_sort(all.begin(), all.end(), [](const Face& a, const Face& b) { return a.depth > b.depth; });
    return all;
  }

  void line(Dart a, Dart b) { drawing_.parts.push_back(DrawnLine{spot(a), spot(b), 1, dark}); }

  void draw(const Face& face) {
    if (face.closed) {
      DrawnPolygon polygon{{}, {0xdbe7f3, map_.dimension() == 2 ? 1 : 0.45}};
      for (Dart d : face.darts) polygon.corners.push_back(spot(d));
      drawing_.parts.push_back(std::move(polygon));
    }
    for (Dart d : face.darts) line(d, map_.alpha(0, d));
  }

  Vec3 middle_of(Orbit orbit, Dart d) const {
    Vec3 sum = Vec3::Zero();
    const std::vector<Dart> darts = darts_of(map_, orbit, d);
    for (Dart e : darts) sum += place(e);
    return sum / static_cast<double>(darts.size());
  }

  // The link to the next element.
  void links(Dart d) {
    const int link = map_.dimension();
    const Dart other = map_.alpha(link, d);
    if (other <= d) return;
    if (link == 2) {
      const Dart from = map_.alpha(0, d), to = map_.alpha(0, other);
      const auto near = [&](Dart a, Dart b) { return spot(0.7 * place(a) + 0.3 * place(b)); };
      drawing_.parts.push_back(DrawnLine{near(d, from), near(other, to), 1.6, ink_of_link(2)});
    } else if (smallest_dart(map_, {0, 1, 3}, d) == d) {
      drawing_.parts.push_back(
          DrawnLine{spot(middle_of({0, 1}, d)), spot(middle_of({0, 1}, other)), 2, ink_of_link(3)});
    }
  }

  // A dart: the half of its edge next to its vertex, inside of its face.
  void mark(Dart d) {
    const Vec3 from = place(d), to = place(map_.alpha(0, d));
    const Vec3 inside = middle_of({0, 1}, d);
    const Vec3 end = from + 0.45 * (to - from);
    const Spot a = spot(from + 0.1 * (inside - from)), b = spot(end + 0.1 * (inside - end));
    drawing_.parts.push_back(DrawnLine{a, b, 3, {0xd55e00}});
    drawing_.parts.push_back(DrawnCircle{a, 3.2, {0xd55e00}, no_ink, 0});
  }

  static constexpr Ink dark{0x333333};

  const EmbeddedMap& body_;
  const GMap& map_;
  const MapView& view_;
  double side_, scale_;
  std::vector<Vec3> middle_; // of the element of each dart
  Drawing drawing_;
};

} // namespace

MapView MapView::of(const std::vector<const EmbeddedMap*>& maps) {
  MapView view;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto each_point = [&](const auto& take) {
    for (const EmbeddedMap* map : maps) map->map().for_each_dart([&](Dart d) { take(map->position_of(d)); });
  };
  each_point([&](const Vec3& x) {
    low = std::min(low, x.z());
    high = std::max(high, x.z());
  });
  view.flat = !(high > low);
  bool first = true;
  each_point([&](const Vec3& x) {
    const Spot at = view.project(x);
    view.low = first ? at : Spot{std::min(view.low.x, at.x), std::min(view.low.y, at.y)};
    view.high = first ? at : Spot{std::max(view.high.x, at.x), std::max(view.high.y, at.y)};
    first = false;
  });
  return view;
}

Spot MapView::project(const Vec3& x) const {
  return flat ? Spot{x.x(), x.y()} : Spot{x.x() + 0.42 * x.y(), x.z() + 0.3 * x.y()};
}

double MapView::scale(double side) const {
  const double extent = std::max({high.x - low.x, high.y - low.y, 1e-9});
  return std::min((side - 2 * map_margin) / extent, 130.0);
}

double MapView::height(double side) const {
  return scale(side) * (high.y - low.y) + 2 * map_margin;
}

Drawing picture_of(const EmbeddedMap& map, const MapView& view, const std::vector<Dart>& marked, double side) {
  return MapPicture(map, view, side).run(marked);
}

} // namespace rend
