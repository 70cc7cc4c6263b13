#include "sim/mechanics/shear_face.h"

#include "sim/mechanics/spring_law.h"
#include "sim/mechanics/spring_stiffness.h"
#include "sim/topology/walk.h"

namespace rend {
namespace {

bool has_face(const EmbeddedMap& map, int at_least, int at_most) {
  bool found = false;
  for_each_face(map, [&](Dart d) {
    const int sides = sides_of_face(map.map(), d);
    found = found || (sides >= at_least && sides <= at_most);
  });
  return found;
}

UnitParameters along_face_diagonal(const EmbeddedMap& body, Dart d, const std::vector<Word>& unit, double k,
                                   double damping) {
  const std::vector<Vec3> x = rest_positions(body, d, unit);
  return {k, damping, (x[1] - x[0]).norm()};
}

const std::vector<std::vector<Word>> face_diagonals{{"", "010"}, {"0", "10"}};
const std::vector<Word> across_corner{"0", "10"};

std::unique_ptr<Interaction> make_isotropic_face(EmbeddedMap& map, const InteractionRequest& request) {
  const bool there = has_face(map, 4, 4);
  if (!there && leave_out(request, "shear was left out: no face is a quad, which is what it acts on"))
    return nullptr;
  Pattern pattern{.owner = FaceOfVolume,
                  .support = FaceOfVolume,
                  .units = face_diagonals,
                  .fold = {},
                  .present = [](const GMap& m, Dart d, std::size_t) { return sides_of_face(m, d) == 4; }};
  if (map.dimension() == 3) pattern.fold.emplace_back("3");
  const StiffnessOf k = stiffness_of(request, &diagonal_stiffness);
  const double damping = request.settings.damping;
  return make_or_await<2>(map, there, request, "shear isotropic", spring_law(), pattern,
                          [=, surface = request.surface](const EmbeddedMap& body, Dart d, int unit) {
                            if (surface && !body.map().is_free(3, d)) return UnitParameters{};
                            if (sides_of_face(body.map(), d) != 4) return UnitParameters{};
                            return along_face_diagonal(body, d, face_diagonals[static_cast<std::size_t>(unit)],
                                                       k(body, d), damping);
                          });
}

// Whether the corner of d carries a spring: in a pentagon and larger polygons every corner, in a quad the
// corner of its smallest dart and the next one along that dart's edge. In a solid the smallest dart of both
// sides of the face counts, so that both sides carry springs at the same corners, where they are summed.
bool carries(const GMap& map, Dart d) {
  const int sides = sides_of_face(map, d);
  if (sides != 4) return sides > 4;
  const Dart first = smallest_dart(map, Face, d);
  const Dart next = map.alpha(0, first);
  return same_cell(map, VertexOfFaceBothSides, d, first) || same_cell(map, VertexOfFaceBothSides, d, next);
}

std::unique_ptr<Interaction> make_anisotropic_face(EmbeddedMap& map, const InteractionRequest& request) {
  const bool there = has_face(map, 4, 1 << 30);
  if (!there && leave_out(request, "shear was left out: no face has a diagonal, every one is a triangle"))
    return nullptr;
  Pattern pattern{.owner = VertexOfFace,
                  .support = FaceOfVolume,
                  .units = {across_corner},
                  .fold = {},
                  .present = [](const GMap& m, Dart d, std::size_t) { return sides_of_face(m, d) >= 4; }};
  if (map.dimension() == 3) pattern.fold.emplace_back("3");
  const StiffnessOf k = stiffness_of(request, &diagonal_stiffness);
  const double damping = request.settings.damping;
  return make_or_await<1>(map, there, request, "shear anisotropic", spring_law(), pattern,
                          [=, surface = request.surface](const EmbeddedMap& body, Dart d, int) {
                            if (surface && !body.map().is_free(3, d)) return UnitParameters{};
                            if (!carries(body.map(), d)) return UnitParameters{};
                            return along_face_diagonal(body, d, across_corner, k(body, d), damping);
                          });
}

} // namespace

InteractionType shear_face_isotropic() {
  return {.element = "shear",
          .kind = "isotropic",
          .what = "springs along both diagonals of each quad, one stiffness",
          .k_unit = "N/m",
          .make = make_isotropic_face,
          .where = "face",
          .by_formula = true};
}
InteractionType shear_face_anisotropic() {
  return {.element = "shear",
          .kind = "anisotropic",
          .what = "a spring across each corner, each with a stiffness of its own",
          .k_unit = "N/m",
          .make = make_anisotropic_face,
          .where = "face",
          .by_formula = true};
}

} // namespace rend
