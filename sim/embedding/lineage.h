// What the new darts of an edit come from: of a kind of orbit, a dart and its parents.
//
// An edit that divides a cell knows which cell that was; the values of the new cells follow from the values of
// the old ones (inheritance.h). Here stands only who descends from whom.
#pragma once

#include "sim/topology/index_set.h"
#include "sim/topology/orbit.h"

#include "sim/base/id.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace rend {

struct Parent {
  Dart dart;         // from before the edit
  double weight = 1; // the weights of one child sum up to 1
};

class Lineage {
public:
  bool empty() const { return family_of_.empty(); }

  // Parents for one or many children.
  std::uint32_t add_family(std::span<const Parent> parents);
  void assign(Dart child, Orbit orbit, std::uint32_t family); // of two, the last counts

  // The parents of a child: nullopt if none were recorded.
  std::optional<std::span<const Parent>> parents(Dart child, Orbit orbit) const;

  // How much was recorded, and the way back to it.
  struct Savepoint {
    std::size_t families = 0, assigned = 0;
  };
  Savepoint savepoint() const { return {first_.size() - 1, family_of_.size()}; }
  void rollback(const Savepoint& to) noexcept;

private:
  struct Assigned {
    Dart child;
    std::uint32_t orbit, family;
    std::uint32_t before; // index in family_of_ of what counted before, or IndexMap::none
  };
  std::vector<Parent> parents_;            // family by family
  std::vector<std::size_t> first_{0};      // of each family, and the end
  std::vector<Assigned> family_of_;        // in the order of the calls
  std::array<IndexMap, orbit_kinds> last_; // [orbit]: dart → index in family_of_
};

} // namespace rend
