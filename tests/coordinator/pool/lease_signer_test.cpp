#include "coordinator/pool/lease_signer.h"

#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include "coordinator/pool/task_key.h"

namespace swarmsmith {
namespace {

Task task_of(std::int64_t candidate, const std::string& machine) {
  return {{.machine = machine}, {{candidate}, Purpose::Race, 1}};
}

TEST(LeaseSigner, SignsKeyAttemptAndPrincipal) {
  const LeaseSigner signer(lease_secret_of("secret", 1));
  const Task one = task_of(1, "m");
  const std::set<std::uint64_t> signatures = {
      signer.sign(one, 1, "a"), signer.sign(task_of(2, "m"), 1, "a"),
      signer.sign(one, 2, "a"), signer.sign(one, 1, "b"),
      signer.sign(one, 1, ""),  signer.draw(key_of(one))};
  EXPECT_EQ(signatures.size(), 6U);
  const std::uint64_t signature = signer.sign(one, 1, "a");
  EXPECT_EQ(signature, LeaseSigner(lease_secret_of("secret", 1)).sign(one, 1, "a"));
  EXPECT_TRUE(signer.is_ours(signature, key_of(one), 1, "a"));
  EXPECT_FALSE(signer.is_ours(signature, key_of(one), 2, "a"));
  EXPECT_FALSE(signer.is_ours(signature, key_of(one), 1, "b"));
  EXPECT_FALSE(signer.is_ours(signature ^ 1, key_of(one), 1, "a"));
  EXPECT_FALSE(signer.is_ours(signature ^ std::uint64_t{1} << 63, key_of(one), 1, "a"));
  EXPECT_FALSE(signer.is_ours(0, key_of(one), 1, "a"));
}

TEST(LeaseSigner, TellsTasksOfOneKeyApart) {
  const LeaseSigner signer(lease_secret_of("secret", 1));
  const Task one = task_of(1, "m");
  const std::uint64_t signature = signer.sign(one, 1, "a");
  EXPECT_TRUE(signer.is_of(signature, one));
  std::vector<Task> others(6, one);
  others[0].mission = 1;
  others[1].method = 1;
  others[2].instance = 7;
  others[3].seed = 7;
  others[4].machine = "n";
  others[5].bound = 7;
  for (const Task& other : others) {
    SCOPED_TRACE(&other - others.data());
    EXPECT_FALSE(signer.is_of(signature, other));
    EXPECT_TRUE(signer.is_of(signer.sign(other, 1, "a"), other));
    EXPECT_TRUE(signer.is_ours(signer.sign(other, 1, "a"), key_of(one), 1, "a"));
  }
}

/// The secret is kept in the store, so workers may return leases of a coordinator's earlier
/// release. The numbers are from SipHash-2-4 in Python, which gives the value in its paper's
/// appendix.
TEST(LeaseSigner, GivesTheSameSignaturesInEachRelease) {
  const LeaseSigner signer(lease_secret_of("secret", 1));
  const Task task{
      {.mission = 3, .method = 4, .instance = 5, .seed = 6, .machine = "-n 1", .bound = 7.5},
      {{9}, Purpose::Race, 3}};
  EXPECT_EQ(signer.sign(task, 2, "node1@10.0.0.5"), 0xa9cc738688c0905bU);
  EXPECT_EQ(signer.draw(key_of(task)), 0xf59a3acef028863fU);
}

TEST(LeaseSigner, HasASecretAScenario) {
  EXPECT_NE(lease_secret_of("secret", 1), lease_secret_of("secret", 2));
  EXPECT_NE(lease_secret_of("secret", 1), lease_secret_of("another", 1));
  EXPECT_NE(LeaseSigner(lease_secret_of("secret", 1)).sign(task_of(1, "m"), 1, "a"),
            LeaseSigner(lease_secret_of("secret", 2)).sign(task_of(1, "m"), 1, "a"));
}

TEST(LeaseSigner, MakesSecretsThatDiffer) {
  EXPECT_EQ(random_secret().size(), 64U);
  EXPECT_NE(random_secret(), random_secret());
  EXPECT_TRUE(same_secret("ab", "ab"));
  EXPECT_FALSE(same_secret("ab", "ac"));
  EXPECT_FALSE(same_secret("", "")) << "an empty secret fits none";
}

}  // namespace
}  // namespace swarmsmith
