#include "sim/mechanics/springs.h"

namespace rend {

template <> const Fields<SpringsSettings>& fields_of() {
  using S = SpringsSettings;
  static const Fields<S> fields{
      field(&S::young,
            number("young", "Pa", "stiffness of stretch and shear by formula instead of k").above(0)),
      field(&S::poisson, number("poisson", "", "Poisson's ratio, for young").at_least(0).at_most(0.5)),
      field(&S::thickness, number("thickness", "m", "for young").above(0)),
      field(&S::cumulated, word("cumulated", {"auto", "yes", "no"},
                                "fold springs between the same particles into one: auto folds unless a law "
                                "looks at each by itself")),
      field(&S::on, word("on", {"all", "surface"},
                         "surface: only on the faces that are on the surface at the start (springs over finite "
                         "elements)"))};
  return fields;
}

const InteractionType* find_interaction(std::string_view element, std::string_view kind,
                                        std::string_view where) {
  for (const InteractionType& type : all_interactions())
    if (type.element == element && (kind.empty() || type.kind.empty() || type.kind == kind) &&
        (where.empty() || type.where.empty() || type.where == where))
      return &type;
  return nullptr;
}

} // namespace rend
