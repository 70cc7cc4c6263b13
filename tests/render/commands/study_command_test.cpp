// rend study, as a user runs it.
#include "tests/render/commands/program_run.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>

namespace rend::study_command_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const char* hanging =
    R"(<scene name="hanging"><body name="cloth"><sheet cells="3 3" size="1 1"/><mass total="0.1"/>
  <springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs><viscosity value="0.1" per="body"/>
  <fix side="-x"/></body><time step="1e-3" integrator="rk4" duration="1"/></scene>)";

// An independent parser of RFC 4180.
std::vector<std::vector<std::string>> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows{{""}};
  bool quoted = false;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const char c = text[n];
    if (quoted && c == '"' && n + 1 < text.size() && text[n + 1] == '"') {
      rows.back().back() += text[n++];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.emplace_back(1);
    } else if (quoted || c != '\r') {
      rows.back().back() += c;
    }
  }
  rows.pop_back(); // after the last line's end
  return rows;
}

TEST(StudyCommand, writes_a_page_tables_and_plots_that_agree) {
  const TestFolder place;
  place.write("hanging.xml", hanging);
  const Outcome made =
      place.rend("study hanging.xml --quick --integrators symplectic,verlet,rk4 -o here -q --json");
  ASSERT_EQ(made.code, 0) << made.err;
  const auto json = made.json();
  const auto rows = read_csv(program::content(place.path() / "here/study.csv"));
  ASSERT_EQ(rows.size(), json["rows"].size() + 1);
  std::map<std::string, std::size_t> column;
  for (std::size_t n = 0; n < rows[0].size(); ++n) column[rows[0][n]] = n;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const auto& one = json["rows"][n - 1];
    ASSERT_EQ(rows[n].size(), rows[0].size());
    for (const char* name : {"step", "error", "seconds", "position_l2", "energy_drift"}) {
      const std::string& field = rows[n][column.at(name)];
      if (one[name].is_null())
        EXPECT_EQ(field, "") << name;
      else
        EXPECT_EQ(std::stod(field), one[name].get<double>()) << name << ": all digits are there";
    }
    EXPECT_EQ(rows[n][column.at("outcome")], one["outcome"].get<std::string>());
    EXPECT_EQ(rows[n][column.at("reason")].empty(), one["outcome"] == "done");
  }
  const std::string page = program::content(place.path() / "here/index.html");
  for (const char* part : {"Study of hanging", "To come within 1 % of the motion", "Time to reach", "Orders",
                           "All runs", "XXH3", "--integrators symplectic,verlet,rk4"})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("src=\"http")), Not(HasSubstr("href=\"http")), Not(HasSubstr("nan"))));
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  for (const char* plot : {"work-precision", "order", "energy"}) {
    EXPECT_THAT(program::content(place.path() / (fmt::format("here/{}.svg", plot))), HasSubstr("</svg>"));
    EXPECT_EQ(program::content(place.path() / (fmt::format("here/{}.png", plot))).substr(1, 3), "PNG");
  }
}

TEST(StudyCommand, does_without_gnuplot_and_says_so) {
  const TestFolder place;
  place.write("hanging.xml", hanging);
  const Outcome made =
      place.shell("PATH=/nowhere " + std::string(test::rend_program) +
                  " study hanging.xml --quick --steps 3 --integrators verlet --duration 0.05 -q");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("gnuplot is not installed"));
  EXPECT_THAT(program::content(place.path() / "out/hanging-study/index.html"), HasSubstr("no plots"));
  EXPECT_FALSE(std::filesystem::exists(place.path() / "out/hanging-study/order.svg"));
}

TEST(StudyCommand, sweeps_meshes_and_attributes_against_the_first) {
  const TestFolder place;
  place.write("hanging.xml", hanging);
  const Outcome made =
      place.rend("study hanging.xml --quick --steps 3 --integrators verlet --duration 0.05 -q --json "
                 "--refine 1,2 --sweep body.springs.cumulated=yes,no -o o");
  ASSERT_EQ(made.code, 0) << made.err;
  const auto references = made.json()["references"];
  ASSERT_EQ(references.size(), 4u);
  EXPECT_EQ(references[0]["group"], "mesh × 2, body.springs.cumulated=yes");
  EXPECT_EQ(references[0]["elements"], 36);
  EXPECT_EQ(references[2]["elements"], 9);
  EXPECT_LT(references[1]["distance"].get<double>(), 1e-10) << "cumulated springs are the same springs";
  EXPECT_GT(references[2]["distance"].get<double>(), 1e-3) << "a coarser mesh is another cloth";
}

TEST(StudyCommand, refuses_before_it_runs) {
  const TestFolder place;
  place.write("hanging.xml", hanging);
  const auto refused = [&](const std::string& arguments, int code, const std::string& words) {
    const Outcome made = place.rend("study hanging.xml " + arguments);
    EXPECT_EQ(made.code, code) << arguments << made.err;
    EXPECT_THAT(made.err, HasSubstr(words)) << arguments;
    EXPECT_EQ(made.out, "");
  };
  refused("--integrators rk4,verlett", 64, "did you mean 'verlet'?");
  refused("--integrators rk4,rk4", 64, "there twice");
  refused("--integrators static", 64, "has no time steps to study");
  refused("--sweep body.springs.cumulated", 64, "PATH=a,b,c");
  refused("--sweep body.springs.cumulatd=yes,no", 64, "cumulated");
  refused("--sweep time.step=1,2", 64, "--steps");
  refused("--sweep body.springs.cumulated=yes,maybe", 65, "maybe");
  refused("--refine 0", 64, "is not a factor");
  refused("--duration 2", 64, "1 s only");
  refused("--steps 1", 64, "--steps");
  refused("-o hanging.xml", 73, "hanging.xml");
  refused("-o /proc/none", 73, "/proc/none");
  EXPECT_EQ(place.rend("study nothing.xml").code, 66);
  // A mesh from a file cannot be refined; without refinement it can be studied.
  place.write("two.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  std::string of_file = hanging;
  const std::string generated = R"(<sheet cells="3 3" size="1 1"/>)";
  place.write("file.xml",
              of_file.replace(of_file.find(generated), generated.size(), R"(<mesh file="two.off"/>)"));
  for (const char* factors : {"1,2", "3"}) {
    const Outcome made = place.rend(std::string("study file.xml --quick -q --refine ") + factors);
    EXPECT_EQ(made.code, 64) << made.err;
    EXPECT_THAT(made.err, AllOf(HasSubstr(std::string("--refine ") + factors),
                                HasSubstr("the mesh of body 1 comes from a file"),
                                HasSubstr("<sheet>, <bar> or <tube>")));
    EXPECT_EQ(made.out, "");
  }
  EXPECT_FALSE(std::filesystem::exists(place.path() / "out"));
}

} // namespace
} // namespace rend::study_command_test
