#include "sim/scene/step_cause.h"

#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rend {
namespace {

constexpr double matters = 2; // the gain from which something other than stiffness is the cause

// Springs and hinges have a damping of their own, elements one that all elements of the body share.
bool is_of_elements(const Interaction& interaction) {
  return interaction.law->damping_value() < 0;
}

// One parameter of a preset that damps: of all kinds of elements, or of one kind of springs.
struct Damping {
  std::string words;         // "`damping` of <stretch>"
  double value = 0;          // in its unit
  std::string unit;          // " s"
  std::vector<double> share; // [N·s/m], one per corner slot: of CornerBounds::damping
};

// The bounds of one body, part by part.
class Parts {
public:
  Parts(const ElementSteps& steps, const Scheme& scheme) : steps_(&steps), scheme_(&scheme) {
    const Body& body = steps.body();
    whole_.stiffness.assign(body.map->cells(body.mass->orbit()).slots(), 0);
    whole_.damping = whole_.stiffness;
    for (const auto& interaction : body.interactions) add(*interaction);
  }

  // [s], of the body with this share of a damping.
  double step(const Damping& damping, double share) const {
    CornerBounds bounds = whole_;
    for (std::size_t c = 0; c < damping.share.size(); ++c)
      bounds.damping[c] = std::max(0.0, bounds.damping[c] - (1 - share) * damping.share[c]);
    return step(bounds);
  }
  double step_without_drag() const {
    const Body& body = steps_->body();
    const FrequencyBounds b = frequency_bounds(whole_, *body.map, *body.mass, nullptr);
    return scheme_->limit({b.omega_squared, b.damping_rate, 0});
  }
  double step_undamped() const {
    CornerBounds bounds = whole_;
    bounds.damping.assign(bounds.damping.size(), 0);
    return step(bounds);
  }
  // With this share of an interaction's stiffness, and of what elements damp in proportion to it.
  double step_with_stiffness(std::size_t interaction, double share) const {
    CornerBounds bounds = whole_;
    const CornerBounds& own = own_[interaction];
    const bool damps_alike = is_of_elements(*steps_->body().interactions[interaction]);
    for (std::size_t c = 0; c < bounds.stiffness.size(); ++c) {
      bounds.stiffness[c] = std::max(0.0, bounds.stiffness[c] - (1 - share) * own.stiffness[c]);
      if (damps_alike) bounds.damping[c] = std::max(0.0, bounds.damping[c] - (1 - share) * own.damping[c]);
    }
    return step(bounds);
  }

  const std::vector<Damping>& dampings() const { return dampings_; }
  // The interaction that adds most to the highest frequency.
  std::size_t stiffest() const {
    const Body& body = steps_->body();
    std::size_t corner = 0, most = 0;
    double highest = -1;
    for (std::size_t c = 0; c < whole_.stiffness.size(); ++c)
      if (const double m = (*body.mass)[static_cast<Slot>(c)]; m > 0 && whole_.stiffness[c] / m > highest) {
        highest = whole_.stiffness[c] / m;
        corner = c;
      }
    for (std::size_t n = 1; n < own_.size(); ++n)
      if (own_[n].stiffness[corner] > own_[most].stiffness[corner]) most = n;
    return most;
  }

private:
  double step(const CornerBounds& bounds) const {
    const Body& body = steps_->body();
    return steps_->step(*scheme_, frequency_bounds(bounds, *body.map, *body.mass, body.drag));
  }

  void add(const Interaction& interaction) {
    const std::array<const Interaction*, 1> one{&interaction};
    CornerBounds bounds = corner_bounds(*steps_->body().map, one, *steps_->body().mass);
    for (std::size_t c = 0; c < bounds.stiffness.size(); ++c) {
      whole_.stiffness[c] += bounds.stiffness[c];
      whole_.damping[c] += bounds.damping[c];
    }
    if (std::any_of(bounds.damping.begin(), bounds.damping.end(), [](double d) { return d > 0; }))
      add_damping(interaction, bounds);
    own_.push_back(std::move(bounds));
  }

  void add_damping(const Interaction& interaction, const CornerBounds& bounds) {
    Damping damping = parameter_of(interaction, bounds);
    const auto known = std::find_if(dampings_.begin(), dampings_.end(),
                                    [&](const Damping& other) { return other.words == damping.words; });
    if (known == dampings_.end()) {
      damping.share = bounds.damping;
      dampings_.push_back(std::move(damping));
    } else {
      for (std::size_t c = 0; c < known->share.size(); ++c) known->share[c] += bounds.damping[c];
    }
  }

  // Of springs and hinges each unit has its damping; elements of one body have one, in proportion to stiffness.
  Damping parameter_of(const Interaction& interaction, const CornerBounds& bounds) const {
    if (!is_of_elements(interaction)) {
      const int at = interaction.law->damping_value();
      const CellIndex& owners = steps_->body().map->cells(interaction.pattern.owner);
      double value = 0;
      for (Slot owner = 0; owner < owners.slots() && value == 0; ++owner)
        if (owners.alive(owner)) value = interaction.unit(owner, 0)[at];
      const char* unit = interaction.law->name() == "hinge" ? " N m s" : " N s/m";
      return {"`damping` of the springs '" + interaction.name + "'", value, unit, {}};
    }
    double ratio = 0;
    for (std::size_t c = 0; c < bounds.damping.size() && ratio == 0; ++c)
      if (bounds.stiffness[c] > 0) ratio = bounds.damping[c] / bounds.stiffness[c];
    return {"`damping-stiffness`", ratio, " s", {}};
  }

  const ElementSteps* steps_;
  const Scheme* scheme_;
  CornerBounds whole_;
  std::vector<CornerBounds> own_; // one per interaction
  std::vector<Damping> dampings_;
};

std::string times(double gain) {
  return gain < 10 ? fmt::format("{:.2g}", gain) : fmt::format("{:.0f}", gain);
}

// The largest number of one digit below `value`, or below a share of it, with which the step is at least 0.8 of
// that without this damping.
double lower_damping(const Parts& parts, const Damping& damping) {
  const double enough = 0.8 * parts.step(damping, 0);
  double unit = power(10, std::floor(logarithm(damping.value) / logarithm(10)));
  for (int decade = 0; decade < 12; ++decade, unit /= 10)
    for (const double digit : {9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0})
      if (const double value = digit * unit;
          value < damping.value && parts.step(damping, value / damping.value) >= enough)
        return value;
  return 0;
}

StepCause by_damping(const Parts& parts, double step) {
  const Damping* most = nullptr;
  double longest = matters * step;
  for (const Damping& damping : parts.dampings())
    if (const double without = parts.step(damping, 0); without >= longest && !(most && without == longest)) {
      longest = without;
      most = &damping;
    }
  if (!most) {
    const double gain = parts.step_undamped() / step;
    if (!(gain >= matters)) return {};
    return {.of = StepCause::Of::Damping,
            .gain = gain,
            .words =
                fmt::format("`damping` of its springs and elements together limits the step; without any it is "
                            "{} times longer",
                            times(gain))};
  }
  const double value = lower_damping(parts, *most), gain = parts.step(*most, value / most->value) / step;
  return {.of = StepCause::Of::Damping,
          .gain = gain,
          .words = fmt::format("{} of {:.3g}{} limits the step; with {:.3g}{} it is {} times longer",
                               most->words, most->value, most->unit, value, most->unit, times(gain))};
}

StepCause by_drag(const Parts& parts, double step) {
  const double gain = parts.step_without_drag() / step;
  if (!(gain >= matters)) return {};
  return {.of = StepCause::Of::Drag,
          .gain = gain,
          .words = "its drag (<viscosity>, `damping-mass`, wind) limits the step; without it " +
                   (std::isinf(gain) ? "nothing does" : fmt::format("it is {} times longer", times(gain)))};
}

StepCause by_stiffness(const Parts& parts, const Body& body, double step) {
  const std::size_t most = parts.stiffest();
  const Interaction& interaction = *body.interactions[most];
  const bool springs = !is_of_elements(interaction);
  const double gain = parts.step_with_stiffness(most, 0.25) / step;
  return {.of = StepCause::Of::Stiffness,
          .gain = gain,
          .words = fmt::format(
              "the stiffness of its {} limits the step; with a quarter of {} it is {} times longer, "
              "with four times the mass at least twice as long",
              springs ? "springs '" + interaction.name + "'" : "elements", springs ? "their k" : "`young`",
              times(gain))};
}

StepCause by_scheme(const ElementSteps& body, const Scheme& scheme, double step) {
  const Scheme& symplectic = *find_scheme("symplectic");
  const double other = body.least(symplectic);
  if (!(other >= matters * step) || std::isinf(other)) return {};
  return {.of = StepCause::Of::Scheme,
          .gain = other / step,
          .words =
              fmt::format("the integrator '{}' limits the step, since drag alone keeps it stable; with '{}' it "
                          "{}",
                          scheme.name, symplectic.name,
                          step > 0 ? fmt::format("is {} times longer", times(other / step))
                                   : fmt::format("is up to {:.3g} s", other))};
}

// All but stiffness.
StepCause unusual_cause_of_body(const ElementSteps& body, const Scheme& scheme, double step) {
  using Of = StepCause::Of;
  if (StepCause cause = by_scheme(body, scheme, step); cause.of != Of::Nothing) return cause;
  // first: what is flat limits the step through its damping, too
  if (const FewElements few = few_that_limit(body, scheme, step); few.gain >= matters)
    return {.of = Of::FewElements, .gain = few.gain, .words = few.words};
  if (body.least_undamped(scheme) >= matters * step) {
    const Parts parts(body, scheme);
    if (StepCause cause = by_damping(parts, step); cause.of != Of::Nothing) return cause;
    if (StepCause cause = by_drag(parts, step); cause.of != Of::Nothing) return cause;
  }
  return {};
}

const ElementSteps* limiting_body(const std::vector<ElementSteps>& bodies, const Scheme& scheme) {
  const ElementSteps* least = nullptr;
  double limit = std::numeric_limits<double>::infinity();
  for (const ElementSteps& each : bodies)
    if (const double step = each.least(scheme); step < limit) {
      limit = step;
      least = &each;
    }
  return least;
}

// Names the body, and says how many others would limit the step all the same.
StepCause of_scene(StepCause cause, const ElementSteps& body, const std::vector<ElementSteps>& bodies,
                   const Scheme& scheme) {
  cause.limit = body.least(scheme);
  const auto others = std::count_if(bodies.begin(), bodies.end(), [&](const ElementSteps& each) {
    return &each != &body && each.least(scheme) < cause.gain * cause.limit;
  });
  cause.words = fmt::format("body '{}': {}", body.body().name, cause.words);
  if (cause.of != StepCause::Of::Scheme && others > 0)
    cause.words += fmt::format(", if {} other bod{} that limit{} it too {} changed as well", others,
                               others == 1 ? "y" : "ies", others == 1 ? "s" : "", others == 1 ? "is" : "are");
  return cause;
}

} // namespace

StepCause unusual_cause_of_step(const std::vector<ElementSteps>& bodies, const Scheme& scheme) {
  const ElementSteps* body = limiting_body(bodies, scheme);
  if (!body) return {};
  StepCause cause = unusual_cause_of_body(*body, scheme, body->least(scheme));
  return cause.of == StepCause::Of::Nothing ? cause : of_scene(std::move(cause), *body, bodies, scheme);
}

StepCause cause_of_step(const std::vector<ElementSteps>& bodies, const Scheme& scheme) {
  const ElementSteps* body = limiting_body(bodies, scheme);
  if (!body) return {};
  StepCause cause = unusual_cause_of_step(bodies, scheme);
  if (cause.of != StepCause::Of::Nothing) return cause;
  cause = by_stiffness(Parts(*body, scheme), body->body(), body->least(scheme));
  return of_scene(std::move(cause), *body, bodies, scheme);
}

} // namespace rend
