#include "sim/export/skin.h"

#include "sim/body/measure.h"
#include "sim/body/probe.h"
#include "sim/export/element_stress.h"
#include "sim/mechanics/winding.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

struct SkinFace {
  Dart first;             // the smallest
  Dart start;             // where it is walked from, by to_next_side
  Dart element;           // the smallest dart of its cell
  std::uint32_t fragment; // in the body
  bool exposed;           // laid bare by fracture
};

// Appends one body to the skin.
class BodySkin {
public:
  BodySkin(Body& body, const Sides& sides, Skin& skin)
      : body_(body), map_(*body.map), links_(map_.map()), sides_(sides), skin_(skin),
        number_(static_cast<std::int32_t>(skin.bodies.size())) {}

  // `fragments`: how many there are in the bodies before; grows by those of this one. picture: null, none has.
  void add(const SkinMaker::Arrays& wanted, const SkinPicture* picture, std::int32_t& fragments);

private:
  void collect_faces();
  void add_points();
  void add_faces(std::int32_t fragments);
  void add_stress();
  void add_exposed();
  void add_places(const SkinPicture& picture);

  // Calls f(dart) for each of its corners, in the order in which it is walked.
  template <class F> void for_each_corner(const SkinFace& face, F&& f) const {
    Dart at = face.start;
    do {
      f(at);
      at = links_.follow(at, to_next_side);
    } while (at != face.start);
  }

  Body& body_;
  const EmbeddedMap& map_;
  const GMap& links_;
  const Sides& sides_;
  Skin& skin_;
  std::int32_t number_;
  std::vector<SkinFace> faces_;
  std::uint32_t fragments_ = 0;
  std::vector<std::int32_t> point_; // of each vertex slot; -1: not on the surface
};

void BodySkin::add(const SkinMaker::Arrays& wanted, const SkinPicture* picture, std::int32_t& fragments) {
  collect_faces();
  add_points();
  add_faces(fragments);
  if (wanted.stress) add_stress();
  if (wanted.exposed) add_exposed();
  if (picture) add_places(*picture);
  fragments += static_cast<std::int32_t>(fragments_);
  skin_.bodies.push_back({body_.name, body_.tears(), skin_.points.size() / 3, skin_.ends.size()});
}

void BodySkin::collect_faces() {
  const bool sheet = map_.dimension() == 2;
  const std::vector<std::uint32_t> labels = label_fragments(links_);
  std::vector<Dart> element(links_.capacity()); // of each dart; none: not walked yet
  std::vector<Dart> darts;
  const auto element_of = [&](Dart d) {
    if (element[d.value]) return element[d.value];
    darts.clear();
    collect(links_, element_orbit(map_.dimension()), d, darts);
    const Dart smallest = *std::min_element(darts.begin(), darts.end());
    for (const Dart e : darts) element[e.value] = smallest;
    return smallest;
  };
  body_.boundary().for_each_face([&](const BoundaryFaces::Face& face, std::span<const Slot>) {
    const Dart first = face.first;
    const bool along = sheet ? sides_.of_dart[first.value] == 1 : !face.turned;
    const std::uint32_t label = labels[first.value];
    faces_.push_back({first, along ? first : links_.alpha(1, first), element_of(first), label, face.exposed});
    fragments_ = std::max(fragments_, label + 1);
  });
  std::sort(faces_.begin(), faces_.end(), [](const SkinFace& a, const SkinFace& b) {
    return a.fragment != b.fragment ? a.fragment < b.fragment : a.first < b.first;
  });
}

void BodySkin::add_points() {
  point_.assign(map_.cells(Vertex).slots(), -1);
  for (const SkinFace& face : faces_) for_each_corner(face, [&](Dart d) { point_[map_.vertex(d)] = 0; });
  for (Slot v = 0; v < point_.size(); ++v) {
    if (point_[v] < 0) continue;
    point_[v] = static_cast<std::int32_t>(skin_.vertex.size());
    const Vec3 x = map_.position()[v].vec(), speed = map_.velocity()[v].vec();
    skin_.points.insert(skin_.points.end(), {x.x(), x.y(), x.z()});
    skin_.velocity.insert(skin_.velocity.end(), {speed.x(), speed.y(), speed.z()});
    skin_.vertex.push_back(static_cast<std::int32_t>(v));
    skin_.body_of_point.push_back(number_);
  }
}

void BodySkin::add_faces(std::int32_t fragments) {
  for (const SkinFace& face : faces_) {
    for_each_corner(face, [&](Dart d) { skin_.corners.push_back(point_[map_.vertex(d)]); });
    skin_.ends.push_back(static_cast<std::int64_t>(skin_.corners.size()));
    skin_.body_of_face.push_back(number_);
    skin_.fragment.push_back(fragments + static_cast<std::int32_t>(face.fragment));
    skin_.element.push_back(face.element.value);
  }
}

void BodySkin::add_stress() {
  std::vector<Dart> elements;
  for (const SkinFace& face : faces_) elements.push_back(face.element);
  for (const Eigen::Matrix3d& stress : stress_of_elements(body_, elements))
    skin_.equivalent.push_back(von_mises(stress));
  const std::vector<double> largest = vertex_stress(body_);
  for (Slot v = 0; v < point_.size(); ++v)
    if (point_[v] >= 0) skin_.largest_stress.push_back(largest[v]);
}

void BodySkin::add_exposed() {
  for (const SkinFace& face : faces_) skin_.exposed.push_back(face.exposed ? 1 : 0);
}

void BodySkin::add_places(const SkinPicture& picture) {
  std::vector<Dart> corners; // of a face
  for (const SkinFace& face : faces_) {
    corners.clear();
    for_each_corner(face, [&](Dart d) { corners.push_back(d); });
    if (picture.material(face.exposed).picture.empty())
      skin_.texture.resize(skin_.texture.size() + corners.size());
    else
      picture.lay(corners, face.exposed, skin_.texture);
  }
}

} // namespace

SkinMaker::SkinMaker(const Scene& scene, SkinPictures pictures)
    : scene_(&scene), pictures_(std::move(pictures)) {
  for (const auto& body : scene.bodies()) {
    const bool sheet = body->map->dimension() == 2;
    sides_.push_back(sheet ? sides_of(body->map->map()) : Sides{});
    arrays_.stress = arrays_.stress || has_stress(*body);
    arrays_.exposed = arrays_.exposed || (!sheet && body->border);
  }
}

Skin SkinMaker::skin() const {
  Skin skin;
  skin.time = scene_->time();
  std::int32_t fragments = 0;
  for (std::size_t n = 0; n < sides_.size(); ++n)
    BodySkin(*scene_->bodies()[n], sides_[n], skin)
        .add(arrays_, pictures_.empty() ? nullptr : &pictures_.at(n), fragments);
  return skin;
}

} // namespace rend
