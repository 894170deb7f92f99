#include "tests/fuzz/fuzz.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith::fuzz {
namespace {

/// Refused with reasons, places and codes, or read to a calibration whose text reads back as the
/// same text.
template <class Parse>
void check(std::string_view input, const Parse& parse) {
  const auto calibration = parse(input, "calibration.toml");
  if (!calibration) return require_reasons(calibration.error(), "E_");
  const std::string text = calibration_text(*calibration);
  const auto again = parse(text, "again.toml");
  require(again.has_value(), "what is printed can be read");
  require(calibration_text(*again) == text, "what is printed reads back as the same");
}

}  // namespace

/// Each text as all three kinds of calibrations.
void run(std::string_view input) {
  check(input, parse_camera_calibration);
  check(input, parse_place_calibration);
  check(input, parse_offset_calibration);
}

}  // namespace swarmsmith::fuzz
