// The 3-dimensional generalized map: darts and four involutions α0..α3 (Lienhardt 1994; thesis 3.2).
//
//   αi(αi(d)) = d                        every αi is an involution; αi(d) = d is a free link
//   αi(αj(αi(αj(d)))) = d  for j ≥ i+2   so is αiαj
//
// The four links of a dart are stored together: a walk around a cell follows two or three different links of
// the same darts and so loads one cache line per dart instead of three. Removed darts are reused, the last
// removed first. A GMap has no public writer; MapEdit writes it, and keeps a journal of what it touched.
#pragma once

#include "sim/base/id.h"
#include "sim/topology/orbit.h"

#include <array>
#include <cstddef>
#include <vector>

namespace rend {

class Archive;

class GMap {
public:
  using Links = std::array<std::uint32_t, 4>; // α0(d) .. α3(d)

  // 2: a sheet, whose darts all stay α3-free, so that <1,2> is a vertex; 3: a solid.
  explicit GMap(int dimension);

  int dimension() const { return dimension_; }

  Dart alpha(int i, Dart d) const { return Dart{links_[d.value][static_cast<std::size_t>(i)]}; }
  bool is_free(int i, Dart d) const { return alpha(i, d) == d; }
  bool alive(Dart d) const { return d.value < links_.size() && links_[d.value][0] != Dart::none_value; }

  // The dart reached from d by following `word`, whose letters are '0'..'3', from left to right.
  template <class Word> Dart follow(Dart d, const Word& word) const {
    for (auto letter : word) d = alpha(letter - '0', d);
    return d;
  }

  std::size_t capacity() const { return links_.size(); } // darts are 0 .. capacity-1, some of them removed
  std::size_t dart_count() const { return links_.size() - free_.size(); }
  std::size_t bytes() const;

  // Calls f(d) for every dart that is alive, in increasing order.
  template <class F> void for_each_dart(F&& f) const {
    for (std::uint32_t i = 0; i < links_.size(); ++i)
      if (links_[i][0] != Dart::none_value) f(Dart{i});
  }

  // Writes or reads the whole map (base/archive.h). A map that is read must result from this one by separating
  // and removing elements, the only changes that fracture makes: so it satisfies the axioms, and its cells have
  // known shapes. ArchiveError otherwise, and this map is unchanged.
  void store(Archive& archive);

  // The same for a map that rules change as well: what is read must satisfy the axioms, and have at most
  // `most_darts`, removed ones included.
  void store_any(Archive& archive, std::size_t most_darts);

private:
  friend class MapEdit;
  struct Stored;

  int dimension_;
  std::vector<Links> links_;        // one per dart; α0 = none: removed
  std::vector<std::uint32_t> free_; // removed darts, reused from the back
};

} // namespace rend
