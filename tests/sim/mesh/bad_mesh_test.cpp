// Files that are truncated, state wrong counts, contain invalid numbers or cells that no map can represent:
// each is refused with the file name and the place, and none makes its reader crash, hang or take memory out of
// proportion to its size.
#include "sim/mesh/moka.h"
#include "sim/mesh/reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "sim/mesh/mesh_files.h"

namespace rend::bad_mesh_test {
namespace {

using files::Folder;
namespace fs = std::filesystem;
using testing::HasSubstr;

// While it exists, the process can allocate at most 256 MB more: beyond that, std::bad_alloc.
class MemoryLimit {
public:
  MemoryLimit() {
    getrlimit(RLIMIT_DATA, &before_);
    std::ifstream status("/proc/self/status");
    unsigned long kilobytes = 0;
    for (std::string word; status >> word;)
      if (word == "VmData:") status >> kilobytes;
    rlimit limit = before_;
    limit.rlim_cur = std::min<rlim_t>(before_.rlim_max, kilobytes * 1024 + (rlim_t{256} << 20U));
    setrlimit(RLIMIT_DATA, &limit);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_DATA, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
  rlimit before_{};
};

enum class Verdict { Taken, Refused };

// The test fails on anything but a map or a UserError that names the file.
Verdict verdict(const std::string& name, const std::string& text, std::string* message = nullptr) {
  const MemoryLimit limit;
  try {
    files::read(name, text);
    return Verdict::Taken;
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    EXPECT_EQ(std::string(error.what()).rfind(name + ":", 0), 0u) << error.what();
    if (message) *message = error.what();
    return Verdict::Refused;
  }
}

std::string refusal(const std::string& name, const std::string& text) {
  std::string message = "not refused";
  verdict(name, text, &message);
  return message;
}

// Valid files of every format.
const std::map<std::string, std::string>& good() {
  static const std::map<std::string, std::string> all = [] {
    std::map<std::string, std::string> made;
    const Folder folder;
    folder.write("in.msh", files::text_of(files::mixed_bar()));
    folder.write("two.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0,1,1,1}; Mesh.MeshSizeMax = 1;\n"
                            "Physical Volume(\"all\") = {1}; Physical Surface(\"skin\") = {1,2};");
    for (const auto& [name, options] : {std::pair{"22.msh", "-format msh22"},
                                        {"22b.msh", "-format msh22 -bin"},
                                        {"41.msh", "-format msh41"},
                                        {"41b.msh", "-format msh41 -bin"}}) {
      folder.gmsh(std::string("in.msh -save -save_all ") + options + " -o " + name);
      made[std::string("bar-") + name] = files::content(folder.path() / name);
      folder.gmsh(std::string("two.geo -3 ") + options + " -o " + name);
      made[std::string("box-") + name] = files::content(folder.path() / name);
    }
    SheetShape shape;
    shape.pattern = SheetPattern::Mixed;
    shape.nx = 3;
    shape.ny = 2;
    shape.size = {3, 2};
    made["sheet.obj"] = files::obj_text(sheet_polygons(shape));
    made["sheet.off"] = files::off_text(sheet_polygons(shape));
    made["bar.moka"] = moka_text(*files::mixed_bar());
    return made;
  }();
  return all;
}

TEST(BadMesh, good_files_are_taken) {
  for (const auto& [name, text] : good()) EXPECT_EQ(verdict(name, text), Verdict::Taken) << name;
}

TEST(BadMesh, files_that_are_cut_off_are_refused) {
  int files = 0;
  for (const auto& [name, text] : good()) {
    if (name == "sheet.obj") continue; // has no end mark: half of its polygons are a sheet, too
    for (int part = 0; part < 12; ++part, ++files) {
      const std::size_t length = text.size() * static_cast<std::size_t>(part) / 12;
      EXPECT_EQ(verdict(name, text.substr(0, length)), Verdict::Refused) << name << " cut at " << length;
    }
  }
  EXPECT_GE(files, 60);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

// Replaces each integer in the text in turn.
TEST(BadMesh, texts_with_a_number_that_is_none_are_refused) {
  int files = 0;
  for (const auto& [name, text] : good()) {
    if (name.find("b.msh") != std::string::npos) continue;
    for (const char* bad : {"nan", "-inf", "1e999", "0x10", "99999999999999999999", "1,5", "-7777777"}) {
      for (std::size_t at = text.size() / 5; at < text.size(); at += text.size() / 5) {
        const std::size_t begin = text.find_first_of(" \n", at), end = text.find_first_of(" \n", begin + 1);
        if (end == std::string::npos || text[begin + 1] < '0' || text[begin + 1] > '9') continue;
        std::string changed = text;
        changed.replace(begin + 1, end - begin - 1, std::string(bad));
        if (verdict(name, changed) == Verdict::Refused)
          ++files;
        else
          EXPECT_STREQ(bad, "-7777777") << name << " at " << begin; // may be a coordinate
      }
    }
  }
  EXPECT_GE(files, 60);
}

std::string binary(const std::string& name, std::size_t from, std::uint64_t number, std::size_t bytes) {
  std::string text = good().at(name);
  for (std::size_t n = 0; n < bytes; ++n) text[from + n] = static_cast<char>(number >> 8U * n);
  return text;
}

TEST(BadMesh, counts_that_lie_are_refused_before_anything_is_allocated) {
  for (const char* count : {"2", "4000000000", "9000000000000000000", "-3"}) {
    for (const char* name : {"bar-22.msh", "bar-41.msh"}) {
      for (const char* section : {"$Nodes\n", "$Elements\n"}) {
        std::string text = good().at(name);
        const std::size_t at = text.find(section) + std::string(section).size();
        text.replace(at, text.find_first_of(" \n", at) - at, std::string(count));
        EXPECT_EQ(verdict(name, text), Verdict::Refused) << name << section << count;
      }
    }
    EXPECT_EQ(verdict("sheet.off", replaced(good().at("sheet.off"), "\n", std::string("\n") + count + " ")),
              Verdict::Refused);
  }
  for (const std::uint64_t count :
       {std::uint64_t{2}, std::uint64_t{1} << 33U, ~std::uint64_t{0}, ~std::uint64_t{0} / 8}) {
    for (const char* section : {"$Nodes\n", "$Elements\n"}) {
      const std::size_t at = good().at("bar-41b.msh").find(section) + std::string(section).size();
      for (std::size_t field : {0, 1}) // number of blocks, total number
        EXPECT_EQ(verdict("bar-41b.msh", binary("bar-41b.msh", at + 8 * field, count, 8)), Verdict::Refused);
      EXPECT_EQ(verdict("bar-41b.msh", binary("bar-41b.msh", at + 44, count, 8)),
                Verdict::Refused); // number of a block
    }
    const std::string& text = good().at("bar-22b.msh");
    const std::size_t elements = text.find('\n', text.find("$Elements\n") + 10) + 1;
    EXPECT_EQ(verdict("bar-22b.msh", binary("bar-22b.msh", elements + 4, count + 1000, 4)), Verdict::Refused);
  }
}

TEST(BadMesh, elements_that_no_map_holds_are_named) {
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 0 0 "
      "-1\n60 0.2 0.2 0\n$EndNodes\n$Elements\n";
  const auto of = [&](const std::string& elements) {
    return refusal("a.msh", head + elements + "$EndElements\n");
  };
  EXPECT_THAT(of("1\n7 4 0 10 20 30 99\n"), HasSubstr("a.msh:15:1: tetrahedron 7 has a node 99"));
  EXPECT_THAT(of("1\n7 4 0 10 20 30 20\n"), HasSubstr("a.msh:15:1: tetrahedron 7 has the node 20 twice"));
  EXPECT_THAT(of("1\n7 4 0 10 20 30 60\n"), HasSubstr("a.msh:15:1: tetrahedron 7 has no volume"));
  EXPECT_THAT(of("1\n7 11 0 10 20 30 40 50 60 10 20 30 40\n"),
              HasSubstr("a.msh:15:3: element 7 is a tetrahedron of 10 nodes, of second order"));
  EXPECT_THAT(of("1\n7 9 0 10 20 30 40 50 60\n"), HasSubstr("triangle of 6 nodes, of second order"));
  EXPECT_THAT(of("1\n7 77 0 10 20 30 40 50 60\n"), HasSubstr("third order"));
  EXPECT_THAT(of("1\n7 4000 0 10 20 30 40 50 60\n"), HasSubstr("does not know"));
  EXPECT_THAT(of("3\n1 4 0 10 20 30 40\n2 4 0 10 20 30 50\n3 4 0 10 20 30 40\n"),
              HasSubstr("a.msh:17:1: tetrahedron 3 shares the face with the points 10 20 30"));
  EXPECT_THAT(of("2\n1 4 0 10 20 30 40\n2 2 0 20 30 50\n"),
              HasSubstr("a.msh:16:1: triangle 2 is not a face of any solid"));
  EXPECT_THAT(of("2\n1 4 0 10 20 30 40\n2 3 0 10 20 30 40\n"), HasSubstr("quad 2 is not a face of any solid"));
  EXPECT_THAT(of("1\n1 1 0 10 20\n"), HasSubstr("holds no solids, triangles or quads"));
  EXPECT_THAT(of("3\n1 2 0 10 20 30\n2 2 0 10 20 40\n3 2 0 10 20 50\n"),
              HasSubstr("polygon 3 shares the edge between points 10 and 20"));
  EXPECT_THAT(of("1\n1 4 0 10 20 30 40 50\n"), HasSubstr("more numbers on its line than 4 nodes"));
  EXPECT_THAT(of("2\n1 4 0 10 20 30 40\n"), HasSubstr("a.msh:16:1: "));
  EXPECT_THAT(refusal("a.msh", replaced(head, "2.2", "3.0")), HasSubstr("a.msh:2:1: version '3.0'"));
  EXPECT_THAT(refusal("a.msh", replaced(head, "20 1 0 0", "10 1 0 0")),
              HasSubstr("a.msh:7:1: node 10 is there twice"));
  EXPECT_THAT(refusal("a.msh", "solid"), HasSubstr("starts with $MeshFormat"));
  EXPECT_THAT(refusal("a.stl", "solid"), HasSubstr("'.stl' is no mesh format"));
  // a degenerate triangle in a sheet
  EXPECT_THAT(refusal("a.msh", replaced(head, "30 0 1 0", "30 0.5 0 0") + "1\n1 2 0 10 20 30\n$EndElements\n"),
              HasSubstr("polygon 1 has no area"));
}

TEST(BadMesh, other_formats_name_line_and_entity) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(refusal("a.obj", points + "f 1 2 4\n"),
              HasSubstr("a.obj:4:7: a polygon has a corner 4, and there are 3"));
  EXPECT_THAT(refusal("a.obj", points + "f 1 2 0\n"), HasSubstr("a.obj:4:7: a polygon has a corner 0"));
  EXPECT_THAT(refusal("a.obj", points + "f 1 2\n"), HasSubstr("a.obj:4:1: a polygon of 2 corners"));
  EXPECT_THAT(refusal("a.obj", points + "f 1 2 2\n"), HasSubstr("a.obj:4:1: polygon 1 meets point 2 twice"));
  EXPECT_THAT(refusal("a.obj", points + "f 1 2 x\n"), HasSubstr("'x' is no corner"));
  EXPECT_THAT(refusal("a.obj", points + "f 1 2/y 3\n"), HasSubstr("'2/y' is no corner"));
  EXPECT_THAT(refusal("a.obj", points + "f 1 2/-/1 3\n"), HasSubstr("'2/-/1' is no corner"));
  EXPECT_THAT(refusal("a.obj", points + "vt 0 0\nf 1/1 2/2 3/1\n"),
              HasSubstr("a.obj:5:7: a corner has the texture coordinates 2, and there are 1"));
  EXPECT_THAT(refusal("a.obj", points + "f 1/1 2/1 3/1\n"), HasSubstr("and there are 0 so far"));
  EXPECT_THAT(refusal("a.obj", points + "vt\nf 1 2 3\n"), HasSubstr("texture coordinates without numbers"));
  EXPECT_THAT(refusal("a.obj", points + "vt 0 -1e7\nf 1 2 3\n"), HasSubstr("the texture coordinate -1e+07"));
  EXPECT_THAT(refusal("a.obj", points + "vt 0 inf\nf 1 2 3\n"), HasSubstr("a.obj:4:6: "));
  EXPECT_THAT(refusal("a.obj", "v 0 0\nf 1 2 3\n"), HasSubstr("fewer than three coordinates"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 nan\n"), HasSubstr("a.obj:1:7: "));
  EXPECT_THAT(refusal("a.obj", points), HasSubstr("holds no polygons"));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
              HasSubstr("a.off:6:7: a face has a corner 3"));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n"),
              HasSubstr("a.off:6:1: polygon 0 meets point 1 twice"));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n"),
              HasSubstr("more after the 1 faces"));
  EXPECT_THAT(refusal("a.off", "OFF BINARY\n"), HasSubstr("binary OFF is not read"));
  const std::string& moka = good().at("bar.moka");
  EXPECT_THAT(refusal("a.moka", replaced(moka, "ascii", "binary")), HasSubstr("a.moka:1:1: "));
  EXPECT_THAT(refusal("a.moka", replaced(moka, "\n1 ", "\n5 ")), HasSubstr("α0 of dart 0 is 5, whose α0 is 4"));
  EXPECT_THAT(refusal("a.moka", replaced(moka, "\n1 ", "\n99999 ")),
              HasSubstr("a.moka:3:1: α0 of dart 0 is 99999, and there are"));
  EXPECT_THAT(refusal("a.moka", replaced(moka, " 1 0 0 0\n", " 0\n")), HasSubstr("carries a point"));
}

TEST(BadMesh, binary_files_name_the_byte) {
  const std::string& text = good().at("bar-41b.msh");
  const std::size_t at = text.find("$Nodes\n") + 7;
  EXPECT_THAT(refusal("a.msh", binary("bar-41b.msh", at + 8, 1000000, 8)),
              HasSubstr(fmt::format("a.msh: byte {}: 1000000 nodes are announced, and the", at + 8)));
  EXPECT_THAT(refusal("a.msh", text.substr(0, at + 100)), HasSubstr(fmt::format("a.msh: byte {}: ", at + 8)));
}

// A sparse file of 20 GB; reading it must not allocate 256 MB.
TEST(BadMesh, a_file_with_a_hole_takes_no_memory) {
  const Folder folder;
  for (const auto& [name, text] : good()) {
    for (const std::string& beginning : {std::string(), text}) {
      const fs::path path = folder.write("hole-" + name, beginning);
      fs::resize_file(path, std::uintmax_t{20} << 30U);
      const MemoryLimit limit;
      try {
        read_mesh(path);
        FAIL() << name;
      } catch (const UserError& error) {
        EXPECT_EQ(error.code, Exit::BadInput);
        EXPECT_THAT(error.what(), HasSubstr("hole-" + name + ": byte ")) << name;
        EXPECT_THAT(error.what(), HasSubstr("4096 bytes are zero, which no mesh holds")) << name;
      }
      fs::remove(path);
    }
  }
  // A binary file with a hole in the middle, and one that ends within the hole.
  const std::string& binary = good().at("bar-41b.msh");
  const fs::path path = folder.write("middle.msh", binary);
  fs::resize_file(path, std::uintmax_t{1} << 34U);
  std::ofstream(path, std::ios::binary | std::ios::app) << binary;
  const MemoryLimit limit;
  EXPECT_THROW(read_mesh(path), UserError);
  EXPECT_NO_THROW(read_mesh(folder.write("whole.msh", binary)));
}

// Node tags can be arbitrary: no array may be as long as the largest tag.
TEST(BadMesh, tags_far_apart_take_no_memory) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n";
  const std::string tail = " 0 0 1\n$EndNodes\n$Elements\n1\n1 4 0 1 7 4000000000 ";
  const std::string high = "9000000000000000000";
  EXPECT_EQ(verdict("far.msh", head + "7 1 0 0\n4000000000 0 1 0\n" + high + tail + high + "\n$EndElements\n"),
            Verdict::Taken);
}

// tinyobjloader allocates what a tag announces, and polygons can be in any number of groups.
TEST(BadMesh, obj_statements_that_announce_much_take_no_memory) {
  const std::string sheet = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::string tags = sheet + "f 1 2 3\n", groups = sheet + "g";
  for (int n = 0; n < 20000; ++n) tags += "t a 8192/8192/8192\n";
  EXPECT_EQ(verdict("tags.obj", tags), Verdict::Taken);
  for (int n = 0; n < 5000; ++n) groups += fmt::format(" {}", n);
  groups += "\n";
  for (int n = 0; n < 5000; ++n) groups += "f 1 2 3\n";
  EXPECT_THAT(refusal("groups.obj", groups), HasSubstr("in one group too many"));
}

TEST(BadMesh, numbers_of_groups_are_of_32_bits_without_their_sign) {
  const auto msh = [](const std::string& named, const std::string& used) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 " + named +
           " \"all\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 "
           "1\n$EndNodes\n$Elements\n1\n"
           "1 4 2 " +
           used + " 0 1 2 3 4\n$EndElements\n";
  };
  const auto groups = [&](const std::string& named, const std::string& used) {
    return files::read("a.msh", msh(named, used)).groups;
  };
  for (const char* number : {"-9223372036854775808", "9223372036854775807", "2147483648", "-2147483648"}) {
    EXPECT_THAT(refusal("a.msh", msh(number, "1")), HasSubstr("a.msh:6:3: is too large for the number of a"));
    EXPECT_THAT(refusal("a.msh", msh("1", number)), HasSubstr("a.msh:17:7: is too large for the number of a"));
  }
  EXPECT_THAT(refusal("a.msh", msh("1", "4294967297")), HasSubstr("too large")); // 1 in 32 bits
  for (const char* used : {"2147483647", "-2147483647"})                         // reversed orientation
    EXPECT_EQ(groups("2147483647", used).count("all"), 1u) << used;
  const auto of_entity = [](const char* number) {
    return fmt::format("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 {} 0\n"
                       "$EndEntities\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                       "$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n",
                       number);
  };
  EXPECT_EQ(files::read("a.msh", of_entity("-7")).groups.count("7"), 1u);
  EXPECT_THAT(refusal("a.msh", of_entity("-2147483648")), HasSubstr("a.msh:6:17: is too large"));
}

TEST(BadMesh, a_file_that_is_not_there_is_another_matter) {
  try {
    read_mesh(std::filesystem::path("nowhere/none.msh"));
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::NoInput);
    EXPECT_THAT(error.what(), HasSubstr("nowhere/none.msh"));
  }
}

// Bytes changed, dropped or doubled at random: the file is refused, or gives a valid map.
TEST(BadMesh, random_damage_ends_in_a_map_or_a_refusal) {
  std::mt19937 random(5);
  std::size_t refused = 0;
  for (const auto& [name, text] : good()) {
    for (int n = 0; n < 150; ++n) {
      std::string damaged = text;
      for (unsigned k = 0; k <= random() % 3; ++k) {
        const std::size_t at = random() % damaged.size(), length = random() % 9;
        switch (random() % 4) {
        case 0:
          damaged[at] = static_cast<char>(random());
          break;
        case 1:
          damaged.erase(at, length);
          break;
        case 2:
          damaged.insert(at, damaged.substr(random() % damaged.size(), length));
          break;
        default:
          damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
        }
        if (damaged.empty()) damaged.assign(1, ' ');
      }
      refused += verdict(name, damaged) == Verdict::Refused;
    }
  }
  EXPECT_GE(refused, 60u);
}

// A point shared by a million faces must not make sewing quadratic; nor a group for each byte.
TEST(BadMesh, files_of_a_megabyte_that_are_made_to_be_slow_are_not) {
  std::string fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", groups = fan;
  while (fan.size() < 1000000) fan += "f 1 2 3\n";
  EXPECT_EQ(verdict("fan.obj", fan), Verdict::Refused);
  for (int n = 0; groups.size() < 1000000; ++n) groups += "g a" + std::to_string(n) + "\nf 1 2 3\n";
  EXPECT_EQ(verdict("groups.obj", groups), Verdict::Refused);
  std::string polygon = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n400000";
  for (int n = 0; n < 400000; ++n) polygon += " 0";
  EXPECT_EQ(verdict("polygon.off", polygon + "\n"), Verdict::Refused);
}

} // namespace
} // namespace rend::bad_mesh_test
