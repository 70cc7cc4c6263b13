// Gmsh's .msh, versions 2.2 and 4.1, ASCII and binary (Gmsh reference manual, "MSH file format").
//
// A file is a list of sections, $Name ... $EndName. In 4.1, text and binary files hold the same numbers in the
// same order; binary 2.2 groups elements under headers. Sections without geometry or groups are skipped.
#include "sim/base/wording.h"
#include "sim/mesh/msh_content.h"
#include "sim/mesh/scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace rend {
namespace {

struct Msh {
  MeshFile& file;
  Scanner in;
  MshContent content;
  bool version4 = false;
  std::map<std::pair<int, int>, std::vector<int>> entities; // (dimension, tag) → physical groups

  explicit Msh(MeshFile& f) : file(f), in(f.source), content(f) {}

  // The minimal size of a number.
  std::size_t bytes(std::size_t binary) const { return in.binary ? binary : 2; }
};

void end_section(Msh& msh, const std::string& name) {
  if (msh.in.token("the end of a section") != "$End" + name)
    msh.in.fail(fmt::format("$End{} is expected after what ${} announces", name, name));
}

void read_format(Msh& msh) {
  Scanner& in = msh.in;
  const std::string_view version = in.token("the version");
  if (version != "2.2" && version != "4.1")
    in.fail(fmt::format("version {} of the format is not read", in_quotes(version)),
            "2.2 and 4.1 are: gmsh FILE -save -format msh41");
  msh.version4 = version == "4.1";
  const std::int64_t form = in.integer("0 or 1, for ASCII or binary");
  if (form != 0 && form != 1) in.fail("0 or 1 is expected, for ASCII or binary");
  if (in.integer("the size of a number") != 8) in.fail("numbers of 8 bytes are expected");
  if (form == 1) {
    in.rest_of_line();
    in.binary = msh.file.source.binary = true;
    if (in.raw<std::int32_t>("the number 1 that tells the byte order") != 1) {
      in.go_to(in.last());
      in.swapped = true;
      if (in.raw<std::int32_t>("the number 1") != 1)
        in.fail("the number 1 is expected, which tells the byte order");
    }
  }
  end_section(msh, "MeshFormat");
}

// The sign of a physical group is the element's orientation (Gmsh reference manual), which is not used.
int group_number(const Scanner& in, std::int64_t number) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (number < -most || number > most) in.fail("is too large for the number of a physical group");
  return static_cast<int>(number < 0 ? -number : number);
}

void read_names(Msh& msh) { // text also in binary files
  Scanner& in = msh.in;
  const std::uint64_t count = in.size("the number of physical groups");
  in.check_count(count, 7, "names");
  for (std::uint64_t n = 0; n < count; ++n) {
    const std::int64_t dimension = in.integer("the dimension of a physical group");
    if (dimension < 0 || dimension > 3)
      in.fail(fmt::format("{} is no dimension of a physical group", dimension));
    const int number = group_number(in, in.integer("the number of a physical group"));
    const std::string_view line = in.rest_of_line();
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (open == std::string_view::npos || close == open)
      in.fail("the name of a physical group stands in quotes");
    msh.content.name_group(static_cast<int>(dimension), number,
                           std::string(line.substr(open + 1, close - open - 1)));
  }
}

void read_entities(Msh& msh) {
  Scanner& in = msh.in;
  std::array<std::uint64_t, 4> counts;
  for (auto& count : counts) count = in.number<std::uint64_t>("a number of entities");
  for (int dimension = 0; dimension < 4; ++dimension) {
    const std::uint64_t count = counts[static_cast<std::size_t>(dimension)];
    in.check_count(count, msh.bytes(4 + 24 + 8), "entities");
    for (std::uint64_t n = 0; n < count; ++n) {
      const auto tag = in.number<std::int32_t>("the tag of an entity");
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in.number<double>("the bounds of an entity");
      const auto groups = in.number<std::uint64_t>("the number of an entity's groups");
      in.check_count(groups, msh.bytes(4), "groups");
      auto& list = msh.entities[{dimension, tag}];
      for (std::uint64_t g = 0; g < groups; ++g)
        list.push_back(group_number(in, in.number<std::int32_t>("a physical group")));
      if (dimension == 0) continue;
      const auto borders = in.number<std::uint64_t>("the number of an entity's borders");
      in.check_count(borders, msh.bytes(4), "borders");
      for (std::uint64_t b = 0; b < borders; ++b) in.number<std::int32_t>("the tag of a border");
    }
  }
}

Vec3 read_point(Scanner& in) {
  const double x = in.number<double>("the coordinate of a node");
  const double y = in.number<double>("the coordinate of a node");
  return {x, y, in.number<double>("the coordinate of a node")};
}

void read_nodes_2(Msh& msh) {
  Scanner& in = msh.in;
  const std::uint64_t count = in.size("the number of nodes"); // text also in binary files
  in.check_count(count, in.binary ? 28 : 8, "nodes");
  if (in.binary) in.rest_of_line();
  for (std::uint64_t n = 0; n < count; ++n) {
    const std::int64_t tag = in.binary ? in.raw<std::int32_t>("a node") : in.integer("a node");
    if (tag < 0) in.fail(fmt::format("{} is no tag of a node", tag));
    const std::size_t offset = in.last();
    msh.content.add_node(static_cast<std::uint64_t>(tag), read_point(in), offset);
  }
}

void read_nodes_4(Msh& msh) {
  Scanner& in = msh.in;
  const auto blocks = in.number<std::uint64_t>("the number of blocks of nodes");
  const auto total = in.number<std::uint64_t>("the number of nodes");
  in.check_count(total, msh.bytes(32), "nodes");
  in.number<std::uint64_t>("the smallest tag");
  in.number<std::uint64_t>("the largest tag");
  std::uint64_t seen = 0;
  std::vector<std::pair<std::uint64_t, std::size_t>> tags; // of one block, with their offsets
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const auto dimension = in.number<std::int32_t>("the dimension of a block");
    if (dimension < 0 || dimension > 3) in.fail(fmt::format("{} is no dimension of an entity", dimension));
    in.number<std::int32_t>("the entity of a block");
    const auto parametric = in.number<std::int32_t>("0 or 1, for parametric coordinates");
    if (parametric != 0 && parametric != 1) in.fail("0 or 1 is expected, for parametric coordinates");
    const auto count = in.number<std::uint64_t>("the number of nodes of a block");
    in.check_count(count, msh.bytes(32), "nodes");
    seen += count;
    tags.clear();
    for (std::uint64_t n = 0; n < count; ++n) {
      const auto tag = in.number<std::uint64_t>("the tag of a node");
      tags.push_back({tag, in.last()});
    }
    for (const auto& [tag, offset] : tags) {
      msh.content.add_node(tag, read_point(in), offset);
      for (int k = 0; k < parametric * dimension; ++k) in.number<double>("a parametric coordinate");
    }
  }
  if (seen != total) in.fail(fmt::format("{} nodes were announced, and there are {}", total, seen));
}

const MshType& known_type(const Msh& msh, std::int64_t number, const std::string& who) {
  const MshType* type = number >= 0 && number < 1000 ? find_msh_type(static_cast<int>(number)) : nullptr;
  if (!type)
    msh.in.fail(fmt::format("{} {}", who,
                            unread_msh_type(number >= 0 && number < 1000 ? static_cast<int>(number) : -1)),
                "elements of first order are read; in gmsh: Merge the file, SetOrder 1, Save");
  return *type;
}

// Reads the numbers of an element one by one, from text or binary 2.2.
struct ElementNumbers {
  Scanner& in;
  std::int64_t next(const char* what) const {
    return in.binary ? in.raw<std::int32_t>(what) : in.integer(what);
  }
};

void read_element_2(Msh& msh, const MshType& type, Origin origin, std::int64_t tags,
                    std::vector<std::uint64_t>& nodes) {
  const ElementNumbers numbers{msh.in};
  int group = 0;
  for (std::int64_t t = 0; t < tags; ++t) {
    const std::int64_t tag = numbers.next("a tag of an element");
    if (t == 0) group = group_number(msh.in, tag);
  }
  nodes.clear();
  for (int n = 0; n < type.nodes; ++n)
    nodes.push_back(static_cast<std::uint64_t>(numbers.next("a node of an element")));
  if (!msh.in.binary && !msh.in.line_ends())
    msh.in.source().fail(origin.offset, fmt::format("{} {} has more numbers on its line than {} nodes",
                                                    type.name, origin.tag, type.nodes));
  msh.content.add_element(type, origin, nodes,
                          group == 0 ? std::span<const int>() : std::span<const int>(&group, 1));
}

std::int64_t tag_count(const Msh& msh, std::int64_t tags) {
  if (tags < 0 || tags > 1000) msh.in.fail(fmt::format("{} is no number of tags", tags));
  return tags;
}

void read_elements_2(Msh& msh) {
  Scanner& in = msh.in;
  const ElementNumbers numbers{in};
  const std::uint64_t count = in.size("the number of elements");
  in.check_count(count, msh.bytes(4) * 2, "elements");
  if (in.binary) in.rest_of_line();
  std::vector<std::uint64_t> nodes;
  for (std::uint64_t seen = 0; seen < count;) {
    if (in.binary) { // a header for several elements of one type
      const MshType& type = known_type(msh, numbers.next("the type of elements"), "the element");
      const std::int64_t many = numbers.next("the number of elements of that type");
      if (many < 1 || static_cast<std::uint64_t>(many) > count - seen)
        in.fail(fmt::format("{} elements of a type do not fit into the {} that are left of those announced",
                            many, count - seen));
      const std::int64_t tags = tag_count(msh, numbers.next("the number of tags"));
      for (std::int64_t n = 0; n < many; ++n, ++seen) {
        const std::int64_t number = numbers.next("an element");
        read_element_2(msh, type, {in.last(), static_cast<std::uint64_t>(number)}, tags, nodes);
      }
    } else {
      const std::int64_t number = numbers.next("an element");
      const Origin origin{in.last(), static_cast<std::uint64_t>(number)};
      const MshType& type =
          known_type(msh, numbers.next("the type of an element"), fmt::format("element {}", number));
      const std::int64_t tags = tag_count(msh, numbers.next("the number of tags"));
      read_element_2(msh, type, origin, tags, nodes);
      ++seen;
    }
  }
}

void read_elements_4(Msh& msh) {
  Scanner& in = msh.in;
  const auto blocks = in.number<std::uint64_t>("the number of blocks of elements");
  const auto total = in.number<std::uint64_t>("the number of elements");
  in.check_count(total, msh.bytes(8) * 2, "elements");
  in.number<std::uint64_t>("the smallest tag");
  in.number<std::uint64_t>("the largest tag");
  std::uint64_t seen = 0;
  std::vector<std::uint64_t> nodes;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const auto dimension = in.number<std::int32_t>("the dimension of a block");
    const auto entity = in.number<std::int32_t>("the entity of a block");
    const MshType& type =
        known_type(msh, in.number<std::int32_t>("the type of elements"), "a block of elements");
    if (type.dimension != dimension)
      in.fail(
          fmt::format("a {} is of dimension {}, and its block says {}", type.name, type.dimension, dimension));
    const auto count = in.number<std::uint64_t>("the number of elements of a block");
    in.check_count(count, msh.bytes(8) * static_cast<std::size_t>(1 + type.nodes), "elements");
    seen += count;
    const auto found = msh.entities.find({dimension, entity});
    const std::span<const int> groups = found == msh.entities.end() ? std::span<const int>() : found->second;
    for (std::uint64_t n = 0; n < count; ++n) {
      const auto tag = in.number<std::uint64_t>("the tag of an element");
      const Origin origin{in.last(), tag};
      nodes.clear();
      for (int k = 0; k < type.nodes; ++k) nodes.push_back(in.number<std::uint64_t>("a node of an element"));
      if (!in.binary && !in.line_ends())
        in.source().fail(origin.offset, fmt::format("{} {} has more numbers on its line than {} nodes",
                                                    type.name, tag, type.nodes));
      msh.content.add_element(type, origin, nodes, groups);
    }
  }
  if (seen != total) in.fail(fmt::format("{} elements were announced, and there are {}", total, seen));
}

void skip_section(Msh& msh, const std::string& name) {
  const std::string_view bytes = msh.file.source.bytes();
  const std::string end = "$End" + name;
  const std::size_t found = bytes.find("\n" + end, msh.in.offset() == 0 ? 0 : msh.in.offset() - 1);
  if (found == std::string_view::npos)
    msh.in.fail(fmt::format("the section ${} has no end", name), end + " ends it");
  msh.in.go_to(found + 1);
}

void read_section(Msh& msh, const std::string& name) {
  Scanner& in = msh.in;
  if (in.binary && name != "PhysicalNames") in.rest_of_line();
  if (name == "PhysicalNames") {
    read_names(msh);
  } else if (name == "Entities" && msh.version4) {
    read_entities(msh);
  } else if (name == "Nodes") {
    if (msh.content.has_nodes()) in.fail("there is a second section $Nodes");
    if (msh.version4)
      read_nodes_4(msh);
    else
      read_nodes_2(msh);
    msh.content.close_nodes();
  } else if (name == "Elements") {
    if (!msh.content.has_nodes()) in.fail("$Elements stands before $Nodes");
    if (msh.version4)
      read_elements_4(msh);
    else
      read_elements_2(msh);
  } else {
    skip_section(msh, name);
  }
  end_section(msh, name);
}

void read_msh(MeshFile& file) {
  Msh msh(file);
  if (msh.in.token("$MeshFormat") != "$MeshFormat") msh.in.fail("a Gmsh file starts with $MeshFormat");
  read_format(msh);
  bool elements = false;
  while (!msh.in.at_end()) {
    const std::string_view head = msh.in.token("a section");
    if (head.size() < 2 || head[0] != '$' || head.starts_with("$End"))
      msh.in.fail(fmt::format("a section such as $Nodes is expected, and {} is none", in_quotes(head)));
    elements = elements || head == "$Elements";
    read_section(msh, std::string(head.substr(1)));
  }
  if (!elements) file.source.fail("the file ends without a section $Elements", "it may have been cut off");
  msh.content.finish();
}

} // namespace

MeshReader msh_reader() {
  return {"Gmsh", {".msh"}, "versions 2.2 and 4.1, ASCII and binary, elements of first order", read_msh};
}

} // namespace rend
