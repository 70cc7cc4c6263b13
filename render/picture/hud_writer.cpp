#include "render/picture/hud_writer.h"

#include "render/picture/colour.h"
#include "sim/base/archive.h"
#include "sim/base/check.h"
#include "sim/base/units.h"
#include "sim/base/wording.h"

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

const std::vector<std::pair<std::string, std::string>>& hud_placeholders() {
  static const std::vector<std::pair<std::string, std::string>> all{
      {"time", "the simulated time"},
      {"step", "the number of steps so far"},
      {"frame", "the number of the frame"},
      {"speed", "seconds of simulation in a second of the clip"},
      {"tears", "the number of tears"},
      {"fragments", "the number of fragments"},
      {"kinetic", "the kinetic energy"},
      {"elastic", "the elastic energy"},
      {"title", "the title"}};
  return all;
}

namespace {

std::string placeholders_in_words() {
  std::string out;
  for (const auto& [word, what] : hud_placeholders())
    out += fmt::format("{}{{{}}}, {}", out.empty() ? "" : "; ", word, what);
  return out;
}

// Calls f(text) for what is outside of braces, g(word) for what is inside. False: braces are not closed.
template <class F, class G> bool each_part(std::string_view text, F&& f, G&& g) {
  while (!text.empty()) {
    const std::size_t open = std::min(text.find('{'), text.size());
    f(text.substr(0, open));
    text.remove_prefix(open);
    if (text.empty()) return true;
    const std::size_t close = text.find('}');
    if (close == std::string_view::npos) return false;
    g(std::string(text.substr(1, close - 1)));
    text.remove_prefix(close + 1);
  }
  return true;
}

} // namespace

template <> const Fields<HudText>& fields_of() {
  using S = HudText;
  static const Fields<S> fields{
      field(&S::at, numbers("at", 2, "",
                            "place of the text, in shares of the picture's width and height, from its "
                            "upper left corner")
                        .at_least(0)
                        .at_most(1)),
      field(&S::text,
            text("text", "the text; words in braces are replaced in every frame: " + placeholders_in_words())
                .is_required()),
      field(&S::align, word("align", {"left", "centre", "right"}, "which end of the text is at its place")),
      field(&S::size, word("size", {"small", "large"},
                           "size of its letters\nsmall: as the figures\nlarge: as the title")),
      colour_field(&S::colour, text("colour", "#rrggbb"))};
  return fields;
}

void check_text(const HudText& text) {
  std::vector<std::string> words;
  for (const auto& [word, what] : hud_placeholders()) words.push_back(word);
  const auto check = [&](const std::string& word) {
    if (std::find(words.begin(), words.end(), word) == words.end())
      text.source.fail("text", fmt::format("nothing stands for {{{}}} in a text", word),
                       suggestion(word, words, "words in braces are"));
  };
  if (!each_part(
          text.text, [](std::string_view) {}, check))
    text.source.fail("text", "a brace is opened and not closed: " + in_quotes(text.text), "write it as {time}");
}

template <> const Fields<HudSettings>& fields_of() {
  using S = HudSettings;
  static const Fields<S> fields{
      field(
          &S::show,
          words_of(
              "show", {"title", "time", "energy", "tears", "legend", "cost", "none"},
              "what is written over the picture\ntitle: title and subtitle\ntime: the simulated "
              "time\nenergy: curves of the energies\ntears: the numbers of tears and fragments\nlegend: the "
              "scale of the bodies' colours\ncost: the run time of a step (it differs from run to run)\nnone: "
              "nothing but what <text> says")),
      field(&S::title, text("title", "title of the clip; default: the scene's name")),
      field(&S::subtitle, text("subtitle", "a line below the title"))};
  return fields;
}

HudWriter::HudWriter(const HudSettings& hud, const Scene& scene, long frames) : scene_(scene), frames_(frames) {
  for (const HudText& text : hud.texts) check_text(text);
  const auto has = [&](const char* word) {
    return std::find(hud.show.begin(), hud.show.end(), word) != hud.show.end();
  };
  name_ = hud.title.value_or(scene.name());
  if (has("title")) {
    title_ = name_;
    subtitle_ = hud.subtitle.value_or("");
  }
  texts_ = hud.texts;
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

std::string HudWriter::value_of(const std::string& placeholder, long frame, double speed) const {
  if (placeholder == "time") return fmt::format("{:.3f} s", scene_.time());
  if (placeholder == "step") return fmt::format("{}", scene_.steps_done());
  if (placeholder == "frame") return fmt::format("{}", frame);
  if (placeholder == "speed") return fmt::format("{:.3g}", speed);
  if (placeholder == "tears") return fmt::format("{}", scene_.tears());
  if (placeholder == "fragments") return fmt::format("{}", scene_.fragments());
  if (placeholder == "kinetic") return in_units(scene_.kinetic_energy(), "J");
  if (placeholder == "elastic") return in_units(scene_.elastic_energy(), "J");
  CHECK_NOTE(placeholder == "title", placeholder);
  return name_;
}

HudContent HudWriter::content(std::vector<HudLegend> legends, long frame, double speed) const {
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
  for (const HudText& text : texts_) {
    HudLine line{.x = static_cast<float>(text.at[0]),
                 .y = static_cast<float>(text.at[1]),
                 .anchor = 0.5f * static_cast<float>(text.align),
                 .large = text.size == HudText::Size::Large,
                 .colour = text.colour};
    each_part(
        text.text, [&](std::string_view part) { line.text += part; },
        [&](const std::string& word) { line.text += value_of(word, frame, speed); });
    out.lines.push_back(std::move(line));
  }
  return out;
}

} // namespace rend
