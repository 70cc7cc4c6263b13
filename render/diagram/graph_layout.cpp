#include "render/diagram/graph_layout.h"

#include "sim/base/math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rend {
namespace {

using Arcs = std::vector<std::pair<std::size_t, std::size_t>>;

constexpr std::size_t most_nodes_of_trials = 60;
constexpr std::size_t trials = 24;

class Layout {
public:
  explicit Layout(const RuleGraph& graph) : n_(graph.nodes.size()) {
    for (int node = 0; node < graph.size(); ++node)
      for (int i = 0; i < 4; ++i) {
        const RuleLink& link = graph.link(node, i);
        if (link.kind == RuleLink::Kind::Arc && link.to > node)
          arcs_.emplace_back(static_cast<std::size_t>(node), static_cast<std::size_t>(link.to));
      }
    measure();
  }

  std::vector<Spot> run() {
    std::vector<Spot> best;
    double least = std::numeric_limits<double>::infinity();
    const std::size_t count =
        n_ > most_nodes_of_trials ? 1 : std::min(trials, std::max<std::size_t>(1, n_ - 1));
    for (std::size_t step = 1; step <= count; ++step) {
      std::vector<Spot> x = start(step);
      relax(x);
      const double cost = count == 1 ? 0 : stress(x) + faults(x);
      if (cost < least - 1e-9) {
        least = cost;
        best = std::move(x);
      }
    }
    turn(best);
    spread(best);
    return best;
  }

private:
  double wanted(std::size_t a, std::size_t b) const { return distance_[a * n_ + b]; }

  // How many arcs lie between two nodes; between parts of the graph that no arc joins, 1.5.
  void measure() {
    std::vector<std::vector<std::size_t>> neighbours(n_);
    for (const auto& [a, b] : arcs_) {
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
    distance_.assign(n_ * n_, 0.0);
    for (std::size_t from = 0; from < n_; ++from) {
      std::vector<std::size_t> queue{from};
      for (std::size_t at = 0; at < queue.size(); ++at)
        for (std::size_t next : neighbours[queue[at]])
          if (next != from && wanted(from, next) == 0) {
            distance_[from * n_ + next] = wanted(from, queue[at]) + 1;
            queue.push_back(next);
          }
      for (std::size_t to = 0; to < n_; ++to)
        if (to != from && wanted(from, to) == 0) distance_[from * n_ + to] = 1.5;
    }
  }

  // On a circle, the nodes `step` places apart in an order that reaches each.
  std::vector<Spot> start(std::size_t step) const {
    std::vector<Spot> x(n_);
    std::vector<bool> taken(n_);
    std::size_t place = 0;
    const double radius = 0.3 * static_cast<double>(n_) / 2 + 0.2;
    for (std::size_t node = 0; node < n_; ++node) {
      while (taken[place]) place = (place + 1) % n_;
      taken[place] = true;
      const double angle = 180 - 360.0 * static_cast<double>(place) / static_cast<double>(n_);
      x[node] = radius * Spot{cosine_of_degrees(angle), -sine_of_degrees(angle)};
      place = (place + step) % n_;
    }
    return x;
  }

  void relax(std::vector<Spot>& x) const {
    const std::size_t pairs = n_ * n_ + 1;
    const std::size_t rounds = std::clamp<std::size_t>(40'000'000 / pairs, 20, 800);
    for (std::size_t round = 0; round < rounds; ++round)
      for (std::size_t a = 0; a < n_; ++a) {
        Spot sum;
        double weights = 0;
        for (std::size_t b = 0; b < n_; ++b) {
          if (a == b) continue;
          const double d = wanted(a, b), w = 1 / (d * d), is = std::max(1e-9, distance(x[a], x[b]));
          sum = sum + w * (x[b] + d / is * (x[a] - x[b]));
          weights += w;
        }
        if (weights > 0) x[a] = 1 / weights * sum;
      }
  }

  double stress(const std::vector<Spot>& x) const {
    double sum = 0;
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const double miss = distance(x[a], x[b]) / wanted(a, b) - 1;
        sum += miss * miss;
      }
    return sum;
  }

  static double side(Spot a, Spot b, Spot c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

  // Arcs that cross, nodes that hide each other or an arc.
  double faults(const std::vector<Spot>& x) const {
    double sum = 0;
    for (std::size_t e = 0; e < arcs_.size(); ++e)
      for (std::size_t f = 0; f < e; ++f) {
        const auto [a, b] = arcs_[e];
        const auto [c, d] = arcs_[f];
        if (a == c || a == d || b == c || b == d) continue;
        if (side(x[a], x[b], x[c]) * side(x[a], x[b], x[d]) < 0 &&
            side(x[c], x[d], x[a]) * side(x[c], x[d], x[b]) < 0)
          sum += 1;
      }
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = 0; b < a; ++b) sum += distance(x[a], x[b]) < 0.55 ? 3 : 0;
    for (const auto& [a, b] : arcs_)
      for (std::size_t c = 0; c < n_; ++c)
        if (c != a && c != b && is_on(x[a], x[b], x[c])) sum += 2;
    return sum;
  }

  static bool is_on(Spot a, Spot b, Spot c) {
    const double length = distance(a, b);
    if (length == 0) return false;
    const double t = ((c.x - a.x) * (b.x - a.x) + (c.y - a.y) * (b.y - a.y)) / (length * length);
    return t > 0 && t < 1 && std::abs(side(a, b, c)) / length < 0.3;
  }

  // The axis of the largest spread lies horizontally; the first node is to the left, and not below the middle.
  void turn(std::vector<Spot>& x) const {
    if (n_ < 2) return;
    Spot middle;
    for (const Spot& at : x) middle = middle + 1.0 / static_cast<double>(n_) * at;
    double xx = 0, xy = 0, yy = 0;
    for (Spot& at : x) {
      at = at - middle;
      xx += at.x * at.x;
      xy += at.x * at.y;
      yy += at.y * at.y;
    }
    const bool round = (xx - yy) * (xx - yy) + 4 * xy * xy < 1e-4 * (xx + yy) * (xx + yy);
    const double angle = round ? 0 : 0.5 * arc_tangent(2 * xy, xx - yy);
    const double c = cosine(angle), s = sine(angle);
    for (Spot& at : x) at = {c * at.x + s * at.y, c * at.y - s * at.x};
    const Spot flip{x[0].x > 1e-6 ? -1.0 : 1.0, x[0].y > 1e-6 ? -1.0 : 1.0};
    for (Spot& at : x) at = {flip.x * at.x, flip.y * at.y};
  }

  // Larger, where two nodes would touch.
  void spread(std::vector<Spot>& x) const {
    double least = 1;
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = 0; b < a; ++b) least = std::min(least, distance(x[a], x[b]));
    const double scale = std::min(1.7, 0.72 / std::max(1e-3, least));
    if (scale > 1)
      for (Spot& at : x) at = scale * at;
  }

  std::size_t n_;
  Arcs arcs_;
  std::vector<double> distance_; // wanted, [node][node]
};

} // namespace

std::vector<Spot> lay_out(const RuleGraph& graph) {
  return graph.nodes.empty() ? std::vector<Spot>() : Layout(graph).run();
}

} // namespace rend
