#include "sim/fracture/law_quantities.h"

#include "sim/base/check.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

LawQuantities::LawQuantities(const CriterionRequest& request)
    : map_(&request.map), mass_(&request.mass), compression_{request.compression}, rows_(request) {
  CHECK(!rows_->continuum().empty());
}

void LawQuantities::begin(const ForceView& view) {
  time = view.time;
  if (!rows_) return;
  for (Field& field : fields_) {
    field.element.clear();
    field.vertex.clear();
    field.of_element.clear();
    field.at_vertex.clear();
  }
  view_.emplace(view);
  old_links_.emplace(map_->map());
  noted_ = {};
}

void LawQuantities::before_change(const Edit& edit) {
  if (!rows_) return;
  old_links_->note(*edit.journal(), noted_);
  noted_ = edit.MapEdit::savepoint();
}

void LawQuantities::rebind(const Changes& changes) {
  if (rows_) rows_->rebind(changes);
}
void LawQuantities::reserve_for_separations() {
  if (rows_) rows_->reserve_for_separations();
}
std::size_t LawQuantities::bytes() const {
  std::size_t sum = rows_ ? rows_->bytes() : 0;
  for (const Field& field : fields_)
    sum += field.of_element.capacity() * sizeof(OfElement) + field.at_vertex.capacity() * sizeof(double);
  return sum;
}

double LawQuantities::largest(Field& field, const Edit& edit, Dart d, Of of) {
  CHECK(view_);
  const Journal& journal = *edit.journal();
  if (journal.empty()) return from_before(field, edit, d, of);
  const Orbit orbit = of == Of::AtVertex ? Vertex : element_orbit(map_->dimension());
  darts_.clear();
  collect(edit.map(), orbit, d, darts_);
  std::sort(darts_.begin(), darts_.end());
  for (Dart e : darts_)
    if (map_->cells(Vertex).find(e) != no_slot) return from_before(field, edit, e, of);
  for (Dart e : darts_) {
    const std::span<const Parent> parents = edit.parents(e, orbit);
    double sum = 0;
    for (const Parent& parent : parents) sum += parent.weight * from_before(field, edit, parent.dart, of);
    if (!parents.empty()) return sum;
  }
  throw ExpressionError(1, "what an earlier change of the step made out of nothing has no stress or strain");
}

double LawQuantities::from_before(Field& field, const Edit& edit, Dart d, Of of) {
  return of == Of::InElement ? of_element(field, d).largest : at_vertex(field, edit, d);
}

const LawQuantities::OfElement& LawQuantities::of_element(Field& field, Dart d) {
  const auto next = static_cast<std::uint32_t>(field.of_element.size());
  const std::uint32_t at = field.element.insert(map_->slot(element_orbit(map_->dimension()), d), next);
  if (at != next) return field.of_element[at];
  OfElement sum;
  for (std::size_t part = 0; part < rows_->parts().size(); ++part) {
    const Interaction& interaction = *rows_->parts()[part].interaction;
    const PackedRows& rows = rows_->of(*view_, part).rows();
    const std::size_t units = interaction.pattern.units.size();
    const Slot owner = map_->slot(interaction.pattern.owner, d);
    for (std::size_t unit = 0; unit < units; ++unit)
      if (const std::size_t key = owner * units + unit; rows.live(key)) add(sum, field, part, rows.row(key));
  }
  field.of_element.push_back(sum);
  return field.of_element.back();
}

// The values are those of the row: units may be made from the map as it is now.
void LawQuantities::add(OfElement& sum, const Field& field, std::size_t part, std::size_t row) {
  const ElementLaw& law = *rows_->parts()[part].law;
  const PackedRows& rows = rows_->of(*view_, part).rows();
  values_.clear();
  for (int c = 0; c < law.values(); ++c) values_.push_back(rows.value(c, row));
  std::array<Vec3, most_particles> position, rest, velocity;
  for (std::size_t n = 0; n < static_cast<std::size_t>(law.particles()); ++n) {
    const Slot v = rows.index(static_cast<int>(n))[row];
    position[n] = view_->position[v];
    rest[n] = map_->rest()[v];
    velocity[n] = Vec3::Zero();
  }
  const Eigen::Matrix3d tensor =
      (law.*field.tensor)(values_.data(), {position.data(), velocity.data(), rest.data()});
  const double most = largest_principal(tensor, compression_).value;
  sum.largest = sum.count == 0 ? most : std::max(sum.largest, most);
  sum.sum += tensor;
  sum.corners = law.particles();
  ++sum.count;
}

double LawQuantities::at_vertex(Field& field, const Edit& edit, Dart d) {
  const auto next = static_cast<std::uint32_t>(field.at_vertex.size());
  const Slot vertex = map_->vertex(d);
  const std::uint32_t at = field.vertex.insert(vertex, next);
  if (at != next) return field.at_vertex[at];
  old_links_->note(*edit.journal(), noted_); // what the rule or script that asks has changed itself
  old_links_->collect(Vertex, map_->cells(Vertex).first_dart(vertex), corners_);
  const CellIndex& corners = map_->cells(mass_->orbit());
  std::erase_if(corners_, [&](Dart e) { return corners.first_dart(corners.slot(e)) != e; });
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double whole = 0;
  int first =
      0; // number of corners of the first element: with elements of one kind, weights are exactly masses
  for (Dart e : corners_) {
    const OfElement& element = of_element(field, e);
    if (element.count == 0) continue;
    if (first == 0) first = element.corners;
    const double m = (*mass_)[corners.slot(e)] * (static_cast<double>(element.corners) / first);
    sum += m * element.sum;
    whole += m * element.count;
  }
  if (whole > 0) sum /= whole;
  field.at_vertex.push_back(largest_principal(sum, compression_).value);
  return field.at_vertex.back();
}

} // namespace rend
