// Forged checkpoints: a genuine one with bytes changed, removed or inserted, and the checksum recomputed.
//
// Each is gone on from in a process of its own. It is refused in words (65), or it is just another state:
// that goes on and stays finite, or is stopped as unstable (76). It never ends by a signal, as a fault of
// rend's, or by limits of time and memory. By default some hundreds, always the same; with REND_WHOLE in the
// environment thousands (tests/run --all).
#include "render/clip/checkpoint.h"

#include "render/clip/frame_output.h"
#include "render/clip/session.h"
#include "sim/base/archive.h"
#include "sim/base/hash.h"
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <sys/resource.h>
#include <unistd.h>

namespace rend::forged_checkpoint_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
namespace fs = std::filesystem;

bool thorough() {
  return std::getenv("REND_WHOLE") != nullptr;
}

// Small scenes, and the frame before which each is stored: together they contain every kind of data in a
// checkpoint.
struct Clip {
  std::string name, xml;
  long next;
};
void PrintTo(const Clip& clip, std::ostream* out) {
  *out << clip.name;
}

std::string clip_xml(const std::string& body, const std::string& world, const std::string& time,
                     const std::string& more = "") {
  return R"(<scene name="clip"><body name="body">)" + body + "</body>" + world + time + more +
         R"(<image size="64 48" fps="50" samples="1"/></scene>)";
}

const std::string springs = R"(<springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>)";
const std::string pulled = R"(<place rotate="90 0 0"/><mass total="0.1"/>)" + springs +
                           R"(<fix side="-x"/><drive side="+x" velocity="4 0 0"/>)";

std::vector<Clip> clips() {
  const std::string sheet = R"(<sheet cells="5 5" size="1 1"/>)";
  const std::string tear = R"(<tear criterion="global-border" threshold="2" max-per-step="1"/>)";
  return {
      {"torn", program::followed, 9},
      {"fractured",
       clip_xml(R"(<bar pattern="tetrahedra" cells="3 1 1" size="0.6 0.2 0.2"/><place translate="0 0 0.3"/>
                   <mass density="1000"/><elasticity young="2e5" damping-stiffness="1e-3"/>
                   <tear criterion="vertex-stress" threshold="2e3"/>
                   <tear criterion="atomic-element" threshold="2e4"/>
                   <contact with="floor obstacles fragments" thickness="0.005"/><look by="stress"/>)",
                R"(<world gravity="0 0 -9.81"><floor z="0"/><sphere centre="0.3 0.1 0.7" radius="0.1" mass="2"
                   velocity="0 0 -3"/></world>)",
                R"(<time step="auto" integrator="symplectic" duration="0.6"/>)",
                R"(<hud show="time energy tears legend"/>)"),
       14},
      {"crumbling",
       clip_xml(R"(<bar cells="3 2 2" size="0.6 0.2 0.2"/><mass total="1"/>
                   <springs><stretch k="2000"/><shear kind="isotropic" where="volume" k="1000"/></springs>
                   <fix side="-x"/><drive side="+x" rotate="1 0 0 400" centre="0 0.1 0.1"/>
                   <tear criterion="strain" kind="stretch" threshold="0.2" change="delete-edge"
                         max-per-step="1"/>
                   <look as="exploded" apart="0.3"/>)",
                R"(<world gravity="0 0 -9.81"/>)", R"(<time step="1e-3" integrator="verlet" duration="0.4"/>)"),
       12},
      {"implicit",
       clip_xml(sheet + pulled + tear, R"(<world gravity="0 0 -9.81"><floor z="-0.2"/></world>)",
                R"(<time step="1e-2" integrator="implicit" duration="0.5"/>)", R"(<camera frame="follow"/>)"),
       12},
      {"rk45",
       clip_xml(sheet + pulled + tear + R"(<look by="strain"/>)", "",
                R"(<time step="5e-3" integrator="rk45" duration="0.4"/>)"),
       9},
      {"static",
       clip_xml(R"(<bar cells="4 1 1" size="1 0.1 0.1"/><mass density="1000"/>
                   <elasticity model="linear" young="1e6" poisson="0"/><fix side="-x"/>
                   <load side="+x" force="0 0 -0.1" until="0.2"/><probe name="tip" side="+x"/>
                   <answer probe="tip" quantity="dz" at="0.05" value="-1" tolerance="1"/>
                   <answer probe="tip" quantity="dz" value="-1" tolerance="1"/>)",
                "", R"(<time step="0.02" integrator="static" duration="0.3"/>)"),
       5},
      {"blown",
       clip_xml(R"(<sheet pattern="triangles" cells="5 5" size="1 1"/><mass total="0.1"/>)" + springs +
                    R"(<fix side="-x"/><load side="+x" force="0.1 0 0" until="0.2"/>
                                <contact with="floor obstacles fragments self" thickness="0.01"/>)",
                R"(<world gravity="0 0 -9.81"><floor z="-0.3"/><sphere centre="0.5 0.5 0.3" radius="0.1"
                            mass="0.1"/><sphere centre="0.7 0.2 -0.2" radius="0.1" velocity="0 0 1"/>
                            <box low="0.2 0.2 -0.3" high="0.4 0.4 -0.1"/><wind velocity="2 0 1"/></world>)",
                R"(<time step="1e-3" integrator="midpoint" duration="0.5"/>)", R"(<hud show="energy"/>)"),
       12},
      {"unguarded",
       clip_xml(sheet + pulled + tear + R"(<look by="fragment"/>)", "",
                R"(<time step="1e-3" integrator="rk4" duration="0.3"/>)"),
       6},
  };
}

// A run in this process; of its pictures only the last is drawn, and none written.
struct ForgedRun {
  Session session;
  FrameOutput output;
  std::string key;
  ForgedRun(const TestFolder& place, const Clip& clip)
      : session(options_in(place, clip)), output(session, files(), last_frame(session)),
        key(picture_key(session, 64, 48, 1)) {}
  static SessionOptions options_in(const TestFolder& place, const Clip& clip) {
    SessionOptions options;
    options.preset = (place.path() / "clip.xml").string();
    options.quiet = true;
    options.threads = 1; // fork() copies only the calling thread
    options.guard = clip.name != "unguarded";
    return options;
  }
  static PipelineOptions files() {
    PipelineOptions files;
    files.width = 64;
    files.height = 48;
    files.png = false;
    return files;
  }
  static FramePlan last_frame(const Session& session) {
    return {FrameChoice(std::to_string(session.clock().frames() - 1)), session.clock(), {}};
  }
  Stopped run(long first, long last) {
    return session.run(last, {[&](long frame) { output.take(frame); }, {}}, first);
  }
};

// A genuine checkpoint: a few steps beyond the frame before `next`.
std::string genuine(const TestFolder& place, const Clip& clip, long next) {
  ForgedRun run(place, clip);
  EXPECT_EQ(run.run(0, next - 1), Stopped::No);
  for (int n = 0; n < 3 && run.session.scene().steps_done() < run.session.clock().step_of(next); ++n)
    run.session.scene().step();
  const fs::path path = place.path() / "genuine.checkpoint";
  write_checkpoint(path, run.key, next, run.session, run.output);
  return content(path);
}

constexpr std::size_t sum_size = 8;
std::size_t head_size(const std::string& bytes) {
  return bytes.find('\n') + 1 + 16;
}

// With the correct checksum for these bytes.
std::string mended(std::string bytes) {
  const std::size_t end = bytes.size() - sum_size;
  std::uint64_t sum = hash_bytes(bytes.data(), head_size(bytes), 0);
  for (std::size_t at = head_size(bytes); at < end; at += Archive::piece)
    sum = hash_bytes(bytes.data() + at, std::min(Archive::piece, end - at), sum);
  std::memcpy(bytes.data() + end, &sum, sizeof sum);
  return bytes;
}

// Modifies a genuine checkpoint as an attacker would.
class Forger {
public:
  Forger(std::string bytes, std::string other, unsigned seed)
      : bytes_(std::move(bytes)), other_(std::move(other)), random_(seed) {
    for (const char* mark :
         {"map", "contacts", "guard", "seconds", "pictures", "scene", "position", "velocity"})
      for (std::size_t at = bytes_.find(mark); at != std::string::npos; at = bytes_.find(mark, at + 1))
        marks_.push_back(at);
  }

  // The forged bytes, and a description of the change.
  std::pair<std::string, std::string> next() {
    std::string out = bytes_;
    const std::size_t kind = below(12);
    const std::size_t a = head_size(out) + below(out.size() - head_size(out) - sum_size),
                      most = out.size() - sum_size;
    const std::size_t length = 1 + below(std::min<std::size_t>(most - a, below(2) ? 64 : 4096));
    std::string what;
    if (kind == 0) {
      out.erase(a, most - a);
      what = fmt::format("ends at {}", a);
    } else if (kind == 1) {
      out.erase(a, length);
      what = fmt::format("{} bytes at {} are gone", length, a);
    } else if (kind == 2) {
      out.insert(a, out.substr(a, length));
      what = fmt::format("{} bytes at {} stand there twice", length, a);
    } else if (kind == 3) {
      std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(a), length, below(2) ? '\0' : '\xff');
      what = fmt::format("{} bytes at {} are all alike", length, a);
    } else if (kind == 4) {
      const std::size_t from = std::min(a, other_.size() - sum_size);
      out = out.substr(0, a) + other_.substr(from);
      what = fmt::format("goes on at {} as a later one does", a);
    } else {
      for (std::size_t n = below(6) == 0 ? 1 + below(20) : 1; n > 0; --n) what += set_word(out);
    }
    return {mended(out), what};
  }

private:
  std::size_t below(std::size_t most) { return most == 0 ? 0 : random_() % most; }
  std::string set_word(std::string& out) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     inf = std::numeric_limits<double>::infinity();
    static const std::vector<double> reals{nan, inf, -inf, 1e308, -1e308, 1e30, -1, 0.5, 1e-310, 0, -0.0};
    static const std::vector<std::uint64_t> whole{
        0, 1, 2, ~0ULL, 1ULL << 31U, 1ULL << 60U, ~0U, 1ULL << 32U, 1ULL << 63U, (1ULL << 63U) - 1, 1000000};
    const std::size_t head = head_size(out);
    std::size_t at = head + below(out.size() - head - sum_size);
    if (below(2) == 0) at = marks_[below(marks_.size())] + below(160);
    if (below(40) == 0) at = head - 8; // the next frame
    const std::size_t room = out.size() - sum_size;
    at = std::min(at, room - 8);
    std::uint64_t word = 0;
    std::memcpy(&word, out.data() + at, 8);
    std::size_t size = 8;
    switch (below(6)) {
    case 0:
      std::memcpy(&word, &reals[below(reals.size())], 8);
      break;
    case 1:
      word = whole[below(whole.size())];
      break;
    case 2:
      word = whole[below(whole.size())];
      size = 4;
      break;
    case 3:
      word = below(2) ? word + 1 : word - 1;
      size = below(2) ? 4 : 8;
      break;
    case 4:
      word ^= 1ULL << below(64);
      break;
    default:
      word = below(2) ? random_() : below(4);
      size = below(2) ? 4 : 1;
    }
    std::memcpy(out.data() + at, &word, size);
    return fmt::format("{} bytes at {} are {:x}; ", size, at, word);
  }

  std::string bytes_, other_; // of two states of a run
  std::vector<std::size_t> marks_;
  std::mt19937_64 random_;
};

// Limits: 10 s of processor time, 1 GB of memory beyond the present use; stderr is discarded.
void limit() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const auto set = [](auto which, rlim_t most) {
    const rlimit both{most, most};
    setrlimit(which, &both);
  };
  set(RLIMIT_AS, pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (std::size_t{1} << 30U));
  set(RLIMIT_CPU, 10);
  set(RLIMIT_CORE, 0);
  if (std::getenv("REND_LOUD") == nullptr) std::freopen("/dev/null", "w", stderr);
}

// The exit code that the program would have: 65, 76, or 0 after some frames.
int go_on_from(const fs::path& path, ForgedRun& run) try {
  const long frames = run.session.clock().frames();
  const auto head = read_checkpoint(path, run.key, frames, run.session, run.output);
  if (!head) return 65; // its key or next frame does not fit
  if (run.run(head->next, frames - 1) == Stopped::Unstable) return 76;
  for (const auto& body : run.session.scene().bodies())
    for (const Record& x : body->map->position().values())
      if (!x.vec().allFinite()) return 70;
  return 0;
} catch (const UserError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.code);
} catch (const std::bad_alloc&) {
  return 75;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 70;
}

int in_a_process_of_its_own(const fs::path& path, ForgedRun& run) {
  const pid_t child = fork();
  if (child == 0) {
    limit();
    _exit(go_on_from(path, run));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class Forged : public testing::TestWithParam<Clip> {
protected:
  const TestFolder place;
};

TEST_P(Forged, is_refused_in_words_or_goes_on) {
  const Clip& clip = GetParam();
  place.write("clip.xml", clip.xml);
  const std::string bytes = genuine(place, clip, clip.next), later = genuine(place, clip, clip.next + 2);
  const fs::path path = place.path() / "forged.checkpoint";
  ForgedRun run(place, clip); // forked processes get it as it was built
  place.write("forged.checkpoint", mended(bytes));
  ASSERT_EQ(in_a_process_of_its_own(path, run), 0) << "as it was";
  Forger forger(bytes, later, 17);
  std::map<int, int> ends;
  for (int n = 0; n < (thorough() ? 3000 : 40); ++n) {
    const auto [forged, what] = forger.next();
    place.write("forged.checkpoint", forged);
    const int code = in_a_process_of_its_own(path, run);
    ++ends[code];
    EXPECT_THAT(code, testing::AnyOf(0, 65, 76)) << "number " << n << ": " << what;
  }
  std::string figures;
  for (const auto& [code, count] : ends) figures += fmt::format(" {} end with {}", count, code);
  RecordProperty("ends", figures);
  if (thorough()) fmt::print("{}:{}\n", clip.name, figures);
}

INSTANTIATE_TEST_SUITE_P(Every, Forged, testing::ValuesIn(clips()),
                         [](const auto& each) { return each.param.name; });

class ForgedClip : public program::StoppedClip {};

// The same for the whole program.
TEST_F(ForgedClip, ends_a_run_that_goes_on_from_it_in_words_or_not_at_all) {
  NEEDS_PNG;
  alone();
  stop_midway("c");
  const std::string bytes = in("c").at("clip.checkpoint");
  Forger forger(bytes, bytes, 23);
  for (int n = 0; n < (thorough() ? 100 : 4); ++n) {
    const auto [forged, what] = forger.next();
    fs::remove_all(place.path() / "d");
    fs::copy(place.path() / "c", place.path() / "d");
    place.write("d/clip.checkpoint", forged);
    const Outcome outcome = place.shell(fmt::format(
        "(ulimit -v 8000000; ulimit -t 60; exec {} render clip.xml -q --resume -o d)", test::rend_program));
    EXPECT_THAT(outcome.code, testing::AnyOf(0, 65, 76)) << what << outcome.err;
    const char* named = outcome.code == 65 ? "clip.checkpoint" : "";
    EXPECT_THAT(outcome.err, testing::HasSubstr(named)) << what;
  }
}

} // namespace
} // namespace rend::forged_checkpoint_test
