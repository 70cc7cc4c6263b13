// Signals: the handler itself, in a process that blocks for ever; and the program as a user runs it.
#include "render/console/signals.h"

#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <pty.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

namespace rend::signals_test {
namespace {

using program::content;
using program::Files;
using program::Outcome;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::array signals{SIGHUP, SIGINT, SIGTERM, SIGXCPU};

// A child process that catches signals and runs an action; what it writes to `tell` is read here.
class ChildWithHandlers {
public:
  explicit ChildWithHandlers(const std::function<void(int tell)>& what) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    process_ = ::fork();
    if (process_ == 0) {
      ::close(ends[0]);
      // resets dispositions inherited from the test runner
      for (const int signal : signals) std::signal(signal, SIG_DFL);
      what(ends[1]);
      ::_exit(0);
    }
    ::close(ends[1]);
    told_ = ends[0];
  }
  ~ChildWithHandlers() {
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
    }
    ::close(told_);
  }
  ChildWithHandlers(const ChildWithHandlers&) = delete;
  ChildWithHandlers& operator=(const ChildWithHandlers&) = delete;

  void send(int signal) const { ::kill(process_, signal); }
  char next_word() const { // 0: it has ended
    char word = 0;
    return ::read(told_, &word, 1) == 1 ? word : '\0';
  }
  bool ended() {
    int status = 0;
    if (process_ > 0 && ::waitpid(process_, &status, WNOHANG) == process_) {
      process_ = -1;
      code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    return process_ < 0;
  }
  // Its exit code, after at most 20 s; meanwhile it is sent the signal repeatedly, if one is given.
  int code(int signal = 0) {
    for (int n = 0; n < 2000 && !ended(); ++n) {
      if (signal != 0) send(signal);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return code_;
  }

private:
  pid_t process_ = -1;
  int told_ = -1, code_ = -1000;
};

void tell(int where, char word) {
  EXPECT_EQ(::write(where, &word, 1), 1);
}

// A call that blocks for ever, in a process that reports just before it.
class Pipe {
public:
  Pipe() { EXPECT_EQ(::mkfifo((place_.path() / "pipe").c_str(), 0666), 0); }
  void wait_for_ever(int where) const {
    const std::string name = (place_.path() / "pipe").string();
    tell(where, 'r');
    while (true) ::open(name.c_str(), O_RDONLY); // blocks until a writer opens it
  }

private:
  program::TestFolder place_;
};

TEST(Signals, end_a_program_at_once_that_has_nothing_to_keep) {
  const Pipe pipe;
  for (const int signal : signals) {
    ChildWithHandlers other([&](int where) {
      catch_signals();
      pipe.wait_for_ever(where);
    });
    ASSERT_EQ(other.next_word(), 'r');
    other.send(signal);
    EXPECT_EQ(other.code(), 128 + signal);
  }
}

TEST(Signals, end_a_program_that_waits_for_ever_the_second_time) {
  const Pipe pipe;
  for (const int signal : signals) {
    ChildWithHandlers other([&](int where) {
      catch_signals();
      const GracefulStop graceful_stop;
      pipe.wait_for_ever(where);
    });
    ASSERT_EQ(other.next_word(), 'r');
    EXPECT_EQ(other.code(signal), 128 + signal);
  }
}

TEST(Signals, sent_at_once_are_one_and_the_next_ends_the_program) {
  ChildWithHandlers other([&](int where) {
    catch_signals();
    const GracefulStop graceful_stop;
    tell(where, 'r');
    while (stop_signal() == 0) std::this_thread::yield();
    tell(where, 's');
    while (true) ::pause();
  });
  ASSERT_EQ(other.next_word(), 'r');
  other.send(SIGSTOP);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) other.send(signal);
  other.send(SIGCONT); // now all three are pending, and handled one after another
  EXPECT_EQ(other.next_word(), 's');
  EXPECT_FALSE(other.ended());
  EXPECT_EQ(other.code(SIGTERM), 143);
}

// The kernel sends SIGXCPU every second once the limit is reached; a user sends it with another si_code.
TEST(Signals, a_limit_of_processor_time_is_no_second_signal) {
  ChildWithHandlers other([&](int where) {
    catch_signals();
    const GracefulStop graceful_stop;
    siginfo_t how{};
    how.si_signo = SIGXCPU;
    how.si_code = SI_KERNEL;
    const auto by_the_system = [&] { ::syscall(SYS_rt_sigqueueinfo, ::getpid(), SIGXCPU, &how); };
    by_the_system();
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    by_the_system();
    tell(where, stop_signal() == SIGXCPU ? 's' : 'n');
    while (true) ::pause();
  });
  EXPECT_EQ(other.next_word(), 's');
  EXPECT_EQ(other.code(SIGXCPU), 152);
}

TEST(Signals, that_were_ignored_from_the_start_stay_so) {
  ChildWithHandlers other([&](int where) {
    std::signal(SIGHUP, SIG_IGN);
    std::signal(SIGINT, SIG_IGN);
    catch_signals();
    ::raise(SIGHUP);
    ::raise(SIGINT);
    tell(where, 'r');
    while (true) ::pause();
  });
  EXPECT_EQ(other.next_word(), 'r');
  other.send(SIGTERM);
  EXPECT_EQ(other.code(), 143);
}

class SignalledProgram : public program::StoppedClip {
protected:
  SignalledProgram() { place.write("pulled.xml", program::pulled); }
  static std::string without_end() { return " --set time.duration=1e5 --set body.drive.until=0.1"; }
};

TEST_F(SignalledProgram, leaves_a_checkpoint_to_go_on_from) {
  NEEDS_PNG;
  const std::string line = "render clip.xml --resume --set time.step=5e-5 -o ";
  EXPECT_EQ(place.rend(line + "alone -q").code, 0);
  for (const auto& [signal, code] : {std::pair{"HUP", 129}, {"XCPU", 152}}) {
    const std::string folder = signal;
    const Outcome first = stopped_when("[ -e " + folder + "/00000.png ]", line + folder, signal);
    EXPECT_EQ(first.code, code) << first.err;
    EXPECT_THAT(first.err, HasSubstr("repeat the command with --resume"));
    EXPECT_TRUE(in(folder).contains("clip.checkpoint"));
    EXPECT_THAT(place.rend(line + folder).err, HasSubstr("continuing at"));
    expect_same(in(folder), in("alone"), "");
  }
}

TEST_F(SignalledProgram, stops_at_its_limit_of_processor_time) {
  NEEDS_PNG;
  const Outcome outcome = place.shell("(ulimit -S -t 1; exec " + std::string(test::rend_program) +
                                      " render pulled.xml -o c" + without_end() + ")");
  EXPECT_EQ(outcome.code, 152) << outcome.err;
  EXPECT_TRUE(in("c").contains("pulled.checkpoint"));
}

TEST_F(SignalledProgram, goes_on_under_nohup) {
  NEEDS_PNG;
  const Outcome outcome = place.shell("trap '' HUP; " + std::string(test::rend_program) +
                                      " render clip.xml -q -o c & until "
                                      "[ -e c/00000.png ] || ! kill -0 $!; do sleep 0.005; done; kill -HUP $!; "
                                      "wait $!");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(in("c").size(), 31u);
}

TEST_F(SignalledProgram, stops_when_its_terminal_goes) {
  NEEDS_PNG;
  const std::string preset = (place.path() / "pulled.xml").string(), folder = (place.path() / "c").string();
  int terminal = -1;
  const pid_t process = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (process == 0) {
    ::execl(test::rend_program, "rend", "render", preset.c_str(), "-o", folder.c_str(), "--set",
            "time.duration=1e5", "--set", "body.drive.until=0.1", nullptr);
    ::_exit(127);
  }
  int status = 0;
  while (!fs::exists(place.path() / "c/00000.png") && ::waitpid(process, &status, WNOHANG) == 0) {
    std::array<char, 4096> said{};
    if (::read(terminal, said.data(), said.size()) < 0) break;
  }
  ::close(terminal);
  EXPECT_EQ(::waitpid(process, &status, 0), process);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 129) << status;
  EXPECT_TRUE(in("c").contains("pulled.checkpoint"));
}

// From a pipe without a writer.
TEST_F(SignalledProgram, that_waits_for_its_input_ends_at_once) {
  NEEDS_PNG;
  ASSERT_EQ(place.shell("mkfifo pipe.xml").code, 0);
  const std::string caught = "[ $((0x$(sed -n 's/^SigCgt:[^0-9a-f]*//p' /proc/$pid/status) & 0x4000)) -ne 0 ]";
  for (const char* line : {"info pipe.xml", "run pipe.xml", "render pipe.xml", "study pipe.xml",
                           "study --lean pipe.xml", "sheet pipe.xml -o s.png", "diff . . -t pipe.xml"}) {
    const auto [code, out, err] = place.shell(
        fmt::format("timeout -s KILL 20 {} {} & until pid=$(pgrep -P $!) && {}; do sleep 0.005; done; "
                    "kill -TERM $pid; wait $!",
                    test::rend_program, line, caught));
    EXPECT_EQ(code, 143) << line << out << err;
  }
  EXPECT_EQ(place.shell("timeout -s KILL 20 " + std::string(test::rend_program) + " check pipe.xml").code, 66)
      << "it is read often";
}

TEST_F(SignalledProgram, of_many_jobs_ends_all_of_them) {
  NEEDS_PNG;
  place.write("also.xml", program::pulled);
  const Outcome outcome = place.shell(
      std::string(test::rend_program) + " batch pulled.xml also.xml -o b -q --jobs 2 --memory 8G" +
      without_end() +
      " & batch=$!; until [ -e b/pulled/00001.png ] && [ -e b/also/00001.png ] || ! kill -0 $batch; "
      "do sleep 0.005; done; jobs=$(pgrep -P $batch); kill -HUP $batch; wait $batch; code=$?; "
      "for job in $jobs; do kill -0 $job 2>&1 && echo $job is still there; done; exit $code");
  EXPECT_EQ(outcome.code, 129) << outcome.err;
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("is still there")));
  for (const char* name : {"b/pulled/pulled.checkpoint", "b/also/pulled.checkpoint", "b/index.html"})
    EXPECT_TRUE(fs::exists(place.path() / name)) << name;
}

} // namespace
} // namespace rend::signals_test
