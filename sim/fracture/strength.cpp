#include "sim/fracture/strength.h"

#include "sim/base/check.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace rend {
namespace {

constexpr double least_strength = 1e-6;

} // namespace

template <> const Fields<StrengthSettings>& fields_of() {
  using S = StrengthSettings;
  static const Fields<S> fields =
      fields_of_part(&S::where) +
      Fields<S>{field(
          &S::factor,
          text("strength",
               "what the threshold is multiplied by, from element to element: an expression of rest (the "
               "middle of the element [m]), u and v (its place in a picture, 0 to 1), picture, random, "
               "weibull(m), in(group), noise(...); default where there is a picture: 0.1 + 0.9*picture"))} +
      fields_of_part(&S::of_expression);
  return fields;
}

ElementQuantity strength_quantity() {
  return {.element = "tear",
          .attribute = "strength",
          .above = least_strength,
          .most = std::numeric_limits<double>::max(),
          .hint = "max(0.1, ...) keeps it above 0.1",
          .example = "strength=\"0.2 + 0.8*picture\""};
}

std::optional<std::string> strength_expression(const StrengthSettings& settings, bool given) {
  if (!settings.factor.empty() || given) return settings.factor;
  const ExpressionSettings& expression = settings.of_expression;
  if (!expression.picture.empty() || expression.mask) return "0.1 + 0.9*picture";
  return {};
}

std::shared_ptr<Strength> Strength::of(const StrengthSettings& settings, Cell cell, std::optional<double> walls,
                                       const BodyAtRest& body, const SettingsSource& source) {
  EmbeddedMap& map = body.map;
  std::shared_ptr<Strength> made(new Strength(cell));
  if (const auto text = strength_expression(settings, source.given("strength"))) {
    const auto expression =
        std::make_shared<ElementExpression>(*text, settings.of_expression, strength_quantity(), body, source);
    ElementStrength strength{.orbit = element_orbit(map.dimension()), .expression = expression};
    made->strength_ = &map.add(std::move(strength));
    made->elements_ = &map.cells(made->strength_->orbit());
    expression->forget_groups();
  } else {
    ElementExpression::refuse_unused(strength_quantity(), source);
  }
  if (walls) {
    made->pieces_ = find_pieces(map);
    CHECK(made->pieces_);
    made->wall_ = *walls;
  }
  made->rebind();
  if (settings.where.given() || source.given("group"))
    made->select(map, select_vertices(map, body.groups, settings.where, "tear", source), source);
  return made->strength_ || made->selected_ || made->pieces_ ? made : nullptr;
}

void Strength::rebind() {
  least_ = wall_;
  if (!strength_) return;
  least_ = std::numeric_limits<double>::max();
  for (Slot e = 0; e < elements_->slots(); ++e)
    if (elements_->alive(e)) least_ = std::min(least_, (*strength_)[e]);
  least_ *= wall_;
}

void Strength::select(EmbeddedMap& map, const std::vector<Slot>& vertices, const SettingsSource& source) {
  auto& selected = map.add(SelectedVertex{});
  for (Slot v : vertices) selected[v] = 1;
  selected_ = &selected;
  bool any = false;
  map.map().for_each_dart(
      [&](Dart d) { any = any || is_selected(map, darts_of(map.map(), orbit_of(cell_, map.dimension()), d)); });
  if (any) return;
  source.fail("", fmt::format("<tear> selects no {} with all its vertices", name_of(cell_, map.dimension())),
              "the criterion measures these: select more vertices");
}

bool Strength::is_selected(const EmbeddedMap& map, std::span<const Dart> cell) const {
  if (!selected_) return true;
  return std::ranges::all_of(cell, [&](Dart d) { return (*selected_)[map.slot(Vertex, d)] != 0; });
}

double Strength::at(const EmbeddedMap& map, std::span<const Dart> cell) const {
  if (!strength_) return 1;
  double least = std::numeric_limits<double>::infinity();
  for (Dart d : cell) least = std::min(least, (*strength_)[map.slot(strength_->orbit(), d)]);
  return least;
}

void Strength::weigh(const EmbeddedMap& map, double above, std::vector<Candidate>& candidates) const {
  thread_local std::vector<Dart> cell;
  const Orbit orbit = orbit_of(cell_, map.dimension());
  std::erase_if(candidates, [&](Candidate& candidate) {
    cell.clear();
    collect(map.map(), orbit, candidate.dart, cell);
    if (!is_selected(map, cell)) return true;
    candidate.strength = at(map, cell);
    candidate.wall = pieces_ && is_at_wall(map, *pieces_, cell);
    if (candidate.wall) candidate.strength *= wall_;
    return !(candidate.relative() > above);
  });
}

} // namespace rend
