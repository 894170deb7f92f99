#include "coordinator/lease_signer.h"

#include <gtest/gtest.h>
#include <set>

namespace swarmsmith {
namespace {

TEST(LeaseSigner, SignsKeyAttemptAndPrincipal) {
  const LeaseSigner signer(lease_secret_of("secret", 1));
  const std::set<std::uint64_t> signatures = {signer.sign(1, 1, "a"), signer.sign(2, 1, "a"),
                                              signer.sign(1, 2, "a"), signer.sign(1, 1, "b"),
                                              signer.sign(1, 1, ""),  signer.draw(1)};
  EXPECT_EQ(signatures.size(), 6U);
  EXPECT_EQ(signer.sign(1, 1, "a"), LeaseSigner(lease_secret_of("secret", 1)).sign(1, 1, "a"));
}

TEST(LeaseSigner, HasASecretAScenario) {
  EXPECT_NE(lease_secret_of("secret", 1), lease_secret_of("secret", 2));
  EXPECT_NE(lease_secret_of("secret", 1), lease_secret_of("another", 1));
  EXPECT_NE(LeaseSigner(lease_secret_of("secret", 1)).sign(1, 1, "a"),
            LeaseSigner(lease_secret_of("secret", 2)).sign(1, 1, "a"));
}

TEST(LeaseSigner, MakesSecretsThatDiffer) {
  EXPECT_EQ(random_secret().size(), 64U);
  EXPECT_NE(random_secret(), random_secret());
  EXPECT_TRUE(same_secret("ab", "ab"));
  EXPECT_FALSE(same_secret("ab", "ac"));
  EXPECT_FALSE(same_secret("", "")) << "no secret is nobody's";
}

}  // namespace
}  // namespace swarmsmith
