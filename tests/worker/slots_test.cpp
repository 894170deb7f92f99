#include "worker/slots.h"

#include <gtest/gtest.h>
#include <cstdlib>

namespace swarmsmith {
namespace {

TEST(Slots, ComeFromTheBatchSystemFirst) {
  setenv("SLURM_CPUS_PER_TASK", "7", 1);
  EXPECT_EQ(available_slots(), 7);
  setenv("SLURM_CPUS_PER_TASK", "many", 1);
  EXPECT_GE(available_slots(), 1);
  unsetenv("SLURM_CPUS_PER_TASK");
  EXPECT_GE(available_slots(), 1);
}

TEST(Slots, IdentitiesDiffer) {
  const WorkerIdentity one = identity_of_this_process(2, "1.0");
  const WorkerIdentity other = identity_of_this_process(2, "1.0");
  EXPECT_EQ(one.id.size(), kWorkerIdBytes);
  EXPECT_NE(one.id, other.id);
  EXPECT_FALSE(one.host.empty());
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
  setenv("SLURM_RESTART_COUNT", "2", 1);
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "12_4 restart 2");
  for (const char* name : {"SLURMD_NODENAME", "SLURM_JOB_ID", "SLURM_ARRAY_JOB_ID",
                           "SLURM_ARRAY_TASK_ID", "SLURM_RESTART_COUNT"}) {
    unsetenv(name);
  }
  EXPECT_NE(identity_of_this_process(1, "1.0").host, "n3");
  EXPECT_EQ(identity_of_this_process(1, "1.0").job, "");
}

}  // namespace
}  // namespace swarmsmith
