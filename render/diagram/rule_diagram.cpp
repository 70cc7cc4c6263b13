#include "render/diagram/rule_diagram.h"

#include "render/diagram/diagram_parts.h"
#include "render/diagram/graph_layout.h"
#include "render/diagram/rule_colours.h"
#include "sim/base/math.h"

#include <algorithm>

namespace rend {
namespace {

using Kind = RuleLink::Kind;

using diagram::faint, diagram::text_ink;

constexpr double arc = 82, radius = 21, loop = 9, graph_margin = 44;
constexpr unsigned kept = 0xffffff, created = 0xd9f0d3, removed = 0xf6d5d0;

std::string text_of_label(const RuleNode& node) {
  std::string out;
  for (int link : node.label) out += (out.empty() ? "" : ",") + (link < 0 ? "_" : std::to_string(link));
  return out.empty() ? out : "<" + out + ">";
}

class GraphDiagram {
public:
  GraphDiagram(const RuleGraph& graph, const RuleGraph& other, RuleSide side)
      : graph_(graph), other_(other), side_(side), at_(lay_out(graph)) {}

  Drawing run() {
    place();
    for (int n = 0; n < graph_.size(); ++n)
      for (int i = 0; i < 4; ++i)
        if (graph_.link(n, i).kind == Kind::Arc && graph_.link(n, i).to > n) line(n, graph_.link(n, i).to, i);
    for (int n = 0; n < graph_.size(); ++n) loops(n);
    for (int n = 0; n < graph_.size(); ++n) node(n);
    if (at_.empty())
      drawing_.parts.push_back(DrawnText{{drawing_.width / 2, drawing_.height / 2 + 5},
                                         side_ == RuleSide::Left ? "nothing is matched" : "nothing is left",
                                         12,
                                         faint,
                                         DrawnText::Align::Middle});
    return std::move(drawing_);
  }

private:
  Spot at(int node) const { return at_[static_cast<std::size_t>(node)]; }

  void place() {
    Spot low, high;
    for (std::size_t n = 0; n < at_.size(); ++n) {
      at_[n] = arc * at_[n];
      low = n == 0 ? at_[n] : Spot{std::min(low.x, at_[n].x), std::min(low.y, at_[n].y)};
      high = n == 0 ? at_[n] : Spot{std::max(high.x, at_[n].x), std::max(high.y, at_[n].y)};
    }
    for (Spot& each : at_) each = each - low + Spot{graph_margin, graph_margin};
    drawing_.width = std::max(140.0, high.x - low.x + 2 * graph_margin);
    drawing_.height = high.y - low.y + 2 * graph_margin;
    const double shift = (drawing_.width - (high.x - low.x) - 2 * graph_margin) / 2;
    for (Spot& each : at_) each.x += shift;
  }

  void line(int a, int b, int link) {
    drawing_.parts.push_back(DrawnLine{at(a), at(b), 2, ink_of_link(link), dashes_of_link(link)});
    // Its number: in the middle of what is seen of it.
    const Spot middle = 0.5 * (at(a) + at(b));
    drawing_.parts.push_back(DrawnCircle{middle, 6.5, {0xffffff}, no_ink, 0});
    drawing_.parts.push_back(DrawnText{{middle.x, middle.y + 3.5},
                                       std::to_string(link),
                                       10,
                                       ink_of_link(link),
                                       DrawnText::Align::Middle,
                                       true});
  }

  // Free links are drawn where a node has most room: in the middle of the widest angles between what is there.
  void loops(int n) {
    constexpr int directions = 24;
    std::vector<Spot> taken;
    for (int i = 0; i < 4; ++i)
      if (graph_.link(n, i).kind == Kind::Arc) taken.push_back(direction(at(n), at(graph_.link(n, i).to)));
    for (int i = 0; i < 4; ++i) {
      if (graph_.link(n, i).kind != Kind::Loop) continue;
      Spot best{0, -1};
      double widest = -1;
      for (int k = 0; k < directions; ++k) {
        const double angle = -90 + 360.0 * k / directions;
        const Spot here{cosine_of_degrees(angle), sine_of_degrees(angle)};
        double nearest = 4;
        for (Spot other : taken) nearest = std::min(nearest, distance(here, other));
        nearest = std::min(nearest, room(n, here));
        if (nearest > widest + 1e-6) {
          widest = nearest;
          best = here;
        }
      }
      taken.push_back(best);
      const Spot centre = at(n) + (radius + loop - 4) * best;
      drawing_.parts.push_back(DrawnCircle{centre, loop, no_ink, ink_of_link(i), 2});
      drawing_.parts.push_back(DrawnText{{centre.x + 1.5 * best.x, centre.y + 1.5 * best.y + 3.5},
                                         std::to_string(i),
                                         9,
                                         ink_of_link(i),
                                         DrawnText::Align::Middle,
                                         true});
    }
  }

  static Spot direction(Spot from, Spot to) {
    const double length = std::max(1e-9, distance(from, to));
    return 1 / length * (to - from);
  }

  // From the place of a loop to the next node, in radii.
  double room(int n, Spot towards) const {
    const Spot place = at(n) + (radius + loop) * towards;
    double nearest = 4;
    for (int m = 0; m < graph_.size(); ++m)
      if (m != n) nearest = std::min(nearest, (distance(place, at(m)) - radius) / radius);
    return nearest;
  }

  void node(int n) {
    const RuleNode& node = graph_[n];
    const bool both = other_.find(node.name) >= 0;
    const unsigned fill = both ? kept : side_ == RuleSide::Left ? removed : created;
    drawing_.parts.push_back(DrawnCircle{at(n), radius, {fill}, {0x333333}, 1.3});
    if (node.hook) drawing_.parts.push_back(DrawnCircle{at(n), radius - 3, no_ink, {0x333333}, 1.3});
    const std::string label = text_of_label(node);
    const double down = label.empty() ? 4 : -1;
    const std::string name = node.name.size() > 7 ? node.name.substr(0, 6) + "…" : node.name;
    drawing_.parts.push_back(DrawnText{{at(n).x, at(n).y + down},
                                       name,
                                       name.size() > 4 ? 8.0 : 12.0,
                                       text_ink,
                                       DrawnText::Align::Middle,
                                       true});
    if (!label.empty())
      drawing_.parts.push_back(DrawnText{{at(n).x, at(n).y + 10},
                                         label,
                                         node.label.size() > 3 ? 7.0 : 8.0,
                                         text_ink,
                                         DrawnText::Align::Middle});
  }

  const RuleGraph &graph_, &other_;
  RuleSide side_;
  std::vector<Spot> at_; // of each node
  Drawing drawing_;
};

void add_key(Drawing& page, double y) {
  double x = 20;
  const auto word = [&](const std::string& text) {
    page.parts.push_back(DrawnText{{x, y + 4}, text, 11, faint});
    x += rough_width(text, 11) + 16;
  };
  for (int link = 0; link < 4; ++link) {
    page.parts.push_back(DrawnLine{{x, y}, {x + 26, y}, 2, ink_of_link(link), dashes_of_link(link)});
    x += 31;
    word("α" + std::to_string(link));
  }
  for (const auto& [fill, what] : {std::pair{created, "created"}, std::pair{removed, "removed"}}) {
    page.parts.push_back(DrawnCircle{{x + 7, y}, 7, {fill}, {0x333333}, 1});
    x += 19;
    word(what);
  }
  page.parts.push_back(DrawnCircle{{x + 7, y}, 7, no_ink, {0x333333}, 1});
  page.parts.push_back(DrawnCircle{{x + 7, y}, 4.5, no_ink, {0x333333}, 1});
  x += 19;
  word("hook");
}

} // namespace

Drawing diagram_of(const RuleGraph& graph, const RuleGraph& other, RuleSide side) {
  return GraphDiagram(graph, other, side).run();
}

Drawing diagram_of(const Rule& rule, const RuleShown& shown) {
  const std::vector<Drawing> graphs{diagram_of(rule.left, rule.right, RuleSide::Left),
                                    diagram_of(rule.right, rule.left, RuleSide::Right)};
  Drawing page;
  page.width = std::max({graphs[0].width + graphs[1].width + 100, 2 * diagram::map_side + 100,
                         diagram::width_of_heading(rule.name())});
  double y = diagram::add_heading(page, rule.name(), rule.settings.about);
  const double height = std::max(graphs[0].height, graphs[1].height);
  diagram::add_row(page, graphs, y - 8, height);
  y += height;
  if (shown.sample) {
    y = diagram::add_maps(page, {shown.before.get(), shown.after.get()}, shown.hooks, y);
    diagram::add_caption(page, "on " + shown.sample->what + (shown.hooks.empty() ? "" : "; orange: the hook"),
                         y);
    y += 14;
  }
  add_key(page, y + 14);
  page.height = y + 32;
  return page;
}

} // namespace rend
