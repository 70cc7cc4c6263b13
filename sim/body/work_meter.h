// The work done on a body from outside, measured step by step: entries of the energy account
// (sim/scene/energy_account.h).
//
// A step takes a vertex of mass m from x, v to x', v'. With Δx = x' − x, its load L, and the forces F at the
// start and F' at the end of the step, each of them internal force + load + weight, by the trapezoidal rule:
//
//   loads    Σ ½ (L + L')·Δx
//   drives   Σ Δ(½ m v²) − ½ (F + F')·Δx + m γ v'·Δx       along prescribed coordinates; γ: ambient drag
// Sums are of the order of the scheme's, two at most. An adaptive scheme is measured over the whole step. What
// contact takes, and what moves as prescribed does through it, is told by the answer to contacts
// (sim/contact/contact_answer.h) or by the solve (solved_contact.h).
//
//   changes  Δ of the potential in gravity, of matter that a change of the map takes away or adds, and where
//            gravity grows
//   remesh   Δ(K + U) where a law divides elements or moves vertices: mass goes to other vertices, and springs
//            that are divided or turn may be strained otherwise than before
//
// F' is known once the forces of the next step are: until then it is pending. A body on which nothing does work
// has no meter.
#pragma once

#include "sim/integrate/system.h"
#include "sim/outside/constraint.h"
#include "sim/outside/contact_work.h"
#include "sim/outside/load.h"

namespace rend {

struct Work {
  double loads = 0, drives = 0, changes = 0, remesh = 0; // [J]
  ContactWork contact;

  // [J]: what was done to the body. What contact takes is lost: it is no cause of anything.
  double sum() const { return loads + drives + contact.obstacles + changes + remesh; }
  double size() const; // [J], sum of magnitudes; without changes, which depend on the origin
  Work& operator+=(const Work& other);
};

// What a meter sees of its body. Arrays: one record per vertex slot, of the current state.
struct MeteredBody {
  const System& system;
  const Constraints& constraints;
  const Loads& loads;
  const Record *position, *velocity; // [m], [m/s]
  const Record* force;               // [N], internal
};

// Of internal forces, loads and weight F on free coordinates.
struct FreeMotion {
  double power = 0;          // [W], Σ F·v
  double squared_forces = 0; // [N²/kg], Σ F²/m
};
FreeMotion free_motion(const MeteredBody& body, double time);

class WorkMeter {
public:
  explicit WorkMeter(std::size_t obstacles = 0) : touched_(obstacles) {} // World::obstacles(), if it meets them

  // The calls of a step, in this order. Forces and loads of the current state are evaluated; called again if
  // they were evaluated anew, after a change of the map.
  void settle(const MeteredBody& body);
  // Of `next` as it is accepted, after contact; `time` [s] at the end of the step.
  void measure(const MeteredBody& body, double time, const State& next);
  void contact(const ContactWork& work); // of the step
  void touch(std::size_t obstacle);      // in the step; by its number in the world

  void forget_vertices(); // what is listed is of vertices before a change of the map; nothing is pending
  void rebind() { listed_ = false; }                         // after a change of the map
  void change(double energy) { settled_.changes += energy; } // [J], potential that it or gravity added

  void remesh(double energy) { settled_.remesh += energy; } // [J]

  // Since the start. Of `body`, forces and loads are those of the current state; without it, those of the state
  // before stand in for what is pending.
  Work work(const MeteredBody& body) const;
  Work work() const;

  bool touched(std::size_t obstacle) const { return obstacle < touched_.size() && touched_[obstacle] != 0; }

  void store(Archive& archive, std::size_t most); // of a body with at most `most` vertex slots
  std::size_t bytes() const;

private:
  struct Entry {
    Slot vertex = 0;
    Record force = {};   // [N], F or L at the start of the step
    Record pending = {}; // [m], ½ Δx: F'·pending [J] is still to be added
    void store(Archive& archive);
  };
  struct Entries {
    std::vector<Entry> loads, drives;
  };
  void list(const MeteredBody& body);
  // What is settled and what is pending: with F' or L' [N] of an entry.
  template <class Load, class Force> Work with_pending(const Load& load, const Force& force) const;

  bool listed_ = false; // loads and drives have the vertices of the current map
  Work settled_;
  std::vector<std::uint8_t> touched_; // one per obstacle: 1 if the body has touched it
  Entries entries_;
};

} // namespace rend
