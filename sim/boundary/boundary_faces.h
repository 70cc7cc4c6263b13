// The boundary faces of a solid: few among many, so stored sparsely, and in an order determined by the map
// alone.
//
// The key of a face is its smallest dart. Keys come in blocks of 128 darts; a block holds its boundary faces
// sorted by key, and their corners face by face. An insertion moves only what follows in its block; an empty
// block costs 48 bytes (0.4 bytes per dart of the map); the whole is a pure function of the set of faces,
// however it was reached.
#pragma once

#include "sim/boundary/line_kind.h"
#include "sim/embedding/cell_index.h"

#include <span>
#include <vector>

namespace rend {

class BoundaryFaces {
public:
  struct Corner {
    Slot vertex;
    // corners of one group share a normal; the group's smallest dart (on an exposed face: the face's)
    Dart group;
    LineKind side; // along the edge to the next corner
    bool operator==(const Corner&) const = default;
  };
  struct Face {
    Dart first;  // its smallest dart; its corner is corner 0
    bool turned; // corners are listed from α1(first) on, not from first: counter-clockwise as seen from outside
    bool exposed; // exposed by fracture
    std::uint32_t sides;
    bool operator==(const Face&) const = default;
  };

  void resize(std::size_t darts); // makes room for keys below `darts`; never shrinks
  void set(const Face& face, std::span<const Corner> corners); // replaces the face if it is present
  bool erase(Dart first);                                      // false: there was none

  struct Found {
    const Face* face = nullptr; // null: not present
    std::span<Corner> corners;
  };
  Found find(Dart first); // valid until the next set() or erase()
  std::size_t count() const { return faces_; }
  std::size_t corner_count() const { return corners_; }

  // Calls f(Face, std::span<const Corner>) by increasing key.
  template <class F> void for_each(F&& f) const {
    for (const Block& block : blocks_) {
      const Corner* at = block.corners.data();
      for (const Face& face : block.faces) {
        f(face, std::span<const Corner>(at, face.sides));
        at += face.sides;
      }
    }
  }

  std::size_t bytes() const;
  bool operator==(const BoundaryFaces&) const = default;

private:
  static constexpr std::size_t block_size = 128; // [darts]
  struct Block {
    std::vector<Face> faces;     // by increasing first
    std::vector<Corner> corners; // face by face
    bool operator==(const Block&) const = default;
  };
  struct Place {
    std::size_t face, corner; // in the block: of the first face whose key is not smaller
  };
  Place place_of(const Block& block, Dart first) const;

  std::vector<Block> blocks_;
  std::size_t faces_ = 0, corners_ = 0;
};

} // namespace rend
