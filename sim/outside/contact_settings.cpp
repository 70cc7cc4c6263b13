#include "sim/outside/contact_settings.h"

#include <algorithm>

namespace rend {

template <> const Fields<ContactSettings>& fields_of() {
  using S = ContactSettings;
  static const Fields<S> fields{
      field<S>({{"floor", &S::floor},
                {"obstacles", &S::obstacles},
                {"fragments", &S::fragments},
                {"self", &S::self}},
               "with",
               "what it collides with\nfloor: the floor\nobstacles: the floor, spheres and boxes\nfragments: "
               "other fragments, and other bodies whose contact has fragments as well\nself: fragments, and "
               "all faces of its own"),
      field(&S::thickness,
            number("thickness", "m", "the distance that is kept from what it touches").at_least(0)),
      field(&S::friction,
            number("friction", "", "Coulomb's coefficient of friction, where the obstacle has none of its own")
                .at_least(0)),
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
