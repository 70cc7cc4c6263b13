// The connected parts of a body whose elements have been assigned to cells, and how they become a given number
// of pieces (pieces.h).
#pragma once

#include "sim/cuts/wall_cutter.h"
#include "sim/fracture/piece.h"

#include <map>

namespace rend {

class PieceParts {
public:
  PieceParts(EmbeddedMap& map, WallCutter& cutter, PieceColumn& pieces)
      : map_(map), cutter_(cutter), pieces_(pieces) {}

  // Leaves that many, numbered in the order of their first elements. False: there can't be so many, or so few.
  bool settle(std::size_t count);
  std::size_t count() const { return alive_; }

private:
  struct Part {
    double size = 0;                           // [m³], of a sheet [m²]; 0: it has been joined to another one
    std::map<std::uint32_t, double> borders{}; // with other parts [m²], [m]
  };

  void find();
  void flood(Slot first, std::uint32_t part);
  void add_borders();
  double measure_of(Dart border) const;
  bool join_smallest();
  void join(std::uint32_t part, std::uint32_t to);
  void write();
  bool divide_largest();
  bool is_even() const;
  Slot element(Dart d) const { return map_.slot(pieces_.orbit(), d); }

  EmbeddedMap& map_;
  WallCutter& cutter_;
  PieceColumn& pieces_;
  std::vector<std::uint32_t> part_of_; // of each element slot
  std::vector<Part> parts_;
  std::vector<std::uint32_t> into_; // to which each part has been joined; itself: to none
  std::size_t alive_ = 0;
};

} // namespace rend
