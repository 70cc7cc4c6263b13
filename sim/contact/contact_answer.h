// The answer to the contacts of a step: impulses that let nothing come too close, and make no energy.
//
// A contact acts in a step of size h as symplectic Euler takes a force: an impulse λ changes the velocity u' of
// the step by λ/m, and the position by h λ/m. With the velocity u of the step before (leapfrog.h: those of the
// middles of steps), it changes what the scheme keeps (K + U and its shadow term; exact for linear forces) by
//
//   ΔE = ½ λ·(u + u')
//
// with relative velocities of both sides. So with the normal n and the gap g at the end of the step, each
// contact asks for
//
//   λ_n ≥ 0,   u'·n ≥ min(what makes g ≥ 0, c (−u·n)),   with equality where λ_n > 0
//
// with c = ½ where it came, −u·n > 0, and 1 where it was leaving, and none makes energy. What approaches is
// stopped: an impact is inelastic for the vertices that meet, and keeps what elasticity keeps. With a
// coefficient of restitution e ≤ 1 it leaves with −e u·n at least (Newton's law), which still is no more than
// −u·n, so that ΔE = ½ λ_n (1 − e) u·n ≤ 0. That is for impacts alone: what rests or rolls is pressed on by
// forces in each step, and would never come to rest. It is an impact where
//
//   −u·n > 2 |(u'° − u)·n|              u'°: the velocity of the step without contact
//
// that is, where the approach is faster than what the forces of the step give in two of them. (Engines of games
// compare with a fixed speed, which depends on the size of the scene: Box2D with 1 m/s, Bullet with 0.5 m/s.)
// So what bounces under gravity g comes to rest once it strikes with less than 2 g h.
//
// A penetration is paid for by the velocity with which the point would go deeper: it leaves at most half as
// fast as it came. (As fast would make no energy either; but what sinks in a first step, and is given back
// whole, hops for ever: a block would lie in every second step only.) One that rests in something stays there.
// Where the forces of the step turn around what was leaving, it may come back as far as it had gone.
// (CD-Lagrange schemes have the same balance: Fekak et al. 2017; Di Stasio et al. 2019.)
//
// Schemes that solve lose energy in every step, and have contact of their own (solved_contact.h). What that has
// left is stopped, and pushed out on positions only (way_out() in contact_settings.h).
//
// Friction λ_t takes the sliding velocity away, with |λ_t| ≤ μ λ_n, and so that λ_t·(u_t + u'_t) ≤ 0.
//
// All contacts of a step are one problem, solved by sweeps over them with accumulated impulses
// (contact_sweeps.h); if the sum of all impulses then still makes energy, they are scaled down. They act on
// *movers*, the vertices and spheres that something touches. Momentum is kept to round-off.
#pragma once

#include "sim/contact/contact_constraint.h"
#include "sim/contact/contact_sweeps.h"

namespace rend {

class ContactAnswer {
public:
  // `pushes`: of a scheme that solves; there is no restitution.
  explicit ContactAnswer(bool pushes) : pushes_(pushes) {}
  void begin() { // a step
    contacts_.clear();
    moved_.clear();
    sweeps_.clear();
  }
  void add(const ContactConstraint& contact);
  // Also one that has no negative gap yet, since others may push it there.
  void require(const ContactConstraint& contact);
  bool empty() const { return contacts_.empty(); }
  const std::vector<ContactConstraint>& contacts() const { return contacts_; } // of this step, as added
  void solve(double step);                                                     // [s]
  void take_back();     // what solve() has changed, so that it can be called again with more contacts
  void account() const; // once solved: what contact took, to the meters of bodies and spheres

  // Calls f(body, vertex, Δu [m/s]) for each vertex that it has changed.
  template <class F> void each_change(const F& f) const {
    for (std::size_t m = 0; m < moved_.size(); ++m)
      if (const Moved& mover = moved_[m]; mover.body)
        f(*mover.body, mover.vertex, Vec3(sweeps_.movers()[m].velocity - mover.start));
  }

  std::size_t touching() const; // contacts that took an impulse
  std::size_t bytes() const {
    return bytes_of(contacts_) + sweeps_.bytes() + bytes_of(start_) + bytes_of(moved_) + mover_bytes();
  }

private:
  struct Moved {             // a mover of the sweeps, of the same index
    Vec3 start;              // [m/s], without contact
    Vec3 position;           // [m], at the end of the step without contact
    const ContactBody* body; // null: a sphere
    Sphere* sphere;
    Slot vertex;
  };
  using Row = ContactSweeps::Row;
  std::uint32_t mover_of(const ContactBody& body, Slot vertex);
  std::uint32_t mover_of(Sphere& sphere);
  std::uint32_t add_mover(const Moved& mover, const Vec3& inverse_mass);
  void gather(Row& row, const ContactSide& side, double sign);
  void gather(double step);
  double least_rebound(std::size_t contact) const;
  void push(double step);
  void make_no_energy();
  void write_back(double step);
  std::size_t mover_bytes() const;

  bool pushes_;
  std::vector<ContactConstraint> contacts_;
  ContactSweeps sweeps_;    // its rows are those of the contacts, of the same index
  std::vector<Vec3> start_; // [m/s], one per contact: u' without contact
  std::vector<Moved> moved_;
  std::vector<std::vector<std::uint32_t>> mover_of_; // scratch, per body one per vertex slot; none: no mover
};

} // namespace rend
