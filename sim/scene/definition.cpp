#include "sim/scene/definition.h"

#include <fmt/format.h>

namespace rend {

template <> const Fields<TimeSettings>& fields_of() {
  using S = TimeSettings;
  static const Fields<S> fields{
      field(&S::step,
            number_or("step", {"auto"}, "s",
                      "auto: 0.9 of what is stable (under rk45: with symplectic; under static: the duration)")
                .above(0)),
      field(&S::scheme, all_schemes(), "integrator", "the scheme"),
      field(&S::tolerance,
            number("tolerance", "",
                   "of rk45, which cuts each step into parts until what one part has wrong, in the mean over "
                   "the body's mass, is below this share of the body's size (a velocity's error counts with "
                   "the step's length)")
                .at_least(1e-14)
                .at_most(0.1)),
      field(&S::duration,
            number("duration", "s", "of the clip; only static does without, and then it is 1").at_least(0)),
      field(&S::mass_scaling,
            number(
                "mass-scaling", "",
                "makes the elements that limit the step heavier, as long as no body gains more than this share "
                "of its mass: larger steps, and other inertia and weight where the mesh is finest")
                .above(0)
                .at_most(1))};
  return fields;
}

// An equilibrium takes no time: one step to the end, and any end.
double duration_of(const TimeSettings& time) {
  check_settings(time);
  if (time.duration) return *time.duration;
  if (time.scheme->name == "static") return 1;
  for (const Field<TimeSettings>& field : fields_of<TimeSettings>())
    if (field.type.name == "duration")
      time.source.fail("", "<time> needs duration",
                       fmt::format("duration: {}; expected {}", field.type.what, expected(field.type)));
  return 0;
}

} // namespace rend
