#include "render/picture/dart_picture.h"

#include "render/picture/colour.h"
#include "render/picture/obstacle_picture.h"
#include "sim/base/check.h"
#include "sim/topology/walk.h"

namespace rend {
namespace {

constexpr std::array<Colour, 4> link_colours{{{25, 25, 28}, {200, 35, 45}, {35, 80, 190}, {30, 140, 70}}};
constexpr Colour dart_colour{40, 42, 48};
// The dot of a dart is interpolated between its vertex and the midpoints of its edge, of its face and, in a
// solid, of its volume.
constexpr double to_edge = 0.22, to_face = 0.24, to_volume = 0.16;

class Darts {
public:
  Darts(const Body& body, FrameBody& out)
      : map_(body.map->map()), body_(body), out_(out), dots_(map_.capacity(), Vec3::Zero()) {
    double length = 0;
    std::size_t count = 0;
    map_.for_each_dart([&](Dart d) {
      dots_[d.value] = dot(d);
      length += (place(d) - place(map_.alpha(0, d))).norm();
      ++count;
    });
    size_ = count > 0 ? 0.022 * length / static_cast<double>(count) : 0;
  }

  void add(Dart d) {
    const FrameBody ball = rounded_box(dots_[d.value], Vec3::Zero(), 1.6 * size_, 3, dart_colour);
    out_.corners.insert(out_.corners.end(), ball.corners.begin(), ball.corners.end());
    for (int i = 0; i < 4; ++i) {
      const Dart other = map_.alpha(i, d);
      if (d.value < other.value)
        add_rod(dots_[d.value], dots_[other.value], link_colours[static_cast<std::size_t>(i)]);
    }
  }

private:
  Vec3 place(Dart d) const { return body_.map->position()[body_.map->cells(Vertex).slot(d)].vec(); }

  Vec3 middle(Orbit orbit, Dart d) const {
    Vec3 sum = Vec3::Zero();
    const std::vector<Dart> darts = darts_of(map_, orbit, d);
    for (Dart each : darts) sum += place(each);
    return sum / static_cast<double>(darts.size());
  }

  Vec3 dot(Dart d) const {
    const Vec3 vertex = place(d), edge = 0.5 * (vertex + place(map_.alpha(0, d)));
    Vec3 at = vertex + to_edge * (edge - vertex);
    at += to_face * (middle(FaceOfVolume, d) - at);
    if (map_.dimension() == 3) at += to_volume * (middle(Volume, d) - at);
    return at;
  }

  // A bar with four sides, with the normals of a round one.
  void add_rod(const Vec3& from, const Vec3& to, const Colour& colour) {
    const Vec3 along = to - from;
    if (along.norm() == 0) return;
    int least = 0;
    along.cwiseAbs().minCoeff(&least);
    const Vec3 u = along.cross(Vec3::Unit(least)).normalized(), v = along.cross(u).normalized();
    const std::array<Vec3, 4> side{u, v, -u, -v};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 &a = side[k], &b = side[(k + 1) % 4];
      const auto corner = [&](const Vec3& end, const Vec3& normal) {
        out_.corners.push_back(
            {as_floats(end + size_ * normal), as_floats(normal), {colour[0], colour[1], colour[2], 255}, {}});
      };
      for (const auto& [end, normal] : {std::pair(from, a), {from, b}, {to, b}, {from, a}, {to, b}, {to, a}})
        corner(end, normal);
    }
  }

  const GMap& map_;
  const Body& body_;
  FrameBody& out_;
  std::vector<Vec3> dots_; // [m], one per dart
  double size_ = 0;        // [m], half the width of a bar
};

} // namespace

void draw_darts(const Body& body, FrameBody& out) {
  CHECK(body.map->map().dart_count() <= most_drawn_darts);
  out.edges = false;
  out.two_sided = false;
  out.shades_back = false;
  Darts darts(body, out);
  body.map->map().for_each_dart([&](Dart d) { darts.add(d); });
}

} // namespace rend
