// What is read into a scene is looked at: each field that somebody set to what no run comes to is refused in
// words that name it. (tests/render/clip/forged_checkpoint_test.cpp changes bytes anywhere.)
#include "sim/base/archive.h"
#include "sim/presets.h"
#include "sim/scene/scene.h"

#include <gmock/gmock.h>

#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>

namespace rend::forged_store_test {
namespace {

using testing::HasSubstr;

std::vector<std::uint8_t> stored_bytes(Scene& scene) {
  Archive archive;
  scene.store(archive);
  return archive.bytes();
}

// The error message; empty: accepted.
std::string refused(Scene& scene, const std::vector<std::uint8_t>& bytes) try {
  Archive archive{std::span<const std::uint8_t>(bytes)};
  scene.store(archive);
  archive.end();
  return "";
} catch (const ArchiveError& error) {
  return error.what();
}

// Offsets of the fields of a stored scene of one body, in the order of Scene::store and what it calls.
struct Layout {
  std::size_t scene = 0, links = 0, free_darts = 0, body = 0, guard = 0;
  std::map<int, std::size_t> slots, first, free; // of orbits, by mask; slots: four bytes for each dart
  std::map<std::string, std::size_t> columns;    // values of columns

  explicit Layout(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {
    mark("scene");
    scene = at_;
    at_ += 5 * 8;
    mark("body");
    mark("map");
    at_ += 8;
    links = list(16);
    free_darts = list(4);
    for (int mask = 0; mask < orbit_kinds; ++mask) {
      if (number() == 0) continue;
      slots[mask] = list(4);
      list(4);
      list(1);
      first[mask] = list(4);
      free[mask] = list(4);
    }
    for (std::uint64_t left = number(); left > 0; --left) {
      const std::size_t length = number();
      const std::string name(bytes.begin() + static_cast<std::ptrdiff_t>(at_),
                             bytes.begin() + static_cast<std::ptrdiff_t>(at_ + length));
      at_ += length;
      columns[name] = list(1);
    }
    body = at_;
    guard = after("guard");
  }

private:
  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes_.data() + at_, 8);
    at_ += 8;
    return value;
  }
  std::size_t list(std::size_t each) { // offset of its elements
    const std::uint64_t count = number();
    const std::size_t begin = at_;
    at_ += count * each;
    return begin;
  }
  void mark(const std::string& name) {
    if (number() != name.size() || std::memcmp(bytes_.data() + at_, name.data(), name.size()) != 0)
      throw std::logic_error(name + " stands elsewhere");
    at_ += name.size();
  }
  std::size_t after(const std::string& name) const {
    const auto found = std::find_end(bytes_.begin(), bytes_.end(), name.begin(), name.end());
    return static_cast<std::size_t>(found - bytes_.begin()) + name.size();
  }
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

// A scene of one body, after some steps, and others that read its state.
class StoredScene {
public:
  StoredScene(std::string xml, long steps) : xml_(std::move(xml)), loaded_(presets::load(xml_)) {
    while (loaded_->steps_done() < steps) loaded_->step();
    bytes_ = stored_bytes(*loaded_.scene);
    EXPECT_EQ(refused(*presets::load(xml_).scene, bytes_), "");
  }
  const EmbeddedMap& map() const { return *loaded_.body().map; }
  const Body& body() const { return loaded_.body(); }
  Layout layout() const { return Layout(bytes_); }
  template <class T> T there(std::size_t at) const {
    T value{};
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }

  // The error message when this value is stored at this offset.
  template <class T> std::string with(std::size_t at, T value) const {
    std::vector<std::uint8_t> forged = bytes_;
    std::memcpy(forged.data() + at, &value, sizeof value);
    return refused(*presets::load(xml_).scene, forged);
  }

private:
  std::string xml_;
  presets::Loaded loaded_;
  std::vector<std::uint8_t> bytes_;
};

std::string stored_scene_xml(const std::string& body, const std::string& rest) {
  return R"(<scene name="forged"><body name="body">)" + body + "</body>" + rest + "</scene>";
}

// Springs that are deleted when they are stretched too far: elements are removed, borders open.
StoredScene torn() {
  return {stored_scene_xml(R"(<sheet cells="4 4" size="1 1"/><mass total="0.1"/>
                      <springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>
                      <fix side="-x"/><drive side="+x" velocity="4 0 0"/>
                      <tear criterion="global-border" threshold="1" max-per-step="1"/>
                      <tear criterion="atomic-spring" kind="shear" threshold="0.5" max-per-step="1"/>)",
                           R"(<time step="1e-3" integrator="rk4" duration="1"/>)"),
          200};
}

Dart some_dart(const GMap& map, const std::function<bool(Dart)>& fits) {
  Dart found;
  map.for_each_dart([&](Dart d) {
    if (!found && fits(d)) found = d;
  });
  EXPECT_TRUE(found);
  return found;
}

TEST(ForgedStore, links_are_those_of_the_scene_or_open) {
  const StoredScene genuine = torn();
  const GMap& map = genuine.map().map();
  ASSERT_LT(map.dart_count(), map.capacity()) << "something was deleted";
  const auto link = [links = genuine.layout().links](int i, Dart d) {
    return links + 16 * d.value + 4 * static_cast<std::size_t>(i);
  };
  const Dart sewn = some_dart(map, [&](Dart d) { return !map.is_free(2, d); });
  const Dart open = some_dart(map, [&](Dart d) { return map.is_free(2, d); });
  const auto none = Dart::none_value;
  EXPECT_THAT(genuine.with(genuine.layout().links - 8, map.capacity() + 1), HasSubstr("number of darts"));
  EXPECT_THAT(genuine.with(link(0, sewn), 1U << 31U), HasSubstr("within its element"));
  EXPECT_THAT(genuine.with(link(1, sewn), sewn.value), HasSubstr("within its element"));
  EXPECT_THAT(genuine.with(link(2, open), 1U << 31U), HasSubstr("across its element's border"));
  EXPECT_THAT(genuine.with(link(2, sewn), sewn.value), HasSubstr("border is open"));
  EXPECT_THAT(genuine.with(link(3, sewn), sewn.value + 1), HasSubstr("α3-free"));
  const auto in_part = testing::AnyOf(HasSubstr("removed in part"), HasSubstr("there in part"),
                                      HasSubstr("open on one side")); // which is found first
  EXPECT_THAT(genuine.with(link(0, sewn), none), in_part);
  EXPECT_THAT(genuine.with(link(0, sewn), std::array{none, none, none, none}), in_part);
  EXPECT_THAT(genuine.with(genuine.layout().free_darts, sewn.value), HasSubstr("free dart"));
  EXPECT_THAT(genuine.with(genuine.layout().free_darts, 1U << 31U), HasSubstr("free dart"));
  EXPECT_THAT(
      genuine.with(genuine.layout().free_darts, genuine.there<std::uint32_t>(genuine.layout().free_darts + 4)),
      HasSubstr("free twice"));
}

TEST(ForgedStore, every_dart_has_the_slot_of_its_orbit) {
  const StoredScene genuine = torn();
  const Layout layout = genuine.layout();
  const int mask = Vertex.mask;
  const CellIndex& vertices = genuine.map().cells(Vertex);
  const Dart some = some_dart(genuine.map().map(), [](Dart) { return true; });
  const Slot slot = vertices.slot(some), other = slot == 0 ? 1 : 0;
  const std::size_t slot_of = layout.slots.at(mask) + 4 * some.value,
                    first_of = layout.first.at(mask) + 4 * slot;
  EXPECT_THAT(genuine.with(slot_of, other), HasSubstr("another slot"));
  EXPECT_THAT(genuine.with(slot_of, 1U << 31U), HasSubstr("another slot"));
  EXPECT_THAT(genuine.with(layout.slots.at(mask) - 8, 1ULL << 60U), HasSubstr("longer than"));
  EXPECT_THAT(genuine.with(first_of, Dart::none_value), HasSubstr("have a slot"));
  EXPECT_THAT(genuine.with(first_of, 1U << 30U), HasSubstr("without darts"));
  const Dart next = genuine.map().map().alpha(1, some);
  ASSERT_LT(some, next);
  EXPECT_THAT(genuine.with(first_of, next.value), HasSubstr("smaller"));
}

TEST(ForgedStore, what_the_preset_says_is_no_state) {
  const StoredScene genuine = torn();
  const Layout layout = genuine.layout();
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  const Slot alive = genuine.map().vertex(some_dart(genuine.map().map(), [](Dart) { return true; }));
  for (const char* column : {"position", "velocity"}) {
    EXPECT_THAT(genuine.with(layout.columns.at(column) + 32 * alive, nan), HasSubstr("not finite"));
    EXPECT_THAT(genuine.with(layout.columns.at(column) + 32 * alive + 16, -infinite), HasSubstr("not finite"));
    EXPECT_THAT(genuine.with(layout.columns.at(column) + 32 * alive + 24, 1.0), HasSubstr("fourth"));
    EXPECT_EQ(genuine.with(layout.columns.at(column) + 32 * alive, 0.5), "") << "just another state";
  }
  for (const char* column : {"rest position", "prescribed motions"})
    EXPECT_THAT(genuine.with(layout.columns.at(column) + (column[0] == 'r' ? 32 : 8) * alive, 0.5),
                HasSubstr("from its preset"))
        << column;
  std::size_t constant = 0;
  for (const auto& [name, at] : layout.columns) constant += name != "position" && name != "velocity";
  EXPECT_GE(constant, 5u) << "mass, springs, born borders";
}

TEST(ForgedStore, a_body_that_nothing_tears_is_as_it_was_built) {
  const StoredScene genuine(presets::cloth("quads", 3), 5);
  std::vector<std::uint8_t> opened;
  const auto torn = presets::load(presets::cloth("quads", 3));
  torn.body().map->edit([&](Edit& edit) {
    unsew(edit, 2, some_dart(edit.map(), [&](Dart d) { return !edit.map().is_free(2, d); }));
  });
  torn.body().rebind();
  EXPECT_THAT(refused(*presets::load(presets::cloth("quads", 3)).scene, stored_bytes(*torn.scene)),
              HasSubstr("that nothing tears"));
}

TEST(ForgedStore, times_and_numbers_of_steps_agree) {
  const StoredScene genuine = torn();
  const Layout layout = genuine.layout();
  const std::size_t done = layout.scene + 8, looked = layout.scene + 24;
  for (const long steps :
       {-1L, 0L, 100L, 201L, std::numeric_limits<long>::max(), std::numeric_limits<long>::min()})
    EXPECT_THAT(genuine.with(done, steps), HasSubstr("between two steps")) << steps;
  EXPECT_THAT(genuine.with(looked, 200L), HasSubstr("between two steps")) << "laws would not be asked";
  EXPECT_THAT(genuine.with(layout.scene, 2e-3), HasSubstr("another length"));
  EXPECT_THAT(genuine.with(layout.scene + 16, 0.5), HasSubstr("another time"));
  EXPECT_THAT(genuine.with(layout.body, 1ULL << 60U), HasSubstr("longer than"));
  EXPECT_THAT(genuine.with(layout.body, 1ULL << 12U), HasSubstr("more tears than darts"));
  EXPECT_THAT(genuine.with(layout.body + 8, -1.0), HasSubstr("later than now"));
  EXPECT_THAT(genuine.with(layout.body + 8 + 8, -1L), HasSubstr("no step"));
  EXPECT_THAT(genuine.with(layout.body + 8 + 16, 2), HasSubstr("law that is not there"));
  EXPECT_THAT(genuine.with(layout.body + 8 + 28, 1U << 30U), HasSubstr("dart that is not there"));
}

TEST(ForgedStore, the_guard_goes_back_to_a_start_that_there_is) {
  const StoredScene genuine = torn();
  const std::size_t first = genuine.layout().guard + 8, aside = first + 8, state = aside + 1 + 8;
  for (const long step : {-1L, 0L, 201L, std::numeric_limits<long>::min()})
    EXPECT_THAT(genuine.with(first, step), HasSubstr("starts")) << step;
  EXPECT_THAT(genuine.with(aside, std::uint8_t{0}), HasSubstr("has no start"));
  EXPECT_THAT(genuine.with(aside, std::uint8_t{2}), HasSubstr("neither yes nor no"));
  EXPECT_THAT(genuine.with(state - 8, 2ULL), HasSubstr("number of bodies"));
  EXPECT_THAT(genuine.with(state, genuine.map().cells(Vertex).slots() + 1), HasSubstr("more vertices"));
}

TEST(ForgedStore, what_a_scheme_hands_on_is_what_it_would) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string scheme : {"rk45", "implicit", "tr-bdf2", "static"}) {
    const StoredScene genuine(
        stored_scene_xml(R"(<sheet cells="3 3" size="1 1"/><mass total="0.1"/>
                                      <springs><stretch k="60"/></springs><fix side="-x"/>)",
                         R"(<time step="5e-3" integrator=")" + scheme + R"(" duration="1"/>)"),
        3);
    std::size_t at = genuine.layout().body + 8 + 1 + 8 + 8 + 8 +
                     1; // no tears, not removed; evaluations, time, step; staggered
    for (int n = 0; n < 2; ++n) at += 8 + 32 * genuine.there<std::uint64_t>(at);
    at += 2 + 32; // large, staggered, probe
    ASSERT_EQ(genuine.there<std::uint64_t>(at), scheme == "static" ? 6u : 4u);
    EXPECT_THAT(genuine.with(at, 1ULL), HasSubstr("hand on")) << scheme;
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t number = at + 8 + 8 * n;
      EXPECT_THAT(genuine.with(number, nan), HasSubstr("is none")) << scheme << n;
      EXPECT_THAT(genuine.with(number, -1.0), HasSubstr("hand on")) << scheme << n;
      const char* real = scheme == "rk45" && n < 2 ? "" : "hand on"; // the length of a substep, and its error
      EXPECT_THAT(genuine.with(number, 1e300), HasSubstr(real)) << scheme << n;
      EXPECT_THAT(genuine.with(number, 0.0), HasSubstr(scheme == "rk45" && n < 2 ? "hand on" : ""))
          << "parts of no length never end";
    }
  }
}

} // namespace
} // namespace rend::forged_store_test
