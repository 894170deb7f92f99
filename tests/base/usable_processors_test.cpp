#include "base/usable_processors.h"

#include <gmock/gmock.h>
#include <sched.h>
#include <fstream>

#include "base/cgroup.h"
#include "base/mounts.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// A folder with the files of /proc and /sys that a test writes.
class Host : public testing::Test {
 protected:
  void write(const std::filesystem::path& file, const std::string& text) const {
    const std::filesystem::path path = root() / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::filesystem::path root() const { return folder.path(); }
  std::optional<double> processors() const { return cgroup_limits(root()).processors; }

  /// Version 2, mounted where most systems have it.
  void mount_second(const std::string& inside = "/",
                    const std::string& point = "/sys/fs/cgroup") const {
    write("proc/self/mountinfo", "22 1 0:5 / /proc rw,nosuid - proc proc rw\n30 22 0:26 " + inside +
                                     " " + point +
                                     " rw,relatime shared:9 - cgroup2 cgroup2 rw,nsdelegate\n");
  }

  TemporaryFolder folder;
};

TEST_F(Host, WithoutGroupsHasNoLimit) {
  EXPECT_EQ(cgroup_limits(root()), CgroupLimits());
  write("proc/self/cgroup", "0::/\n");
  mount_second();
  EXPECT_EQ(cgroup_limits(root()), CgroupLimits());
  EXPECT_GE(usable_processors(root()), 1);
}

TEST_F(Host, OfVersion2HasTheLeastOfAllGroupsAbove) {
  write("proc/self/cgroup", "0::/user/job 7/step\n");
  mount_second();
  write("sys/fs/cgroup/user/job 7/step/cpu.max", "max 100000\n");
  write("sys/fs/cgroup/user/job 7/cpu.max", "150000 100000\n");
  write("sys/fs/cgroup/user/cpu.max", "400000 100000\n");
  write("sys/fs/cgroup/other/cpu.max", "1000 100000\n");
  write("sys/fs/cgroup/user/memory.max", "1000000000\n");
  write("sys/fs/cgroup/user/job 7/memory.max", "max\n");
  EXPECT_EQ(cgroup_limits(root()), (CgroupLimits{1.5, 1'000'000'000}));
}

TEST_F(Host, OfVersion1HasAHierarchyForEachController) {
  write("proc/self/cgroup", "9:name=systemd:/x\n4:memory:/m\n2:cpu,cpuacct:/job/7\n0::/x\n");
  write("proc/self/mountinfo",
        "31 30 0:28 / /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n"
        "34 30 0:31 / /groups/memory rw - cgroup none rw,memory\n"
        "35 30 0:32 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
        "40 30 0:37 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
  write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  write("sys/fs/cgroup/cpu,cpuacct/job/7/cpu.cfs_quota_us", "25000\n");
  write("sys/fs/cgroup/cpu,cpuacct/job/7/cpu.cfs_period_us", "50000\n");
  write("sys/fs/cgroup/cpuset/cpu.cfs_quota_us", "1\n");
  write("sys/fs/cgroup/cpuset/cpu.cfs_period_us", "100000\n");
  write("groups/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write("groups/memory/m/memory.limit_in_bytes", "64000000\n");
  EXPECT_EQ(cgroup_limits(root()), (CgroupLimits{0.5, 64'000'000}));
}

/// A container without a namespace of groups sees the host's paths, and its own group alone.
TEST_F(Host, InAContainerIsWhereItsGroupIsMounted) {
  write("proc/self/cgroup", "0::/docker/ab12/inner\n");
  mount_second("/docker/ab12", "/sys/fs/my\\040groups");
  write("sys/fs/my groups/cpu.max", "50000 100000\n");
  EXPECT_EQ(processors(), 0.5);
  write("sys/fs/my groups/inner/cpu.max", "20000 100000\n");
  EXPECT_EQ(processors(), 0.2);
}

TEST_F(Host, BelieveOnlyMountsThatShowItsOwnGroups) {
  write("sys/fs/cgroup/cpu.max", "50000 100000\n");
  write("proc/self/cgroup", "0::/mine\n");
  mount_second("/other");
  EXPECT_EQ(processors(), std::nullopt);
  // From outside of its namespace: a group above.
  write("proc/self/cgroup", "0::/\n");
  mount_second("/../..");
  EXPECT_EQ(processors(), 0.5);
  mount_second("/../other");
  EXPECT_EQ(processors(), std::nullopt);
  // It was moved out of its namespace.
  write("proc/self/cgroup", "0::/../other\n");
  mount_second();
  EXPECT_EQ(processors(), std::nullopt);
}

TEST_F(Host, WithFilesOfAnotherFormHasNoLimit) {
  write("proc/self/cgroup", "0::/\nno colons\n0:\n");
  mount_second();
  for (const char* text : {"", "max", "max 100000", "50000", "-5 100000", "5 0", "x y", "nan 1"}) {
    write("sys/fs/cgroup/cpu.max", text);
    EXPECT_EQ(processors(), std::nullopt) << text;
  }
}

TEST(Processors, AreRoundedToTheNearestAndNeverNone) {
  EXPECT_EQ(processors_within(8, std::nullopt), 8);
  EXPECT_EQ(processors_within(8, 0.05), 1);
  EXPECT_EQ(processors_within(8, 0.5), 1);
  EXPECT_EQ(processors_within(8, 1.4), 1);
  EXPECT_EQ(processors_within(8, 1.5), 2);
  EXPECT_EQ(processors_within(2, 1.9), 2);
  EXPECT_EQ(processors_within(2, 64.0), 2);
  EXPECT_EQ(processors_within(0, std::nullopt), 1);
}

TEST(Processors, AreThoseOfTheMask) {
  cpu_set_t before;
  CPU_ZERO(&before);
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  const TemporaryFolder nothing;
  EXPECT_EQ(usable_processors(nothing.path()), CPU_COUNT(&before));
  cpu_set_t one;
  CPU_ZERO(&one);
  for (std::size_t cpu = 0; CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(usable_processors(), 1);
  sched_setaffinity(0, sizeof before, &before);
}

TEST(Mounts, HaveProcAmongThem) {
  EXPECT_THAT(mounts(), testing::Contains(testing::Field(&Mount::type, "proc")));
}

}  // namespace
}  // namespace swarmsmith
