#include "sim/fracture/made_elements.h"

#include "sim/mechanics/mass_tensor.h"
#include "sim/rules/rest_measures.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

// The laws of all kinds of elements, as the body has them for those that are there. Mass-tensors are made of
// linear elements; inner modes do not matter here.
std::vector<std::shared_ptr<const ElementLaw>> laws_of(const CriterionRequest& request) {
  std::vector<std::shared_ptr<const ElementLaw>> laws;
  const auto add = [&](ElasticModel model, Rotation rotation, const ElasticMaterial& material) {
    for (int kind = 0; kind < element_kinds; ++kind) {
      auto law = element_law(static_cast<ElementKind>(kind), model, rotation, material);
      if (law->shape().dimension == request.map.dimension()) laws.push_back(std::move(law));
    }
  };
  for (const auto& interaction : request.interactions) {
    if (const auto* law = dynamic_cast<const ElementLaw*>(interaction->law.get()))
      add(law->model(), law->rotation(), law->material());
    if (const auto* tensors = dynamic_cast<const MassTensorLaw*>(interaction->law.get()))
      add(ElasticModel::Linear, Rotation::Polar, tensors->request().material);
    if (!laws.empty()) break; // a body has one elasticity
  }
  return laws;
}

bool relinks_elements(const Rule& rule, int dimension) {
  const auto within = [&](int link) { return link < dimension; };
  return rule.creates() || rule.removes() ||
         std::any_of(rule.plan.unlinks.begin(), rule.plan.unlinks.end(),
                     [&](const auto& each) { return within(each.second); }) ||
         std::any_of(rule.plan.links.begin(), rule.plan.links.end(),
                     [&](const RulePlan::Link& each) { return within(each.link); });
}

bool moves_vertices(const Rule& rule) {
  for (std::size_t n = 0; n < rule.before.size(); ++n)
    if (rule.before[n] >= 0 && rule.vertex_set[n] >= 0) return true;
  return false;
}

} // namespace

MadeElements::MadeElements(const RuleOrScript& what, int dimension, const CriterionRequest* request) {
  look_through(what, dimension);
  if (request && !unchanged()) laws_ = laws_of(*request);
}

void MadeElements::look_through(const RuleOrScript& what, int dimension) {
  if (what.rule) {
    relinks_ = relinks_ || relinks_elements(*what.rule, dimension);
    moves_ = moves_ || moves_vertices(*what.rule);
    return;
  }
  for (const Script::Step& step : what.script->steps) look_through(step.what, dimension);
}

void MadeElements::begin() {
  moved_.clear();
  rest_of_moved_.clear();
}

std::string MadeElements::fault(Edit& edit, RuleOrScriptRunner& runner) {
  if (unchanged()) return {};
  note_moves(edit, runner);
  find_changed(edit, runner);
  // A rule that creates darts has looked at the shapes of what it made, where vertices stay (apply.h).
  const bool known_in_shape =
      runner.rule() && runner.rule()->rule().creates() && moving_darts_.empty() && rest_of_moved_.empty();
  std::string fault = fault_of_changed(edit, known_in_shape);
  if (fault.empty()) keep_moves();
  return fault;
}

// A vertex that a rule moves has its old point until the edit closes; one that a script moves, its new one.
void MadeElements::note_moves(const Edit& edit, RuleOrScriptRunner& runner) {
  moving_.clear();
  moving_darts_.clear();
  if (!runner.rule()) return;
  for (const auto& [d, point] : runner.rule()->moved()) {
    const std::size_t first = moving_darts_.size();
    collect(edit.map(), Vertex, d, moving_darts_);
    rest_of_moved_.push_back(point.rest);
    for (std::size_t n = first; n < moving_darts_.size(); ++n)
      moving_.assign(moving_darts_[n].value, static_cast<std::uint32_t>(rest_of_moved_.size() - 1));
  }
}

void MadeElements::keep_moves() {
  for (Dart d : moving_darts_) moved_.assign(d.value, moving_.find(d.value));
}

// A dart at least of each element that has other links or corners.
void MadeElements::find_changed(const Edit& edit, RuleOrScriptRunner& runner) {
  changed_ = moving_darts_;
  if (const RuleRunner* rule = runner.rule()) {
    changed_.insert(changed_.end(), rule->darts().begin(), rule->darts().end());
    return;
  }
  for (Dart d : runner.script()->used()) {
    if (!edit.map().alive(d)) continue;
    if (moves_)
      collect(edit.map(), Vertex, d, changed_);
    else
      changed_.push_back(d);
  }
}

std::string MadeElements::fault_of_changed(Edit& edit, bool known_in_shape) const {
  thread_local IndexSet seen;
  seen.clear();
  const Edit::Savepoint before = edit.savepoint();
  std::string fault;
  for (std::size_t n = 0; n < changed_.size() && fault.empty(); ++n) {
    if (seen.contains(changed_[n].value)) continue;
    element_.clear();
    collect(edit.map(), element_orbit(edit.map().dimension()), changed_[n], element_);
    for (Dart e : element_) seen.insert(e.value);
    const char* why = relinks_ ? fault_of_links(edit) : nullptr;
    if (!why && relinks_) why = fault_of_origin(edit);
    if (why) fault = why;
    if (why) break;
    if (!known_in_shape) // the measures ask the edit for points
      for (Dart e : element_)
        if (is_moved(e)) edit.give(e, {.position = Vec3::Zero(), .rest = rest_of(edit, e)});
    if ((!known_in_shape && !shape_fault(edit, element_.front()).empty()) || !fits_elasticity(edit))
      fault = RuleOrScriptRunner::unfit;
  }
  edit.rollback(before); // those points: moves count when the edit closes
  return fault;
}

// Null: its links are those of an element.
const char* MadeElements::fault_of_links(const Edit& edit) const {
  const GMap& map = edit.map();
  const bool sheet = map.dimension() == 2;
  for (Dart d : element_)
    for (int i = 0; i < map.dimension(); ++i)
      if (map.is_free(i, d)) return i < 2 ? "it would leave a face open" : "it would leave a volume open";
  if (!sheet)
    return element_at(map, element_.front())
               ? nullptr
               : "it would make a volume that is no tetrahedron, hexahedron, prism or pyramid";
  const int sides = sides_of_face(map, element_.front());
  if (sides < 3) return "it would make a face of fewer than three sides";
  if (sides <= 4 || laws_.empty()) return nullptr;
  return "it would make a face of more than four sides, for which elasticity has no element";
}

// Null: it has darts from before the edit, or they come from an element that was there.
const char* MadeElements::fault_of_origin(const Edit& edit) const {
  const Orbit element = element_orbit(edit.map().dimension());
  if (!edit.inherits()) return nullptr; // nothing has a mass
  for (Dart d : element_)
    if (!edit.is_new(d) || !edit.parents(d, element).empty()) return nullptr;
  return "it would add an element where there was none, and mass with it";
}

bool MadeElements::fits_elasticity(const Edit& edit) const {
  const Dart first = *std::min_element(element_.begin(), element_.end()); // from which values are written
  const std::optional<ElementPlace> at = laws_.empty() ? std::nullopt : element_at(edit.map(), first);
  if (!at) return true;
  std::vector<Vec3> rest;
  for (const auto& word : shape_of(at->kind).units[at->unit])
    rest.push_back(rest_of(edit, edit.map().follow(first, word)));
  constexpr double thickness = 1; // [m], which does not matter here
  for (const auto& law : laws_) {
    if (law->shape().kind != at->kind) continue;
    std::vector<double> values(static_cast<std::size_t>(law->values()));
    if (!law->write_unit(rest.data(), thickness, values.data())) return false;
  }
  return true;
}

bool MadeElements::is_moved(Dart d) const {
  return moving_.find(d.value) != IndexMap::none || moved_.find(d.value) != IndexMap::none;
}

Vec3 MadeElements::rest_of(const Edit& edit, Dart d) const {
  for (const IndexMap* moved : {&moving_, &moved_})
    if (const std::uint32_t at = moved->find(d.value); at != IndexMap::none) return rest_of_moved_[at];
  return edit.point(d).rest;
}

} // namespace rend
