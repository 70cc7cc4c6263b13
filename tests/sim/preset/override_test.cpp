#include "sim/preset/override.h"

#include "tests/sim/preset/reading.h"

#include <array>
#include <gtest/gtest.h>
#include <random>

namespace rend::override_test {
namespace {

using namespace small_table;

std::string refused_set(const std::string& set, Exit code = Exit::Usage) {
  return refusal(code, [&] { read(preset, {set}); });
}

TEST(Override, ReplacesAndAddsAttributes) {
  const auto root = read(preset, {"time.step=1e-4", "scene.name=other", "body[left].tear[2].threshold=2",
                                  "body[2].sheet.cells=64 64", "body[left].tear[rim].threshold=3",
                                  "body[left].springs.stretch.damping=0.1"});
  EXPECT_EQ(root->text("name"), "other");
  EXPECT_EQ(root->child("time")->number("step"), 1e-4);
  const PresetNode& left = *root->all("body")[0];
  EXPECT_EQ(left.all("tear")[1]->number("threshold"), 2);
  EXPECT_EQ(left.all("tear")[0]->number("threshold"), 3);
  EXPECT_EQ(left.child("springs")->child("stretch")->number("damping"), 0.1);
  EXPECT_EQ(root->all("body")[1]->child("sheet")->numbers("cells"), (std::vector<double>{64, 64}));
  EXPECT_EQ(read(preset, {"name=third"})->text("name"), "third");
}

TEST(Override, TheLastOneWins) {
  EXPECT_EQ(read(preset, {"time.step=1", "time.step=2"})->child("time")->number("step"), 2);
}

TEST(Override, MakesAnElementThatMayStandOnce) {
  const auto root = read(preset, {"hud.show=title time", "body[right].springs.stretch.k=7"});
  EXPECT_EQ(root->child("hud")->words("show").size(), 2U);
  const PresetNode& springs = *root->all("body")[1]->child("springs");
  EXPECT_EQ(springs.child("stretch")->number("k"), 7);
  EXPECT_FALSE(springs.flag("cumulated"));
  EXPECT_NE(refused_set("body[right].tear.threshold=1").find("there is no <tear> in this <body>"),
            std::string::npos);
  // An element created by an override must be complete as well.
  EXPECT_EQ(refused_set("body[right].springs.stretch.damping=1", Exit::BadInput).substr(0, 79),
            "--set body[right].springs.stretch.damping=1: <stretch> needs k | k: stiffness; ");
}

TEST(Override, HasItsValueBeforeAnyIsLookedAt) {
  const std::string bad = changed("step=\"1e-3\"", "step=\"never\"");
  EXPECT_EQ(read(bad, {"time.step=1"})->child("time")->number("step"), 1);
}

TEST(Override, PointsAtABadValue) {
  expect_starts(
      refused_set("time.step=abc", Exit::BadInput),
      "--set time.step=abc: step of <time> is 'abc', which is not known here; expected auto, or a number");
  expect_starts(refused_set("version=2", Exit::BadInput), "--set version=2: the preset is of version '2'");
}

TEST(Override, NamesThePartOfAPathThatIsNotThere) {
  EXPECT_EQ(refused_set("tiem.step=1"),
            "--set tiem.step=1: there is no element 'tiem' in <scene> | did you mean "
            "'time'? in <scene> may stand: body, time, hud, camera, map");
  EXPECT_EQ(refused_set("time.stp=1"),
            "--set time.stp=1: <time> has no attribute 'stp' | did you mean 'step'? <time> "
            "has: step, integrator");
  EXPECT_EQ(refused_set("time=1"),
            "--set time=1: <time> is an element: the path must end with an attribute of it");
  EXPECT_EQ(refused_set("time.step.x=1"),
            "--set time.step.x=1: step is an attribute of <time>, not an element");
  EXPECT_EQ(refused_set("time.step[1]=1"),
            "--set time.step[1]=1: step is the last part and so an attribute, which takes no brackets");
}

TEST(Override, AsksWhichWhereThereAreSeveral) {
  EXPECT_EQ(refused_set("body.name=x"),
            "--set body.name=x: there are 2 <body> in <scene> | say which, as body[1] or "
            "by its name: 1 left, 2 right");
  EXPECT_EQ(refused_set("body[lft].name=x"),
            "--set body[lft].name=x: there is no body[lft] in <scene>, which has 2 "
            "<body> | did you mean 'left'? there are: left, right");
  for (const std::string which : {"0", "3", "99999999999999999999999", "-1", "1.0"})
    EXPECT_NE(refused_set("body[" + which + "].name=x").find("there is no body["), std::string::npos) << which;
  EXPECT_EQ(refusal(Exit::Usage,
                    [] {
                      read(preset, {"body[2].name=left", "body[left].name=x"});
                    }),
            "--set body[left].name=x: 2 <body> are called 'left' | say which by its number");
}

TEST(Override, RefusesAMalformedPath) {
  EXPECT_EQ(refused_set("time.step"),
            "--set time.step: there is no '=' in it | write --set PATH=VALUE, such as --set time.step=1e-4");
  for (const std::string set : {"", "=1", ".=1", "time.=1", ".step=1", "time..step=1", "[1].x=1", "body[]=1",
                                "body[left.name=1", "body[left]name=1", "body].name=1", "body[left]]=1"})
    EXPECT_NE(refused_set(set), "") << set;
}

TEST(Override, TakesDotsAndSignsInNames) {
  const std::string text = changed("name=\"left\"", "name=\"a.b=c\"");
  EXPECT_EQ(read(text, {"body[a.b=c].name=x=y"})->child("body")->text("name"), "x=y");
}

TEST(Override, ReadsOrRefusesWhateverPathItIsGiven) {
  constexpr std::array<const char*, 14> pieces = {"body", "[",    "]", ".",    "=", "1",     "left",
                                                  "time", "step", "x", "tear", " ", "scene", "2"};
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    std::string set;
    for (std::size_t n = random() % 9; n > 0; --n) set += pieces[random() % pieces.size()];
    try {
      read(preset, {set});
    } catch (const UserError& error) {
      EXPECT_NE(error.hint + error.what(), "");
    }
  }
}

} // namespace
} // namespace rend::override_test
