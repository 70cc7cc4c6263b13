#include "render/files/temporaries.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace rend {
namespace {

TemporaryPath* newest = nullptr;
std::atomic_flag list_lock;             // spin lock of the list: a signal handler must not lock a mutex
std::atomic<int> opening = 0;           // files that are being created and not in the list yet
std::atomic<bool> program_ends = false; // all are removed, or are being removed

constexpr int most_waits = 100; // of one millisecond each: a file system may hang

void wait_a_moment() {
  const timespec moment{0, 1'000'000};
  ::nanosleep(&moment, nullptr);
}

class ListLock {
public:
  ListLock() {
    while (list_lock.test_and_set()) ::sched_yield();
  }
  ~ListLock() { list_lock.clear(); }
  ListLock(const ListLock&) = delete;
  ListLock& operator=(const ListLock&) = delete;
};

void block_until_exit() {
  while (program_ends) ::pause();
}

// By getdents64, since readdir() allocates memory.
void remove_files_in(const char* path) {
  const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  alignas(8) static std::array<char, 32768> entries;
  for (long count; (count = ::syscall(SYS_getdents64, folder, entries.data(), entries.size())) > 0;) {
    for (long at = 0; at < count;) {
      const char* entry = entries.data() + at; // struct linux_dirent64
      std::uint16_t length = 0;
      std::memcpy(&length, entry + 16, sizeof length);
      ::unlinkat(folder, entry + 19, 0);
      at += length;
    }
  }
  ::close(folder);
}

} // namespace

TemporaryPath::TemporaryPath() {
  ++opening;
  if (!program_ends) return;
  --opening;
  block_until_exit();
}

TemporaryPath::TemporaryPath(const char* path) : TemporaryPath() {
  register_path(path);
}

TemporaryPath::~TemporaryPath() {
  unregister();
}

void TemporaryPath::register_path(const char* path) {
  path_ = path;
  {
    const ListLock list;
    before_ = newest;
    if (newest != nullptr) newest->after_ = this;
    newest = this;
  }
  if (opening_) --opening;
  opening_ = false;
}

void TemporaryPath::remove_contents() {
  with_files_ = true;
}

void TemporaryPath::unregister() {
  if (opening_) --opening;
  opening_ = false;
  if (path_ == nullptr) return;
  const ListLock list;
  (after_ != nullptr ? after_->before_ : newest) = before_;
  if (before_ != nullptr) before_->after_ = after_;
  before_ = after_ = nullptr;
  path_ = nullptr;
}

void TemporaryPath::remove() const noexcept {
  if (with_files_) remove_files_in(path_);
  if (::unlink(path_) != 0) ::rmdir(path_);
}

void remove_temporaries() noexcept {
  program_ends = true;
  for (int n = 0; n < most_waits && opening > 0; ++n) wait_a_moment();
  for (int n = 0; n < most_waits && list_lock.test_and_set(); ++n) wait_a_moment();
  for (const TemporaryPath* one = newest; one != nullptr; one = one->before_) one->remove();
}

} // namespace rend
