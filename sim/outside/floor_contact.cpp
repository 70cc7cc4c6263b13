#include "sim/outside/floor_contact.h"

#include "sim/outside/impact.h"

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

void FloorContact::apply(const Record* from, State& next, double step,
                         std::vector<TouchedVertex>& touched) const {
  for (std::size_t i = 0; i < next.position.size(); ++i) {
    Record &x = next.position[i], &v = next.velocity[i];
    if (!(x.z < height)) continue;
    touched.push_back({static_cast<Slot>(i), x, v});
    const Impulse change = impact(v, Vec3::UnitZ(), friction, Vec3::Ones());
    const double least = height - way_out(height - from[i].z, step);
    x = Record(x.x + step * change.friction.x(), x.y + step * change.friction.y(), std::max(x.z, least));
    v = Record(v.vec() + change.whole());
  }
}

} // namespace rend
