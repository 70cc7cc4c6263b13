// Wavefront's object file (.obj): one object per body and obstacle, and in a body that may tear one group per
// fragment. Wavefront, "B1. Object Files", Advanced Visualizer Manual (1992).
//
// Numbers are the shortest that parse to the same double. There are no normals: programs compute their own.
//
// Where a body has a picture, corners of faces have texture coordinates (vt, v up), each place once. A material
// library (.mtl) beside the files names the pictures: it has one material for each body and obstacle, and one
// for the faces of a solid that fracture exposes. How a picture goes on beyond 0 and 1 it does not say, since
// readers disagree on the option for it.
#include "sim/export/format.h"
#include "sim/export/obstacle_skin.h"

#include <fmt/format.h>

#include <iterator>
#include <map>

namespace rend {
namespace {

std::string library_name(const Scene& scene) {
  return one_word(scene.name()) + ".mtl";
}

// Numbered, since bodies may have names that are one word alike.
std::string material_name(std::size_t body, const std::string& name, bool exposed) {
  return fmt::format("{}_{}{}", body + 1, one_word(name), exposed ? "_inside" : "");
}

class ObjFile {
public:
  // library: the name of the material library.
  ObjFile(const Skin& skin, const SkinPictures& pictures, std::string library)
      : skin_(skin), pictures_(pictures), library_(std::move(library)) {}

  std::string text() {
    add("# time {} s, lengths in m, z is up\n", skin_.time);
    if (!pictures_.empty()) add("mtllib {}\n", library_);
    SkinOfBody last;
    for (std::size_t b = 0; b < skin_.bodies.size(); ++b) {
      const SkinOfBody& body = skin_.bodies[b];
      const std::string name = one_word(body.name);
      add("o {}\n", name);
      for (std::size_t p = last.points_end; p < body.points_end; ++p)
        add("v {} {} {}\n", skin_.points[3 * p], skin_.points[3 * p + 1], skin_.points[3 * p + 2]);
      for (std::size_t f = last.faces_end; f < body.faces_end; ++f) {
        const bool first = f == last.faces_end || skin_.fragment[f] != skin_.fragment[f - 1];
        if (body.tears && first) add("g {}_{}\n", name, skin_.fragment[f]);
        if (!pictures_.empty()) add_material(b, f, f == last.faces_end);
        add_face(f);
      }
      last = body;
    }
    return std::move(out_);
  }

private:
  template <class... T> void add(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }

  std::size_t begin(std::size_t face) const {
    return face == 0 ? 0 : static_cast<std::size_t>(skin_.ends[face - 1]);
  }

  bool is_exposed(std::size_t face) const { return !skin_.exposed.empty() && skin_.exposed[face] != 0; }

  // Where it is another than that of the face before; and the texture coordinates that are new.
  void add_material(std::size_t body, std::size_t face, bool first) {
    const bool exposed = is_exposed(face);
    if (first || exposed != is_exposed(face - 1))
      add("usemtl {}\n", material_name(body, skin_.bodies[body].name, exposed));
    if (pictures_[body].material(exposed).picture.empty()) return;
    for (std::size_t c = begin(face); c < static_cast<std::size_t>(skin_.ends[face]); ++c) {
      const TexturePlace& at = skin_.texture[c];
      const auto [known, added] = places_.try_emplace({at.u, at.v}, places_.size() + 1);
      if (added) add("vt {} {}\n", at.u, at.v);
      place_of_.push_back(known->second);
    }
  }

  void add_face(std::size_t face) {
    out_ += 'f';
    for (std::size_t c = begin(face), n = 0; c < static_cast<std::size_t>(skin_.ends[face]); ++c, ++n) {
      add(" {}", skin_.corners[c] + 1); // from 1
      if (!place_of_.empty()) add("/{}", place_of_[n]);
    }
    out_ += '\n';
    place_of_.clear();
  }

  const Skin& skin_;
  const SkinPictures& pictures_;
  std::string library_;
  std::map<std::pair<double, double>, std::size_t> places_; // u, v → number of its vt, from 1
  std::vector<std::size_t> place_of_;                       // of each corner of the next face; empty: none
  std::string out_;
};

void add_material(std::string& to, const std::string& name, const SkinMaterial& material) {
  const auto [r, g, b] = material.picture.empty() ? material.colour : std::array<double, 3>{1, 1, 1};
  to += fmt::format("newmtl {}\nKd {} {} {}\n", name, r, g, b);
  if (!material.picture.empty()) to += fmt::format("map_Kd {}\n", material.picture);
}

class ObjExporter final : public Exporter {
public:
  ObjExporter(const Scene& scene, const SkinPictures& pictures)
      : scene_(scene), pictures_(pictures), maker_(scene, pictures) {}

  std::string state() const override {
    Skin skin = maker_.skin();
    add_obstacles(skin, scene_.world());
    return ObjFile(skin, pictures_, library_name(scene_)).text();
  }

  std::vector<FileBeside> beside() const override {
    if (pictures_.empty()) return {};
    std::string text;
    for (std::size_t n = 0; n < scene_.bodies().size(); ++n)
      for (const bool exposed : {false, true})
        if (!exposed || scene_.bodies()[n]->map->dimension() == 3)
          add_material(text, material_name(n, scene_.bodies()[n]->name, exposed),
                       pictures_[n].material(exposed));
    std::size_t number = scene_.bodies().size();
    for (const ObstacleSkin& obstacle : obstacle_skins(scene_.world(), 0)) {
      add_material(text, material_name(number, obstacle.name, false), pictures_[number].outside);
      ++number;
    }
    return {{library_name(scene_), std::move(text)}};
  }

private:
  const Scene& scene_;
  SkinPictures pictures_;
  SkinMaker maker_;
};

} // namespace

ExportFormat obj_format() {
  return {
      .name = "obj",
      .what =
          "the surface as polygons, an object per body and obstacle, a group per fragment; with pictures on "
          "them a material library; text, one file per frame",
      .extension = ".obj",
      .index_extension = "",
      .every_frame = true,
      .make = &make_exporter<ObjExporter>};
}

} // namespace rend
