// Projected Gauss–Seidel over the contacts of a step (contact_answer.h): what its sweeps read and write, and
// nothing else, so that a visit costs a few cache lines.
//
// A row is a contact: it asks for λ_n ≥ 0 and u'·n ≥ wanted, with equality where λ_n > 0, and its friction
// obeys |λ_t| ≤ μ λ_n. Its approach is
//
//   u' = surface + Σ weight · velocity        over its parts: movers with weights
//
// and an impulse λ changes the velocity of a mover that it pushes by weight · λ/m, along each axis. Sweeps
// visit rows in their order, those of which a mover has changed since the last visit, until none has by more
// than a tolerance, at most 12 times.
#pragma once

#include "sim/base/bytes.h"
#include "sim/base/record.h"

#include <cstdint>
#include <vector>

namespace rend {

class ContactSweeps {
public:
  struct Mover {                      // a vertex or a sphere
    Vec3 velocity = Vec3::Zero();     // [m/s]
    Vec3 inverse_mass = Vec3::Zero(); // [1/kg] along x, y, z
    long changed = 0;                 // the visit that changed it last, counted from 1
  };
  struct Part {
    double weight = 0; // of its velocity in the approach, and of the impulse on it
    std::uint32_t mover = 0;
  };
  struct Row {
    Vec3 normal = Vec3::Zero();               // unit
    Vec3 inverse_masses = Vec3::Zero();       // [1/kg], K of both sides, along x, y, z
    double along = 0;                         // [1/kg], n·K n
    Vec3 before = Vec3::Zero();               // [m/s], u
    Vec3 surface = Vec3::Zero();              // [m/s], what obstacles add to the approach
    double wanted = 0;                        // [m/s], the least u'·n
    double coefficient = 0;                   // μ, of friction
    double normal_impulse = 0;                // [N·s], λ_n
    Vec3 friction = Vec3::Zero();             // [N·s], λ_t
    long visited = 0;                         // the last visit
    std::uint32_t parts = 0, parts_end = 0;   // in the array of parts
    std::uint32_t pushed = 0, pushed_end = 0; // of these: those whose side is not held
    Vec3 impulse() const { return normal_impulse * normal + friction; } // [N·s]
  };

  void clear();       // all
  void clear_parts(); // the movers and parts: rows are to get theirs anew, and have no impulse
  void start_anew();  // rows have no impulse, nothing was visited

  std::uint32_t add(const Mover& mover);
  void add(const Row& row) { rows_.push_back(row); }
  // The next part of a row, whose parts are added one after another.
  void add_part(Row& row, const Part& part, bool pushed);

  std::vector<Row>& rows() { return rows_; }
  const std::vector<Row>& rows() const { return rows_; }
  std::vector<Mover>& movers() { return movers_; }
  const std::vector<Mover>& movers() const { return movers_; }
  Vec3 approach(const Row& row) const; // [m/s], u'

  void solve();
  std::size_t bytes() const { return bytes_of(rows_) + bytes_of(movers_) + bytes_of(parts_); }

private:
  bool changed_since(const Row& row) const;
  bool sweep(double tolerance);
  void apply(const Row& row, const Vec3& impulse, double tolerance);
  void press(Row& row, double tolerance);
  void rub(Row& row, double tolerance);
  static Vec3 slowing(const Row& row, const Vec3& u);

  std::vector<Row> rows_;
  std::vector<Mover> movers_;
  std::vector<Part> parts_; // those of a row one after another
  long visits_ = 0;
};

} // namespace rend
