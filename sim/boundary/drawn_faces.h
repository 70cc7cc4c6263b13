// The faces that are drawn of a solid: few among many, so kept sparsely, and in an order that is the map's
// alone.
//
// A face's key is its smallest dart. Keys come in blocks of 128 darts; a block holds its drawn faces sorted by
// key, and their corners one face after another. An insertion moves what follows in one block; an empty block
// costs 48 bytes (0.4 bytes a dart of the map); and the whole is a pure function of what is drawn, however it
// came about.
#pragma once

#include "sim/boundary/side.h"
#include "sim/embedding/cell_index.h"

#include <span>
#include <vector>

namespace rend {

class DrawnFaces {
public:
  struct Corner {
    Slot vertex;
    Dart group; // corners of one group share a normal; named by its smallest dart (a bare face: by the face's)
    Side side;  // along the edge to the next corner
    bool operator==(const Corner&) const = default;
  };
  struct Face {
    Dart first;  // the smallest dart; its corner is corner 0
    bool turned; // corners are met from α1(first) on, not from first: counter-clockwise seen from outside
    bool bare;   // laid bare by fracture
    std::uint32_t sides;
    bool operator==(const Face&) const = default;
  };

  void resize(std::size_t darts);                              // room for keys below; never shrinks
  void set(const Face& face, std::span<const Corner> corners); // in place of what was there
  bool erase(Dart first);                                      // false: there was none

  struct Found {
    const Face* face = nullptr; // null: not drawn
    std::span<Corner> corners;
  };
  Found find(Dart first); // holds until the next set() or erase()
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
  bool operator==(const DrawnFaces&) const = default;

private:
  static constexpr std::size_t block_size = 128; // [darts]
  struct Block {
    std::vector<Face> faces;     // by increasing first
    std::vector<Corner> corners; // face after face
    bool operator==(const Block&) const = default;
  };
  struct Place {
    std::size_t face, corner; // in the block: of the first face whose key is not below
  };
  Place place_of(const Block& block, Dart first) const;

  std::vector<Block> blocks_;
  std::size_t faces_ = 0, corners_ = 0;
};

} // namespace rend
