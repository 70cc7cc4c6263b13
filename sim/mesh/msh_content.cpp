#include "sim/mesh/msh_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace rend {

void MshContent::name_group(int dimension, int physical, std::string name) {
  names_[{dimension, physical}] = std::move(name);
}

void MshContent::add_node(std::uint64_t tag, const Vec3& x, std::size_t offset) {
  points_.push_back(x);
  tags_.push_back(tag);
  offsets_.push_back(offset);
}

void MshContent::close_nodes() {
  if (points_.size() >= Dart::none_value) file_.source.fail("holds more than 2^32 nodes");
  const std::uint64_t largest = tags_.empty() ? 0 : *std::max_element(tags_.begin(), tags_.end());
  const auto twice = [&](std::uint32_t p) {
    file_.source.fail(offsets_[p], fmt::format("node {} is there twice", tags_[p]));
  };
  const auto count = static_cast<std::uint32_t>(points_.size());
  if (largest < 4 * points_.size() + 1000) {
    dense_.assign(largest + 1, Dart::none_value);
    for (std::uint32_t p = 0; p < count; ++p) {
      if (dense_[tags_[p]] != Dart::none_value) twice(p);
      dense_[tags_[p]] = p;
    }
  } else {
    by_tag_.resize(count);
    std::iota(by_tag_.begin(), by_tag_.end(), 0u);
    std::sort(by_tag_.begin(), by_tag_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(tags_[a], a) < std::pair(tags_[b], b);
    });
    for (std::size_t n = 1; n < by_tag_.size(); ++n)
      if (tags_[by_tag_[n]] == tags_[by_tag_[n - 1]]) twice(by_tag_[n]);
  }
  offsets_ = {};
  closed_ = true;
}

std::uint32_t MshContent::node(std::uint64_t tag, const Origin& origin, const MshType& type) const {
  if (tag < dense_.size() && dense_[tag] != Dart::none_value) return dense_[tag];
  const auto found = std::lower_bound(by_tag_.begin(), by_tag_.end(), tag,
                                      [&](std::uint32_t p, std::uint64_t wanted) { return tags_[p] < wanted; });
  if (found != by_tag_.end() && tags_[*found] == tag) return *found;
  file_.source.fail(origin.offset, fmt::format("{} {} has a node {}, and there is no such node", type.name,
                                               origin.tag, static_cast<std::int64_t>(tag)));
}

void MshContent::add_element(const MshType& type, const Origin& origin, std::span<const std::uint64_t> nodes,
                             std::span<const int> groups) {
  std::array<std::uint32_t, 8> points;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    points[n] = node(nodes[n], origin, type);
    if (std::find(points.begin(), points.begin() + n, points[n]) != points.begin() + n)
      file_.source.fail(origin.offset,
                        fmt::format("{} {} has the node {} twice", type.name, origin.tag, nodes[n]));
  }
  // A small file could otherwise put each element into very many groups.
  members_ += groups.size() * nodes.size();
  if (members_ > 8 * file_.source.bytes().size() + 1000000)
    file_.source.fail(origin.offset,
                      fmt::format("{} {} is in one group too many: there is a limit on how many "
                                  "elements are in how many groups, of 8 nodes a byte of the file",
                                  type.name, origin.tag));
  for (const int group : groups) {
    auto& members = groups_[{type.dimension, group}];
    members.insert(members.end(), points.begin(), points.begin() + nodes.size());
  }
  if (type.dimension < 2) return;
  elements_.push_back({&type, static_cast<std::uint32_t>(corners_.size()), groups.empty() ? 0 : groups[0]});
  origins_.push_back(origin);
  corners_.insert(corners_.end(), points.begin(), points.begin() + nodes.size());
  if (corners_.size() >= Dart::none_value)
    file_.source.fail(origin.offset, "there are too many elements: a mesh holds at most 2^32 darts");
}

// Version 2.2 lists an element once for each of its groups: which elements are repetitions.
std::vector<bool> MshContent::repeats(int dimension) const {
  std::vector<bool> repeat(elements_.size(), false);
  bool several = false;
  int group = -1;
  for (const Element& e : elements_) {
    if (e.type->dimension != dimension) continue;
    several = several || (group != -1 && group != e.group);
    group = e.group;
  }
  if (!several) return repeat;
  using Key = std::array<std::uint32_t, 9>; // sorted corners, and the element
  std::vector<Key> keys;
  for (std::uint32_t n = 0; n < elements_.size(); ++n) {
    const Element& e = elements_[n];
    if (e.type->dimension != dimension) continue;
    Key key;
    key.fill(Dart::none_value);
    std::copy_n(corners_.begin() + e.first, e.type->nodes, key.begin());
    std::sort(key.begin(), key.begin() + e.type->nodes);
    key[8] = n;
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t n = 1; n < keys.size(); ++n)
    if (std::equal(keys[n].begin(), keys[n].begin() + 8, keys[n - 1].begin()) &&
        elements_[keys[n][8]].group != elements_[keys[n - 1][8]].group)
      repeat[keys[n][8]] = true;
  return repeat;
}

namespace {

// A ring of points independent of its direction and start: the smallest point, its neighbours in order, the
// opposite point.
using RingKey = std::array<std::uint32_t, 4>;

template <class At> RingKey ring_key(std::size_t sides, At&& at) {
  std::size_t low = 0;
  for (std::size_t n = 1; n < sides; ++n)
    if (at(n) < at(low)) low = n;
  const std::uint32_t a = at((low + 1) % sides), b = at((low + sides - 1) % sides);
  return {at(low), std::min(a, b), std::max(a, b), sides == 4 ? at((low + 2) % 4) : Dart::none_value};
}

} // namespace

void MshContent::check_faces(const CellMesh& cells) const {
  std::vector<std::pair<RingKey, std::uint32_t>> faces; // with its element
  for (std::uint32_t n = 0; n < elements_.size(); ++n) {
    const Element& e = elements_[n];
    if (e.type->dimension == 2)
      faces.push_back({ring_key(static_cast<std::size_t>(e.type->nodes),
                                [&](std::size_t c) { return corners_[e.first + c]; }),
                       n});
  }
  if (faces.empty()) return;
  std::sort(faces.begin(), faces.end());
  std::vector<bool> found(faces.size(), false);
  for (std::size_t c = 0; c < cells.cells(); ++c) {
    const CellShape& shape = shape_of(cells.kinds[c]);
    const auto corners = cells.corners_of(c);
    for (std::size_t f = 0; f < static_cast<std::size_t>(shape.faces); ++f) {
      const RingKey key = ring_key(static_cast<std::size_t>(shape.sides[f]), [&](std::size_t n) {
        return corners[static_cast<std::size_t>(shape.ring[f][n])];
      });
      auto at = std::lower_bound(faces.begin(), faces.end(), std::pair(key, 0u));
      for (; at != faces.end() && at->first == key; ++at)
        found[static_cast<std::size_t>(at - faces.begin())] = true;
    }
  }
  for (std::size_t n = 0; n < faces.size(); ++n) {
    if (found[n]) continue;
    const std::uint32_t e = faces[n].second;
    file_.source.fail(
        origins_[e].offset,
        fmt::format("{} {} is not a face of any solid of this file", elements_[e].type->name, origins_[e].tag),
        "a body is either a sheet or a solid: put them into two files, for two bodies");
  }
}

void MshContent::finish() {
  const bool solid =
      std::any_of(elements_.begin(), elements_.end(), [](const Element& e) { return e.type->dimension == 3; });
  if (elements_.empty())
    file_.source.fail("holds no solids, triangles or quads",
                      "in Gmsh, mesh the surfaces or volumes before saving (gmsh -2 or -3)");
  const int dimension = solid ? 3 : 2;
  const std::vector<bool> repeat = repeats(dimension);
  CellMesh cells;
  PolygonMesh polygons;
  polygons.first.push_back(0);
  for (std::size_t n = 0; n < elements_.size(); ++n) {
    const Element& e = elements_[n];
    if (e.type->dimension != dimension || repeat[n]) continue;
    const std::span<const std::uint32_t> corners(corners_.data() + e.first,
                                                 static_cast<std::size_t>(e.type->nodes));
    file_.origins.push_back(origins_[n]);
    if (solid) {
      cells.add(e.type->kind, corners);
    } else {
      polygons.corners.insert(polygons.corners.end(), corners.begin(), corners.end());
      polygons.first.push_back(static_cast<std::uint32_t>(polygons.corners.size()));
    }
  }
  if (solid) check_faces(cells);
  for (auto& [key, members] : groups_) {
    const auto name = names_.find(key);
    auto& group = file_.groups[name == names_.end() ? std::to_string(key.second) : name->second];
    group.insert(group.end(), members.begin(), members.end());
  }
  (solid ? cells.points : polygons.points) = std::move(points_);
  (solid ? cells.names : polygons.names) = std::move(tags_);
  if (solid)
    file_.mesh = std::move(cells);
  else
    file_.mesh = std::move(polygons);
}

} // namespace rend
