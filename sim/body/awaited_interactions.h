// Interactions that a body was asked for and has no cells for yet, and that it gets when an edit makes some.
//
// The element laws of quads, say, in a sheet of triangles, where a law may make quads of them; shear, which
// acts in quads; bending, where no edge lies between two faces. As long as no cell is there, such an
// interaction has neither embedding nor rows. When an edit has made the first one, its embedding is added to
// the map, initialised from rest positions as any other, and the interaction stands behind those that the body
// has. From then on it stays.
//
// So the list of interactions depends on what the body has become: which were added, in their order, is stored
// with the state.
#pragma once

#include "sim/mechanics/interaction.h"

#include <memory>
#include <string>
#include <vector>

namespace rend {

class Archive;

class AwaitedInteractions {
public:
  std::vector<AwaitedInteraction>& all() {
    return all_;
  } // to be declared; and to be cleared, if no edit makes cells

  // Adds those that act in an element which these changes have touched; true: there were some.
  bool arrive(EmbeddedMap& map, const Changes& changes,
              std::vector<std::unique_ptr<Interaction>>& interactions);

  // Whether all that were awaited at the start have this law.
  bool only(const std::shared_ptr<const ForceLaw>& law) const;
  std::vector<std::string> names() const; // of those that are still awaited

  // Reading: adds those that had been added; true: there were some. Before the map is stored.
  bool store(Archive& archive, EmbeddedMap& map, std::vector<std::unique_ptr<Interaction>>& interactions);

private:
  bool has_arrived(std::uint32_t n) const;
  void add(std::uint32_t n, EmbeddedMap& map, std::vector<std::unique_ptr<Interaction>>& interactions);
  bool acts_in(const AwaitedInteraction& awaited, const GMap& map) const;

  std::vector<AwaitedInteraction> all_;
  std::vector<std::uint32_t> arrived_; // indices in all_, in the order in which they were added
  std::vector<Dart> darts_;            // scratch: of the changed elements, one element after the other
  std::vector<std::size_t> begin_;     // scratch: of each element in darts_
};

} // namespace rend
