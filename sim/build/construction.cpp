#include "sim/build/construction.h"

#include "sim/body/body.h"
#include "sim/build/constructed_cells.h"
#include "sim/build/read_settings.h"
#include "sim/build/shape.h"
#include "sim/cuts/start_element.h"
#include "sim/embedding/texture_coordinates.h"
#include "sim/fracture/piece.h"
#include "sim/mesh/dart_order.h"
#include "sim/rules/cell_words.h"
#include "sim/rules/rest_measures.h"
#include "sim/rules/rounds.h"
#include "sim/rules/sheet_in_space.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr const char* subdivision = "subdivide"; // stands for the rule of the body's dimension

// The groups of a vertex: bit k is group k, in the order of names.
struct GroupMask {
  using Value = std::uint64_t;
  std::string name = "groups";
  Orbit orbit = Vertex;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap&, Dart) const { return 0; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value& absorbed) const { return kept | absorbed; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    Value all = ~Value{0};
    for (const Inherited<Value>& parent : parents) all &= parent.value;
    return all;
  }
};
using GroupColumn = Column<GroupMask>;

// Which darts lie at the same place: their vertices, the other ends of their sides and, if asked for, those of
// the next sides of their faces are apart by less than 1e-9 of the body's size.
class Touching {
public:
  Touching(const EmbeddedMap& map, bool needed) : map_(map) {
    if (!needed) return;
    double size = 0;
    map.map().for_each_dart([&](Dart d) {
      by_x_.push_back({map.position_of(d).x(), d});
      size = std::max(size, (map.position_of(d) - map.position_of(by_x_[0].second)).norm());
    });
    std::sort(by_x_.begin(), by_x_.end());
    slack_ = 1e-9 * size;
  }

  // Without d itself; in increasing order.
  std::vector<Dart> darts_at(Dart d, bool next_sides) const {
    std::vector<Dart> found;
    const double x = map_.position_of(d).x();
    auto at = std::lower_bound(by_x_.begin(), by_x_.end(), std::pair(x - slack_, Dart{0u}));
    for (; at != by_x_.end() && at->first <= x + slack_; ++at) {
      const Dart e = at->second;
      if (e != d && close(d, e, "") && close(d, e, "0") && (!next_sides || close(d, e, "10")))
        found.push_back(e);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

private:
  bool close(Dart d, Dart e, std::string_view word) const {
    return (map_.position_of(map_.map().follow(d, word)) - map_.position_of(map_.map().follow(e, word)))
               .norm() <= slack_;
  }

  const EmbeddedMap& map_;
  std::vector<std::pair<double, Dart>> by_x_;
  double slack_ = 0; // [m]
};

// To a map that was made from another one: order[n] is the dart there of dart n here.
void hand_on_texture_coordinates(const EmbeddedMap& from, EmbeddedMap& to, std::span<const Dart> order) {
  const Column<TextureCoordinates>* old = find_texture_coordinates(from);
  if (!old) return;
  Column<TextureCoordinates>& places = to.add(TextureCoordinates{});
  to.map().for_each_dart(
      [&](Dart d) { places[to.slot(VertexOfFace, d)] = (*old)[from.slot(VertexOfFace, order[d.value])]; });
}

class Construction {
public:
  Construction(Body& body, const RuleBook& rules, const SettingsSource& shape)
      : body_(body), rules_(rules), shape_(shape) {
    if (body.groups.size() > 64)
      shape.fail("", fmt::format("the mesh has {} groups, and rules pass on 64 at most", body.groups.size()));
    if (!body.groups.empty()) groups_ = &body.map->add(GroupMask{});
    Slot bit = 0;
    for (const auto& [name, slots] : body.groups) {
      for (Slot v : slots) (*groups_)[v] |= std::uint64_t{1} << bit;
      ++bit;
    }
  }

  void apply(const ApplySettings& settings) {
    check_settings(settings);
    const RuleOrScript what = rule_of(settings);
    if (what.rule && what.rule->makes_solids() && body_.map->dimension() == 2) make_solid();
    check_hooks(what, settings);
    check_quantities(what, settings);
    RuleOrScriptRunner runner(what, {.wheres = arguments_of(what, settings)});
    RoundResult all;
    for (int n = 0; n < settings.times; ++n) {
      const RoundResult one = round(what, runner, settings, n);
      all.applied += one.applied;
      all.skipped += one.skipped;
    }
    body_.applied.push_back({std::string(what.name()), settings.source.place().line, all.applied, all.skipped});
    note_skipped(what, settings, all);
    note_open(what, settings);
  }

  // The body's map, as if it came from a file.
  void finish(const Placement& place, KeepStart keep_start) {
    check_shapes();
    MapMesh mesh = map_mesh();
    place.apply(mesh.points);
    check_cells(mesh, shape_, opened_);
    const std::vector<Dart> order = mesh.map.dimension() == 3 ? cell_order(mesh) : face_order(mesh.map);
    mesh = renumbered(mesh, order);
    std::vector<std::uint32_t> point; // of each vertex slot
    const std::vector<std::uint64_t> masks = groups_ ? groups_->values() : std::vector<std::uint64_t>();
    auto map = std::make_unique<EmbeddedMap>(std::move(mesh.map), [&](Dart d) {
      point.push_back(mesh.point[d.value]);
      const Vec3& x = mesh.points[point.back()];
      return Point{x, x, Vec3::Zero()};
    });
    VertexGroups groups;
    std::size_t bit = 0;
    for (const auto& [name, slots] : body_.groups) {
      std::vector<Slot>& chosen = groups[name];
      for (Slot v = 0; v < point.size(); ++v)
        if (masks[point[v]] >> bit & 1) chosen.push_back(v);
      ++bit;
    }
    body_.groups = std::move(groups);
    if (keep_start == KeepStart::Yes) hand_on_start_elements(*body_.map, *map, order, place.scale);
    hand_on_pieces(*body_.map, *map, order);
    hand_on_texture_coordinates(*body_.map, *map, order);
    body_.map = std::move(map);
  }

private:
  RuleOrScript rule_of(const ApplySettings& settings) const {
    if (settings.rule == subdivision)
      return find_rule({}, body_.map->dimension() == 2 ? "quarter-faces" : "divide-volumes", settings.source,
                       "");
    return find_rule(rules_, settings.rule, settings.source, "rule");
  }

  void check_hooks(const RuleOrScript& rule, const ApplySettings& settings) const {
    if (body_.map->dimension() == 2 && !rule.fits_sheets())
      settings.source.fail("rule",
                           fmt::format("{} '{}' changes what lies between volumes, and this body is a sheet",
                                       rule.kind(), rule.name()),
                           "a sheet has faces alone: its α3 are all free");
    const std::size_t hooks = rule.hooks();
    const bool with = settings.with == ApplySettings::With::Touching;
    if (hooks > 2 || (hooks == 2 && !with))
      settings.source.fail("rule", fmt::format("rule '{}' has {} hooks", rule.name(), hooks),
                           hooks == 2 ? "with=\"touching\" finds the second one where two places coincide"
                                      : "<apply> finds the darts of two at most");
    if (with && hooks < 2)
      settings.source.fail("with", fmt::format("rule '{}' has no second hook", rule.name()), "leave it out");
  }

  void check_quantities(const RuleOrScript& rule, const ApplySettings& settings) const {
    if (const std::vector<std::string> names = rule.quantities_of_law(); !names.empty())
      settings.source.fail("rule", fmt::format("{} '{}' asks for {}", rule.kind(), rule.name(), names[0]),
                           "which only a <tear> knows");
  }

  static Value value_of(const RuleOrScript& rule, const Rule::Where& where, const std::string& text,
                        const ApplySettings& settings) {
    try {
      return Expression(text, {}, where.type).evaluate();
    } catch (const ExpressionError& error) {
      settings.source.fail(where.name,
                           fmt::format("{} of {} '{}': {} (character {} of {})", where.name, rule.kind(),
                                       rule.name(), error.flaw, error.column, in_quotes(text)),
                           error.hint);
    }
  }

  static std::vector<Value> arguments_of(const RuleOrScript& rule, const ApplySettings& settings) {
    const std::vector<Rule::Where>& wheres = rule.wheres();
    std::vector<Value> values;
    std::vector<std::string> names;
    for (const Rule::Where& where : wheres) {
      names.push_back(where.name);
      values.push_back(where.value);
    }
    for (const auto& [name, text] : settings.arguments) {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        settings.source.fail(
            name, fmt::format("{} '{}' has no argument {}", rule.kind(), rule.name(), in_quotes(name)),
            names.empty() ? "it takes none" : suggestion(name, names, "it has"));
      const auto n = static_cast<std::size_t>(found - names.begin());
      values[n] = value_of(rule, wheres[n], text, settings);
    }
    return values;
  }

  // `done`: rounds before.
  RoundResult round(const RuleOrScript& rule, RuleOrScriptRunner& runner, const ApplySettings& settings,
                    int done) {
    EmbeddedMap& map = *body_.map;
    runner.context().most_darts = most_darts(map);
    std::vector<bool> chosen;
    if (settings.where.given()) {
      chosen.resize(map.cells(Vertex).slots());
      for (Slot v : select_vertices(map, groups_now(), settings.where, "apply", settings.source))
        chosen[v] = true;
    }
    const auto selected = [&](Dart d) { return chosen[map.vertex(d)]; };
    const bool pairs = rule.hooks() == 2;
    const Touching touching(map, pairs);
    const bool sides = pairs && rule.hook_orbit().has(1);
    const Partners partners = [&](Dart d) { return touching.darts_at(d, sides); };
    const RoundResult result = apply_round(
        map, runner, chosen.empty() ? std::function<bool(Dart)>() : std::function<bool(Dart)>(selected),
        pairs ? partners : Partners());
    if (result.over_budget) refuse_growth(rule, result, runner.context().most_darts, settings, done);
    if (result.applied == 0)
      settings.source.fail("",
                           fmt::format("{} '{}' applies nowhere{}", rule.kind(), rule.name(),
                                       result.reason.empty() ? "" : ": " + result.reason),
                           result.reason.empty() ? nothing_selected(rule, settings) : "");
    return result;
  }

  // Places that overlap are left to a further round, which nobody may have thought of.
  void note_skipped(const RuleOrScript& rule, const ApplySettings& settings, const RoundResult& all) {
    if (all.skipped == 0) return;
    const auto places = [](std::size_t n) { return fmt::format("{} place{}", n, n == 1 ? "" : "s"); };
    body_.notes.push_back(fmt::format(
        "{} '{}' was applied at {}{}, and skipped {} that overlap{} one before in the same round: times=\"{}\" "
        "tries again",
        rule.kind(), rule.name(), places(all.applied),
        settings.times > 1 ? fmt::format(" in {} rounds", settings.times) : std::string(), places(all.skipped),
        all.skipped == 1 ? "s" : "", settings.times + 1));
  }

  // No orbit was tried.
  static std::string nothing_selected(const RuleOrScript& rule, const ApplySettings& settings) {
    if (rule.hooks() == 0 || !settings.where.given()) return "there is nothing that its hook stands for";
    return fmt::format(
        "its hook stands for all darts of an orbit {} ({}), and is tried where all vertices of that are "
        "selected; to=\"all\" selects every one",
        to_string(rule.hook_orbit()), cell_in_words(rule.hook_orbit()));
  }

  [[noreturn]] static void refuse_growth(const RuleOrScript& rule, const RoundResult& result, std::size_t most,
                                         const ApplySettings& settings, int done) {
    const std::string round =
        settings.times > 1 ? fmt::format("round {} of {}: ", done + 1, settings.times) : std::string();
    const std::string places = result.places > 1 ? fmt::format(", at {} places,", result.places) : "";
    const std::string darts = result.darts > 0 ? fmt::format("{} darts", result.darts) : "more darts";
    settings.source.fail(settings.times > 1 ? "times" : "",
                         fmt::format("{}with {} '{}'{} the body would have {}, and rules may let it grow to {}",
                                     round, rule.kind(), rule.name(), places, darts, most),
                         done > 0 ? fmt::format("times=\"{}\" is the most that fits here", done)
                                  : "apply it to fewer cells, or begin with fewer");
  }

  VertexGroups groups_now() const {
    VertexGroups groups;
    std::size_t bit = 0;
    const CellIndex& vertices = body_.map->cells(Vertex);
    for (const auto& [name, slots] : body_.groups) {
      std::vector<Slot>& chosen = groups[name];
      for (Slot v = 0; v < vertices.slots(); ++v)
        if (vertices.alive(v) && ((*groups_)[v] >> bit & 1)) chosen.push_back(v);
      ++bit;
    }
    return groups;
  }

  void check_shapes() const {
    body_.map->edit([&](Edit& edit) {
      const CellIndex elements(edit.map(), element_orbit(edit.map().dimension()));
      for (Slot e = 0; e < elements.slots(); ++e)
        if (const std::string fault = shape_fault(edit, elements.first_dart(e)); !fault.empty())
          shape_.fail("", "after its rules " + fault);
    });
  }

  // Points are vertex slots.
  MapMesh map_mesh() const {
    const EmbeddedMap& from = *body_.map;
    MapMesh mesh{{}, from.map(), std::vector<std::uint32_t>(from.map().capacity())};
    for (const Record& x : from.position().values()) mesh.points.push_back(x.vec());
    from.map().for_each_dart([&](Dart d) { mesh.point[d.value] = from.vertex(d); });
    return mesh;
  }

  // The rule will make volumes on its faces.
  void make_solid() {
    auto solid = sheet_in_space(*body_.map);
    if (groups_) {
      GroupColumn& groups = solid->add(GroupMask{});
      Dart made{0u};
      body_.map->map().for_each_dart([&](Dart d) {
        groups[solid->vertex(made)] = (*groups_)[body_.map->vertex(d)];
        made = Dart{made.value + 1};
      });
      groups_ = &groups;
    }
    if (find_texture_coordinates(*body_.map))
      body_.notes.emplace_back(
          "the texture coordinates of its mesh are of no use to a solid that a rule makes of "
          "it: pictures lie on its faces as on other solids");
    body_.map = std::move(solid);
  }

  // Which rule has opened what is open; the next may close it.
  void note_open(const RuleOrScript& what, const ApplySettings& settings) {
    if (!has_open_cells(body_.map->map()))
      opened_.reset();
    else if (!opened_)
      opened_ = OpenedBy{fmt::format("{} '{}'", what.kind(), what.name()), settings.source};
  }

  Body& body_;
  const RuleBook& rules_;
  const SettingsSource& shape_;
  GroupColumn* groups_ = nullptr; // null: the body has none
  std::optional<OpenedBy> opened_;
};

} // namespace

template <> const Fields<ApplySettings>& fields_of() {
  using S = ApplySettings;
  static const Fields<S> fields =
      Fields<S>{
          field(&S::with,
                word("with", {"nothing", "touching"},
                     "for rules with two hooks: touching: the second hook is the dart at the same place")),
          field(&S::rule,
                text("rule", "a rule of this scene, or a built-in one (rend rule list)").is_required()),
          field(&S::times, integer("times", "how many times; each time on the result of the time before")
                               .at_least(1)
                               .at_most(1000))} +
      fields_of_part(&S::where);
  return fields;
}

const ElementType& apply_type() {
  static const ElementType type = [] {
    ElementType made{"apply",
                     "a rule that constructs: it is applied wherever all vertices are selected",
                     attributes_of<ApplySettings>(),
                     {}};
    made.attributes.push_back(word("to", {"all"}, "all: apply the rule everywhere, as without a selector"));
    made.further = "an argument of the rule: an expression of numbers";
    return made;
  }();
  return type;
}

const ElementType& subdivide_type() {
  static const ElementType type{
      "subdivide",
      "each face of a sheet becomes one quad per corner, each volume of a solid one hexahedron per corner",
      {integer("times", "how many times").at_least(1).at_most(20).otherwise("1")},
      {}};
  return type;
}

ApplySettings read_apply(const PresetNode& node) {
  if (node.name() == subdivide_type().name)
    return {.rule = subdivision, .times = node.integer("times"), .source = source_of(node)};
  ApplySettings settings = read_settings<ApplySettings>(node);
  for (const std::string& name : node.further()) settings.arguments[name] = node.find(name)->text;
  if (node.given("to") && settings.where.given())
    node.fail("to", "<apply> has both to and a selector", "give one of them");
  return settings;
}

void construct(Body& body, const std::vector<ApplySettings>& applies, const std::vector<SlitSettings>& slits,
               const std::optional<PiecesSettings>& pieces, const RuleBook& rules, const Placement& place,
               KeepStart keep_start, const SettingsSource& shape) {
  Construction construction(body, rules, shape);
  for (const ApplySettings& settings : applies) construction.apply(settings);
  cut_slits(*body.map, slits);
  if (pieces) make_pieces(*body.map, *pieces);
  construction.finish(place, keep_start);
}

} // namespace rend
