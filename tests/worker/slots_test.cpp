#include "worker/slots.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <utility>

#include "base/usable_processors.h"

namespace swarmsmith {
namespace {

TEST(Slots, ComeFromTheBatchSystemFirst) {
  const int usable = std::clamp(usable_processors(), 1, 4096);
  const std::pair<const char*, int> cases[] = {{"7", 7},
                                               {"1", 1},
                                               {"4096", 4096},
                                               {"4097", 4096},
                                               {"2147483647", 4096},
                                               {"0", usable},
                                               {"-3", usable},
                                               {"many", usable},
                                               {"", usable},
                                               {"7x", usable},
                                               {" 7", usable},
                                               {"7 ", usable},
                                               {"1e2", usable},
                                               {"99999999999", usable}};
  for (const auto& [text, slots] : cases) {
    setenv("SLURM_CPUS_PER_TASK", text, 1);
    EXPECT_EQ(available_slots(), slots) << text;
  }
  unsetenv("SLURM_CPUS_PER_TASK");
  EXPECT_EQ(available_slots(), usable);
}

/// The value of the first line "model name : ..." of /proc/cpuinfo; other processors have none.
std::string first_model() {
  std::ifstream info("/proc/cpuinfo");
  const std::string text{std::istreambuf_iterator<char>(info), {}};
  std::smatch match;
  return std::regex_search(text, match, std::regex("(^|\n)model name\\s*: ([^\n]*)"))
             ? match[2].str()
             : "";
}

TEST(Slots, AnIdentityDescribesThisProcess) {
  const WorkerIdentity identity = identity_of_this_process(2, "1.0");
  std::array<char, 1024> host{};
  ASSERT_EQ(gethostname(host.data(), host.size() - 1), 0);
  EXPECT_EQ(identity.build, "1.0");
  EXPECT_EQ(identity.slots, 2);
  EXPECT_EQ(identity.host, host.data());
  EXPECT_EQ(identity.pid, getpid());
  EXPECT_EQ(identity.job, "");
  EXPECT_EQ(identity.cpu, first_model());
  EXPECT_EQ(identity.secret, "");
}

/// All bits of all bytes are random.
TEST(Slots, IdentitiesDiffer) {
  std::array<unsigned, kWorkerIdBytes> ones{};
  std::array<unsigned, kWorkerIdBytes> zeros{};
  for (int i = 0; i < 64; ++i) {
    const std::string id = identity_of_this_process(2, "1.0").id;
    ASSERT_EQ(id.size(), kWorkerIdBytes);
    for (std::size_t at = 0; at < id.size(); ++at) {
      ones[at] |= static_cast<unsigned char>(id[at]);
      zeros[at] |= static_cast<unsigned char>(~id[at]);
    }
  }
  for (std::size_t at = 0; at < kWorkerIdBytes; ++at) {
    EXPECT_EQ(ones[at], 255U);
    EXPECT_EQ(zeros[at], 255U);
  }
}

TEST(Slots, AWorkerInAJobNamesNodeAndJob) {
  setenv("SLURMD_NODENAME", "n3", 1);
  setenv("SLURM_JOB_ID", "17", 1);
  EXPECT_EQ(identity_of_this_process(1, "1.0").host, "n3");
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "17");
  // An element of an array has a job id of its own, which no person knows.
  setenv("SLURM_ARRAY_JOB_ID", "12", 1);
  setenv("SLURM_ARRAY_TASK_ID", "4", 1);
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "12_4");
  setenv("SLURM_RESTART_COUNT", "0", 1);
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "12_4");
  setenv("SLURM_RESTART_COUNT", "1", 1);
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "12_4 restart 1");
  setenv("SLURM_RESTART_COUNT", "2", 1);
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "12_4 restart 2");
  unsetenv("SLURM_ARRAY_JOB_ID");
  unsetenv("SLURM_JOB_ID");
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "") << "no job was restarted";
  for (const char* name : {"SLURMD_NODENAME", "SLURM_JOB_ID", "SLURM_ARRAY_JOB_ID",
                           "SLURM_ARRAY_TASK_ID", "SLURM_RESTART_COUNT"}) {
    unsetenv(name);
  }
  EXPECT_NE(identity_of_this_process(1, "1.0").host, "n3");
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "");
}

}  // namespace
}  // namespace swarmsmith
