// The continuum elements of a body, and the stress in them and at vertices (thesis 7.1, 7.2).
//
//   σ of an element:  ElementLaw::stress, in world axes
//   σ at a vertex:    Σ m σ / Σ m over the elements around it, m the masses of whole elements
//
// An element's mass is that of one of its corners times their number: the corners of an element have equal
// shares (sim/mechanics/mass.h), and no separation changes them.
//
// Mass-tensors store no elements: the linear elements that they were assembled from are recreated.
#pragma once

#include "sim/mechanics/element_law.h"
#include "sim/mechanics/mass.h"
#include "sim/rows/current_unit.h"

namespace rend {

class Continuum {
public:
  struct Part {
    const Interaction* interaction;
    const ElementLaw* law;
    std::size_t index; // among the body's interactions; `recreated`: recreated for mass-tensors
  };
  static constexpr std::size_t recreated = ~std::size_t{0};

  Continuum(const EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions);

  bool empty() const { return parts_.empty(); }
  const std::vector<Part>& parts() const { return parts_; }

  // Calls f(part, unit) for every element, part by part in the order of slots.
  template <class F> void each(const Record* x, const Record* v, F&& f) const {
    for (const Part& part : parts_) {
      const CellIndex& owners = map_->cells(part.interaction->pattern.owner);
      for (Slot owner = 0; owner < owners.slots(); ++owner)
        if (owners.alive(owner)) each_in(part, owners.first_dart(owner), x, v, f);
    }
  }

  // The same for the element whose smallest dart is d.
  template <class F> void each_of(Dart d, const Record* x, const Record* v, F&& f) const {
    for (const Part& part : parts_) each_in(part, d, x, v, f);
  }

private:
  template <class F> void each_in(const Part& part, Dart d, const Record* x, const Record* v, F&& f) const {
    const Pattern& pattern = part.interaction->pattern;
    for (std::size_t unit = 0; unit < pattern.units.size(); ++unit) {
      if (!pattern.present(map_->map(), d, unit)) continue;
      const CurrentUnit now(*map_, *part.interaction, d, unit, x, v);
      if (now.acts()) f(part, now);
    }
  }

  const EmbeddedMap* map_;
  std::vector<Part> parts_; // one per kind of element, in the order of the interactions
  std::vector<std::unique_ptr<Interaction>> recreated_; // recreated for mass-tensors
};

inline Eigen::Matrix3d stress_of(const Continuum::Part& part, const CurrentUnit& element) { // σ [Pa]
  return part.law->stress(element.values, element.state());
}
inline Eigen::Matrix3d strain_of(const Continuum::Part& part, const CurrentUnit& element) { // ε
  return part.law->strain(element.values, element.state());
}

// The average stress at vertices; elements are evaluated when first needed.
class VertexStress {
public:
  // CHECK: the map has slots for elements.
  VertexStress(const EmbeddedMap& map, const Continuum& continuum, const MassColumn& mass)
      : map_(&map), continuum_(&continuum), mass_(&mass) {}
  void clear() { // before another state
    place_.clear();
    sums_.clear();
  }
  Eigen::Matrix3d at(Slot vertex, const Record* x); // [Pa]; 0: no element there
  std::size_t bytes() const { return sums_.capacity() * sizeof(Sum); }

private:
  struct Sum { // of one element: usually a single stress
    Eigen::Matrix3d stress;
    int count;
    int corners; // number of the element's corners
  };
  const Sum& of_element(Slot element, const Record* x);

  const EmbeddedMap* map_;
  const Continuum* continuum_;
  const MassColumn* mass_;
  IndexMap place_;            // element slot → index in sums_
  std::vector<Sum> sums_;     // one per element evaluated since clear()
  std::vector<Dart> corners_; // scratch: the smallest dart of each corner at a vertex
};

// The largest eigenvalue of a symmetric tensor and its unit eigenvector, whose largest component is positive;
// with Compression::Counts the largest by size, as a magnitude. No function but the root is used: the same bits
// everywhere.
struct Principal {
  double value;
  Vec3 direction;
};
enum class Compression : bool { Ignored, Counts };
Principal largest_principal(const Eigen::Matrix3d& tensor, Compression compression);

} // namespace rend
