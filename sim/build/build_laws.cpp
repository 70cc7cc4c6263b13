#include "sim/build/build_laws.h"

#include "sim/build/body_at_rest.h"
#include "sim/fracture/pairs.h"
#include "sim/fracture/rule_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rend {
namespace {

void let_grow(Body& body) {
  if (body.map->grows()) return;
  body.map->let_grow();
  if (body.map->dimension() == 2) body.map->add(FaceSense{});
}

bool lets_grow(const LawSettings& law, const RuleBook& rules) {
  return law.rule.empty() ? law.change && law.change->grows
                          : find_rule(rules, law.rule, law.source, "rule").grows();
}

void take_rule(LawSettings& law, const RuleBook& rules, const CriterionRequest& request) {
  if (law.change) law.source.fail("rule", "<tear> has both a change and a rule", "give one of them");
  const RuleOrScript what = find_rule(rules, law.rule, law.source, "rule");
  if (const std::string misfit = misfit_of(what, request); !misfit.empty())
    law.source.fail("rule", fmt::format("{} '{}' {}", what.kind(), what.name(), misfit));
  law.by_rule = change_by(what, request.map.dimension(), &request);
  law.change = law.by_rule.get();
}

void check_grain(const LawSettings& law) {
  Grain::check(law.grain, law.source);
  if (!law.grain.along) return;
  if (!law.criterion->takes_grain)
    law.source.fail("grain", fmt::format("the criterion '{}' does not use a grain", law.criterion->name),
                    "criterion=\"vertex-stress\" looks for the weakest plane");
  if (law.compression)
    law.source.fail("grain",
                    "a grain says how a body splits where it is pulled, and this law counts compression",
                    "leave out one of them");
}

// Whether walls between pieces are weak for the law (strength.h).
bool parts_walls(const LawSettings& law) {
  const auto of_walls = [](Cell cell) { return cell == Cell::Borders || cell == Cell::Vertices; };
  return of_walls(law.cell) && of_walls(law.change->cell);
}

// With what is found on the body.
LawSettings completed(LawSettings law, Body& body, const BodySettings& settings) {
  check_settings(law);
  const SettingsSource& source = law.source;
  if (!law.kind.empty() && law.criterion->kinds.empty())
    source.fail("kind", fmt::format("the criterion '{}' does not use kind", law.criterion->name),
                "leave kind out: only atomic-spring and strain measure springs of one kind");
  if (law.compression && !law.criterion->takes_compression)
    source.fail("compression", fmt::format("the criterion '{}' does not use compression", law.criterion->name),
                "leave it out: only stresses and strains have a sign");
  check_grain(law);
  const CriterionRequest request = body.request_for(law);
  const NamedCriterion criterion{law.criterion, law.kind};
  law.cell = criterion.cell();
  if (!law.rule.empty()) take_rule(law, settings.rules, request);
  if (!law.change) law.change = &default_change(law.cell);
  if (const std::string refusal = pair_of(criterion, *law.change, request.map.dimension()).refusal;
      !refusal.empty())
    source.fail("kind", fmt::format("'{}' {}", criterion.name(), refusal));
  if (const std::string lacking = law.criterion->lacking(request); !lacking.empty())
    source.fail("criterion", fmt::format("'{}' {}", law.criterion->name, lacking));
  if (source.given("smallest-part") && !law.change->has_least_part)
    source.fail("smallest-part", fmt::format("'{}' does not use smallest-part", law.change->name),
                "leave it out: only change=\"cut\" has a least part");
  law.unit = law.criterion->unit_there ? law.criterion->unit_there(request) : law.criterion->unit;
  if (law.change->lacking)
    if (const std::string lacking = law.change->lacking(request); !lacking.empty())
      source.fail("change", fmt::format("'{}' {}", law.change->name, lacking),
                  "rend help tear tells what each change needs; change=\"split-vertex\" parts whole elements "
                  "of every kind");
  std::optional<double> walls;
  if (settings.pieces && law.rule.empty() && parts_walls(law)) walls = settings.pieces->strength;
  law.by_place = Strength::of(law.strength, law.cell, walls,
                              body_at_rest(body, settings, law.strength.of_expression), source);
  if (law.until < law.from) source.fail("until", "the law ends before it starts: until is less than from");
  return law;
}

// Shear acts along diagonals: cells of other kinds, which a rule may make of those that have some, have none.
void note_shear(Body& body) {
  const bool shears = std::any_of(body.interactions.begin(), body.interactions.end(), [](const auto& each) {
    return each->name.starts_with("shear isotropic") || each->name == "shear anisotropic volume";
  });
  if (shears)
    body.notes.push_back(fmt::format("shear acts in {} alone: other cells that a law makes of them have none",
                                     body.map->dimension() == 2 ? "quads" : "quads and hexahedra"));
}

// Every vertex is prescribed in all its coordinates, for good, and none of them ever moves.
bool wholly_fixed(const Body& body) {
  const CellIndex& vertices = body.map->cells(Vertex);
  if (body.constraints.drives() || body.constraints.vertices().size() < vertices.count()) return false;
  for (Slot v : body.constraints.vertices()) {
    std::array<bool, 3> held{};
    body.constraints.for_each_motion(v, [&](const Motion& motion) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        held[axis] = held[axis] || (motion.axes[axis] && !motion.then_free);
    });
    if (!held[0] || !held[1] || !held[2]) return false;
  }
  return true;
}

} // namespace

void build_laws(Body& body, const BodySettings& settings) {
  if (settings.tears.empty()) {
    body.left_out.emplace_back("tearing: the body has no <tear>");
    return;
  }
  if (wholly_fixed(body))
    body.notes.push_back("tearing: every vertex is fixed, so nothing moves and the forces never change");
  body.border = &body.map->add(InitialBorder(body.map->dimension()));
  // before the laws, since criteria must know which cells there may be; after the border, which is that of now
  for (const LawSettings& asked : settings.tears)
    if (lets_grow(asked, settings.rules)) let_grow(body);
  for (const LawSettings& asked : settings.tears)
    if (asked.change && asked.change->prepare) asked.change->prepare(*body.map);
  if (body.map->grows())
    note_shear(body);
  else
    body.awaited.all().clear();
  for (const LawSettings& asked : settings.tears) {
    const LawSettings law = completed(asked, body, settings);
    body.tear_laws.emplace_back(body.request_for(law), law);
    if (!body.tear_laws.back().elementary() || body.cumulated != Cumulated::Yes) continue;
    law.source.fail(
        law.criterion->elementary ? "criterion" : "change",
        law.criterion->elementary
            ? fmt::format("the criterion '{}' measures each element separately, but cumulated=\"yes\" "
                          "merges their springs",
                          law.criterion->name)
            : fmt::format("the change '{}' of '{}' needs the force of each element separately, but "
                          "cumulated=\"yes\" merges them",
                          law.change->name, law.criterion->name),
        "remove cumulated=\"yes\"");
  }
}

} // namespace rend
