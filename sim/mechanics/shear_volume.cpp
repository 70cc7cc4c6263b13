#include "sim/mechanics/shear_volume.h"

#include "sim/mechanics/element.h"
#include "sim/mechanics/spring_law.h"
#include "sim/mechanics/spring_stiffness.h"
#include "sim/topology/walk.h"

namespace rend {
namespace {

const std::vector<std::vector<Word>> volume_diagonals{
    {"", "010210"}, {"0", "10210"}, {"010", "210"}, {"10", "0210"}};

bool in_hexahedron(const GMap& map, Dart d, std::size_t) {
  return element_present<ElementKind::Hexahedron>(map, d, 0);
}

// Why the interaction has no unit here; nullopt if it has some.
std::optional<std::string> reason_to_leave_out(const EmbeddedMap& map) {
  bool found = false;
  if (map.dimension() == 3)
    map.map().for_each_dart([&](Dart d) { found = found || in_hexahedron(map.map(), d, 0); });
  if (found) return {};
  return "shear where=\"volume\" was left out: no cell is a hexahedron, and others keep their shape by their "
         "faces";
}

UnitParameters along_volume_diagonal(const EmbeddedMap& body, Dart d, const std::vector<Word>& unit, double k,
                                     double damping) {
  const std::vector<Vec3> x = rest_positions(body, d, unit);
  return {k, damping, (x[1] - x[0]).norm()};
}

void refuse_surface(const InteractionRequest& request) {
  if (request.surface)
    throw UserError(Exit::BadInput, request.settings.source.place(),
                    "springs on the surface have no diagonals inside", "leave it out, or take where=\"face\"");
}

std::unique_ptr<Interaction> make_isotropic_volume(EmbeddedMap& map, const InteractionRequest& request) {
  refuse_surface(request);
  const auto missing = reason_to_leave_out(map);
  if (missing && leave_out(request, *missing)) return nullptr;
  const Pattern pattern{
      .owner = Volume, .support = Volume, .units = volume_diagonals, .fold = {}, .present = &in_hexahedron};
  const StiffnessOf k = stiffness_of(request, nullptr);
  const double damping = request.settings.damping;
  return make_or_await<4>(map, !missing, request, "shear isotropic volume", spring_law(), pattern,
                          [=](const EmbeddedMap& body, Dart d, int unit) {
                            if (!in_hexahedron(body.map(), d, 0)) return UnitParameters{};
                            return along_volume_diagonal(
                                body, d, volume_diagonals[static_cast<std::size_t>(unit)], k(body, d), damping);
                          });
}

std::unique_ptr<Interaction> make_anisotropic_volume(EmbeddedMap& map, const InteractionRequest& request) {
  refuse_surface(request);
  const auto missing = reason_to_leave_out(map);
  if (missing && leave_out(request, *missing)) return nullptr;
  const Pattern pattern{.owner = VertexOfVolume,
                        .support = Volume,
                        .units = {volume_diagonals.front()},
                        .fold = {},
                        .present = &in_hexahedron};
  const StiffnessOf k = stiffness_of(request, nullptr);
  const double damping = request.settings.damping;
  return make_or_await<1>(map, !missing, request, "shear anisotropic volume", spring_law(), pattern,
                          [=](const EmbeddedMap& body, Dart d, int) {
                            const GMap& m = body.map();
                            if (!in_hexahedron(m, d, 0)) return UnitParameters{};
                            const Dart far_end = m.follow(d, volume_diagonals.front().back());
                            if (smallest_dart(m, VertexOfVolume, far_end) < smallest_dart(m, VertexOfVolume, d))
                              return UnitParameters{}; // the other end carries it
                            return along_volume_diagonal(body, d, volume_diagonals.front(), k(body, d),
                                                         damping);
                          });
}

} // namespace

InteractionType shear_volume_isotropic() {
  return {"shear", "isotropic",           "springs along the diagonals of each hexahedron, one stiffness",
          "N/m",   make_isotropic_volume, "volume"};
}
InteractionType shear_volume_anisotropic() {
  return {"shear",
          "anisotropic",
          "springs along the diagonals of each hexahedron, each with its own stiffness",
          "N/m",
          make_anisotropic_volume,
          "volume"};
}

} // namespace rend
