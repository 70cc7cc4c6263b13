#include "render/picture/body_picture.h"

#include "render/draw/hud.h"
#include "render/picture/curved_triangles.h"
#include "render/picture/dart_picture.h"
#include "render/picture/sheet_rim.h"
#include "render/picture/smooth_normals.h"
#include "sim/base/archive.h"
#include "sim/base/units.h"
#include "sim/body/measure.h"
#include "sim/topology/count.h"
#include "sim/topology/orientation.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

static_assert(static_cast<int>(LineKind::Inner) == static_cast<int>(Line::None) &&
              static_cast<int>(LineKind::Cell) == static_cast<int>(Line::Cell) &&
              static_cast<int>(LineKind::Border) == static_cast<int>(Line::Border) &&
              static_cast<int>(LineKind::Torn) == static_cast<int>(Line::Torn) &&
              static_cast<int>(LineKind::Crease) == static_cast<int>(Line::Crease));

Corner corner(const Vec3& x, const Vec3& normal, const Colour& colour, const std::array<LineKind, 3>& side) {
  const auto line = [&](std::size_t k) { return static_cast<std::uint8_t>(side[k]); };
  return {
      as_floats(x), as_floats(normal), {colour[0], colour[1], colour[2], 255}, {line(0), line(1), line(2), 0}};
}

// Their edges need no line to be seen.
bool torn_by_cuts_alone(const Body& body) {
  const bool others = std::ranges::any_of(body.tear_laws, [](const TearLaw& law) {
    const ChangeType* change = law.settings().change;
    return !change || change->name != "cut";
  });
  return !body.tear_laws.empty() && !others;
}

// Those that are seen.
LookTextures seen_of(LookTextures textures, const LookSettings& look, bool orientable) {
  if (!shows_pictures(look)) return {};
  if (!orientable) textures.back = nullptr; // what has one side has no back
  return textures;
}

// The share of its largest extent from which on a sheet looks like a slab: two pixels of a picture that is 640
// wide.
constexpr double visible_thickness = 1.0 / 300;

// Whether a sheet that says nothing of it is drawn with the thickness of its mass. What asks for lines along
// edges gets these.
bool shows_thickness_of_mass(const Body& body, const LookSettings& look, const LookTextures& textures) {
  const bool drawn = body.map->dimension() == 2 && look.as == DrawStyle::Surface && look.smooth == 1;
  const bool lines = look.torn_edges.value_or(draws_edges(look)) || look.source.given("torn-width");
  const bool holes = textures.front && textures.front->cut_out;
  if (look.thickness || !look.mass_thickness || !drawn || holes || lines) return false;
  Eigen::AlignedBox3d rest;
  const CellIndex& cells = body.map->cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v)) rest.extend(body.map->rest()[v].vec());
  return !rest.isEmpty() && *look.mass_thickness >= visible_thickness * rest.sizes().maxCoeff();
}

// More triangles than any picture shows.
void check_parts(Body& body, const LookSettings& look) {
  constexpr double most = 2e7;
  if (look.smooth == 1) return;
  Boundary& boundary = body.boundary();
  const bool solid = body.map->dimension() == 3;
  const auto triangles =
      static_cast<double>(solid ? boundary.solid().triangles() : boundary.sheet().triangles());
  if (const double parts = triangles * look.smooth * look.smooth; parts > most)
    look.source.fail(
        "smooth",
        fmt::format("the body has {:.0f} triangles; divided they are {:.0f}, and {:.0f} is the most", triangles,
                    parts, most),
        "its cells are small enough to be drawn as they are: leave smooth out");
}

} // namespace

BodyPicture::BodyPicture(Body& body, LookSettings look, const LookTextures& textures)
    : body_(&body), look_(std::move(look)), solid_(body.map->dimension() == 3),
      orientable_(solid_ || is_orientable(body.map->map())),
      texture_(body, look_, seen_of(textures, look_, orientable_)), scale_(look_.most.value_or(0)) {
  if (shows_thickness_of_mass(body, look_, textures)) look_.thickness = look_.mass_thickness;
  if (!solid_) body.boundary().sheet(); // that of a solid is there
  check_parts(body, look_);
  if (look_.as == DrawStyle::Darts && body.map->map().dart_count() > most_drawn_darts)
    look_.source.fail("as",
                      fmt::format("the body has {} darts; at most {} can be drawn",
                                  body.map->map().dart_count(), most_drawn_darts),
                      "draw fewer cells, or as=\"exploded\"");
}

constexpr double at_rest = 1e-9; // strain

void BodyPicture::observe(std::size_t& fragments_seen) {
  if (look_.by == ColourBy::Fragment) label_fragments(fragments_seen);
  if (look_.by == ColourBy::Plain || look_.by == ColourBy::Fragment) return;
  values_ = look_.by == ColourBy::Strain   ? vertex_strain(*body_)
            : look_.by == ColourBy::Stress ? vertex_stress(*body_)
                                           : vertex_force(*body_);
  if (look_.most) return;
  double most = 0;
  for (double value : values_) most = std::max(most, value);
  if (look_.by != ColourBy::Strain && most > 0 && scale_ == 0) { // at rest all is round-off, and no colour
    const std::vector<double> strain = vertex_strain(*body_);
    if (*std::max_element(strain.begin(), strain.end()) < at_rest) most = 0;
  }
  if (look_.by == ColourBy::Strain && most < at_rest) most = 0;
  scale_ = std::max(scale_, rounded_up(most));
}

std::optional<HudLegend> BodyPicture::legend() const {
  if (look_.by == ColourBy::Plain || look_.by == ColourBy::Fragment || scale_ == 0) return {};
  HudLegend legend;
  legend.title = std::string(look_.by == ColourBy::Strain   ? "largest strain"
                             : look_.by == ColourBy::Stress ? "largest principal stress"
                                                            : "largest force");
  const char* unit = look_.by == ColourBy::Strain ? "" : look_.by == ColourBy::Stress ? "Pa" : "N";
  legend.low = in_units(0, "");
  legend.high = in_units(scale_, unit);
  for (int n = 0; n < 64; ++n) legend.colours.push_back(colour_of_share(n / 63.0));
  return legend;
}

void BodyPicture::label_fragments(std::size_t& fragments_seen) {
  labels_ = rend::label_fragments(body_->map->map());
  fragment_colours_.clear();
  // darts come in increasing order, so the first of a label is its smallest
  body_->map->map().for_each_dart([&](Dart d) {
    if (labels_[d.value] != fragment_colours_.size()) return;
    const auto [at, added] = colour_numbers_.try_emplace(d.value, fragments_seen);
    if (added) ++fragments_seen;
    fragment_colours_.push_back(colour_of_number(at->second));
  });
}

void BodyPicture::colour_vertices() {
  std::array<Colour, 256> table;
  for (std::size_t n = 0; n < table.size(); ++n) table[n] = colour_of_share(static_cast<double>(n) / 255);
  const double factor = scale_ > 0 ? 255 / scale_ : 0;
  vertex_colours_.resize(values_.size());
  for (std::size_t v = 0; v < values_.size(); ++v)
    vertex_colours_[v] = table[static_cast<std::size_t>(std::min(255.0, values_[v] * factor + 0.5))];
}

FrameBody BodyPicture::plain() const {
  FrameBody out;
  out.edges = draws_edges(look_);
  out.two_sided = !solid_;
  out.shades_back = orientable_;
  out.back = look_.back;
  out.finish = look_.finish;
  out.torn = torn_line();
  out.filled = look_.as != DrawStyle::Wires;
  return out;
}

void BodyPicture::draw(std::vector<FrameBody>& out) {
  const std::size_t before = out.size();
  draw_as_it_is(out);
  for (std::size_t n = before; n < out.size(); ++n) curve_triangles(out[n], look_.smooth);
}

void BodyPicture::draw_as_it_is(std::vector<FrameBody>& out) {
  if (look_.by != ColourBy::Plain && look_.by != ColourBy::Fragment) colour_vertices();
  if (look_.thickness) return draw_thick_sheet(out);
  if (look_.as == DrawStyle::Darts) return draw_darts(*body_, out.emplace_back(plain()));
  if (look_.as == DrawStyle::Exploded)
    return draw_exploded(
        *body_, look_.apart, [this](const CellCorner& at) { return colour_at(at); }, out.emplace_back(plain()));
  find_normals();
  const auto draw = [&](DrawnFaces which) {
    FrameBody& body = out.emplace_back(plain());
    draw_faces(body, which, 0);
    texture_.lay(body, which);
  };
  if (!solid_ || !(texture_.any() || look_.finish_inside)) return draw(DrawnFaces::All);
  draw(DrawnFaces::Outer);
  draw(DrawnFaces::Exposed);
  out.back().finish = look_.finish_inside.value_or(look_.finish);
}

TornLine BodyPicture::torn_line() const {
  if (look_.thickness) return {.width = 0};
  if (!look_.torn_edges.value_or(draws_edges(look_) && !torn_by_cuts_alone(*body_))) return {.width = 0};
  TornLine line{.width = static_cast<float>(look_.torn_width)};
  for (std::size_t c = 0; look_.torn && c < 3; ++c) {
    const float share = static_cast<float>((*look_.torn)[c]) / 255;
    line.colour[c] = share * share; // as decode() in shaders/common.glsl
  }
  return line;
}

Colour BodyPicture::colour_at(const CellCorner& at) const {
  if (look_.by == ColourBy::Fragment) return fragment_colours_[labels_[at.dart.value]];
  if (!vertex_colours_.empty()) return vertex_colours_[at.vertex];
  return at.inner ? look_.inside : look_.colour;
}

void BodyPicture::find_normals() {
  Boundary& boundary = body_->boundary();
  if (solid_) return boundary.solid().normals(normals_);
  boundary.sheet().normals(normals_);
  if (!draws_edges(look_))
    smooth_normals(boundary.sheet(), body_->map->position().values(), normals_, normal_sums_);
}

void BodyPicture::draw_thick_sheet(std::vector<FrameBody>& out) {
  find_normals();
  const double half = *look_.thickness / 2;
  FrameBody front = plain(), back = plain(), rim = plain();
  draw_faces(front, DrawnFaces::All, half);
  draw_faces(back, DrawnFaces::All, -half);
  texture_.lay(front, DrawnFaces::All);
  back.texture = front.texture;
  back.texture_points = front.texture_points;
  front.sides = SheetSides::Front;
  back.sides = SheetSides::Back;
  rim.two_sided = false;
  const auto colour = [this](const BoundaryTriangle& triangle, std::size_t k, bool torn) {
    if (look_.by == ColourBy::Plain) return rim_colour(torn);
    return colour_at({triangle.first, triangle.vertex[k], false});
  };
  draw_rim({*body_->map, body_->boundary().sheet(), normals_, *look_.thickness, colour}, rim);
  for (FrameBody* body : {&front, &back, &rim}) out.push_back(std::move(*body));
}

// Of what the sheet is made of, where there is a picture on it: that of its back, or white.
Colour BodyPicture::rim_colour(bool torn) const {
  const Colour matter = texture_.covers_front() ? look_.back.value_or(Colour{255, 255, 255}) : look_.colour;
  if (!torn) return matter;
  if (look_.torn) return *look_.torn;
  Colour lighter = matter;
  for (std::uint8_t& channel : lighter) channel = static_cast<std::uint8_t>((channel + 255) / 2);
  return lighter;
}

void BodyPicture::draw_faces(FrameBody& out, DrawnFaces which, double raised) {
  const bool by_vertex = !vertex_colours_.empty();
  const auto& x = body_->map->position().values();
  const auto add = [&](const BoundaryTriangle& triangle, const std::array<LineKind, 3>& lines,
                       auto&& normal_at) {
    Colour colour = colour_at({triangle.first, triangle.vertex[0], triangle.exposed});
    for (std::size_t k = 0; k < 3; ++k) {
      const Slot v = triangle.vertex[k];
      const Vec3 normal = normal_at(triangle.normal[k]);
      if (by_vertex) colour = vertex_colours_[v];
      out.corners.push_back(corner(Vec3(x[v].vec() + raised * normal), normal, colour, lines));
    }
  };
  if (solid_) {
    const SolidSurface& surface = body_->boundary().solid();
    if (which != DrawnFaces::Exposed)
      out.corners.reserve(3 * surface.triangles()); // those are drawn after the others
    surface.for_each_triangle([&](const BoundaryTriangle& triangle) {
      if (is_drawn(which, triangle.exposed))
        add(triangle, triangle.side, [&](std::uint32_t n) { return normals_[n]; });
    });
    return;
  }
  const Surface& surface = body_->boundary().sheet();
  out.corners.reserve(3 * surface.triangles());
  surface.for_each_triangle([&](const BoundaryTriangle& triangle) {
    const auto [a, b, c] = triangle.vertex;
    const Vec3 flat = (x[b].vec() - x[a].vec()).cross(x[c].vec() - x[a].vec());
    std::array<LineKind, 3> lines = triangle.side;
    if (look_.thickness) // the rim takes the place of the others
      for (LineKind& line : lines) line = line == LineKind::Cell ? line : LineKind::Inner;
    add(triangle, lines, [&](std::uint32_t n) { return normal_on_side(normals_[n], flat); });
  });
}

std::size_t BodyPicture::bytes() const {
  Boundary& boundary = body_->boundary();
  return solid_ ? boundary.solid().bytes() : boundary.sheet().bytes();
}

void BodyPicture::store(Archive& archive) {
  const double given = scale_;
  const std::size_t darts = body_->map->map().capacity();
  archive(scale_);
  archive.table(colour_numbers_, darts, "more fragments have a colour than there are darts");
  if (!archive.reading()) return;
  refuse_unless(look_.most ? scale_ == given : scale_ >= 0, "the scale of colours is another, or below 0");
  refuse_unless(colour_numbers_.empty() || colour_numbers_.rbegin()->first < darts,
                "a fragment is of a dart that is not there");
}

} // namespace rend
