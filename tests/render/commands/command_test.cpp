// The program as a user runs it: exit codes, files, figures.
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

namespace rend::command_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class Program : public testing::Test {
protected:
  Program() { place.write("pulled.xml", program::pulled); }
  const TestFolder place;

  void expect_nothing_left() const { EXPECT_EQ(place.files(), std::vector<std::string>{"pulled.xml"}); }
};

TEST_F(Program, SaysWhatItIs) {
  EXPECT_THAT(place.rend("--version").out, StartsWith("rend "));
  EXPECT_EQ(place.rend("--version").code, 0);
  const Outcome help = place.rend("--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("render"), HasSubstr("run"), HasSubstr("info")));
  EXPECT_THAT(place.rend("render --help").out, HasSubstr("--frames"));
  EXPECT_EQ(place.rend("help render").out, place.rend("render --help").out);
  EXPECT_EQ(place.rend("help").out, help.out);
}

TEST_F(Program, ExplainsPresets) {
  EXPECT_THAT(place.rend("help preset").out, AllOf(HasSubstr("scene.body.sheet"), HasSubstr("scene.camera")));
  EXPECT_THAT(place.rend("help preset stretch").out, HasSubstr("stiffness"));
  EXPECT_THAT(place.rend("help tear").out, AllOf(HasSubstr("atomic-border"), HasSubstr("split-vertex")));
  EXPECT_EQ(place.rend("help preset strech").code, 64);
  const Outcome schema = place.rend("help schema > scene.xsd && xmllint --noout --schema scene.xsd pulled.xml");
  EXPECT_EQ(schema.code, 0) << schema.err;
}

TEST_F(Program, RefusesABadCommandLine) {
  for (const char* line :
       {"rnder pulled.xml", "render", "render pulled.xml other.xml", "render pulled.xml --frame 3",
        "run pulled.xml --steps -1", "run pulled.xml --steps 1.5", "run pulled.xml --kernels fast",
        "run pulled.xml --threads 0", "run pulled.xml --fps 0", "render pulled.xml --size 12",
        "render pulled.xml --frames 5-3", "render pulled.xml --frames 100-200", "render pulled.xml --video avi",
        "render pulled.xml --no-png", "run pulled.xml --set time", "run pulled.xml --set time.stpe=1",
        "help nothing", "help render frames"}) {
    const Outcome outcome = place.rend(line);
    EXPECT_EQ(outcome.code, 64) << line << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("rend: error: "), HasSubstr("\n  hint: "))) << line;
    EXPECT_EQ(outcome.out, "") << line;
  }
  EXPECT_THAT(place.rend("rnder pulled.xml").err, HasSubstr("did you mean 'render'?"));
  expect_nothing_left();
}

TEST_F(Program, TellsWhatWasMeantByAFileInAWrongPlace) {
  place.write("box.obj", "v 0 0 0\n");
  EXPECT_THAT(place.rend("pulled.xml").err, HasSubstr("rend render 'pulled.xml' makes pictures of it"));
  EXPECT_THAT(place.rend("box.obj").err, HasSubstr("rend mesh info 'box.obj'"));
  EXPECT_THAT(place.rend("run pulled.xml --set body.tear.criterion=stress").err,
              HasSubstr("did you mean 'vertex-stress'?"));
  const Outcome mesh = place.rend("run box.obj");
  EXPECT_EQ(mesh.code, 65);
  EXPECT_THAT(mesh.err, AllOf(HasSubstr("this is a mesh"), HasSubstr("<mesh file='box.obj'/>")));
  for (const char* option : {"--events", "--diagnostics"}) {
    const Outcome outcome = place.rend(std::string("run pulled.xml --steps 1 ") + option + " -");
    EXPECT_EQ(outcome.code, 64);
    EXPECT_THAT(outcome.err, HasSubstr("'-' (standard output) is not possible here"));
  }
  EXPECT_EQ(place.files(), (std::vector<std::string>{"box.obj", "pulled.xml"}));
}

TEST_F(Program, RefusesAPictureThatThisMachineCannotDrawBeforeTheFirstStep) {
  NEEDS_PNG;
  const Outcome outcome = place.rend("render pulled.xml -o frames --size 8192x8192 --set image.samples=16");
  EXPECT_EQ(outcome.code, 65);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("a picture of 8192 x 8192"), HasSubstr("fewer samples")));
  expect_nothing_left();
}

TEST_F(Program, RefusesAKindOfVideoThatIsNotThere) {
  NEEDS_VIDEO;
  for (const char* kind : {"mpeg4", "clip.mp4", "mp"}) {
    const Outcome outcome = place.rend(std::string("render pulled.xml -o frames --video ") + kind);
    EXPECT_EQ(outcome.code, 64) << kind;
    EXPECT_THAT(outcome.err, HasSubstr("mp4, webm, mkv, gif, apng")) << kind;
  }
  EXPECT_THAT(place.rend("render pulled.xml --video clip.mp4").err, HasSubstr("did you mean 'mp4'?"));
  expect_nothing_left();
}

TEST_F(Program, NotesThatPicturesWillShowNothing) {
  NEEDS_PNG;
  const std::string line = "render pulled.xml --steps 0 -o frames ";
  const std::string away = "--set camera.eye='0 0 3' --set camera.target='0 0 6'";
  EXPECT_THAT(place.rend(line + away).err,
              AllOf(HasSubstr("the camera sees no body"), HasSubstr("body 'cloth' is between (0, ")));
  const std::string beside = "--set camera.eye='2 -3 0.5' --set camera.target='2 0 0.5' --set camera.fov=20 ";
  EXPECT_THAT(place.rend(line + beside).err, HasSubstr("the camera sees no body"));
  EXPECT_THAT(place.rend(line + beside + "--size 256x48").err, testing::Not(HasSubstr("sees no body")));
  const std::string near =
      "--set camera.eye='0.45 0.01 0.45' --set camera.target='0.45 0 0.45'"; // within a cell
  EXPECT_THAT(place.rend(line + near).err, testing::Not(HasSubstr("sees no body")));
  EXPECT_EQ(place.rend(line + away + " --quiet").err, "");
}

TEST_F(Program, RefusesWhatItWasBuiltWithout) {
  if (png_available() && video_available()) GTEST_SKIP() << "built with all";
  if (!png_available()) {
    for (const char* line : {"render pulled.xml", "sheet pulled.xml -o sheet.png"}) {
      const Outcome outcome = place.rend(line);
      EXPECT_EQ(outcome.code, 64) << line;
      EXPECT_THAT(outcome.err, AllOf(HasSubstr("built without PNG"), HasSubstr("-DREND_PNG=ON"))) << line;
    }
  }
  if (!video_available()) {
    const Outcome outcome = place.rend("render pulled.xml --video mp4 --no-png");
    EXPECT_EQ(outcome.code, 64);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("built without video"), HasSubstr("-DREND_VIDEO=ON")));
  }
  expect_nothing_left();
}

TEST_F(Program, SaysWhereASetValueIsBad) {
  const Outcome outcome = place.rend("run pulled.xml --set time.step=x");
  EXPECT_EQ(outcome.code, 65);
  EXPECT_THAT(outcome.err, StartsWith("rend: error: --set time.step=x: step of <time> is 'x'"));
}

TEST_F(Program, HasOneExitCodeForAFileThatIsNotThere) {
  NEEDS_PNG;
  place.write("one.png", "");
  for (const char* line : {"render none.xml", "run none.xml", "info none.xml", "batch none.xml",
                           "batch none --run", "sheet none.xml -o s.png", "check none.xml", "study none.xml",
                           "mesh info none.msh", "mesh convert none.msh out.moka", "rule check none.xml",
                           "rule list none.xml", "list none", "diff none one.png", "diff one.png none",
                           "diff one.png one.png -t none.xml", "diff one.png one.png --mask none.png"}) {
    const Outcome outcome = place.rend(line);
    EXPECT_EQ(outcome.code, 66) << line << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("none")) << line;
  }
}

TEST_F(Program, NamesUnknownOptionsInTheirOrderWithTheNearest) {
  const Outcome outcome = place.rend("render pulled.xml --sze 3x3 --frmes 2 extra.xml");
  EXPECT_EQ(outcome.code, 64);
  EXPECT_THAT(outcome.err, HasSubstr("rend render has no options '--sze', '--frmes'"));
  EXPECT_THAT(outcome.err,
              HasSubstr("did you mean '--size', '--frames'? rend render --help lists what it takes"));
  EXPECT_THAT(place.rend("run pulled.xml --frames").err, HasSubstr("--frames needs a value"));
  EXPECT_THAT(place.rend("run pulled.xml --kernels fast").err, HasSubstr("fast is not one of flat, walk"));
  EXPECT_THAT(place.rend("render").err, HasSubstr("PRESET is missing"));
}

TEST_F(Program, PrintsTheShortHelpWhereNothingIsAsked) {
  const Outcome outcome = place.rend("");
  EXPECT_EQ(outcome.code, 64);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("render"), HasSubstr("list"), HasSubstr("rend COMMAND --help")));
}

TEST_F(Program, SaysThatAPresetIsMissing) {
  NEEDS_PNG;
  const Outcome outcome = place.rend("render puled.xml");
  EXPECT_EQ(outcome.code, 66);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'pulled.xml'?"));
  expect_nothing_left();
}

TEST_F(Program, CannotWriteWhereAFileIs) {
  NEEDS_PNG;
  EXPECT_EQ(place.rend("render pulled.xml -o pulled.xml/frames").code, 73);
  EXPECT_EQ(place.rend("run pulled.xml --diagnostics nowhere/d.csv").code, 73);
  EXPECT_EQ(place.rend("run pulled.xml --json > /dev/full").code, 74);
  expect_nothing_left();
}

// A pipe whose reader has closed: the shell holds both ends, and closes the reading one.
TEST_F(Program, EndsQuietlyWhereNobodyReadsItsResults) {
  const std::string pipe = "mkfifo pipe; exec 3<>pipe 4>pipe 3>&-; rm pipe; ";
  for (const char* line : {"help preset", "help schema", "--help", "--version", "run --help", "info pulled.xml",
                           "run pulled.xml --steps 1 --json", "check pulled.xml --list"}) {
    const Outcome outcome = place.shell(pipe + test::rend_program + " " + line + " >&4");
    EXPECT_EQ(outcome.code, 141) << line;
    EXPECT_EQ(outcome.err, "") << line;
  }
  EXPECT_EQ(place.rend("help preset > /dev/full").code, 74); // a full disk is an error
  // Failing to write to stderr is not an error of the run.
  EXPECT_EQ(place.shell(pipe + test::rend_program + " check pulled.xml --only threads 2>&4").code, 0);
  EXPECT_EQ(place.shell(pipe + test::rend_program + " run missing.xml 2>&4").code, 66);
  expect_nothing_left();
}

TEST_F(Program, FindsAnEquilibriumWithoutBeingToldATime) {
  place.write("hanging.xml", R"(<scene name="hanging"><body><bar cells="4 1 1" size="1 0.2 0.2"/>
  <mass total="1"/><elasticity model="linear" young="1e5" poisson="0.3"/><fix side="-x"/></body>
  <world gravity="0 0 -9.81"/><time integrator="static"/></scene>)");
  const Outcome outcome = place.rend("run hanging.xml --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["steps"], 1);
  EXPECT_EQ(outcome.json()["time"], 1);
  EXPECT_EQ(place.rend("run hanging.xml --json --set time.step=1 --set time.duration=1").json()["hash"],
            outcome.json()["hash"]);
  EXPECT_THAT(place.rend("info hanging.xml").out, HasSubstr("auto: all of the clip, one equilibrium"));
  EXPECT_EQ(place
                .shell(std::string(test::rend_program) +
                       " help schema > scene.xsd && xmllint --noout --schema scene.xsd hanging.xml")
                .code,
            0);
  EXPECT_THAT(place.rend("run hanging.xml --set time.integrator=implicit").err,
              HasSubstr("<time> needs duration"));
}

TEST_F(Program, LeavesNothingBehindWhereItExplodesAtOnce) {
  NEEDS_VIDEO;
  NEEDS_PNG;
  for (const char* step : {"1e3", "1e5", "1e9"}) {
    const std::string set = std::string(" --set time.step=") + step;
    const Outcome render = place.rend("render pulled.xml -o deep/in/frames --video mp4" + set);
    EXPECT_EQ(render.code, 76);
    EXPECT_THAT(render.err, AllOf(HasSubstr("unstable"), HasSubstr("hint: at rest, steps up to")));
    EXPECT_EQ(place.rend("run pulled.xml --diagnostics d.csv --events e.jsonl" + set).code, 76);
    expect_nothing_left();
  }
}

TEST_F(Program, TellsTheLastGoodStateOfAnUnstableRun) {
  const Outcome outcome = place.rend("run pulled.xml --json --set time.step=1e4");
  EXPECT_EQ(outcome.code, 76);
  EXPECT_EQ(outcome.json()["stopped"], "unstable");
  EXPECT_EQ(outcome.json()["steps"], 0);
  EXPECT_LT(outcome.json()["energy"]["kinetic"], 1);
}

TEST_F(Program, PrintsItsFiguresUnderTheNamesOfTheContract) {
  const Outcome outcome = place.rend("run pulled.xml --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json f = outcome.json();
  for (const char* key : {"preset",   "integrator",       "step",     "steps",  "evaluations",
                          "time",     "vertices",         "elements", "darts",  "fragments",
                          "tears",    "stopped",          "seconds",  "energy", "mass",
                          "momentum", "angular_momentum", "probes",   "bytes",  "rows",
                          "hash"})
    EXPECT_TRUE(f.contains(key)) << key;
  for (const char* key : {"total", "build", "bind", "step", "forces", "criteria", "change", "rebind", "surface",
                          "draw", "png", "video"})
    EXPECT_TRUE(f["seconds"].at(key).is_number()) << key;
  for (const char* key : {"map", "embeddings", "program", "surface", "peak_rss"})
    EXPECT_TRUE(f["bytes"].at(key).is_number_unsigned()) << key;
  for (const char* key : {"kinetic", "elastic", "gravity"}) EXPECT_TRUE(f["energy"].at(key).is_number()) << key;
  EXPECT_EQ(f["preset"], "pulled.xml");
  EXPECT_EQ(f["integrator"], "rk4");
  EXPECT_EQ(f["steps"], 300);
  EXPECT_EQ(f["elements"], 36);
  EXPECT_EQ(f["darts"], 36 * 8);
  EXPECT_EQ(f["momentum"].size(), 3U);
  EXPECT_EQ(f["probes"], nlohmann::json::object());
  EXPECT_NEAR(f["mass"].get<double>(), 0.1, 1e-12);
  EXPECT_EQ(f["rows"].size(), 3U);
  EXPECT_EQ(f["rows"]["shear isotropic"], 72);
  EXPECT_GT(f["tears"], 0);
  EXPECT_TRUE(f["stopped"].is_null());
  EXPECT_EQ(f["hash"].get<std::string>().find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(f["hash"].get<std::string>().size(), 16U);
}

TEST_F(Program, ComputesTheSameOnAnyNumberOfThreads) {
  const std::string line =
      "run pulled.xml --json --set body.sheet.cells='70 70' --set time.step=2e-4 --steps 200";
  const nlohmann::json one = place.rend(line + " --threads 1").json();
  for (const char* threads : {" --threads 2", " --threads 3", ""})
    EXPECT_EQ(place.rend(line + threads).json()["hash"], one["hash"]) << threads;
}

TEST_F(Program, WalksTheMapToTheSameForces) {
  const nlohmann::json flat = place.rend("run pulled.xml --json --steps 100").json();
  const nlohmann::json walk = place.rend("run pulled.xml --json --steps 100 --kernels walk").json();
  EXPECT_EQ(flat["tears"], walk["tears"]);
  const double a = flat["energy"]["elastic"], b = walk["energy"]["elastic"];
  EXPECT_NEAR(a, b, 1e-9 * a);
}

TEST_F(Program, MakesAPictureOfEveryFrame) {
  NEEDS_VIDEO;
  NEEDS_PNG;
  const Outcome outcome = place.rend("render pulled.xml -o frames --video mp4");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("7 frames in frames, and frames/pulled.mp4"));
  EXPECT_EQ(place.files(),
            (std::vector<std::string>{"frames", "frames/00000.png", "frames/00001.png", "frames/00002.png",
                                      "frames/00003.png", "frames/00004.png", "frames/00005.png",
                                      "frames/00006.png", "frames/pulled.mp4", "pulled.xml"}));
}

TEST_F(Program, DrawsAFrameAloneAsInTheWholeClip) {
  NEEDS_PNG;
  for (const char* by : {"plain", "strain", "force", "fragment"}) {
    const std::string line = std::string(" --quiet --set body.look.by=") + by;
    ASSERT_EQ(place.rend("render pulled.xml -o all" + line).code, 0);
    ASSERT_EQ(place.rend("render pulled.xml -o some --frames 2,4-6x2" + line).code, 0);
    EXPECT_FALSE(std::filesystem::exists(place.path() / "some/00003.png"));
    for (const char* name : {"00002.png", "00004.png", "00006.png"})
      EXPECT_EQ(content(place.path() / "all" / name), content(place.path() / "some" / name))
          << by << " " << name;
  }
}

TEST_F(Program, WritesIntoAFolderCalledAsTheScene) {
  NEEDS_PNG;
  const Outcome outcome = place.rend("render pulled.xml --frames 0 --size 32x16 --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(place.files(),
            (std::vector<std::string>{"out", "out/pulled", "out/pulled/00000.png", "pulled.xml"}));
}

TEST_F(Program, WritesARowForEveryFrame) {
  ASSERT_EQ(place.rend("run pulled.xml --diagnostics d.csv").code, 0);
  const std::string csv = content(place.path() / "d.csv");
  EXPECT_THAT(csv, StartsWith("frame,step,time,kinetic,elastic,gravity,work,dissipated,balance,momentum_x,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 8);
  EXPECT_THAT(csv, HasSubstr("\n6,300,0.3,"));
}

TEST_F(Program, WritesEveryTopologicalChange) {
  const Outcome outcome = place.rend("run pulled.xml --json --events e.jsonl");
  std::ifstream file(place.path() / "e.jsonl");
  std::string line;
  std::size_t count = 0;
  double last = 0;
  long fragments = 1;
  while (std::getline(file, line)) {
    const nlohmann::json event = nlohmann::json::parse(line);
    EXPECT_EQ(event["body"], "cloth");
    EXPECT_EQ(event["criterion"], "global-border");
    EXPECT_EQ(event["change"], "separate");
    EXPECT_EQ(event["threshold"], 2);
    EXPECT_GT(event["value"], 2);
    EXPECT_EQ(event["position"].size(), 3U);
    EXPECT_EQ(event["cell"], "edge");
    EXPECT_EQ(event["unit"], "N");
    EXPECT_TRUE(event["kind"].is_null());
    EXPECT_TRUE(event["dart"].is_number_unsigned());
    EXPECT_GE(event["fragments"], 1);
    fragments += event["born"].get<long>();
    EXPECT_EQ(event["fragments"], fragments);
    EXPECT_GE(event["time"], last);
    last = event["time"];
    ++count;
  }
  const nlohmann::json figures = outcome.json();
  EXPECT_EQ(figures["tears"], count);
  EXPECT_GT(count, 0U);
  EXPECT_EQ(figures["fragments"], fragments);
  ASSERT_EQ(figures["laws"].size(), 1U);
  EXPECT_EQ(figures["laws"][0]["tears"], count);
  EXPECT_EQ(figures["laws"][0]["change"], "separate");
  EXPECT_LE(figures["laws"][0]["first"], last);
}

TEST_F(Program, RunsSoManySteps) {
  EXPECT_EQ(place.rend("run pulled.xml --json --steps 17").json()["steps"], 17);
  EXPECT_EQ(place.rend("run pulled.xml --json --steps 0").json()["time"], 0);
}

// Starts `rend ARGUMENTS` on an endless clip, and stops it as soon as `file` exists.
Outcome stopped_once_there_is(const std::string& file, const std::string& arguments, const TestFolder& place) {
  const std::string endless = " --set time.duration=1e5 --set body.drive.until=0.1 & ";
  return place.shell(std::string(test::rend_program) + " " + arguments + endless + "while [ ! -e " + file +
                     " ] && kill -0 $!; do sleep 0.02; done; kill -TERM $!; wait $!");
}

TEST_F(Program, FindsTheHelpOfElementsWithoutTheWordPreset) {
  EXPECT_EQ(place.rend("help camera").out, place.rend("help preset camera").out);
  EXPECT_EQ(place.rend("help sphere.key").code, 0);
  EXPECT_THAT(place.rend("help preset sphere.key").out, HasSubstr("sphere.key"));
  EXPECT_EQ(place.rend("help rule").out.find("scene."), std::string::npos) << "a topic stays one";
  EXPECT_EQ(place.rend("help camra").code, 64);
}

TEST_F(Program, StopsOnASignalAndKeepsWhatIsDone) {
  NEEDS_VIDEO;
  NEEDS_PNG;
  const Outcome render = stopped_once_there_is("f/00000.png", "render pulled.xml -o f --video mp4", place);
  EXPECT_EQ(render.code, 143) << render.err;
  EXPECT_THAT(render.err, HasSubstr("stopped by a signal"));
  EXPECT_EQ(place.shell("ffprobe -v error f/pulled.part.mp4").code, 0);
  const Outcome run = stopped_once_there_is("d.csv.part", "run pulled.xml --json --diagnostics d.csv", place);
  EXPECT_EQ(run.code, 143) << run.err;
  EXPECT_EQ(run.json()["stopped"], "interrupted");
  EXPECT_THAT(content(place.path() / "d.csv"), HasSubstr("\n0,0,0,"));
  for (const std::string& name : place.files()) EXPECT_FALSE(name.ends_with(".part")) << name;
}

TEST_F(Program, TellsWhatWasBuiltAndWhatWasLeftOut) {
  const Outcome info = place.rend("info pulled.xml");
  EXPECT_EQ(info.code, 0);
  EXPECT_THAT(info.out, AllOf(HasSubstr("49 vertices, 84 edges, 36 elements"), HasSubstr("born border"),
                              HasSubstr("global-border above 2 N"), HasSubstr("shear isotropic")));
  for (std::size_t at = 0, end = 0; at < info.out.size(); at = end + 1) {
    end = info.out.find('\n', at);
    EXPECT_LE(end - at, 100U) << info.out.substr(at, end - at);
  }
  const nlohmann::json json = place.rend("info pulled.xml --json").json();
  EXPECT_EQ(json["bodies"][0]["interactions"].size(), 3U);
  EXPECT_EQ(json["time"]["from"], "preset");
}

TEST_F(Program, HasNoArrayForWhatIsNotAskedFor) {
  place.write("still.xml",
              R"(<scene name="still"><body><sheet cells="6 6" size="1 1"/><mass total="0.1"/>)"
              R"(<springs><stretch k="60"/></springs></body><time step="auto" duration="1"/></scene>)");
  const Outcome info = place.rend("info still.xml");
  EXPECT_THAT(info.out, AllOf(HasSubstr("left out"), HasSubstr("tearing: the body has no <tear>"),
                              HasSubstr("auto: 0.9 of")));
  EXPECT_THAT(info.out, testing::Not(HasSubstr("born border")));
}

} // namespace
} // namespace rend::command_test
