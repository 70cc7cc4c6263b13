#include "sim/rules/rule_directions.h"

#include "sim/expression/expression.h"
#include "sim/rules/rest_measures.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

struct Sum {
  Vec3 value = Vec3::Zero(), rate = Vec3::Zero();
};

class Finder {
public:
  Finder(const Edit& edit, bool at_rest, std::optional<Sides>& sides)
      : edit_(edit), map_(edit.map()), at_rest_(at_rest), sides_(sides) {}

  Sum along(Dart d, std::string_view which) const {
    if (which == "edge") {
      const Point from = edit_.point(d), to = edit_.point(map_.alpha(0, d));
      return {to.*place() - from.*place(), rate_of(to.velocity - from.velocity)};
    }
    if (which == "face") return face(d);
    Sum sum;
    for (Dart e : darts_of(map_, Vertex, d)) {
      if ((map_.dimension() == 3 && !map_.is_free(3, e)) || e > map_.alpha(1, e)) continue; // once a corner
      const Sum one = face(e);
      sum.value += one.value;
      sum.rate += one.rate;
    }
    return sum;
  }

private:
  Vec3 Point::*place() const { return at_rest_ ? &Point::rest : &Point::position; }
  Vec3 rate_of(const Vec3& rate) const { return at_rest_ ? Vec3(Vec3::Zero()) : rate; }

  Sum face(Dart d) const {
    const Vec3 n = face_vector(edit_, d, place());
    const double sense = map_.dimension() == 2 ? side(d) : outward(d, n);
    return {sense * n, sense * rate_of(face_vector_rate(edit_, d))};
  }

  // Out of its volume; of a flat one as of a face alone.
  double outward(Dart d, const Vec3& n) const {
    const Vec3 from_middle =
        mean_point(edit_, FaceOfVolume, d).*place() - mean_point(edit_, Volume, d).*place();
    const double out = n.dot(from_middle), length = std::sqrt(n.norm());
    if (std::abs(out) <= 1e-9 * length * length * length) return side(d);
    return out < 0 ? -1 : 1;
  }

  double side(Dart d) const {
    if (!sides_) sides_ = sides_of(map_);
    if (!sides_->orientable) throw ExpressionError(1, "a surface with one side has no normal");
    return d.value < sides_->of_dart.size() && sides_->of_dart[d.value] == 2 ? -1 : 1;
  }

  const Edit& edit_;
  const GMap& map_;
  bool at_rest_;
  std::optional<Sides>& sides_;
};

} // namespace

Direction direction_at(const Edit& edit, Dart d, std::string_view which, bool at_rest,
                       std::optional<Sides>& sides) {
  const Sum sum = Finder(edit, at_rest, sides).along(d, which);
  const double length = sum.value.norm();
  if (!(length > 0))
    throw ExpressionError(1, fmt::format("there is no direction '{}' at dart {}", which, d.value));
  const Vec3 unit = sum.value / length;
  return {unit, (sum.rate - sum.rate.dot(unit) * unit) / length};
}

} // namespace rend
