// Wavefront's object file (.obj): one object per body and obstacle, and in a body that may tear one group per
// fragment. Wavefront, "B1. Object Files", Advanced Visualizer Manual (1992).
//
// Numbers are the shortest that parse to the same double. There are no normals: programs compute their own.
#include "sim/export/format.h"
#include "sim/export/obstacle_skin.h"

#include <fmt/format.h>

#include <iterator>

namespace rend {
namespace {

class ObjFile {
public:
  explicit ObjFile(const Skin& skin) : skin_(skin) {}

  std::string text() {
    add("# time {} s, lengths in m, z is up\n", skin_.time);
    SkinOfBody last;
    for (const SkinOfBody& body : skin_.bodies) {
      const std::string name = one_word(body.name);
      add("o {}\n", name);
      for (std::size_t p = last.points_end; p < body.points_end; ++p)
        add("v {} {} {}\n", skin_.points[3 * p], skin_.points[3 * p + 1], skin_.points[3 * p + 2]);
      for (std::size_t f = last.faces_end; f < body.faces_end; ++f) {
        const bool first = f == last.faces_end || skin_.fragment[f] != skin_.fragment[f - 1];
        if (body.tears && first) add("g {}_{}\n", name, skin_.fragment[f]);
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

  void add_face(std::size_t face) {
    const auto begin = face == 0 ? 0 : static_cast<std::size_t>(skin_.ends[face - 1]);
    out_ += 'f';
    for (std::size_t c = begin; c < static_cast<std::size_t>(skin_.ends[face]); ++c)
      add(" {}", skin_.corners[c] + 1); // from 1
    out_ += '\n';
  }

  const Skin& skin_;
  std::string out_;
};

class ObjExporter final : public Exporter {
public:
  explicit ObjExporter(const Scene& scene) : world_(scene.world()), maker_(scene) {}
  std::string state() const override {
    Skin skin = maker_.skin();
    add_obstacles(skin, world_);
    return ObjFile(skin).text();
  }

private:
  const World& world_;
  SkinMaker maker_;
};

} // namespace

ExportFormat obj_format() {
  return {
      .name = "obj",
      .what =
          "the surface as polygons, an object per body, sphere and box, a group per fragment; text, one file "
          "per frame",
      .extension = ".obj",
      .index_extension = "",
      .every_frame = true,
      .make = &make_exporter<ObjExporter>};
}

} // namespace rend
