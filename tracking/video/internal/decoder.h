#pragma once

#include <string>

#include "base/expected.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// A decoder on one thread that says what is damaged. E_VIDEO_UNREADABLE for a codec that is not
/// known or not taken.
Expected<Codec> open_decoder(const AVCodecParameters& about, AVRational time_base,
                             const std::string& name);

/// Whether each picture stands for itself, so that damage ends with it.
bool is_intra_only(AVCodecID codec);

/// The largest picture that is taken of a codec.
std::int64_t most_pixels(AVCodecID codec);

/// Names of the decoders that are taken, with commas.
extern const char* const kTakenDecoders;

}  // namespace swarmsmith::av
