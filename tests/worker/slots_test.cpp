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

}  // namespace
}  // namespace swarmsmith
