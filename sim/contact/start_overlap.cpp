#include "sim/contact/start_overlap.h"

#include "sim/contact/starting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr int rounds = 64;       // of moving what overlaps
constexpr std::size_t named = 4; // overlaps in a message

using Bounds = Eigen::AlignedBox3d;
using Edge = std::pair<Slot, Slot>; // the smaller slot first

// Takes the deeper of two.
void deepen(std::optional<StartOverlap>& worst, double depth, double least, const Vec3& at, const Vec3& way) {
  if (!(depth > least) || (worst && worst->depth >= depth)) return;
  worst.emplace();
  worst->depth = depth;
  worst->at = at;
  worst->way = way;
}

// Whether enough of a point of a triangle can be moved along n: as ContactPoint::held().
bool moves(const Starting& body, const ContactFaces::Triangle& triangle, const Weights& w, const Vec3& n) {
  for (std::size_t k = 0; k < 3; ++k)
    if (w[k] >= 0.25 && body.free_along(triangle.vertex[k], n)) return true;
  return false;
}

std::optional<StartOverlap> in_floor(const Starting& body, double z) {
  std::optional<StartOverlap> worst;
  for (Slot v : body.alive)
    if (body.free_along(v, Vec3::UnitZ()))
      deepen(worst, z - body.at(v).z(), body.least(), body.at(v), Vec3::UnitZ());
  return worst;
}

struct Depth {
  double depth = 0; // [m], negative: outside
  Vec3 way = Vec3::UnitZ();
};

// Obstacles, with the interface that in_obstacle() uses.
struct StartingSphere {
  const Sphere* sphere;
  Vec3 centre() const { return sphere->centre; }
  double reach() const { return sphere->radius; }
  Bounds bounds() const { return {centre() - Vec3::Constant(reach()), centre() + Vec3::Constant(reach())}; }
  Depth depth(const Vec3& x) const {
    const Vec3 from = x - centre();
    const double distance = from.norm();
    return {reach() - distance, distance > 0 ? Vec3(from / distance) : Vec3(Vec3::UnitZ())};
  }
  Weights deepest(const TriangleCorners& x) const { return nearest_in_triangle(x, centre()); }
};

struct StartingBox {
  const Box* box;
  Pose pose = box->pose(0);
  Vec3 centre() const { return pose.of(box->middle()); }
  double reach() const { return 0.5 * (box->high - box->low).minCoeff(); }
  Bounds bounds() const {
    const Bounds still(box->low, box->high);
    Bounds around;
    for (int n = 0; n < 8; ++n) around.extend(pose.of(still.corner(static_cast<Bounds::CornerType>(n))));
    return around;
  }
  Depth depth(const Vec3& there) const {
    const Vec3 x = pose.back(there);
    Depth out{std::numeric_limits<double>::infinity(), Vec3::UnitZ()};
    for (int axis = 0; axis < 3; ++axis) {
      if (const double d = x[axis] - box->low[axis]; d < out.depth) out = {d, -Vec3::Unit(axis)};
      if (const double d = box->high[axis] - x[axis]; d < out.depth) out = {d, Vec3::Unit(axis)};
    }
    return {out.depth, pose.turn * out.way};
  }
  Weights deepest(const TriangleCorners& x) const {
    return deepest_in_box({pose.back(x[0]), pose.back(x[1]), pose.back(x[2])}, *box);
  }
};

// An obstacle that lies wholly in a solid meets none of its faces: its centre tells.
template <class Shape> std::optional<StartOverlap> in_obstacle(const Starting& body, const Shape& shape) {
  std::optional<StartOverlap> worst;
  if (!body.tree || !body.bounds.intersects(shape.bounds())) return worst;
  const auto look = [&](const Vec3& x, const auto& can_move) {
    const Depth d = shape.depth(x);
    if (d.depth > body.least() && can_move(d.way)) deepen(worst, d.depth, body.least(), x, d.way);
  };
  for (Slot v : body.alive) look(body.at(v), [&](const Vec3& n) { return body.free_along(v, n); });
  const auto& triangles = body.faces->triangles();
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const TriangleCorners& x = body.tree->corners(t);
    Bounds box(x[0]);
    if (!box.extend(x[1]).extend(x[2]).intersects(shape.bounds())) continue;
    const Weights w = shape.deepest(x);
    look(w[0] * x[0] + w[1] * x[1] + w[2] * x[2],
         [&](const Vec3& n) { return moves(body, triangles[t], w, n); });
  }
  if (!worst && body.tree->inside(shape.centre())) {
    const SurfaceTree::Nearest near = body.tree->nearest(shape.centre());
    if (moves(body, triangles[near.triangle], {1, 1, 1}, near.normal))
      deepen(worst, near.distance + shape.reach(), body.least(), shape.centre(), -near.normal);
  }
  return worst;
}

std::vector<Edge> edges_of(const ContactFaces& faces) {
  std::vector<Edge> edges;
  for (const ContactFaces::Triangle& t : faces.triangles())
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax({t.vertex[k], t.vertex[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Calls visit(u, v, from, to) for each edge of a whose box meets that of b.
template <class Visit> void for_edges_near(const Starting& a, const Starting& b, const Visit& visit) {
  std::vector<Edge> edges = edges_of(*a.faces);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [u, v] : edges) {
    const Vec3 from = a.at(u), to = a.at(v);
    Bounds box(from);
    if (box.extend(to).intersects(b.bounds)) visit(u, v, from, to);
  }
}

// The parts of the edges of a that lie in the solid b.
void edges_in_solid(const Starting& a, const Starting& b, double least, std::optional<StartOverlap>& worst) {
  for_edges_near(a, b, [&](Slot u, Slot v, const Vec3& from, const Vec3& to) {
    double before = 0;
    const auto look_until = [&](double share) {
      const Vec3 x = from + 0.5 * (before + share) * (to - from);
      if (share - before > 1e-12 && b.tree->inside(x)) {
        const SurfaceTree::Nearest near = b.tree->nearest(x);
        const ContactFaces::Triangle& there = b.faces->triangles()[near.triangle];
        const bool all_pinned = a.pinned(u) && a.pinned(v) && b.pinned(there);
        if (!all_pinned) deepen(worst, near.distance, least, x, near.normal);
      }
      before = share;
    };
    for (const SurfaceTree::Crossing& crossing : b.tree->crossings(from, to)) look_until(crossing.share);
    look_until(1);
  });
}

// The edges of a that go through the sheet b, but not at its border: there they only touch.
void edges_through_sheet(const Starting& a, const Starting& b, double least,
                         std::optional<StartOverlap>& worst) {
  const std::vector<Edge> sides = edges_of(*b.faces);
  const auto on_border = [&](const SurfaceTree::Crossing& crossing) {
    const auto& vertex = b.faces->triangles()[crossing.triangle].vertex;
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge side = std::minmax({vertex[(k + 1) % 3], vertex[(k + 2) % 3]});
      const auto [first, last] = std::equal_range(sides.begin(), sides.end(), side);
      if (crossing.weight[k] < 1e-9 && last - first == 1) return true;
    }
    return false;
  };
  for_edges_near(a, b, [&](Slot u, Slot v, const Vec3& from, const Vec3& to) {
    for (const SurfaceTree::Crossing& crossing : b.tree->crossings(from, to)) {
      if (on_border(crossing)) continue;
      const Vec3 n = b.tree->normal(crossing.triangle), x = from + crossing.share * (to - from);
      const double above = n.dot(from - x), below = n.dot(to - x);
      const bool short_above = std::abs(above) < std::abs(below);
      const Vec3 way = (short_above ? above : below) > 0 ? Vec3(-n) : n;
      if (a.pinned(u) && a.pinned(v) && b.pinned(b.faces->triangles()[crossing.triangle])) continue;
      deepen(worst, std::min(std::abs(above), std::abs(below)), least, x, way);
    }
  });
}

std::optional<StartOverlap> in_each_other(const Starting& a, const Starting& b) {
  std::optional<StartOverlap> worst;
  const double least = std::max(a.least(), b.least());
  if (!a.tree || !b.tree || !a.bounds.intersects(b.bounds)) return worst;
  if ((a.bounds.intersection(b.bounds).sizes().array() <= least).any() && a.solid() && b.solid()) return worst;
  const auto look = [&](const Starting& of, const Starting& in) {
    std::optional<StartOverlap> found;
    if (!in.solid()) {
      edges_through_sheet(of, in, least, found);
    } else {
      for (Slot v : of.alive) {
        if (!in.bounds.contains(of.at(v)) || !in.tree->inside(of.at(v))) continue;
        const SurfaceTree::Nearest near = in.tree->nearest(of.at(v));
        if (of.pinned(v) && in.pinned(in.faces->triangles()[near.triangle])) continue;
        deepen(found, near.distance, least, of.at(v), near.normal);
      }
      edges_in_solid(of, in, least, found);
    }
    return found;
  };
  worst = look(a, b);
  if (const auto other = look(b, a); other) deepen(worst, other->depth, least, other->at, -other->way);
  return worst;
}

using Startings = std::vector<std::unique_ptr<Starting>>;

// `all`: the bodies; `meshes`: the obstacles.
std::vector<StartOverlap> overlaps_of(const World& world, const Startings& all, const Startings& meshes) {
  std::vector<StartOverlap> found;
  const auto keep = [&](const Starting& body, std::optional<StartOverlap> overlap, const std::string& with) {
    if (!overlap) return;
    overlap->body = body.number;
    overlap->with = with;
    found.push_back(*overlap);
  };
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Starting& body = *all[n];
    if (body.body->floor_contact && world.floor) keep(body, in_floor(body, world.floor->z), "the floor");
    const ContactTable& table = body.body->contact_table;
    const auto keep_obstacle = [&](std::size_t number, const auto& shape) {
      if (!table.excludes_obstacle(number)) keep(body, in_obstacle(body, shape), world.called(number));
    };
    for (std::size_t s = 0; s < world.spheres.size() && body.settings().obstacles; ++s)
      keep_obstacle(world.number_of_sphere(s), StartingSphere{&world.spheres[s]});
    for (std::size_t b = 0; b < world.boxes.size() && body.settings().obstacles; ++b)
      keep_obstacle(world.number_of_box(b), StartingBox{&world.boxes[b]});
    for (const auto& mesh : meshes)
      if (body.settings().obstacles && !table.excludes_obstacle(mesh->number))
        keep(body, in_each_other(body, *mesh), world.called(mesh->number));
    for (std::size_t m = n + 1; m < all.size() && body.settings().fragments; ++m) {
      if (!all[m]->settings().fragments || table.excludes_body(all[m]->number)) continue;
      auto overlap = in_each_other(body, *all[m]);
      if (overlap) overlap->other = all[m]->number;
      keep(body, overlap, fmt::format("body '{}'", all[m]->body->name));
    }
  }
  return found;
}

Startings starting(const std::vector<std::unique_ptr<Body>>& bodies) {
  Startings all;
  for (std::size_t n = 0; n < bodies.size(); ++n)
    if (bodies[n]->contact) all.push_back(std::make_unique<Starting>(*bodies[n], n));
  return all;
}

Startings meshes_of(const World& world) {
  Startings all;
  for (std::size_t m = 0; m < world.meshes.size(); ++m)
    all.push_back(std::make_unique<Starting>(world.meshes[m], world.number_of_mesh(m)));
  return all;
}

std::string words_of(const StartOverlap& overlap, const std::string& name) {
  return fmt::format("body '{}' starts {:.3g} m inside {}, at ({:.4g}, {:.4g}, {:.4g}) m", name, overlap.depth,
                     overlap.with, overlap.at.x(), overlap.at.y(), overlap.at.z());
}

[[noreturn]] void refuse(const std::vector<StartOverlap>& overlaps,
                         const std::vector<std::unique_ptr<Body>>& bodies, const std::string& hint) {
  std::string what;
  for (std::size_t n = 0; n < std::min(named, overlaps.size()); ++n)
    what += (n > 0 ? "; " : "") + words_of(overlaps[n], bodies[overlaps[n].body]->name);
  if (overlaps.size() > named) what += fmt::format("; and {} more", overlaps.size() - named);
  bodies[overlaps.front().body]->contact->source.fail("", what, hint);
}

double mass_of(const Starting& body) {
  return total_mass(*body.body->map, *body.body->mass);
}

// Moves what may be moved out of the worst one, and says whether anything was.
bool push_out(const StartOverlap& overlap, Starting& body, Starting* other) {
  const auto may = [](const Starting& one) { return one.settings().push() && one.movable; };
  const bool a = may(body), b = other && may(*other);
  if (!a && !b) return false;
  const double kept =
      other ? 0.5 * (body.settings().thickness + other->settings().thickness) : body.settings().thickness;
  const Vec3 whole = (overlap.depth + kept) * overlap.way;
  const double of_a = a && b ? mass_of(*other) / (mass_of(body) + mass_of(*other)) : a ? 1 : 0;
  if (a) body.move(of_a * whole);
  if (b) other->move((of_a - 1) * whole);
  for (Starting* one : {a ? &body : nullptr, b ? other : nullptr}) {
    if (!one) continue;
    const std::string what = one == &body ? overlap.with : fmt::format("body '{}'", body.body->name);
    if (one->out_of.find(what) == std::string::npos) one->out_of += (one->out_of.empty() ? "" : ", ") + what;
  }
  return true;
}

} // namespace

std::vector<StartOverlap> start_overlaps(const World& world, const std::vector<std::unique_ptr<Body>>& bodies) {
  return overlaps_of(world, starting(bodies), meshes_of(world));
}

void clear_start(const World& world, const std::vector<std::unique_ptr<Body>>& bodies) {
  const auto all = starting(bodies), meshes = meshes_of(world);
  const auto starting_of = [&](std::size_t number) {
    return std::find_if(all.begin(), all.end(), [&](const auto& one) { return one->number == number; })->get();
  };
  std::vector<StartOverlap> overlaps = overlaps_of(world, all, meshes);
  const auto asked = [&](const StartOverlap& overlap) {
    return bodies[overlap.body]->contact->push() || (overlap.other && bodies[*overlap.other]->contact->push());
  };
  if (std::any_of(overlaps.begin(), overlaps.end(), [&](const auto& each) { return !asked(each); })) {
    std::erase_if(overlaps, asked);
    refuse(
        overlaps, bodies,
        "move it by translate of its <place>, or write <contact overlap=\"push\">: it is then moved out before "
        "the first step");
  }
  for (int round = 0; round < rounds && !overlaps.empty(); ++round) {
    const StartOverlap worst = *std::max_element(
        overlaps.begin(), overlaps.end(), [](const auto& a, const auto& b) { return a.depth < b.depth; });
    if (!push_out(worst, *starting_of(worst.body), worst.other ? starting_of(*worst.other) : nullptr)) break;
    overlaps = overlaps_of(world, all, meshes);
  }
  if (!overlaps.empty())
    refuse(
        overlaps, bodies,
        "overlap=\"push\" found no way out: the body has vertices that <fix> or <drive> hold, or is enclosed; "
        "place it elsewhere");
  for (const auto& one : all)
    if (!one->moved.isZero(0))
      one->body->notes.push_back(fmt::format("contact: it started inside {}, and was moved by ({:.4g}, {:.4g}, "
                                             "{:.4g}) m out of it before the first step",
                                             one->out_of, one->moved.x(), one->moved.y(), one->moved.z()));
}

} // namespace rend
