// Batches: every job as rend render alone would do it, whatever becomes of the others.
#include "render/app/batch_jobs.h"
#include "render/app/shard.h"
#include "sim/base/error.h"
#include "tests/render/app/program_run.h"
#include "tests/render/needs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <sstream>

namespace rend {
namespace {

using program::content;
using program::Outcome;
using program::Place;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Batch : public testing::Test {
protected:
  Batch() {
    fs::create_directories(place.path() / "presets/more");
    for (const char* name : {"presets/a.xml", "presets/more/b.xml"}) place.write(name, program::pulled);
  }

  std::map<std::string, std::string> pictures(const std::string& folder) const {
    std::map<std::string, std::string> all;
    std::error_code error;
    for (fs::recursive_directory_iterator at(place.path() / folder, error), end; !error && at != end;
         at.increment(error))
      if (at->path().extension() == ".png") all[at->path().filename().string()] = content(at->path());
    return all;
  }
  static std::vector<nlohmann::json> lines(const std::string& text) {
    std::vector<nlohmann::json> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }

  const Place place;
};

TEST_F(Batch, crosses_sweeps_and_names_each_job) {
  const auto sweeps = std::vector{parse_sweep("time.step=1e-3,2e-3"), parse_sweep("body.mass.total=1,2,3")};
  const std::string presets = (place.path() / "presets").string();
  const auto jobs = batch_jobs({presets, presets + "/a.xml"}, sweeps);
  ASSERT_EQ(jobs.size(), 18u);
  EXPECT_EQ(jobs[0].name, "a_step=1e-3_total=1");
  EXPECT_THAT(jobs[5].sets, ElementsAre("time.step=2e-3", "body.mass.total=3"));
  EXPECT_EQ(jobs[6].name, "more/b_step=1e-3_total=1");
  EXPECT_EQ(jobs[12].name, "a_step=1e-3_total=1-2") << "the same preset, named twice";
  EXPECT_THROW(parse_sweep("time.step=1e-3,,2"), UserError);
  EXPECT_THROW(batch_jobs({presets + "/none.xml"}, {}), UserError);
  fs::create_directories(place.path() / "empty");
  EXPECT_THROW(batch_jobs({(place.path() / "empty").string()}, {}), UserError);
}

TEST_F(Batch, a_job_has_the_bytes_of_rend_render_and_one_that_fails_stops_no_other) {
  NEEDS_PNG;
  place.write("presets/bad.xml", "<scene name=\"bad\"></scene>");
  place.write("presets/wild.xml", program::pulled);
  EXPECT_EQ(place.rend("render presets/a.xml -q -o alone").code, 0);
  const Outcome outcome = place.rend("batch presets -o many --json -q --jobs 2 --memory 4G");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const auto all = lines(outcome.out);
  ASSERT_EQ(all.size(), 4u);
  for (const auto& line : all) {
    const bool bad = line["job"] == "bad";
    EXPECT_EQ(line["state"], bad ? "failed" : "done") << line;
    EXPECT_EQ(line["code"], bad ? 65 : 0);
    if (bad) {
      EXPECT_THAT(line["message"].get<std::string>(), HasSubstr("bad.xml"));
      continue;
    }
    EXPECT_EQ(line["frames"], 7);
    EXPECT_GT(line["peak_bytes"], 1000000);
  }
  for (const char* name : {"a", "more/b", "wild"})
    EXPECT_EQ(pictures(std::string("many/") + name), pictures("alone")) << name;
  const std::string page = content(place.path() / "many/index.html");
  EXPECT_THAT(page, AllOf(HasSubstr("more/b/"), HasSubstr("data:image/png"), HasSubstr("failed")));
}

TEST_F(Batch, sweeps_and_frames_and_what_is_set_for_all) {
  NEEDS_PNG;
  const Outcome outcome = place.rend("batch presets/a.xml -o swept -q --frames 1-5x2 --set time.duration=0.25 "
                                     "--sweep body.mass.total=0.1,0.2");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 of 2 jobs done"));
  EXPECT_EQ(pictures("swept/a_total=0.1").size(), 3u);
  EXPECT_NE(pictures("swept/a_total=0.1"), pictures("swept/a_total=0.2"));
}

TEST_F(Batch, goes_on_with_what_is_missing) {
  NEEDS_PNG;
  EXPECT_EQ(place.rend("batch presets -o many -q").code, 0);
  const auto before = pictures("many");
  fs::remove(place.path() / "many/a/00003.png");
  const Outcome outcome = place.rend("batch presets -o many -q --resume --json");
  EXPECT_EQ(outcome.code, 0);
  int made = 0, kept = 0;
  for (const auto& line : lines(outcome.out)) {
    made += line["frames"].get<int>();
    kept += line["kept"].get<int>();
  }
  EXPECT_EQ(made, 1);
  EXPECT_EQ(kept, 13);
  EXPECT_EQ(pictures("many"), before);
}

TEST_F(Batch, shards_share_jobs_and_where_there_are_too_few_their_frames) {
  NEEDS_PNG;
  EXPECT_EQ(place.rend("batch presets -o serial -q").code, 0);
  for (int count : {1, 2, 3, 7}) {
    const std::string folder = fmt::format("sharded-{}", count);
    for (int n = 1; n <= count; ++n)
      EXPECT_EQ(place.rend(fmt::format("batch presets -o {} -q --shard {}/{}", folder, n, count)).code, 0);
    for (const char* name : {"a", "more/b"})
      EXPECT_EQ(pictures(fmt::format("{}/{}", folder, name)), pictures(fmt::format("serial/{}", name)))
          << count;
  }
}

TEST_F(Batch, a_budget_that_nothing_fits_into_runs_one_job_after_another) {
  NEEDS_PNG;
  const Outcome outcome = place.rend("batch presets -o tight -q --jobs 4 --memory 1M");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(pictures("tight/a").size(), 7u);
}

TEST_F(Batch, a_signal_stops_all_jobs_and_going_on_makes_the_rest) {
  NEEDS_PNG;
  EXPECT_EQ(place.rend("batch presets -o whole -q --set time.step=1e-4").code, 0);
  const Outcome outcome = place.shell(fmt::format(
      "timeout --preserve-status -s TERM 0.4 {} batch presets -o cut -q --set time.step=1e-4", REND_PROGRAM));
  EXPECT_THAT(outcome.code, testing::AnyOf(143, 0)) << outcome.err;
  EXPECT_EQ(place.rend("batch presets -o cut -q --resume --set time.step=1e-4").code, 0);
  for (const char* name : {"a", "more/b"})
    EXPECT_EQ(pictures(std::string("cut/") + name), pictures(std::string("whole/") + name));
  for (const std::string& file : place.files()) EXPECT_FALSE(file.ends_with(".checkpoint")) << file;
}

TEST_F(Batch, refuses_a_bad_command_line) {
  for (const auto& [line, code] :
       std::vector<std::pair<const char*, int>>{{"batch", 64},
                                                {"batch none.xml", 66},
                                                {"batch presets --memory much", 64},
                                                {"batch presets --shard 5/3", 64},
                                                {"batch presets --sweep time.step", 64},
                                                {"batch presets --jobs 0", 64},
                                                {"batch presets --no-png", 64}}) {
    EXPECT_EQ(place.rend(line).code, code) << line;
  }
}

} // namespace
} // namespace rend
