#include "sim/files/internal/read_profile.h"

#include "sim/engine/profile_fields.h"
#include "sim/files/internal/field_reader.h"

namespace swarmsmith {

void read_profile_fields(TableReader& table, Profile& profile) {
  FieldReader reader(table, &profile.ranges);
  visit_profile_fields(profile, reader);
  reader.finish();
}

}  // namespace swarmsmith
