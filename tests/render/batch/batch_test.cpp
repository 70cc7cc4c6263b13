// Batches: each job gives what rend render alone would give, whatever happens to the others.
#include "render/batch/batch_jobs.h"
#include "render/clip/shard.h"
#include "render/picture/scene_preset.h"
#include "sim/base/error.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace rend::batch_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
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

  const TestFolder place;
};

TEST_F(Batch, crosses_sweeps_and_names_each_job) {
  const auto sweeps = std::vector{parse_sweep("time.step=1e-3,2e-3"), parse_sweep("body.mass.total=1,2,3")};
  const std::string presets = (place.path() / "presets").string();
  const auto jobs = batch_jobs({presets, presets + "/a.xml"}, sweeps);
  ASSERT_EQ(jobs.size(), 18u);
  EXPECT_EQ(jobs[0].name, "a_time.step=1e-3_body.mass.total=1");
  EXPECT_THAT(jobs[5].sets, ElementsAre("time.step=2e-3", "body.mass.total=3"));
  EXPECT_EQ(jobs[6].name, "more/b_time.step=1e-3_body.mass.total=1");
  EXPECT_EQ(jobs[12].name, "a_time.step=1e-3_body.mass.total=1-2") << "the same preset, named twice";
  EXPECT_THROW(parse_sweep("time.step=1e-3,,2"), UserError);
  EXPECT_THAT(parse_sweep("a.b=1:10:2").values, ElementsAre("1", "3", "5", "7", "9"));
  EXPECT_THAT(parse_sweep("a.b=0:0.3:0.1,7").values, ElementsAre("0", "0.1", "0.2", "0.3", "7"));
  EXPECT_THAT(parse_sweep("a.b=3:1:-1").values, ElementsAre("3", "2", "1"));
  EXPECT_THAT(parse_sweep("a.b=2:4").values, ElementsAre("2", "3", "4"));
  EXPECT_THAT(parse_sweep("a.b=x:y,C:1:2:3").values, ElementsAre("x:y", "C:1:2:3"));
  for (const char* bad : {"a.b=1:10:0", "a.b=1:10:-1", "a.b=1:1e9:1", "a.b=0:nan:1", "a.b=1:inf"})
    EXPECT_THROW(parse_sweep(bad), UserError) << bad;
  EXPECT_THROW(batch_jobs({presets + "/none.xml"}, {}), UserError);
  fs::create_directories(place.path() / "empty");
  EXPECT_THROW(batch_jobs({(place.path() / "empty").string()}, {}), UserError);
}

TEST_F(Batch, a_preset_that_is_a_link_is_called_by_the_link) {
  fs::create_directories(place.path() / "in/below");
  fs::create_symlink("../presets/a.xml", place.path() / "in/link.xml");
  fs::create_symlink("../../presets/a.xml", place.path() / "in/below/link.xml");
  for (const char* in : {"in", "in/", "in/.", "./in"}) {
    const auto jobs = batch_jobs({(place.path() / in).string()}, {});
    ASSERT_EQ(jobs.size(), 2u);
    EXPECT_EQ(jobs[0].name, "below/link") << in;
    EXPECT_EQ(jobs[1].name, "link") << in;
  }
}

TEST_F(Batch, names_are_of_one_choice_alone_and_fit_into_a_folder) {
  const std::string a = (place.path() / "presets/a.xml").string();
  std::set<std::string> names;
  const std::string long_value(300, '1');
  const std::vector<std::string> sweeps{"body.springs.stretch.k=10,20",
                                        "body.springs.bend.k=10,20",
                                        "image.size=64 48,64_48,64/48,64*48",
                                        "body[a b].mass.total=1",
                                        "body[a_b].mass.total=1",
                                        "body[a/b].mass.total=1",
                                        "body.mass.total=" + long_value,
                                        "body.mass.total=" + long_value + "2"};
  std::size_t count = 0;
  for (const std::string& sweep : sweeps) {
    for (const BatchJob& job : batch_jobs({a}, {parse_sweep(sweep)})) {
      ++count;
      EXPECT_TRUE(names.insert(job.name).second) << job.name;
      EXPECT_LE(job.name.size(), 200u);
      EXPECT_EQ(job.name.find('/'), std::string::npos) << job.name;
    }
  }
  EXPECT_EQ(names.size(), count);
}

TEST_F(Batch, no_job_stands_in_the_place_of_the_page_or_above_its_folder) {
  NEEDS_PNG;
  fs::create_directories(place.path() / "odd/index.3-of-4.html");
  for (const char* name :
       {"index.html.xml", "index.1-of-2.html.xml", "index.3-of-4.html/a.xml", "..xml", "...xml"})
    place.write(std::string("odd/") + name, program::pulled);
  const std::string odd = (place.path() / "odd").string();
  auto jobs = batch_jobs({odd}, {});
  for (const char* file : {"/..xml", "/...xml", "/index.html.xml"})
    jobs.push_back(batch_jobs({odd + file}, {})[0]);
  for (const BatchJob& job : jobs)
    for (const fs::path& part : fs::path(job.name)) {
      EXPECT_FALSE(part.string().starts_with("index.") && part.extension() == ".html") << job.name;
      EXPECT_NE(part, ".");
      EXPECT_NE(part, "..");
    }
  EXPECT_EQ(place.rend("batch odd/index.html.xml -o page -q --frames 0").code, 0);
  EXPECT_TRUE(fs::is_regular_file(place.path() / "page/index.html"));
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
  EXPECT_EQ(pictures("swept/a_body.mass.total=0.1").size(), 3u);
  EXPECT_NE(pictures("swept/a_body.mass.total=0.1"), pictures("swept/a_body.mass.total=0.2"));
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

// The fields of a line of CSV without quotes.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) out.push_back(field);
  return out;
}

TEST_F(Batch, runs_without_pictures_make_one_table_of_all_figures) {
  const Outcome outcome =
      place.rend("batch presets/a.xml --run --sweep body.tear.threshold=1,2,1e9 -o runs --jobs 2");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(" left\n"));
  EXPECT_TRUE(pictures("runs").empty());
  std::istringstream table(content(place.path() / "runs/figures.csv"));
  std::string line;
  std::getline(table, line);
  const std::vector<std::string> head = fields(line);
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin());
  };
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    const std::vector<std::string> row = fields(line);
    const std::string threshold = row.at(column("body.tear.threshold"));
    const nlohmann::json one =
        place.rend("run presets/a.xml --json -q --set body.tear.threshold=" + threshold).json();
    EXPECT_EQ(row.at(column("hash")), one["hash"]);
    EXPECT_EQ(row.at(column("tears")), one["tears"].dump());
    EXPECT_EQ(row.at(column("energy.kinetic")), one["energy"]["kinetic"].dump());
    EXPECT_EQ(row.at(column("laws.0.reached.value")), one["laws"][0]["reached"]["value"].dump());
  }
  EXPECT_EQ(rows, 3);
  EXPECT_EQ(place.rend("batch presets/a.xml --run --video mp4").code, 64);
}

// The rows of figures.csv: of each job, the figures below these names.
std::map<std::string, std::vector<std::string>> rows_of(const fs::path& folder,
                                                        const std::vector<std::string>& names) {
  std::istringstream table(content(folder / "figures.csv"));
  std::string line;
  std::getline(table, line);
  const std::vector<std::string> head = fields(line);
  std::map<std::string, std::vector<std::string>> rows;
  while (std::getline(table, line)) {
    const std::vector<std::string> row = fields(line);
    for (const std::string& name : names)
      rows[row.at(0)].push_back(
          row.at(static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin())));
  }
  return rows;
}

TEST_F(Batch, runs_resume_with_what_is_missing_alone_and_keep_the_table) {
  const std::string sweep = "batch presets/a.xml --run -o runs --sweep body.tear.threshold=";
  const auto jobs_begun = [](const Outcome& outcome) {
    return std::count(outcome.err.begin(), outcome.err.end(), '\n') -
           (outcome.err.find("have their results already") != std::string::npos ? 1 : 0);
  };
  const std::vector<std::string> what{"hash", "seconds", "state"};
  EXPECT_EQ(jobs_begun(place.rend(sweep + "1,2")), 2);
  const auto first = rows_of(place.path() / "runs", what);
  ASSERT_EQ(first.size(), 2u);
  const Outcome wider = place.rend(sweep + "1,2,3 --resume");
  EXPECT_EQ(wider.code, 0) << wider.err;
  EXPECT_EQ(jobs_begun(wider), 1) << wider.err;
  EXPECT_THAT(wider.err, HasSubstr("2 of 3 jobs have their results already"));
  const auto second = rows_of(place.path() / "runs", what);
  ASSERT_EQ(second.size(), 3u);
  for (const auto& [job, row] : first) EXPECT_EQ(second.at(job), row) << "with the seconds that it took then";
  // One job alone: the table still has all.
  EXPECT_EQ(jobs_begun(place.rend(sweep + "2 --resume")), 0);
  EXPECT_EQ(rows_of(place.path() / "runs", what), second);
  // Another preset: nothing holds any more.
  place.write("presets/a.xml", content(place.path() / "presets/a.xml") + "<!-- changed -->\n");
  EXPECT_EQ(jobs_begun(place.rend(sweep + "2 --resume")), 1);
  EXPECT_EQ(rows_of(place.path() / "runs", what).size(), 1u);
  // Without --resume a batch begins anew.
  EXPECT_EQ(jobs_begun(place.rend(sweep + "1,2")), 2);
  EXPECT_EQ(jobs_begun(place.rend(sweep + "3")), 1);
  EXPECT_EQ(rows_of(place.path() / "runs", what).size(), 1u);
}

TEST_F(Batch, runs_that_failed_run_again_with_resume_and_have_their_message_in_the_table) {
  place.write("presets/bad.xml", "<scene name=\"bad\"></scene>");
  EXPECT_EQ(place.rend("batch presets --run -o runs -q").code, 1);
  const auto rows = rows_of(place.path() / "runs", {"state", "message"});
  EXPECT_EQ(rows.at("bad").at(0), "failed");
  EXPECT_THAT(rows.at("bad").at(1), HasSubstr("needs a <body>"));
  EXPECT_EQ(rows.at("a").at(1), "");
  place.write("presets/bad.xml", program::pulled);
  const Outcome again = place.rend("batch presets --run -o runs --resume");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("2 of 3 jobs have their results already"));
}

// A folder of pictures whose name is that of the folder of results.
TEST_F(Batch, runs_remove_no_file_that_is_not_theirs) {
  fs::create_directories(place.path() / "runs/results");
  place.write("runs/results/mine.json", "{}");
  place.write("runs/results/00000.png", "x");
  EXPECT_EQ(place.rend("batch presets/a.xml --run -o runs -q").code, 0);
  EXPECT_EQ(place.rend("batch presets/a.xml --run -o runs -q").code, 0);
  EXPECT_TRUE(fs::exists(place.path() / "runs/results/mine.json"));
  EXPECT_TRUE(fs::exists(place.path() / "runs/results/00000.png"));
}

// What an address of a page names: without %XX.
std::string decoded(const std::string& address) {
  std::string out;
  for (std::size_t n = 0; n < address.size(); ++n) {
    const bool coded = address[n] == '%';
    out += coded ? static_cast<char>(std::stoi(address.substr(n + 1, 2), nullptr, 16)) : address[n];
    if (coded) n += 2;
  }
  return out;
}

TEST_F(Batch, the_page_of_runs_has_their_figures_and_every_link_leads_somewhere) {
  NEEDS_PNG;
  place.write("presets/bad.xml", "<scene name=\"bad\"></scene>");
  for (const char* how : {"--run", "--size 32x24 --frames 0"}) {
    EXPECT_EQ(place.rend(std::string("batch presets --set body.tear.threshold=1,2 -o page -q ") + how).code, 1);
    const std::string page = content(place.path() / "page/index.html");
    const std::regex href("href=\"([^\"#]+)\"");
    int links = 0;
    for (std::sregex_iterator at(page.begin(), page.end(), href), end; at != end; ++at, ++links)
      EXPECT_TRUE(fs::exists(place.path() / "page" / decoded((*at)[1]))) << how << ": " << (*at)[1];
    EXPECT_GE(links, 4) << how;
  }
  EXPECT_EQ(place.rend("batch presets/a.xml --run --set body.tear.threshold=1,2 -o page -q").code, 0);
  const std::string page = content(place.path() / "page/index.html");
  const nlohmann::json one = place.rend("run presets/a.xml --json -q --set body.tear.threshold=2").json();
  EXPECT_THAT(page,
              AllOf(HasSubstr("figures.csv"), HasSubstr("first tear [s]"), HasSubstr("body.tear.threshold")));
  EXPECT_THAT(page, HasSubstr(">" + one["tears"].dump() + "<"));
  EXPECT_THAT(page, HasSubstr(">" + one["fragments"].dump() + "<"));
  EXPECT_THAT(page, testing::Not(HasSubstr("no pictures")));
}

TEST_F(Batch, texts_that_spreadsheets_would_run_are_marked_in_the_table) {
  place.write("presets/more/=1+1.xml", program::pulled);
  place.write("presets/more/@me.xml", program::pulled);
  place.write("presets/more/-3.xml", program::pulled);
  EXPECT_EQ(place.rend("batch presets/more/* --run --sweep 'world.gravity=-1 0 -5' -o runs -q").code, 0);
  const std::string table = content(place.path() / "runs/figures.csv");
  std::vector<std::string> lines_of_jobs;
  std::istringstream in(table);
  std::string head, line;
  std::getline(in, head);
  while (std::getline(in, line)) lines_of_jobs.push_back(line);
  std::sort(lines_of_jobs.begin(), lines_of_jobs.end());
  ASSERT_EQ(lines_of_jobs.size(), 4u);
  EXPECT_THAT(lines_of_jobs, ElementsAre(testing::StartsWith("\"'-3_world.gravity=-1,0,-5\","),
                                         testing::StartsWith("\"'=1+1_world.gravity=-1,0,-5\","),
                                         testing::StartsWith("\"'@me_world.gravity=-1,0,-5\","),
                                         testing::StartsWith("\"b_world.gravity=-1,0,-5\",")));
  for (const std::string& row : lines_of_jobs) EXPECT_THAT(row, HasSubstr(",-1 0 -5,")) << "numbers stay";
}

TEST_F(Batch, what_a_job_says_stands_in_its_log_and_on_the_page) {
  place.write("presets/bad.xml", "<scene name=\"bad\"></scene>");
  EXPECT_EQ(place.rend("batch presets --run -o said -q").code, 1);
  EXPECT_THAT(content(place.path() / "said/logs/bad.log"), HasSubstr("rend: error: "));
  EXPECT_TRUE(fs::exists(place.path() / "said/logs/more/b.log"));
  EXPECT_THAT(content(place.path() / "said/index.html"), HasSubstr("needs a &lt;body&gt;"));
}

TEST_F(Batch, the_shard_that_ends_last_writes_the_page_of_all) {
  EXPECT_EQ(place.rend("batch presets --run -o whole -q").code, 0);
  for (int n : {2, 1, 3}) { // the third has no job
    EXPECT_FALSE(fs::exists(place.path() / "parts/index.html")) << n;
    EXPECT_EQ(place.rend(fmt::format("batch presets --run -o parts -q --shard {}/3", n)).code, 0);
  }
  const std::string page = content(place.path() / "parts/index.html");
  EXPECT_THAT(page, AllOf(HasSubstr("more/b"), HasSubstr("a.xml")));
  const auto without_costs =
      [&](const std::string& folder) { // job, preset, state, code; hash at the end of a state
        std::istringstream table(content(place.path() / folder / "figures.csv"));
        std::vector<std::string> rows;
        std::string line;
        std::getline(table, line);
        const std::vector<std::string> head = fields(line);
        while (std::getline(table, line)) {
          const std::vector<std::string> row = fields(line);
          const auto hash =
              static_cast<std::size_t>(std::find(head.begin(), head.end(), "hash") - head.begin());
          rows.push_back(row.at(0) + " " + row.at(2) + " " + row.at(hash));
        }
        return rows;
      };
  EXPECT_EQ(without_costs("parts"), without_costs("whole"));
  EXPECT_EQ(without_costs("parts").size(), 2u);
  // Parts of another batch do not count.
  EXPECT_EQ(place.rend("batch presets/a.xml --run -o other -q --shard 1/2").code, 0);
  EXPECT_EQ(place.rend("batch presets --run -o other -q --shard 2/2").code, 0);
  EXPECT_FALSE(fs::exists(place.path() / "other/index.html"));
}

TEST_F(Batch, says_that_one_job_takes_more_than_all_may) {
  const Outcome outcome = place.rend("batch presets --run -o tight --memory 1M");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("note: --memory allows 1.0 MB"), HasSubstr("alone took ")));
  EXPECT_THAT(place.rend("batch presets --run -o wide --memory 4G").err, testing::Not(HasSubstr("alone took")));
}

TEST_F(Batch, a_budget_that_nothing_fits_into_runs_one_job_after_another) {
  NEEDS_PNG;
  const Outcome outcome = place.rend("batch presets -o tight -q --jobs 4 --memory 1M");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(pictures("tight/a").size(), 7u);
}

// Shell code that waits until the condition holds, for at most 20 s.
std::string until(const std::string& condition) {
  return "n=0; until " + condition + " || [ $n -ge 2000 ]; do sleep 0.01; n=$((n+1)); done; ";
}

TEST_F(Batch, a_signal_stops_all_jobs_and_going_on_makes_the_rest) {
  NEEDS_PNG;
  // takes many seconds, so that one job starts later
  const std::string options = " -q --set time.step=5e-7 --jobs 2 --memory 8G";
  EXPECT_EQ(place.rend("batch presets -o whole" + options).code, 0);
  const Outcome outcome =
      place.shell(std::string(test::rend_program) + " batch presets -o cut" + options + " & " +
                  until("[ -e cut/a/00001.png ] && [ -e cut/more/b/00001.png ]") + "kill -TERM $!; wait $!");
  EXPECT_EQ(outcome.code, 143) << outcome.err;
  for (const char* name : {"a", "more/b"}) {
    const fs::path folder = place.path() / "cut" / name;
    EXPECT_TRUE(fs::exists(folder / "pulled.checkpoint")) << name;
    EXPECT_FALSE(fs::exists(folder / "00006.png")) << name << " was over before the signal";
  }
  EXPECT_TRUE(fs::exists(place.path() / "cut/index.html"));
  EXPECT_EQ(place.rend("batch presets -o cut --resume" + options).code, 0);
  for (const char* name : {"a", "more/b"})
    EXPECT_EQ(pictures(std::string("cut/") + name), pictures(std::string("whole/") + name));
  for (const std::string& file : place.files()) EXPECT_FALSE(file.ends_with(".checkpoint")) << file;
}

// The job is blocked reading its preset from a pipe, so that the test can find and kill it.
TEST_F(Batch, a_job_that_was_ended_from_outside_is_not_done) {
  NEEDS_PNG;
  for (const auto& [signal, code] : {std::pair{"TERM", 143}, {"KILL", 137}}) {
    const Outcome outcome =
        place.shell(std::string("rm -f pipe.xml; mkfifo pipe.xml; ") + test::rend_program +
                    " batch pipe.xml presets/a.xml -o ended --json -q --jobs 2 --memory 8G & batch=$!; " +
                    until("job=$(pgrep -P $batch -f pipe.xml)") + "kill -" + signal + " $job; wait $batch");
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    for (const auto& line : lines(outcome.out)) {
      if (line["job"] != "pipe") continue;
      EXPECT_EQ(line["state"], "failed");
      EXPECT_EQ(line["code"], code);
      EXPECT_THAT(line["message"].get<std::string>(), HasSubstr("signal"));
    }
    EXPECT_EQ(lines(outcome.out).size(), 2u);
  }
}

// Jobs whose memory is mostly that of their pictures; sizes are such that two jobs of one preset are started,
// but do not fit into the budget together.
class TightBatch : public Batch {
protected:
  void SetUp() override {
    NEEDS_PNG;
    std::string text = program::pulled;
    text.replace(text.find("64 48"), 5, "4800 3600");
    place.write("large.xml", text);
    const Outcome alone =
        place.rend("batch presets/a.xml large.xml -o whole -q --json --jobs 1 --set time.duration=0.15");
    EXPECT_EQ(alone.code, 0) << alone.err;
    // The small preset comes first: its memory is then the estimate for the others.
    for (const auto& line : lines(alone.out))
      (line["job"] == "a" ? small_ : large_) = line["peak_bytes"].get<std::size_t>();
    EXPECT_GT(budget(), 2 * small_);
  }
  // [bytes] On a busy machine the large job takes less than it did alone; and two jobs without an estimate, for
  // which 200 MB are assumed each, must not be started together.
  std::size_t budget() const { return std::min(large_ * 65 / 100, std::size_t{390} << 20U); }
  std::size_t small_ = 0, large_ = 0; // [bytes]
};

TEST_F(TightBatch, a_job_that_made_room_before_it_had_a_checkpoint_begins_anew) {
  NEEDS_PNG;
  fs::create_directories(place.path() / "tight/pipe");
  place.write("tight/pipe/pulled.checkpoint", "of an earlier batch");
  // It blocks in building its scene while its preset does not arrive: until the large job is done.
  const Outcome outcome = place.shell(fmt::format("mkfifo pipe.xml; {} batch presets/a.xml large.xml pipe.xml "
                                                  "-o tight -q --json --jobs 2 --set time.duration=0.15 "
                                                  "--memory {} & batch=$!; ",
                                                  test::rend_program, budget()) +
                                      until("[ -e tight/large/00004.png ]") +
                                      "sleep 0.5; timeout 20 cat presets/a.xml > pipe.xml; wait $batch");
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  for (const auto& line : lines(outcome.out)) {
    EXPECT_EQ(line["tries"], line["job"] == "pipe" ? 2 : 1) << line;
    EXPECT_EQ(line["state"], "done") << line;
  }
  EXPECT_EQ(pictures("tight/pipe"), pictures("whole/a"));
}

// The large job waits for its preset until the one started after it is in progress, and then exceeds the memory
// budget.
TEST_F(TightBatch, a_job_that_made_room_goes_on_from_its_checkpoint) {
  NEEDS_PNG;
  std::string text = program::pulled;
  text.replace(text.find("step=\"1e-3\""), 11, "step=\"2e-7\"");
  place.write("slow.xml", text);
  EXPECT_EQ(place.rend("render slow.xml -q -o alone --set time.duration=0.15").code, 0);
  const std::string checkpoint = "[ -e tight/slow/pulled.checkpoint ]";
  const Outcome outcome = place.shell(
      fmt::format("mkfifo pipe.xml; {} batch presets/a.xml pipe.xml slow.xml -o tight -q --json --jobs 2 "
                  "--set time.duration=0.15 --memory {} & batch=$!; ",
                  test::rend_program, budget()) +
      until("[ -e tight/slow/00000.png ]") + "timeout 20 cat large.xml > pipe.xml; " + until(checkpoint) +
      checkpoint + " && touch it_was_there; wait $batch");
  EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  EXPECT_TRUE(fs::exists(place.path() / "it_was_there"));
  for (const auto& line : lines(outcome.out)) {
    EXPECT_EQ(line["tries"], line["job"] == "slow" ? 2 : 1) << line;
    if (line["job"] == "slow") {
      EXPECT_GE(line["kept"], 1) << line;
    }
  }
  EXPECT_EQ(pictures("tight/slow"), pictures("alone"));
}

TEST_F(Batch, refuses_a_bad_command_line) {
  for (const auto& [line, code] :
       std::vector<std::pair<const char*, int>>{{"batch", 64},
                                                {"batch none.xml", 66},
                                                {"batch presets --memory much", 64},
                                                {"batch presets --shard 5/3", 64},
                                                {"batch presets --sweep time.step", 64},
                                                {"batch presets --jobs 0", 64},
                                                {"batch presets --memory 1e15G", 64},
                                                {"batch presets --memory 1000000000000G", 64},
                                                {"batch presets --memory 0x10G", 64},
                                                {"batch presets --memory 1e-9", 64},
                                                {"batch presets --memory 0.1", 64},
                                                {"batch presets --memory inf", 64},
                                                {"batch presets --memory -4G", 64},
                                                {"batch presets --memory 4GG", 64},
                                                {"batch presets --size 10", 64},
                                                {"batch presets --frames foo", 64},
                                                {"batch presets --fps -1", 64},
                                                {"batch presets --fps many", 64},
                                                {"batch presets --checkpoint-every -1", 64},
                                                {"batch presets --set foo", 64},
                                                {"batch presets --set time.stp=1", 64},
                                                {"batch presets --set time.stp=1,2", 64},
                                                {"batch presets --set time.step=1e-3,much", 65},
                                                {"batch presets --sweep time.stp=1,2", 64},
                                                {"batch presets --sweep time=1,2", 64},
                                                {"batch presets --no-png", 64}}) {
    if (code != 64 && !png_available()) continue; // that is said first
    const Outcome outcome = place.rend(line);
    EXPECT_EQ(outcome.code, code) << line << outcome.err;
    EXPECT_EQ(outcome.out, "") << line;
  }
  EXPECT_FALSE(fs::exists(place.path() / "out")) << "a job was begun";
}

TEST_F(Batch, what_is_said_is_utf8_whatever_files_are_called) {
  NEEDS_PNG;
  place.write("b\xff.xml", program::pulled);
  const Outcome outcome = place.rend("batch b*.xml presets -o many -q --json --frames 0");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  std::set<std::string> names;
  for (const auto& line : lines(outcome.out)) names.insert(line["job"].get<std::string>());
  EXPECT_THAT(names, ElementsAre("a", "b\xef\xbf\xbd", "more/b"));
  EXPECT_TRUE(fs::exists(place.path() / "many/index.html"));
  EXPECT_EQ(place.rend("render b*.xml -o alone -q --json --frames 0").json()["frames"], 1);
}

// With stdout, or all three streams closed: the output of jobs is captured all the same.
TEST_F(Batch, jobs_run_where_standard_streams_are_closed) {
  NEEDS_PNG;
  for (const char* closed : {">&-", "2>&-", "<&- >&- 2>&-"}) {
    place.rend(fmt::format("batch presets -o closed -q --frames 0-2 {}", closed));
    EXPECT_EQ(pictures("closed/a").size(), 3u) << closed;
    EXPECT_THAT(content(place.path() / "closed/index.html"), HasSubstr("class=\"badge good\"")) << closed;
    fs::remove_all(place.path() / "closed");
  }
}

TEST_F(Batch, several_values_of_a_set_are_a_sweep_where_a_comma_is_no_part_of_a_value) {
  const BatchSettings settings = batch_settings(
      scene_type(), {"time.step=1e-3,2e-3", "name=a,b", "time.duration=1", "image.samples=1,4"}, {"name=c,d"});
  EXPECT_THAT(settings.sets, ElementsAre("name=a,b", "time.duration=1"));
  std::vector<std::string> swept;
  for (const Sweep& sweep : settings.sweeps) {
    swept.push_back(sweep.path);
    swept.insert(swept.end(), sweep.values.begin(), sweep.values.end());
  }
  EXPECT_THAT(swept, ElementsAre("time.step", "1e-3", "2e-3", "image.samples", "1", "4", "name", "c", "d"));
}

} // namespace
} // namespace rend::batch_test
