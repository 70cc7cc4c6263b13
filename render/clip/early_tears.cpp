#include "render/clip/early_tears.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {

std::optional<long> early_step(const Session& session, const TearLaw& law, const TearEvent& first) {
  constexpr double far = 10; // times the threshold
  const LawSettings& settings = law.settings();
  if (law.reached().value < far * settings.threshold) return {};
  const long most = std::clamp(session.clock().steps() / 100, 2L, 10L);
  const auto start = static_cast<long>(std::ceil(settings.from / session.scene().step_size() * (1 - 1e-12)));
  const long step = first.step - start + 1;
  return step <= most ? std::optional(step) : std::nullopt;
}

std::vector<std::string> notes_on_early_tears(const Session& session) {
  std::vector<std::string> notes;
  for (const auto& body : session.scene().bodies())
    for (std::size_t n = 0; n < body->tear_laws.size(); ++n) {
      const TearLaw& law = body->tear_laws[n];
      const LawSettings& settings = law.settings();
      const auto first = std::find_if(body->events.begin(), body->events.end(),
                                      [&](const TearEvent& one) { return one.law == static_cast<int>(n); });
      if (first == body->events.end()) continue;
      const auto step = early_step(session, law, *first);
      if (!step) continue;
      const std::string unit = settings.unit.empty() ? "" : " " + settings.unit;
      notes.push_back(fmt::format(
          "the law '{}' of body '{}' tears in its step {} already, and reaches {:.4g}{} with a "
          "threshold of {:.4g}{}: is that too low, or meant in another unit? rend run PRESET "
          "--reach tells what is reached",
          settings.criterion->name, body->name, *step, law.reached().value, unit, settings.threshold, unit));
    }
  return notes;
}

} // namespace rend
