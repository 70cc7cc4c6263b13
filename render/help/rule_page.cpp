#include "render/help/rule_page.h"

#include "render/help/folding.h"
#include "sim/expression/functions.h"
#include "sim/rules/rule_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace rend {
namespace {

constexpr const char* page_language =
    R"page(A rule changes the map of a body: where its left graph matches, its right graph takes the place.

THE MAP consists of darts. A dart is one end of one side of a face, and has four links:
  α0 to the other end of the side             α2 to the next face, across the side
  α1 to the next side, at the same corner     α3 to the next volume, through the face
A link that leads nowhere is free: it leads to the dart itself. In a sheet every α3 is free. What is
reached from a dart by some of the links is an orbit, and cells are orbits: vertex <1,2,3>, edge
<0,2,3>, face <0,1,3>, the same of one volume (or of a sheet) <0,1>, volume <0,1,2>, component
<0,1,2,3>. A hole's border is no cell: fill it with a face per side and sew-edges with="touching".

GRAPHS. left="..." and right="..." hold items in any order, separated by spaces:
  a*(0,1)  a hook: it stands for all darts of an orbit at once, here for those of a face; a*(1,2,3)
           for a vertex, a*(0,2,3) for an edge, a*(0,1,2) for a volume. Its links may be free, as α2
           is at a border. Each connected part of the left graph has one, the right graph has none.
  b(_,2)   a node: one dart beside each dart of the hook's orbit. Position k of its label tells what
           the hook's k-th link becomes there: kept, renamed, or dropped (_). With a*(0,1), b's
           darts are not linked where α0 links those of a, and by α2 where α1 links those of a.
  b        a node with an empty label, as all have beside a hook a*, which is a single dart
  a-1-b    an arc: α1 links the darts of a and b
  a|2,3    α2 and α3 of a are free
A node on both sides is kept. What the left graph does not mention of its links stays; what the left
mentions, the right must mention, too, and nothing else. The right states the label anew. A node on
the right alone is created, one on the left alone removed: there it says of all four links what is.
α0 α2, α0 α3, α1 α3 must close: what α2 links at one end of an α0, it links at the other end, too.
So with an arc a-2-b, 0 stands at the same place of both labels, or in neither; with a-0-c and a-2-b
goes a node d that both lead to, by b-0-d and c-2-d; with a-0-c and a|2 goes c|2. left="" creates.

VALUES are elements within <rule>:
  <set node="c" position="..." rest="..." velocity="..."/>   the point of a new vertex, or where two
      become one, as where a dart passes to another vertex: these need it; or of a kept one, which
      moves. Once a vertex. rest, velocity follow; a kept one's mass stays, in <tear> its rest.
  <when test="size(a, face) > 3" at="all|any" otherwise="why not"/>   a further condition, asked at
      the hook's dart, or at all or any darts of its orbit
  <where name="h" value="0.1"/>   an argument, a number or point(x, y, z), and its default
  <let name="m" value="mean(a, face)"/>   a name for an expression, for those that follow
may-fold="yes" of <rule>: darts of the left graph may coincide; for rules that only open links.
In XML a < within an attribute is written &lt; and & is &amp;: test="size(a, face) &lt; 5".

EXPRESSIONS know numbers, + - * / ^, < <= > >= == !=, and, or, not, if(test, u, v). A node is its
point before the rule; alpha(a, 2), the dart across α2, may stand for a. A value must be the same at
all darts of its vertex: in an edge's middle mean(a, edge) is, and a, one of its two ends, is not:
)page";

constexpr const char* page_use = R"page(
SCRIPTS apply rules to one cell after another, as one change: all of it is done, or nothing.
  <script name="s" hook="a*(0,1)"> <for each="e*(0)" where="length(e) > 1" apply="NAME"/> </script>
applies NAME to each side e of face a, and of what earlier steps made of it, where the test holds;
at="all|any": at all or any darts of e. which="old|new": only cells with darts from before, or none.
at-least="one|none": how often it must apply (all). mark="m": what it met or made is marked(e, m)
in later steps. Without each: once. Other attributes: arguments of NAME.

USE. Rules and scripts stand in a <scene>, or in a file of <rules>: <rules file="mine.xml"/> there.
  <apply rule="smooth" times="2" t="0.3"/>   in a <body>, after its shape: t is an argument; where
      all vertices of the hook's orbit are selected: side="+x"; a box around one edge; to="all"
  <create dimension="2"/>   nothing, for rules like create-quad; <mesh file="cube.obj"/>: a surface
To build alone: duration="0"; rend run S.xml --export obj -o DIR writes it.
rend rule list | show NAME: the rules there are; check FILE; draw NAME --in FILE -o F.svg: see it.

EXAMPLES, a file of rules:
)page";

constexpr const char* page_examples =
    R"page(<rules>
  <!-- c is the new vertex, b the other end of a line to it. The face's α1 is cut; a-1-b turns into
       the triangle of a's side. Where α1 led, b and c go on by α2, to the next triangle. -->
  <rule name="star" about="a triangle on each side of a face of a sheet, around a new vertex c"
        left="a*(0,1) a|3"   right="a(0,_) b(_,2) c(1,2)   a-1-b b-0-c   a|3 b|3 c|3">
    <set node="c" position="mean(a, face)"/> </rule>
  <!-- The hook is an edge: two darts a in each of its faces, which α0 joins, and α2 across. In a
       triangle b and c are the next side, and c's α1 leads where a's α0 leads: 1 in place of 0. -->
  <rule name="cut-edge" about="an edge of a sheet of triangles and its triangles are cut in two"
        left="a*(0,2) b(_,_) c(1,_)  a-1-b b-0-c  a|3 b|3 c|3"
        right="a(_,2) b(_,_) c(_,_) g(_,2) h(2,_) i(2,_)  a-1-b b-0-c a-0-g g-1-h h-0-i i-1-c
               a|3 b|3 c|3 g|3 h|3 i|3">
    <set node="g" position="mean(a, edge)"/> </rule>
  <script name="cut-in-half" about="a triangle off each corner of all faces" hook="a*(0,1,2,3)">
    <for each="e*(0,2,3)" apply="insert-vertex"/>
    <for each="e*(1,3)" which="old" apply="cut-face-corner"/> </script>
  <script name="cut-at" about="cut-edge at one edge, that with its middle at p" hook="a*(0,1,2)">
    <where name="p" value="point(0, 0, 0)"/>
    <for each="e*(0,2)" where="norm(mean(e, edge) - p) &lt; 1e-3" apply="cut-edge"/> </script>
  <rule name="smooth" about="vertices go a share t of the way to the mean of their neighbours"
        left="a*(1,2,3)" right="a(1,2,3)">
    <where name="t" value="0.5"/>
    <let name="goal" value="if(size(a, border) > 0, mean(a, border), mean(a, neighbours))"/>
    <set node="a" position="lerp(a, goal, t)"/> </rule>
</rules>
)page";

// Items one after another, on lines that are indented by two.
std::string folded_items(const std::vector<std::string>& items, const std::string& indent) {
  std::string out, line;
  for (const std::string& item : items) {
    if (!line.empty() && width(line) + 1 + width(item) > page_columns) {
      out += line + "\n";
      line.clear();
    }
    line += line.empty() ? (out.empty() ? "" : indent) + item : " " + item;
  }
  return out + line + "\n";
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

// Those of numbers mean what they always do, or tell their arguments in words.
std::string told(const ExpressionFunction& function, const std::string& names) {
  const bool of_numbers = function.result == ValueType::Scalar &&
                          std::all_of(function.arguments.begin(), function.arguments.end(),
                                      [](ValueType type) { return type == ValueType::Scalar; });
  if (!of_numbers) return names + ": " + function.about;
  return function.about.starts_with(function.name + "(") ? function.about : function.name;
}

// Functions without words of their own are told with the next one that has some.
template <class Functions, class Declared, class Put>
void each_told(const Functions& functions, const Declared& declared, const Put& put) {
  std::string names;
  for (const auto& each : functions) {
    const ExpressionFunction& function = declared(each);
    names += (names.empty() ? "" : ", ") + signature(function);
    if (function.about.empty()) continue;
    put(function, names);
    names.clear();
  }
}

std::string functions_on_page() {
  std::string out;
  each_told(
      rule_vocabulary({}, {}),
      [](const ExpressionFunction& function) -> const ExpressionFunction& { return function; },
      [&](const ExpressionFunction& function, const std::string& names) {
        std::vector<std::string> words = words_of(function.about);
        words.front() = fmt::format("  {:<28} {}", names, words.front());
        out += folded_items(words, std::string(31, ' '));
      });
  std::vector<std::string> known;
  each_told(
      built_ins(), [](const BuiltIn& each) -> const ExpressionFunction& { return each.declared; },
      [&](const ExpressionFunction& function, const std::string& names) {
        for (const std::string& word : words_of(told(function, names) + ";")) known.push_back(word);
      });
  known.front() = "  Angles are in radians: " + known.front();
  known.back().pop_back();
  return out + folded_items(known, "  ");
}

} // namespace

std::string rule_examples() {
  return page_examples;
}

std::string rule_page() {
  return page_language + functions_on_page() + page_use + page_examples;
}

} // namespace rend
