// An interaction: an orbit that carries it, a pattern that finds its particles, and a force law.
//
// (thesis 5.2, 6.2; sim/README.md, "Interactions".) The parameters are embedded on the orbit that carries the
// interaction (the owner), so that a separation does not change them. The pattern is data, words of α-links, so
// that it can be followed forwards (to bind rows) and backwards (to find the rows affected by an edit). One
// owner may carry several units: a rectangle carries two diagonals.
//
// To add one: a file with a function `InteractionType my_interaction()`, and its name in all_interactions().
#pragma once

#include "sim/base/settings.h"
#include "sim/embedding/embedded_map.h"
#include "sim/mechanics/force_law.h"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rend {

// Links to follow from left to right: "010" is α0, then α1, then α0.
using Word = std::string;

struct Pattern {
  Orbit owner;                          // carries the parameters
  Orbit support;                        // the orbit whose links determine the rest state
  std::vector<std::vector<Word>> units; // of each unit: the words from the owner's first dart to its particles
  // Words to other owners whose units may act between the same particles: their rows are summed into one, that
  // of the smallest slot. Each word is a palindrome or a single link, so that the relation is symmetric.
  std::vector<Word> fold;
  // Whether the unit is present (its match is injective); otherwise it exerts no force. Units may exclude each
  // other: the words of a prism depend on the face that contains its first dart.
  bool (*present)(const GMap&, Dart, std::size_t unit);
};

class Interaction {
public:
  virtual ~Interaction() = default;
  std::string name; // "stretch", "shear isotropic", ...
  std::shared_ptr<const ForceLaw> law;
  Pattern pattern;
  bool damped = false; // whether any unit has damping

  // The values of a unit, law->values() of them.
  virtual const double* unit(Slot owner, std::size_t unit) const = 0;
};

// The material of springs whose stiffness comes from a formula.
struct SpringMaterial {
  double young = 0;     // E [Pa]
  double poisson = 0;   // ν
  double thickness = 0; // h [m]
};

struct InteractionType;

// Of one kind of spring or hinge.
struct SpringSettings {
  const InteractionType* type = nullptr; // one of all_interactions()
  std::optional<double> k = {}; // [N/m], of hinges [N·m/rad], of each elementary one; none: from the material
  double damping = 0;           // [N·s/m], [N·m·s/rad]
  SettingsSource source = {};
};

// Whether rows between the same particles are summed into one.
enum class Cumulated {
  Auto, // yes, unless a fracture criterion needs each of them
  Yes,
  No
};

// An interaction that was asked for, for cells of a kind that the body does not have. Where an edit makes some,
// it is added (sim/body/awaited_interactions.h).
struct AwaitedInteraction {
  std::string name;
  std::shared_ptr<const ForceLaw> law;
  Pattern pattern;
  std::function<std::unique_ptr<Interaction>(EmbeddedMap&)> make; // adds the embeddings to the map
};

// A request for an interaction of a body.
struct InteractionRequest {
  const SpringSettings& settings;
  const std::string& element; // its element name, for messages: "stretch"
  std::optional<SpringMaterial> material;
  std::vector<std::string>& notes; // messages for the author of the preset
  bool surface = false;            // only on faces that are on the boundary of the initial body
  // takes what is left out because no cell is there that it acts on; null: no edit will make any
  std::vector<AwaitedInteraction>* awaited = nullptr;
};

// Notes why there is nothing to add here. Whether nothing ever will be.
bool leave_out(const InteractionRequest& request, std::string why);

template <> const Fields<SpringSettings>& fields_of();

struct InteractionType {
  std::string element; // "stretch", "shear", "bend"
  std::string kind;    // its `kind`, if the element has several
  std::string what;    // one line
  std::string k_unit;
  // Adds the embeddings to the map. Null: there is nothing to add here, and a note says why. Throws UserError.
  std::function<std::unique_ptr<Interaction>(EmbeddedMap&, const InteractionRequest&)> make;
  std::string where = "";  // its `where`, if the element has several: "face", "volume"
  bool by_formula = false; // whether k may come from the springs' material (spring_stiffness.h)

  std::string damping_unit() const; // k's times a second: "N.s/m"
};

const std::vector<InteractionType>& all_interactions();

// Calls f(first dart) for every face (<0,1>), in the order of their smallest darts.
void for_each_face(const EmbeddedMap& body, const std::function<void(Dart)>& f);

// Calls f(interaction, first dart of the owner, unit) for every unit that is present, in the order of slots.
template <class F>
void for_each_unit(const EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
                   F&& f) {
  for (const auto& interaction : interactions) {
    const Pattern& pattern = interaction->pattern;
    const CellIndex& owners = map.cells(pattern.owner);
    for (Slot owner = 0; owner < owners.slots(); ++owner) {
      if (!owners.alive(owner)) continue;
      const Dart d = owners.first_dart(owner);
      for (std::size_t unit = 0; unit < pattern.units.size(); ++unit)
        if (pattern.present(map.map(), d, unit)) f(*interaction, d, unit);
    }
  }
}

// Rest positions of the particles of a unit.
std::vector<Vec3> rest_positions(const EmbeddedMap& body, Dart d, const std::vector<Word>& unit);

// What of a spring that is divided follows from the whole, as of springs in series: a side of length L and
// stiffness k that is halved becomes two of 2k.
struct InSeries {
  bool k = false, damping = false;
};

// The embedding of an interaction's parameters: initialised from rest positions and stiffness; fragments keep
// them. In series, a spring along a side that was cut from others (Edit::inherit) has k = Σ w k_p L_p / L, of
// parents with the weights w; its length is that of its rest positions, so that no force arises at rest.
template <int Units> struct UnitEmbedding {
  using Value = std::array<UnitParameters, Units>;
  std::string name;
  Orbit orbit, support;
  std::function<UnitParameters(const EmbeddedMap&, Dart, int unit)> parameters_of;
  InSeries in_series = {};
  Value birth(const EmbeddedMap& map, Dart d) const {
    Value value;
    for (int unit = 0; unit < Units; ++unit)
      value[static_cast<std::size_t>(unit)] = parameters_of(map, d, unit);
    return value;
  }
  Value split(const Value& whole) const { return whole; }
  Value inherit(const EmbeddedMap& map, Dart d, std::span<const Inherited<Value>> parents) const {
    Value value = birth(map, d);
    for (std::size_t unit = 0; unit < Units; ++unit) {
      UnitParameters& own = value[unit];
      if (!(own.k > 0 && own.rest > 0)) continue;
      UnitParameters sum;
      for (const Inherited<Value>& parent : parents) {
        const UnitParameters& whole = parent.value[unit];
        sum.k += parent.weight * whole.k * (whole.rest / own.rest);
        sum.damping += parent.weight * whole.damping * (whole.rest / own.rest);
      }
      if (in_series.k) own.k = sum.k;
      if (in_series.damping) own.damping = sum.damping;
    }
    return value;
  }
};

// Makes an interaction of springs or hinges from its parts.
template <int Units>
std::unique_ptr<Interaction>
make_interaction(EmbeddedMap& map, std::string name, std::shared_ptr<const ForceLaw> law, Pattern pattern,
                 double damping, std::function<UnitParameters(const EmbeddedMap&, Dart, int)> parameters_of,
                 InSeries in_series = {}) {
  struct Carried final : Interaction {
    const Column<UnitEmbedding<Units>>* column = nullptr;
    const double* unit(Slot owner, std::size_t unit) const override { return &(*column)[owner][unit].k; }
  };
  auto made = std::make_unique<Carried>();
  made->column =
      &map.add(UnitEmbedding<Units>{name, pattern.owner, pattern.support, std::move(parameters_of), in_series});
  made->name = std::move(name);
  made->law = std::move(law);
  made->pattern = std::move(pattern);
  made->damped = damping > 0;
  return made;
}

// The same if some cell is `there` that it acts on. Null otherwise: it is awaited.
template <int Units>
std::unique_ptr<Interaction>
make_or_await(EmbeddedMap& map, bool there, const InteractionRequest& request, const std::string& name,
              const std::shared_ptr<const ForceLaw>& law, const Pattern& pattern,
              const std::function<UnitParameters(const EmbeddedMap&, Dart, int)>& parameters_of) {
  const auto make = [=, damping = request.settings.damping](EmbeddedMap& to) {
    return make_interaction<Units>(to, name, law, pattern, damping, parameters_of);
  };
  if (there) return make(map);
  request.awaited->push_back({name, law, pattern, make});
  return nullptr;
}

} // namespace rend
