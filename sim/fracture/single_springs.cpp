#include "sim/fracture/single_springs.h"

#include "sim/mechanics/hinge_law.h"
#include "sim/mechanics/spring_law.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

bool is_hinge(const Interaction& interaction) {
  return interaction.law == hinge_law();
}
bool is_spring(const Interaction& interaction) {
  return interaction.law == spring_law() || is_hinge(interaction);
}

struct Ends {
  Vec3 apart, speed; // [m], [m/s]
};
Ends ends_of(const ForceView& view, const PackedRows& rows, std::size_t row) {
  const std::uint32_t i = rows.index(0)[row], j = rows.index(1)[row];
  return {view.position[j].vec() - view.position[i].vec(), view.velocity[j].vec() - view.velocity[i].vec()};
}

} // namespace

SingleSprings::SingleSprings(const CriterionRequest& request) {
  for (std::size_t n = 0; n < request.interactions.size(); ++n) {
    const Interaction& interaction = *request.interactions[n];
    if (is_spring(interaction) && interaction.name.starts_with(request.kind)) of_.push_back(n);
  }
}

double SingleSprings::bound(const ForceView& view, const PackedRows& rows, std::size_t row) {
  const auto [apart, speed] = ends_of(view, rows, row);
  const double length = apart.norm(), along = length > 0 ? speed.dot(apart) / length : 0;
  const double force =
      rows.value(0, row) * std::abs(length - rows.value(2, row)) + rows.value(1, row) * std::abs(along);
  return force * (1 + 1e-12); // margin for rounding, also of the sum of k
}

double SingleSprings::elongation(const ForceView& view, const PackedRows& rows, std::size_t row) {
  const double rest = rows.value(2, row);
  return rest > 0 ? ends_of(view, rows, row).apart.norm() / rest - 1 : 0;
}

double force_of(const CurrentUnit& spring) {
  if (!is_hinge(*spring.interaction)) return spring.forces()[0].norm();
  return std::abs(hinge_moment(HingeParameters::of(spring.values), spring.position, spring.velocity));
}

double elongation_of(const CurrentUnit& spring) {
  const double rest = UnitParameters::of(spring.values).rest;
  return rest > 0 ? (spring.position[1] - spring.position[0]).norm() / rest - 1 : 0;
}

Cell cell_of_kind(std::string_view kind) {
  return kind == "stretch" ? Cell::Edges : kind == "shear" ? Cell::Elements : Cell::Borders;
}

Dart cell_of(const EmbeddedMap& map, Cell cell, const CurrentUnit& spring) {
  return smallest_dart(map.map(), orbit_of(cell, map.dimension()), spring.owner);
}

std::string lacking_for_springs(const CriterionRequest& request) {
  std::vector<std::string> there;
  bool hinges = false, straight = false;
  for (const auto& interaction : request.interactions) {
    if (!is_spring(*interaction)) continue;
    const std::string kind = interaction->name.substr(0, interaction->name.find(' '));
    if (std::find(there.begin(), there.end(), kind) == there.end()) there.push_back(kind);
    if (kind == request.kind) (is_hinge(*interaction) ? hinges : straight) = true;
  }
  std::string list;
  for (const std::string& kind : there) list += (list.empty() ? "" : ", ") + kind;
  if (there.empty())
    return "measures springs, but this body has none; with <elasticity> take atomic-element, vertex-stress or "
           "atomic-border";
  if (request.kind.empty()) return "measures springs of one kind: give kind, one of " + list;
  if (!hinges && !straight)
    return fmt::format("measures springs of kind '{}', but this body has only {}", request.kind, list);
  if (hinges && straight)
    return "would compare forces and moments with one threshold, because this body has both kinds of <bend>: "
           "keep "
           "one of them, or measure another kind";
  return {};
}

std::string springs_without_meaning(std::string_view kind, int dimension) {
  if (kind != "bend" || dimension == 2) return {};
  return "has nothing to measure in a solid: bending springs join the faces of a sheet, while volumes that "
         "share a "
         "face resist bending by their stretch and shear; atomic-border measures what opens a face between "
         "them";
}

bool turns(const CriterionRequest& request) {
  return std::any_of(request.interactions.begin(), request.interactions.end(),
                     [&](const auto& each) { return is_hinge(*each) && each->name.starts_with(request.kind); });
}

void keep_largest(std::vector<Candidate>& candidates, std::size_t first) {
  const auto begin = candidates.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.dart != b.dart ? a.dart < b.dart : a.value > b.value;
  });
  candidates.erase(std::unique(begin, candidates.end(),
                               [](const Candidate& a, const Candidate& b) { return a.dart == b.dart; }),
                   candidates.end());
}

} // namespace rend
