#include "sim/scene/build_laws.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

const ElementType& tear_type() {
  static const ElementType type = [] {
    std::vector<std::string> criteria, changes;
    std::string what;
    for (const CriterionType& c : all_criteria()) {
      criteria.push_back(c.name);
      what += (what.empty() ? "" : "; ") + c.name + ": " + c.what;
    }
    for (const ChangeType& c : all_changes()) changes.push_back(c.name);
    return ElementType{
        "tear",
        "a law: where the criterion exceeds the threshold, the change is made",
        {word("criterion", criteria, what).is_required(),
         number("threshold", "N", "the value above which it tears; rend run --events tells what was reached")
             .above(0)
             .is_required(),
         word("change", changes, "what is done; default: that of the criterion"),
         number("from", "s", "not before").at_least(0).otherwise("0"),
         number("until", "s", "not after").at_least(0),
         integer("max-per-step", "the worst so many a step; 0: all").at_least(0).otherwise("0")},
        {}};
  }();
  return type;
}

LawSettings law_settings(const Node& node) {
  LawSettings law;
  for (const CriterionType& type : all_criteria())
    if (type.name == node.text("criterion")) law.criterion = &type;
  const std::string& change = node.given("change") ? node.text("change") : law.criterion->default_change;
  std::string fitting;
  for (const ChangeType& type : all_changes()) {
    const bool fits = std::find(type.cells.begin(), type.cells.end(), law.criterion->cell) != type.cells.end();
    if (fits) fitting += (fitting.empty() ? "" : ", ") + type.name;
    if (fits && type.name == change) law.change = &type;
  }
  if (!law.change)
    node.fail("change", fmt::format("'{}' does not fit the criterion '{}'", change, law.criterion->name),
              "these do: " + fitting);
  law.threshold = node.number("threshold");
  law.from = node.number("from");
  if (node.given("until")) law.until = node.number("until");
  if (law.until < law.from) node.fail("until", "the law ends before it starts");
  law.max_per_step = node.integer("max-per-step");
  return law;
}

} // namespace

std::vector<ChildType> law_types() {
  return {{&tear_type(), 0, -1}};
}

void build_laws(Body& body, const Node& node) {
  const std::vector<const Node*> laws = node.all("tear");
  if (laws.empty()) {
    body.left_out.push_back("tearing: no law, so no criterion is bound and no border is remembered");
    return;
  }
  if (body.map->dimension() == 3)
    throw UserError(Exit::BadInput, laws.front()->place(),
                    "a solid does not tear yet: its laws act on sheets alone",
                    "leave <tear> out, or make the body a <sheet>");
  body.border = &body.map->add(BornBorder(body.map->dimension()));
  for (const Node* law : laws) {
    body.laws.emplace_back(*body.map, law_settings(*law));
    if (body.laws.back().settings().criterion->elementary && body.cumulated == Cumulated::Yes)
      law->fail("criterion", "looks at each spring by itself, and cumulated=\"yes\" folds them",
                "leave cumulated at auto");
  }
}

} // namespace rend
