#include "sim/mechanics/springs.h"

namespace rend {

template <> const Fields<SpringsSettings>& fields_of() {
  using S = SpringsSettings;
  static const Fields<S> fields{
      field(
          &S::young,
          number(
              "young", "Pa",
              "Young's modulus, from which the stiffness of stretch and shear is computed where they give no k")
              .above(0)),
      field(&S::poisson, number("poisson", "", "Poisson's ratio, used with young").at_least(0).at_most(0.5)),
      field(&S::thickness, number("thickness", "m", "thickness of the sheet, used with young").above(0)),
      field(&S::cumulated, word("cumulated", {"auto", "yes", "no"},
                                "whether springs between the same two vertices are merged into one; auto: yes, "
                                "unless a <tear> measures each separately")),
      field(&S::on, word("on", {"all", "surface"},
                         "all: everywhere; surface: only on faces that are on the surface at the start, as a "
                         "skin over finite elements"))};
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
