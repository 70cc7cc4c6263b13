#include "render/picture/hud_writer.h"

#include "render/picture/colour.h"
#include "sim/base/archive.h"
#include "sim/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double nothing = 1e-15; // [J], round-off of sums that are zero; a smaller range gives no axis
constexpr std::array<const char*, 4> energy_names{"kinetic", "elastic", "gravity", "sum"};
// Distinguishable by hue and by lightness (Okabe and Ito 2008).
constexpr std::array<Colour, 4> colours{{{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {60, 60, 60}}};

} // namespace

template <> const Fields<HudSettings>& fields_of() {
  using S = HudSettings;
  static const Fields<S> fields{
      field(&S::show,
            words_of(
                "show", {"title", "time", "energy", "tears", "legend", "cost"},
                "what is written over the picture\ntitle: title and subtitle\ntime: the simulated "
                "time\nenergy: curves of the energies\ntears: the numbers of tears and fragments\nlegend: the "
                "scale of the bodies' colours\ncost: the run time of a step (it differs from run to run)")),
      field(&S::title, text("title", "title of the clip; default: the scene's name")),
      field(&S::subtitle, text("subtitle", "a line below the title"))};
  return fields;
}

HudWriter::HudWriter(const HudSettings& hud, const Scene& scene, long frames) : scene_(scene), frames_(frames) {
  const auto has = [&](const char* word) {
    return std::find(hud.show.begin(), hud.show.end(), word) != hud.show.end();
  };
  if (has("title")) {
    title_ = hud.title.value_or(scene.name());
    subtitle_ = hud.subtitle.value_or("");
  }
  time_ = has("time");
  energy_ = has("energy");
  tears_ = has("tears");
  legend_ = has("legend");
  cost_ = has("cost");
  gravity_at_start_ = energy_ ? scene.gravity_energy() : 0;
}

void HudWriter::observe() {
  if (!energy_) return;
  std::array<double, 4> now{scene_.kinetic_energy(), scene_.elastic_energy(),
                            scene_.gravity_energy() - gravity_at_start_, 0};
  now[3] = now[0] + now[1] + now[2];
  for (std::size_t n = 0; n < now.size(); ++n) {
    if (std::abs(now[n]) < nothing) now[n] = 0;
    energies_[n].push_back(static_cast<float>(now[n]));
    high_ = std::max(high_, rounded_up(now[n]));
    low_ = std::min(low_, -rounded_up(-now[n]));
  }
}

void HudWriter::store(Archive& archive) {
  const std::size_t most = energy_ ? static_cast<std::size_t>(frames_) : 0;
  for (auto& curve : energies_) archive.list(curve, most, "there are more energies than frames");
  archive(gravity_at_start_, low_, high_);
  if (!archive.reading()) return;
  for (const auto& curve : energies_)
    refuse_unless(curve.size() == energies_[0].size(), "energies are not of the same frames");
  refuse_unless(low_ <= 0 && high_ >= 0, "the scale of energies has no 0");
}

HudPlot HudWriter::energy_plot() const {
  HudPlot plot;
  plot.title = "energy";
  const bool falls = !scene_.world().gravity.isZero(0);
  for (std::size_t n = 0; n < energies_.size(); ++n)
    if (n != 2 || falls) plot.curves.push_back({energy_names[n], colours[n], energies_[n]});
  plot.low = static_cast<float>(low_);
  plot.high = static_cast<float>(high_);
  plot.low_text = in_units(low_, "J");
  plot.high_text = in_units(high_, "J");
  plot.frames = frames_;
  return plot;
}

HudContent HudWriter::content(std::vector<HudLegend> legends) const {
  HudContent out;
  out.title = title_;
  out.subtitle = subtitle_;
  if (time_) out.figures.push_back(fmt::format("{:.3f} s", scene_.time()));
  if (tears_) {
    const std::size_t tears = scene_.tears(), fragments = scene_.fragments();
    out.figures.push_back(fmt::format("{} tear{}", tears, tears == 1 ? "" : "s"));
    out.figures.push_back(fmt::format("{} fragment{}", fragments, fragments == 1 ? "" : "s"));
  }
  if (cost_ && scene_.steps_done() > 0) {
    const SceneSeconds s = scene_.seconds();
    const double sum = s.forces + s.criteria + s.change + s.rebind + s.integrate;
    out.figures.push_back(in_units(sum / static_cast<double>(scene_.steps_done()), "s") + " a step");
  }
  if (energy_) out.plots.push_back(energy_plot());
  if (legend_) out.legends = std::move(legends);
  return out;
}

} // namespace rend
