// Numbers on the command line: invalid ones, and those out of range, are refused with a message by every
// command.
#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

namespace rend::number_option_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(NumberOption, takes_decimal_and_finite_numbers_alone) {
  const TestFolder place;
  place.write("pulled.xml", program::pulled);
  const std::vector<std::string> bad{"nan", "inf", "-inf", "-1", "1e400", "'1 2'", "' 7'", "0x10", "7s", "''"};
  for (const std::string option : {"run pulled.xml --steps",
                                   "run pulled.xml --fps",
                                   "run pulled.xml --threads",
                                   "run pulled.xml --frames",
                                   "render pulled.xml --checkpoint-every",
                                   "render pulled.xml --fps",
                                   "render pulled.xml --size",
                                   "render pulled.xml --frames",
                                   "render pulled.xml --shard",
                                   "batch pulled.xml --fps",
                                   "batch pulled.xml --checkpoint-every",
                                   "batch pulled.xml --threads",
                                   "batch pulled.xml --jobs",
                                   "batch pulled.xml --memory",
                                   "batch pulled.xml --shard",
                                   "batch pulled.xml --size",
                                   "batch pulled.xml --frames",
                                   "sheet pulled.xml -o s.png --threads",
                                   "sheet pulled.xml -o s.png --size",
                                   "study pulled.xml --steps",
                                   "study pulled.xml --duration",
                                   "study pulled.xml --reruns",
                                   "study pulled.xml --refine",
                                   "check pulled.xml --jobs",
                                   "diff pulled.xml pulled.xml --threads"}) {
    for (const std::string& value : bad) {
      const Outcome outcome = place.rend(option + " " + value);
      EXPECT_EQ(outcome.code, 64) << option << " " << value << "\n" << outcome.err;
      EXPECT_THAT(outcome.err, AllOf(StartsWith("rend: error: "), HasSubstr("\n  hint: "))) << option << value;
      EXPECT_EQ(outcome.out, "") << option << value;
    }
  }
  EXPECT_THAT(place.rend("run pulled.xml --fps nan").err,
              HasSubstr("--fps: 'nan' is not a number from 1e-06 to "));
  for (const char* line :
       {"run pulled.xml --steps true", "run pulled.xml --steps 1e3", "run pulled.xml --fps 1,5"})
    EXPECT_EQ(place.rend(line).code, 64) << line;
  EXPECT_EQ(place.rend("run pulled.xml --steps +2 --json").json()["steps"], 2);
  EXPECT_EQ(place.rend("run pulled.xml --steps 010 --json").json()["steps"], 10);
  EXPECT_EQ(place.files(), std::vector<std::string>{"pulled.xml"});
}

} // namespace
} // namespace rend::number_option_test
