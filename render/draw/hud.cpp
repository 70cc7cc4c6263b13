#include "render/draw/hud.h"

#ifdef REND_HUD
#include "sim/font/font.h"
#include "sim/base/check.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr ImU32 ink = IM_COL32(28, 32, 38, 255), faint = IM_COL32(28, 32, 38, 150);
constexpr ImU32 paper = IM_COL32(255, 255, 255, 168), hair = IM_COL32(28, 32, 38, 60);

// As fractions of the picture's height.
constexpr float title_size = 1 / 26.0f, text_size = 1 / 42.0f, hud_margin = 1 / 30.0f, padding = 1 / 60.0f;
constexpr float plot_width = 0.42f, plot_height = 0.17f, bar_width = 0.30f, bar_height = 1 / 50.0f;

ImU32 colour(const std::array<std::uint8_t, 3>& c) {
  return IM_COL32(c[0], c[1], c[2], 255);
}

// Latin with diacritics, Greek, punctuation and symbols of units.
const ImWchar glyphs[] = {0x20,   0xff,   0x131,  0x131,  0x391,  0x3c9, 0x2013,
                          0x2026, 0x207a, 0x207b, 0x2212, 0x2212, 0};

} // namespace

struct Hud::Context {
  Context(int width, int height);
  ~Context();

  float at(float share) const { return share * height_; }
  ImVec2 size_of(ImFont* font, const std::string& text) const {
    return font->CalcTextSizeA(font->FontSize, 1e9f, 0, text.c_str());
  }
  void write(ImFont* font, float x, float y, ImU32 ink_, const std::string& text) {
    list_->AddText(font, font->FontSize, {std::round(x), std::round(y)}, ink_, text.c_str());
  }
  void panel(float x, float y, float width, float height);
  void titles(const HudContent& content);
  void figures(const HudContent& content);
  float plot(const HudPlot& plot, float bottom); // returns the y of its panel's upper edge
  void curves(const HudPlot& plot, ImVec2 low, ImVec2 high);
  void names(const HudPlot& plot, float x, float y);
  float legend(const HudLegend& legend, float bottom); // likewise
  void line(const HudLine& line);

  float width_, height_; // [pixels]
  ImGuiContext* context_;
  ImFont *title_ = nullptr, *text_ = nullptr; // owned by the context
  ImDrawList* list_ = nullptr;                // of the current frame
};

Hud::Context::Context(int width, int height)
    : width_(static_cast<float>(width)), height_(static_cast<float>(height)), context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.DisplaySize = {width_, height_};
  io.DeltaTime = 1.0f / 60;
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = config.OversampleV = 2;
  const auto add = [&](std::span<const std::uint8_t> font, float share) {
    const float size = std::max(8.0f, std::round(at(share)));
    ImFont* made = io.Fonts->AddFontFromMemoryTTF(const_cast<std::uint8_t*>(font.data()),
                                                  static_cast<int>(font.size()), size, &config, glyphs);
    CHECK(made != nullptr);
    return made;
  };
  text_ = add(font_file(FontWeight::Regular), text_size);
  title_ = add(font_file(FontWeight::SemiBold), title_size);
  CHECK(ImGui_ImplOpenGL3_Init("#version 330 core"));
}

Hud::Context::~Context() {
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

void Hud::Context::panel(float x, float y, float width, float height) {
  list_->AddRectFilled({x, y}, {x + width, y + height}, paper, at(padding) * 0.6f);
}

void Hud::Context::titles(const HudContent& content) {
  float y = at(hud_margin);
  if (!content.title.empty()) {
    write(title_, at(hud_margin), y, ink, content.title);
    y += title_->FontSize * 1.15f;
  }
  if (!content.subtitle.empty()) write(text_, at(hud_margin), y, faint, content.subtitle);
}

void Hud::Context::figures(const HudContent& content) {
  float y = at(hud_margin);
  for (const std::string& line : content.figures) {
    write(text_, width_ - at(hud_margin) - size_of(text_, line).x, y, ink, line);
    y += text_->FontSize * 1.3f;
  }
}

void Hud::Context::curves(const HudPlot& plot, ImVec2 low, ImVec2 high) {
  const float span = plot.high > plot.low ? plot.high - plot.low : 1;
  const float last = static_cast<float>(std::max(plot.frames - 1, 1L));
  const auto place = [&](std::size_t n, float value) {
    return ImVec2(low.x + (high.x - low.x) * static_cast<float>(n) / last,
                  low.y + (high.y - low.y) * std::clamp((value - plot.low) / span, 0.0f, 1.0f));
  };
  if (plot.low < 0 && plot.high > 0) list_->AddLine({low.x, place(0, 0).y}, {high.x, place(0, 0).y}, hair, 1);
  std::vector<ImVec2> points;
  for (const HudCurve& curve : plot.curves) {
    points.clear();
    for (std::size_t n = 0; n < curve.values.size(); ++n) points.push_back(place(n, curve.values[n]));
    const float thick = std::max(1.5f, at(1 / 360.0f));
    list_->AddPolyline(points.data(), static_cast<int>(points.size()), colour(curve.colour), 0, thick);
    if (!points.empty()) list_->AddCircleFilled(points.back(), 1.4f * thick, colour(curve.colour));
  }
}

// The names of the curves, beside markers in their colours.
void Hud::Context::names(const HudPlot& plot, float x, float y) {
  const float mark = text_->FontSize * 0.55f;
  for (const HudCurve& curve : plot.curves) {
    const float top = std::round(y + 0.5f * (text_->FontSize - mark));
    list_->AddRectFilled({x, top}, {x + mark, top + mark}, colour(curve.colour), 0.25f * mark);
    x += 1.5f * mark;
    write(text_, x, y, ink, curve.name);
    x += size_of(text_, curve.name).x + 2 * mark;
  }
}

float Hud::Context::plot(const HudPlot& plot, float bottom) {
  const float pad = at(padding), line = text_->FontSize * 1.35f;
  float across = at(plot_width), named = 0; // as wide as the names of the curves need
  for (const HudCurve& curve : plot.curves) named += size_of(text_, curve.name).x + 1.95f * text_->FontSize;
  named += size_of(text_, plot.low_text).x; // written after them
  across = std::max(across, named);
  const float width = across + 2 * pad, height = at(plot_height) + 2 * line + 2 * pad;
  const float left = at(hud_margin), top = bottom - height;
  panel(left, top, width, height);
  write(text_, left + pad, top + pad, ink, plot.title);
  const ImVec2 high(left + width - pad, top + pad + line), low(left + pad, high.y + at(plot_height));
  list_->AddLine({low.x, low.y}, {high.x, low.y}, hair, 1);
  list_->AddLine({low.x, high.y}, {high.x, high.y}, hair, 1);
  curves(plot, low, high);
  write(text_, high.x - size_of(text_, plot.high_text).x, top + pad, faint, plot.high_text);
  write(text_, high.x - size_of(text_, plot.low_text).x, low.y + 0.3f * line, faint, plot.low_text);
  names(plot, low.x, low.y + 0.3f * line);
  return top;
}

float Hud::Context::legend(const HudLegend& legend, float bottom) {
  const float pad = at(padding), line = text_->FontSize * 1.35f;
  const float words = size_of(text_, legend.low).x + text_->FontSize + size_of(text_, legend.high).x;
  // as wide as its text needs
  const float across = std::max({at(bar_width), size_of(text_, legend.title).x, words});
  const float width = across + 2 * pad, height = at(bar_height) + 2 * line + 2 * pad;
  const float left = width_ - at(hud_margin) - width, top = bottom - height;
  panel(left, top, width, height);
  write(text_, left + pad, top + pad, ink, legend.title);
  const float bar = top + pad + line, step = across / static_cast<float>(legend.colours.size());
  for (std::size_t n = 0; n < legend.colours.size(); ++n)
    list_->AddRectFilled({left + pad + step * static_cast<float>(n), bar},
                         {left + pad + step * static_cast<float>(n + 1), bar + at(bar_height)},
                         colour(legend.colours[n]));
  const float below = bar + at(bar_height) + 0.25f * line;
  write(text_, left + pad, below, faint, legend.low);
  write(text_, left + width - pad - size_of(text_, legend.high).x, below, faint, legend.high);
  return top;
}

// Its anchor is in the middle of its height.
void Hud::Context::line(const HudLine& line) {
  ImFont* font = line.large ? title_ : text_;
  const ImVec2 size = size_of(font, line.text);
  write(font, line.x * width_ - line.anchor * size.x, line.y * height_ - 0.5f * size.y, colour(line.colour),
        line.text);
}

bool hud_available() {
  return true;
}

Hud::Hud(int width, int height) : context_(std::make_unique<Context>(width, height)) {}
Hud::~Hud() = default;

void Hud::draw(const HudContent& content) {
  ImGui::SetCurrentContext(context_->context_);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  context_->list_ = ImGui::GetBackgroundDrawList();
  context_->titles(content);
  context_->figures(content);
  const float foot = context_->height_ - context_->at(hud_margin), gap = context_->at(padding);
  float bottom = foot;
  for (const HudPlot& plot : content.plots) bottom = context_->plot(plot, bottom) - gap;
  bottom = foot;
  for (const HudLegend& legend : content.legends) bottom = context_->legend(legend, bottom) - gap;
  for (const HudLine& line : content.lines) context_->line(line);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

} // namespace rend

#else

namespace rend {

struct Hud::Context {};

bool hud_available() {
  return false;
}

Hud::Hud(int, int) {}
Hud::~Hud() = default;
void Hud::draw(const HudContent&) {}

} // namespace rend

#endif
