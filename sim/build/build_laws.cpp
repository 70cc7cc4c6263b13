#include "sim/build/build_laws.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

const ElementType& tear_type() {
  static const ElementType type = [] {
    std::vector<std::string> criteria, changes;
    std::string what, done;
    for (const CriterionType& c : all_criteria()) {
      criteria.push_back(c.name);
      what += (what.empty() ? "" : "; ") + c.name + ": " + c.what;
    }
    for (const ChangeType& c : all_changes()) {
      changes.push_back(c.name);
      done += "; " + c.name + ": " + c.what;
    }
    return ElementType{
        "tear",
        "a law: where the criterion exceeds the threshold, the change is made",
        {word("criterion", criteria, what).is_required(),
         number("threshold", "",
                "the value above which it tears, in newtons, of stresses in pascals, of strains a ratio; a low "
                "one "
                "and rend run --events tell what is reached")
             .above(0)
             .is_required(),
         word("kind", {"stretch", "shear", "bend"}, "of springs: which of them are measured"),
         flag("compression", "principal stresses and strains count in compression as well").otherwise("no"),
         word("change", changes, "what is done; default: that of the cell which the criterion measures" + done),
         number("from", "s", "not before").at_least(0).otherwise("0"),
         number("until", "s", "not after").at_least(0),
         integer("max-per-step", "the worst so many a step; 0: all").at_least(0).otherwise("0")},
        {}};
  }();
  return type;
}

// The change that was asked for, or the one that is the cell's own.
const ChangeType* change_of(const PresetNode& node, const CriterionType& criterion, Cell cell, int dimension) {
  std::string fitting;
  for (const ChangeType& type : all_changes()) {
    if (!type.fits(cell, dimension)) continue;
    fitting += (fitting.empty() ? "" : ", ") + type.name;
    if (node.given("change") ? type.name == node.text("change") : type.own == cell) return &type;
  }
  node.fail("change",
            fmt::format("'{}' does not fit the criterion '{}', which measures the {}", node.text("change"),
                        criterion.name, name_of(cell, dimension)),
            "these do: " + fitting);
}

LawSettings law_settings(const PresetNode& node, const Body& body) {
  LawSettings law;
  for (const CriterionType& type : all_criteria())
    if (type.name == node.text("criterion")) law.criterion = &type;
  if (node.given("kind")) law.kind = node.text("kind");
  law.compression = node.flag("compression");
  if (!law.kind.empty() && !law.criterion->takes_kind)
    node.fail("kind", fmt::format("a kind means nothing to the criterion '{}'", law.criterion->name),
              "atomic-spring and strain look at springs of a kind");
  if (law.compression && !law.criterion->takes_compression)
    node.fail("compression",
              fmt::format("compression means nothing to the criterion '{}'", law.criterion->name),
              "forces count by magnitude; stresses and strains have a sign");
  const CriterionRequest request = body.request_for(law);
  if (const std::string lacking = law.criterion->lacking(request); !lacking.empty())
    node.fail("criterion", fmt::format("'{}' {}", law.criterion->name, lacking));
  law.cell = law.criterion->cell(request);
  law.change = change_of(node, *law.criterion, law.cell, request.map.dimension());
  law.threshold = node.number("threshold");
  law.unit = law.criterion->unit_there ? law.criterion->unit_there(request) : law.criterion->unit;
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

namespace {

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

void build_laws(Body& body, const PresetNode& node) {
  const std::vector<const PresetNode*> laws = node.all("tear");
  if (laws.empty()) {
    body.left_out.emplace_back("tearing: no law, so no criterion is bound and no border is remembered");
    return;
  }
  if (wholly_fixed(body))
    body.notes.push_back(
        "tearing: every vertex is fixed, so that nothing moves and a law sees the same forces in "
        "every step");
  body.border = &body.map->add(BornBorder(body.map->dimension()));
  for (const PresetNode* law : laws) {
    const LawSettings settings = law_settings(*law, body);
    body.tear_laws.emplace_back(body.request_for(settings), settings);
    if (body.tear_laws.back().settings().elementary() && body.cumulated == Cumulated::Yes)
      law->fail("criterion", "looks at each element by itself, and cumulated=\"yes\" folds what they do",
                "leave cumulated at auto");
  }
}

} // namespace rend
