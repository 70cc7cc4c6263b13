#include "sim/mechanics/bend_angular.h"

#include "sim/mechanics/hinge_law.h"
#include "sim/mechanics/spring_stiffness.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

const std::vector<Word> hinge_corners{"", "0", "10", "010", "2", "20", "210", "2010"};

bool is_hinge(const GMap& map, Dart d, std::size_t = 0) {
  if (map.is_free(2, d)) return false;
  const int one = sides_of_face(map, d), two = sides_of_face(map, map.alpha(2, d));
  return one >= 3 && one <= 4 && two >= 3 && two <= 4;
}

// Initialised from rest positions and stiffness; fragments keep the values.
struct HingeEmbedding {
  using Value = HingeParameters;
  std::string name = "bend angular";
  Orbit orbit = EdgeOfVolume, support = FaceOfVolume;
  StiffnessOf k;
  double damping = 0;
  Value birth(const EmbeddedMap& body, Dart d) const {
    if (!is_hinge(body.map(), d)) return {};
    const std::vector<Vec3> rest = rest_positions(body, d, hinge_corners);
    HingePoints x;
    std::copy(rest.begin(), rest.end(), x.begin());
    return {k(body, d), damping, hinge_angle(x), hinge_fade_threshold(x)};
  }
  Value split(const Value& whole) const { return whole; }
};

struct Hinges final : Interaction {
  const Column<HingeEmbedding>* column = nullptr;
  const double* unit(Slot owner, std::size_t) const override { return &(*column)[owner].k; }
};

// Whether any edge has a hinge. If only some edges between faces have one, a note gives the number of those
// without.
bool has_hinge(const EmbeddedMap& map, std::vector<std::string>& notes) {
  if (!has_inner_edge(map)) {
    notes.emplace_back("bend was left out: no edge lies between two faces");
    return false;
  }
  std::size_t inner = 0, hinges = 0;
  map.map().for_each_dart([&](Dart d) {
    if (map.map().is_free(2, d) || smallest_dart(map.map(), EdgeOfVolume, d) != d) return;
    ++inner;
    hinges += is_hinge(map.map(), d);
  });
  if (hinges < inner)
    notes.push_back(fmt::format(
        R"(bend kind="angular" {} one has more than four sides (kind="provot" bends there, too))",
        hinges == 0
            ? "was left out: at every edge between two faces"
            : fmt::format("has no effect on {} of the {} edges between two faces:", inner - hinges, inner)));
  return hinges > 0;
}

std::unique_ptr<Interaction> add_hinges(EmbeddedMap& map, const HingeEmbedding& embedding,
                                        const Pattern& pattern) {
  auto made = std::make_unique<Hinges>();
  made->name = embedding.name;
  made->law = hinge_law();
  made->damped = embedding.damping > 0;
  made->pattern = pattern;
  made->column = &map.add(HingeEmbedding(embedding));
  return made;
}

std::unique_ptr<Interaction> make_hinges(EmbeddedMap& map, const InteractionRequest& request) {
  refuse_bend_of_solid(map, request);
  const bool there = has_hinge(map, request.notes);
  if (!there && !request.awaited) return nullptr;
  HingeEmbedding embedding;
  embedding.k = stiffness_of(request, nullptr);
  embedding.damping = request.settings.damping;
  const Pattern pattern{.owner = EdgeOfVolume,
                        .support = FaceOfVolume,
                        .units = {hinge_corners},
                        .fold = {},
                        .present = &is_hinge};
  if (there) return add_hinges(map, embedding, pattern);
  request.awaited->push_back({embedding.name, hinge_law(), pattern,
                              [=](EmbeddedMap& to) { return add_hinges(to, embedding, pattern); }});
  return nullptr;
}

} // namespace

InteractionType bend_angular() {
  return {"bend", "angular", "an angular spring on each edge between two triangles or quads", "N.m/rad",
          make_hinges};
}

} // namespace rend
