#include "sim/body/answer.h"

#include <cmath>

namespace rend {

template <> const Fields<AnswerSettings>& fields_of() {
  using S = AnswerSettings;
  static const Fields<S> fields{
      field(&S::probe, text("probe", "its name").is_required()),
      field(&S::quantity,
            word("quantity", probe_quantities(),
                 "position; displacement (d: its length); force of the support (reaction: its size); mean "
                 "stress of the elements there")
                .is_required()),
      field(&S::at, number_or("at", {"end"}, "s", "when: at the first step from then on").at_least(0)),
      field(&S::value, number("value", "m, N or Pa", "the known answer").is_required()),
      field(&S::tolerance,
            number("tolerance", "", "error / |value| that still holds; the error itself where the value is 0")
                .at_least(0)),
      field(&S::known_from, text("source", "where the answer comes from"))};
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
