#include "render/picture/exploded_picture.h"

#include "sim/topology/walk.h"

namespace rend {
namespace {

class Cells {
public:
  Cells(const Body& body, double apart, const std::function<Colour(const CellCorner&)>& colour, FrameBody& out)
      : body_(body), map_(body.map->map()), vertices_(body.map->cells(Vertex)),
        x_(body.map->position().values()), solid_(body.map->dimension() == 3), apart_(apart), colour_(colour),
        out_(out), drawn_(map_.capacity()) {
    for (Slot v = 0; v < vertices_.slots(); ++v)
      if (vertices_.alive(v)) middle_ += x_[v].vec();
    middle_ /= static_cast<double>(std::max<std::size_t>(vertices_.count(), 1));
  }

  void add(Dart first) {
    if (drawn_[first.value]) return;
    const std::vector<Dart> darts = darts_of(map_, solid_ ? Volume : FaceOfVolume, first);
    Vec3 centre = Vec3::Zero();
    for (Dart d : darts) centre += place(d);
    centre /= static_cast<double>(darts.size());
    for (Dart d : darts)
      if (!drawn_[d.value]) add_face(d, centre);
  }

private:
  bool on_border(Dart d) const { // without tearing, as at the start
    return body_.border ? (*body_.border)[body_.map->slot(FaceOfVolume, d)] != 0 : map_.is_free(3, d);
  }
  Vec3 place(Dart d) const { return x_[vertices_.slot(d)].vec(); }

  void add_face(Dart first, const Vec3& centre) {
    corners_.clear();
    std::size_t n = 0;
    walk_two(map_, 0, 1, first, [&](Dart d) {
      drawn_[d.value] = 1;
      if (n++ % 2 == 0) corners_.push_back(d);
    });
    const Vec3 a = place(corners_[0]);
    Vec3 across = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i)
      across += (place(corners_[i]) - a).cross(place(corners_[i + 1]) - a);
    if (solid_ && across.dot(a - centre) < 0) std::reverse(corners_.begin(), corners_.end());
    const Vec3 step = apart_ * (centre - middle_);
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i) add_triangle(i, step);
  }

  void add_triangle(std::size_t i, const Vec3& step) {
    const auto line = [](bool edge) { return static_cast<std::uint8_t>(edge ? Line::Crease : Line::None); };
    const std::array<std::uint8_t, 4> lines{line(true), line(i + 2 == corners_.size()), line(i == 1), 0};
    for (const Dart d : {corners_[0], corners_[i], corners_[i + 1]}) {
      const Colour c = colour_({d, vertices_.slot(d), solid_ && !on_border(d)});
      out_.corners.push_back({as_floats(place(d) + step), {0, 0, 0}, {c[0], c[1], c[2], 255}, lines});
    }
  }

  const Body& body_;
  const GMap& map_;
  const CellIndex& vertices_;
  const std::vector<Record>& x_; // [m], positions, one per vertex slot
  const bool solid_;
  const double apart_;
  const std::function<Colour(const CellCorner&)>& colour_;
  FrameBody& out_;
  Vec3 middle_ = Vec3::Zero();      // [m]
  std::vector<std::uint8_t> drawn_; // one per dart: its face is drawn already
  std::vector<Dart> corners_;       // of the current face, one per vertex
};

} // namespace

void draw_exploded(const Body& body, double apart, const std::function<Colour(const CellCorner&)>& colour,
                   FrameBody& out) {
  Cells cells(body, apart, colour, out);
  body.map->map().for_each_dart([&](Dart d) { cells.add(d); });
}

} // namespace rend
