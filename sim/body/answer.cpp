#include "sim/body/answer.h"

#include <cmath>

namespace rend {

template <> const Fields<AnswerSettings>& fields_of() {
  using S = AnswerSettings;
  static const Fields<S> fields{
      field(&S::probe, text("probe", "its name").is_required()),
      field(&S::quantity,
            word("quantity", probe_quantities(),
                 "what is compared\nx, y, z: the mean position\ndx, dy, dz, d: the mean displacement, and its "
                 "length\nreaction-x, reaction-y, reaction-z, reaction: the force of the supports, and its "
                 "size\nstress-xx ... stress-xz: the mean stress of the elements there")
                .is_required()),
      field(&S::at,
            number_or("at", {"end"}, "s",
                      "the time of the measurement: the first step at or after it; end: the end of the clip")
                .at_least(0)),
      field(&S::value, number("value", "m, N or Pa", "the known answer").is_required()),
      field(&S::tolerance, number("tolerance", "",
                                  "the largest relative error |measured - value| / |value|; where value is 0, "
                                  "the largest error itself")
                               .at_least(0)),
      field(&S::known_from, text("source", "where the known answer comes from; it is only printed"))};
  return fields;
}

double Answer::error() const {
  const double difference = measured.value_or(std::numeric_limits<double>::quiet_NaN()) - value;
  return value == 0 ? difference : difference / std::abs(value);
}

bool Answer::holds() const {
  return std::abs(error()) <= tolerance;
}

} // namespace rend
