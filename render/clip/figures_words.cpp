// The figures of a run as a summary to read.
#include "render/clip/figures.h"
#include "render/console/console.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

std::string guard_in_words(const GuardFigures& guard) {
  if (guard.rejected == 0)
    return guard.most_substeps == 1
               ? ""
               : fmt::format("  step       divided into {} for elements that laws have made\n",
                             guard.most_substeps);
  return fmt::format("  guard      {} steps were too large and redone as {} smaller ones, down to {:.3g} s\n",
                     guard.rejected, guard.redone, guard.smallest);
}

std::string triple(const Vec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z());
}

std::string probes_in_words(const std::vector<ProbeFigures>& probes) {
  std::string out;
  for (const auto& [name, reading] : probes) {
    out += fmt::format("{}{} ", out.empty() ? "  probes     " : "             ", name);
    if (!reading) {
      out += "its vertices have been deleted\n";
      continue;
    }
    out += "at " + triple(reading->position) + " m, displaced by " + triple(reading->displacement) + " m";
    if (reading->reaction) out += ", held by " + triple(*reading->reaction) + " N";
    out += "\n";
  }
  return out;
}

std::string place_in_words(const Reached& reached, const std::string& unit) {
  return fmt::format("{:.6g}{}{} at {:.6g} s near ({:.4g}, {:.4g}, {:.4g}) m", reached.value,
                     unit.empty() ? "" : " ", printable(unit), reached.time, reached.place.x(),
                     reached.place.y(), reached.place.z());
}

std::string reach_in_words(const std::vector<ReachFigures>& all) {
  if (all.empty()) return "";
  std::string out =
      "  reach      largest values where the criterion's default change is possible, without tearing. A\n"
      "             threshold slightly below such a value tears first at that time; one above it never tears\n";
  if (const long every = all.front().look_every; every > 1)
    out += fmt::format("             looked at every {} steps: what is higher between two looks is missed\n",
                       every);
  for (const ReachFigures& one : all)
    out += fmt::format("             {} of '{}': {}\n", printable(one.criterion), printable(one.body),
                       one.reached.value > 0 ? place_in_words(one.reached, one.unit)
                                             : "no value: its change was possible nowhere");
  return out;
}

// Where the criterion exceeded its threshold, and the change was not possible; the most frequent reason first.
std::string refusals_in_words(const Refusals& refusals) {
  std::vector<std::pair<std::string, std::uint64_t>> all(refusals.begin(), refusals.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string out;
  for (const auto& [reason, count] : all)
    out += fmt::format("               refused {}: {}\n", count == 1 ? "once" : fmt::format("{} times", count),
                       printable(reason));
  return out;
}

std::string time_in_words(const LawFigures& law) {
  return fmt::format("in its time, from {:.6g} s {}", law.from,
                     std::isfinite(law.until) ? fmt::format("to {:.6g} s", law.until) : "on");
}

// What the largest value of a law that never tore leaves out.
std::string limits_in_words(const LawFigures& law) {
  std::string out;
  if (law.never == NeverTore::No) return out;
  if (law.from > 0 || std::isfinite(law.until)) out += ", " + time_in_words(law);
  if (law.selects) out += ", among what it selects";
  if (law.is_relative) out += ", divided by the strength there";
  return out;
}

std::string value_in_words(const LawFigures& law) {
  if (law.never == NeverTore::NotInTime) return ": no step was " + time_in_words(law);
  const std::string limits = limits_in_words(law);
  if (law.never == NeverTore::NoValue) return "; no value above 0" + limits;
  const bool sampled = law.look_every > 1 && law.tears == 0;
  const std::string how = sampled          ? fmt::format(", sampled every {} steps: at least", law.look_every)
                          : limits.empty() ? ""
                                           : ":";
  return law.reached.value > 0 ? "; largest value" + limits + how + " " + place_in_words(law.reached, law.unit)
                               : "";
}

std::string laws_in_words(const std::vector<LawFigures>& laws) {
  std::string out;
  for (const LawFigures& law : laws) {
    out += fmt::format("             {} of '{}' above {:.6g} {}, {}: {}", printable(law.criterion),
                       printable(law.body), law.threshold, printable(law.unit), printable(law.change),
                       law.tears == 0   ? "never"
                       : law.tears == 1 ? "once"
                                        : fmt::format("{} times", law.tears));
    if (law.first) out += fmt::format(", first at {:.6g} s", *law.first);
    if (law.at_once)
      out += fmt::format(", in the law's step {}: is the threshold meant in {}, and not too low?", *law.at_once,
                         law.unit.empty() ? "this unit, a ratio" : printable(law.unit));
    out += value_in_words(law);
    out += "\n" + refusals_in_words(law.refusals);
  }
  return out;
}

// "21 fragments: one with 38 % of the mass, 6 above 1 %, 14 below".
std::string fragments_in_words(const FragmentFigures& fragments) {
  if (fragments.count == 1) return "1 fragment";
  std::string out = fmt::format("{} fragments", fragments.count);
  if (fragments.largest > 0) out += fmt::format(": one with {:.3g} % of the mass", 100 * fragments.largest);
  if (fragments.above > 0) out += fmt::format(", {} above 1 %", fragments.above);
  if (fragments.below > 0)
    out += fmt::format(", {} below{}", fragments.below, fragments.above > 0 ? "" : " 1 %");
  return out;
}

std::string answers_in_words(const std::vector<AnswerFigures>& answers) {
  std::string out;
  for (const AnswerFigures& a : answers) {
    out += fmt::format("{}{} {} at {:.6g} s is {:.9g}", out.empty() ? "  answers    " : "             ",
                       a.probe, a.quantity, a.at, a.value);
    if (!a.holds)
      out += ": its time was not reached";
    else if (!a.measured)
      out += ": not measured, because its vertices have been deleted";
    else
      out += fmt::format(", measured {:.9g}: {} of {:.2g} {} {:.2g}", *a.measured,
                         a.value != 0 ? "a relative error" : "an error", *a.error,
                         *a.holds ? "holds, within" : "DOES NOT HOLD, above", a.tolerance);
    if (!a.source.empty()) out += fmt::format(" ({})", printable(a.source));
    out += "\n";
  }
  return out;
}

std::string rows_in_words(const std::vector<std::pair<std::string, std::size_t>>& rows) {
  std::string out;
  for (const auto& [name, count] : rows) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, name);
  return "  rows       " + (out.empty() ? "none" : out + "; each is evaluated in every step") + "\n";
}

std::string schemes_in_words(const StateFigures& state) {
  std::string out;
  if (state.solver)
    out += fmt::format("  solver     {} Newton iterations, {} of conjugate gradients, {} factorisations\n",
                       state.solver->all.newton, state.solver->all.cg, state.solver->all.factorisations);
  if (state.adaptive)
    out += fmt::format("  adaptive   {} parts of steps; {} more were rejected because of their error\n",
                       state.adaptive->substeps, state.adaptive->rejected);
  return out;
}

} // namespace

std::string summary_of(const Figures& f) {
  const StateFigures& s = f.state;
  std::string out =
      fmt::format("{}: {} step{} of {:.6g} s by {}, {:.6g} s simulated in {}\n", printable(f.name), s.steps,
                  s.steps == 1 ? "" : "s", f.step, f.integrator, s.time, seconds_in_words(f.costs.total));
  if (f.stopped != Stopped::No) out += fmt::format("  stopped    {}\n", name_of(f.stopped));
  out += fmt::format("  cells      {} vertices, {} elements, {} darts\n", s.vertices, s.elements, s.darts);
  out += fmt::format("  tearing    {} tears, {}\n", s.tears, fragments_in_words(s.fragments));
  out += laws_in_words(s.laws) + reach_in_words(s.reach);
  out += fmt::format("  energy     {:.6g} J kinetic, {:.6g} J elastic, {:.6g} J potential in gravity\n",
                     s.energy.now.kinetic, s.energy.now.elastic, s.energy.now.gravity);
  out += fmt::format(
      "             {:.6g} J of work done on bodies{} by loads, drives, moving obstacles, and "
      "changes of mass, mesh or gravity;\n             {:.6g} J dissipated, {:.6g} J of it by contact, {:.3g} "
      "J unexplained\n",
      s.energy.now.work.sum(), s.falling ? " and falling spheres" : "", s.energy.dissipated,
      s.energy.now.work.contact.lost(), s.energy.balance);
  for (const auto& [name, added] : s.added_mass)
    out += fmt::format("  mass       {} is heavier by {:.4g} kg for larger steps, in {:.6g} kg of all bodies\n",
                       printable(name), added, s.mass);
  out += guard_in_words(s.guard);
  out += fmt::format("  forces     evaluated {} times\n", s.evaluations);
  out += rows_in_words(s.rows);
  out += schemes_in_words(s);
  out += fmt::format("  memory     {} for the scene; the program took {} at most\n",
                     bytes_in_words(f.bytes.of_scene()), bytes_in_words(f.bytes.peak));
  out += fmt::format("  state      {:016x}, a hash of positions, velocities and mesh\n", s.hash);
  if (f.exported)
    out += fmt::format("  exported   {} files ({}) in {}\n", f.exported->files,
                       bytes_in_words(f.exported->bytes), printable(f.exported->folder));
  return out + probes_in_words(s.probes) + answers_in_words(s.answers);
}

} // namespace rend
