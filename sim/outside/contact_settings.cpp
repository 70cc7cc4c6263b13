#include "sim/outside/contact_settings.h"

#include <algorithm>

namespace rend {
namespace {

// Kinds of things; names are those of a <contact> for single things (ContactPairSettings).
Field<ContactSettings> with_kinds() {
  using S = ContactSettings;
  Field<S> kinds = field<S>(
      {{"floor", &S::floor}, {"obstacles", &S::obstacles}, {"fragments", &S::fragments}, {"self", &S::self}},
      "with",
      "what it collides with\nfloor: the floor\nobstacles: the floor, spheres, boxes and meshes\nfragments: "
      "other "
      "fragments, and other bodies whose contact has fragments as well\nself: fragments, and all faces of its "
      "own\nNAMES of bodies, obstacles or of the floor, in a <contact> of their own: friction and "
      "restitution with these alone, before what others say");
  kinds.type.names = true;
  return kinds;
}

AttributeType names_of_excluded() {
  AttributeType type = words_of("not", {}, "names of bodies, obstacles or of the floor that it passes through");
  type.names = true;
  return type;
}

AttributeType friction() {
  return number("friction", "", "Coulomb's coefficient of friction, where the obstacle has none of its own")
      .at_least(0);
}

AttributeType restitution() {
  return number(
             "restitution", "",
             "the share of its normal speed with which what strikes leaves again at least, where the obstacle "
             "has none of its own; 0: what elasticity gives back")
      .at_least(0)
      .at_most(1);
}

} // namespace

template <> const Fields<ContactPairSettings>& fields_of() {
  using S = ContactPairSettings;
  static const Fields<S> fields{field(&S::with, with_kinds().type.is_required()),
                                field(&S::friction, friction()), field(&S::restitution, restitution())};
  return fields;
}

template <> const Fields<ContactSettings>& fields_of() {
  using S = ContactSettings;
  static const Fields<S> fields{
      with_kinds(),
      field(&S::excluded, names_of_excluded()),
      field(&S::thickness,
            number("thickness", "m", "the distance that is kept from what it touches").at_least(0)),
      field(&S::friction, friction()),
      field(&S::restitution, restitution()),
      field(&S::overlap, word("overlap", {"refuse", "push"},
                              "of a body that starts inside something. refuse: an error; push: it is moved out "
                              "as a whole before "
                              "the first step"))};
  return fields;
}

double way_out(double before, double step) {
  constexpr double relaxation = 0.05; // [s]
  constexpr double fastest_out = 0.1; // [m/s]
  return before > 0 ? before - std::min(before * std::min(1.0, step / relaxation), fastest_out * step) : 0;
}

} // namespace rend
