// The same preset gives the same files, byte for byte, pictures and video: in repeated runs, and for any number
// of threads of the simulation and of the renderer.
//
// By default a few small pictures, a few times; with REND_WHOLE in the environment a whole clip that tears, at
// its full size, 20 times (tests/run --all).
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <array>
#include <map>

namespace rend::same_bytes_test {
namespace {

using program::content;
namespace fs = std::filesystem;

const std::filesystem::path root = test::source_root;

std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename().string()] = content(entry.path());
  return files;
}

TEST(RepeatedRenders, give_the_same_bytes_on_any_number_of_threads) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  const bool whole = std::getenv("REND_WHOLE") != nullptr;
  const program::TestFolder place;
  const auto rendered = [&](const std::string& renderer, const std::string& simulation) {
    const auto outcome = place.shell("rm -rf out; LP_NUM_THREADS=" + renderer + " " + test::rend_program +
                                     " render '" + (root / "presets/tear/cloth-global-border.xml").string() +
                                     "' -q -o out --video mp4 --threads " + simulation +
                                     (whole ? "" : " --frames 0-40x8 --size 192x108"));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return files_of(place.path() / "out");
  };
  const auto first = rendered("1", "1");
  ASSERT_GE(first.size(), 7u);
  constexpr std::array counts{"2", "4", "1", "0"}; // 0: llvmpipe has no threads of its own
  for (std::size_t turn = 0; turn < (whole ? 20 : 3); ++turn) {
    const auto again = rendered(counts[turn % 4], counts[(turn + turn / 4) % 3]);
    ASSERT_EQ(again.size(), first.size());
    for (const auto& [name, bytes] : first) EXPECT_TRUE(again.at(name) == bytes) << name << ", turn " << turn;
  }
}

} // namespace
} // namespace rend::same_bytes_test
