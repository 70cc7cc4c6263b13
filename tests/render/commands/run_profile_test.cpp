// rend run --profile: time and bytes by stage.
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>
#include <map>

namespace rend::run_profile_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;

class ProfileOfARun : public testing::Test {
protected:
  ProfileOfARun() { place.write("pulled.xml", program::pulled); }
  const TestFolder place;
};

TEST_F(ProfileOfARun, parts_the_time_loop_into_stages) {
  const auto plain = place.rend("run pulled.xml --json -q --set body.tear.threshold=1").json();
  const auto asked = place.rend("run pulled.xml --json -q --set body.tear.threshold=1 --profile").json();
  EXPECT_FALSE(plain.contains("profile"));
  EXPECT_EQ(plain["hash"], asked["hash"]); // profiling does not change the result
  ASSERT_GT(plain["tears"], 0);
  const auto& profile = asked["profile"];
  double sum = 0, shares = 0;
  std::map<std::string, double> seconds;
  for (const auto& stage : profile["stages"]) {
    sum += stage["seconds"].get<double>();
    shares += stage["share"].get<double>();
    seconds[stage["stage"]] = stage["seconds"];
  }
  EXPECT_NEAR(sum, profile["seconds"].get<double>(), 1e-12);
  EXPECT_NEAR(shares, 1, 1e-12);
  for (const char* stage : {"forces", "criteria", "changes", "rebinding", "integration", "guard"})
    EXPECT_GT(seconds[stage], 0) << stage;
  EXPECT_EQ(seconds.count("contact"), 0u); // there is none
  EXPECT_LE(sum, asked["seconds"]["total"].get<double>());
}

TEST_F(ProfileOfARun, tells_what_each_interaction_costs_and_what_the_machine_can_do) {
  const auto figures = place.rend("run pulled.xml --json -q --profile").json();
  const auto& profile = figures["profile"];
  EXPECT_GT(profile["machine"]["bytes_per_second"], 1e8);
  EXPECT_GT(profile["machine"]["operations_per_second"], 1e8);
  std::map<std::string, std::size_t> rows;
  double seconds = 0, forces = 0;
  for (const auto& one : profile["interactions"]) {
    if (one["rows_are"] == "folded") rows[one["name"]] = one["rows"];
    seconds += one["seconds"].get<double>();
    EXPECT_GT(one["ns_per_row"], 0);
    EXPECT_GT(one["read_per_row"], 32);
    EXPECT_GT(one["written_per_row"], 8);
    EXPECT_GT(one["operations_per_row"], 20);
    EXPECT_GT(one["bandwidth_share"], 0);
    EXPECT_GT(one["peak_share"], 0);
    EXPECT_LT(one["peak_share"], 1);
  }
  for (const auto& [name, count] : figures["rows"].items()) EXPECT_EQ(rows[name], count) << name;
  for (const auto& stage : profile["stages"])
    if (stage["stage"] == "forces") forces = stage["seconds"];
  EXPECT_LE(seconds, forces); // one thread
  EXPECT_GT(seconds, 0.1 * forces);
}

TEST_F(ProfileOfARun, is_a_table_in_words) {
  const Outcome outcome = place.rend("run pulled.xml -q --profile");
  EXPECT_THAT(outcome.out, HasSubstr("profile    "));
  EXPECT_THAT(outcome.out, HasSubstr("forces"));
  EXPECT_THAT(outcome.out, HasSubstr("shear isotropic"));
  EXPECT_THAT(outcome.out, HasSubstr("GB/s to and from memory"));
  const Outcome none = place.rend("run pulled.xml -q --profile --steps 0");
  EXPECT_EQ(none.code, 0);
  EXPECT_THAT(none.out, testing::Not(HasSubstr("profile    ")));
}

} // namespace
} // namespace rend::run_profile_test
