#include "sim/scene/definition.h"

#include <fmt/format.h>

namespace rend {

namespace {

std::string told_schemes() {
  std::string out = "the time scheme";
  for (const Scheme& scheme : all_schemes()) out += "\n" + scheme.name + ": " + scheme.what;
  return out;
}

} // namespace

template <> const Fields<TimeSettings>& fields_of() {
  using S = TimeSettings;
  static const Fields<S> fields{
      field(&S::step, number_or("step", {"auto"}, "s",
                                "length of a time step; auto: 0.9 of the largest stable one (rk45: of that of "
                                "symplectic; static: the whole duration)")
                          .above(0)),
      field(&S::scheme, all_schemes(), "integrator", told_schemes()),
      field(&S::tolerance,
            number("tolerance", "",
                   "rk45 only: the error that each part of a step may have, relative to the size of the body "
                   "(root mean square over its mass; an error of velocity counts times the length of the part)")
                .at_least(1e-14)
                .at_most(0.1)),
      field(&S::rho_infinity,
            number("rho-infinity", "",
                   "alpha only: the factor that a step leaves of motion too fast for it; 1: all, 0: none")
                .at_least(0)
                .at_most(1)),
      field(&S::duration, number("duration", "s",
                                 "length of the clip in simulated time; 0: the bodies "
                                 "as they are built; required, except with static, where the default is 1")
                              .at_least(0)),
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
