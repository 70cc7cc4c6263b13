// Contact with the floor, spheres and boxes inside the solve of implicit schemes.
//
// Contact after a solve (sim/contact/contact_answer.h) pushes out what the solve has moved in, and what rests
// there is compressed by its weight once more in every step. Here the solve knows of it. Each vertex near an
// obstacle stays in a half-space that is fixed for the step, that of the tangent plane at the point of the
// obstacle nearest to the vertex, where the obstacle is at the end of the step:
//
//   g(x) = n·x − offset ≥ 0
//
// by an augmented Lagrangian (Hestenes 1969; Powell 1969; for contact: Simo and Laursen 1992). With multiplier
// λ and penalty stiffness k,
//
//   P(x) = (max(0, λ − k g)² − λ²)/2k,   f_n = −∂P/∂x = max(0, λ − k g) n,   −∂f_n/∂x = k n nᵀ  where f_n > 0
//
// is convex. When Newton's method has converged, λ ← max(0, λ − k g), and the step is solved again, until
// nothing penetrates by more than `tolerance`. The first λ is what presses against the obstacle at the start of
// the step, so that what rests is solved once.
//
// Coulomb friction with a lagged bound μ λ opposes the displacement u in the plane, relative to the obstacle,
// since the start of the step h (Li et al. 2020, Incremental Potential Contact, 5):
//
//   f_t = −μ λ s(|u|) u/|u|,   s = 2 |u|/ε − (|u|/ε)²  below ε = h · creep, 1 above
//
// so that what sticks creeps, at less than `creep`.
//
// A multiplier acts on one vertex; faces between vertices, bodies and falling spheres are left to contact at
// the end of the step.
#pragma once

#include "sim/integrate/system.h"
#include "sim/outside/contact_settings.h"
#include "sim/outside/contact_table.h"
#include "sim/outside/contact_work.h"
#include "sim/outside/world.h"

namespace rend {

class SolvedContact {
public:
  // All of them must outlive it.
  SolvedContact(const World& world, const ContactSettings& settings, const ContactTable& table)
      : world_(world), settings_(settings), table_(table) {}

  // Of the system as it is at rest, one position per vertex slot [m]: penalty stiffnesses follow from its
  // stiffness. After a change of the map.
  void rebind(System& system, const std::vector<Record>& rest);

  // Finds the planes of a step of size `step` [s] that ends at `end` [s]. `force` [N]: internal, of `now`;
  // null: the multipliers of the step before are kept.
  void begin(const System& system, double end, double step, const StateView& now, const Record* force);
  void end(); // no contact until the next begin()
  bool near() const { return !planes_.empty(); }

  // Of a state of that step, to what is there already.
  void add_forces(const Record* position, Record* force) const;                           // [N]
  void add_stiffness(const Record* position, double by_position, BlockMatrix& out) const; // [N/m]
  double potential(const Record* position) const;                                         // [J], P
  // Moves the multipliers. True: by so much that the step is to be solved again. False: it is accepted.
  bool tighten(const Record* position);
  // In the steps accepted since end(); touched obstacles in any order, also more than once.
  const ContactWork& work() const { return work_; }
  const std::vector<std::uint32_t>& touched() const { return touched_; }

  double deepest(const Record* position) const; // [m], of what penetrates; 0: nothing
  std::size_t bytes() const {
    return bytes_of(planes_) + bytes_of(before_) + bytes_of(stiffness_) + bytes_of(touched_);
  }

private:
  struct VertexPlane {
    Slot vertex = 0;
    std::uint32_t obstacle = 0; // its number in the world
    Plane plane;                // at the end of the step
    Vec3 from, start;           // [m]: at the start; and where it would be if it moved with the obstacle
    double friction = 0;        // coefficient
    double stiffness = 0;       // k [N/m]
    double multiplier = 0;      // λ [N]
    double bound = 0;           // [N], μ λ of the last solve
    double still = 0;           // [m], how deep it may still be at the end of the step (way_out())

    double gap(const Record* position) const { return plane.normal.dot(position[vertex].vec()) - plane.offset; }
    double pressure(const Record* position) const;                                    // |f_n| [N]
    Vec3 sliding(const Record* position) const;                                       // u [m]
    Vec3 force(const Record* position, double epsilon) const;                         // f_n + f_t [N]
    ContactWork work(const Record* position, double epsilon, double thickness) const; // of the step
  };
  template <class Nearest>
  void add_planes(const System& system, const StateView& now, std::size_t obstacle, const RigidStep& way,
                  const Nearest& nearest);
  double fastest(const System& system, double end, const StateView& now) const;
  void add_obstacles(const System& system, double end, const StateView& now);
  void first_multipliers(const System& system, const StateView& now, const Record* force);

  double epsilon() const; // ε [m]

  const World& world_;
  const ContactSettings& settings_;
  const ContactTable& table_;
  std::vector<double> stiffness_; // [N/m], one per vertex slot, of the body at rest
  std::vector<VertexPlane> planes_, before_;
  ContactWork work_;
  std::vector<std::uint32_t> touched_; // obstacles, by number
  double step_ = 0;                    // [s]
  double reach_ = 0;                   // [m]: planes farther from their vertices are left out
  double size_ = 0;                    // [m], of the body
  int rounds_ = 0;                     // of tighten() in this step
};

} // namespace rend
