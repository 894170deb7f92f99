#include "irace_core/internal/kept_configuration.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "base/rng.h"

namespace swarmsmith::irace {
namespace {

TEST(KeptConfigurationTest, GivesTheSameBitsBack) {
  Rng rng(1);
  for (const std::size_t size : {0U, 1U, 7U, 254U, 255U, 256U, 600U, 1111U}) {
    for (int round = 0; round < 20; ++round) {
      Configuration configuration(size);
      for (std::size_t i = 0; i < size; ++i) {
        switch (rng.uniform_int(0, 5)) {
          case 0:
            configuration.set(i, static_cast<double>(rng.uniform_int(0, 300)));
            break;
          case 1:
            configuration.set(i, rng.uniform() * 1e6);
            break;
          case 2:
            configuration.set(i, -static_cast<double>(rng.uniform_int(0, 1000)));
            break;
          default:
            break;
        }
      }
      KeptConfiguration kept(configuration);
      for (int again = 0; again < 2; ++again) {
        kept.put_away();
        kept.put_away();
        EXPECT_EQ(kept.get(), configuration);
        EXPECT_EQ(kept.get().digest(), configuration.digest());
      }
    }
  }
}

TEST(KeptConfigurationTest, KeepsValuesAtTheEndsOfTheirCodes) {
  Configuration configuration(8);
  const double values[] = {0,    253,  254,         255, std::numeric_limits<double>::infinity(),
                           1e-9, -1.0, 4294967296.0};
  for (std::size_t i = 0; i < 8; ++i)
    configuration.set(i, values[i]);
  KeptConfiguration kept(configuration);
  kept.put_away();
  EXPECT_EQ(kept.get(), configuration);
}

}  // namespace
}  // namespace swarmsmith::irace
