// Available memory, on simulated machines: folders with files as in /proc and /sys.
#include "render/batch/available_memory.h"
#include "tests/render/commands/program_run.h"

#include <gtest/gtest.h>

namespace rend::available_memory_test {
namespace {

namespace fs = std::filesystem;

class AvailableMemory : public testing::Test {
protected:
  AvailableMemory() {
    write("proc/meminfo", "MemTotal: 99999 kB\nMemFree: 10 kB\nMemAvailable:   8000 kB\nHugePages_Total:  0\n");
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((place.path() / name).parent_path());
    place.write(name, text);
  }
  void group_2(const std::string& folder, const std::string& most, long usage, long inactive = 0) const {
    const std::string at = "sys/fs/cgroup" + folder;
    write(at + "/memory.max", most + "\n");
    write(at + "/memory.current", std::to_string(usage) + "\n");
    write(at + "/memory.stat", "anon 5\ninactive_file " + std::to_string(inactive) + "\nactive_file 7\n");
  }
  std::size_t here() const { return available_memory(place.path()); }

  static constexpr const char* mount_2 =
      "30 23 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";
  static constexpr std::size_t machine = 8000 * 1024;
  const program::TestFolder place;
};

TEST_F(AvailableMemory, is_the_machines_where_there_are_no_groups) {
  EXPECT_EQ(here(), machine);
  EXPECT_EQ(available_memory(place.path() / "none"), std::size_t{1} << 30U);
  write("proc/self/cgroup", "0::/\n");
  write("proc/self/mountinfo", mount_2);
  EXPECT_EQ(here(), machine) << "the uppermost group has no limits";
}

TEST_F(AvailableMemory, is_the_least_of_the_group_and_its_parents) {
  write("proc/self/cgroup", "0::/slurm/job_7/step_0\n");
  write("proc/self/mountinfo", "22 1 8:1 / / rw - ext4 /dev/sda1 rw\n" + std::string(mount_2));
  group_2("/slurm/job_7/step_0", "max", 1000);
  group_2("/slurm/job_7", "5000000", 1000000);
  group_2("/slurm", "max", 9000000);
  group_2("/other", "10", 0);
  EXPECT_EQ(here(), 4000000u);
  group_2("/slurm/job_7", "5000000", 1000000, 600000);
  EXPECT_EQ(here(), 4600000u) << "files that were read once give way";
  group_2("/slurm/job_7/step_0", "2000000", 1500000);
  EXPECT_EQ(here(), 500000u);
  group_2("/slurm", "9000000", 9500000);
  EXPECT_EQ(here(), 0u) << "more is used than the limit, as after it was lowered";
}

TEST_F(AvailableMemory, is_of_the_groups_of_version_1_too) {
  write("proc/self/cgroup", "9:name=systemd:/\n4:cpu,memory:/box/job\n0::/\n");
  write("proc/self/mountinfo", "35 31 0:32 / /sys/fs/cgroup/cpu,memory rw - cgroup cgroup rw,cpu,memory\n"
                               "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
  const std::string at = "sys/fs/cgroup/cpu,memory";
  write(at + "/memory.limit_in_bytes", "9223372036854771712\n");
  write(at + "/memory.usage_in_bytes", "5000000\n");
  write(at + "/box/memory.limit_in_bytes", "3000000\n");
  write(at + "/box/memory.usage_in_bytes", "1000000\n");
  write(at + "/box/memory.stat", "inactive_file 1\ntotal_inactive_file 400000\n");
  EXPECT_EQ(here(), 2400000u);
}

// In a container the mount shows the container's own cgroup, and /proc names the group as the host or the
// container sees it.
TEST_F(AvailableMemory, is_of_the_group_of_a_container) {
  group_2("", "3000000", 1000000);
  for (const auto& [root, group] :
       {std::pair{"/docker/7f", "/docker/7f"}, {"/docker/7f", "/"}, {"/../..", "/"}}) {
    write("proc/self/cgroup", std::string("0::") + group + "\n");
    write("proc/self/mountinfo",
          std::string("30 23 0:26 ") + root + " /sys/fs/cgroup ro - cgroup2 cgroup rw\n");
    EXPECT_EQ(here(), 2000000u) << root << " " << group;
  }
}

} // namespace
} // namespace rend::available_memory_test
