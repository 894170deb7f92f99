#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "tracking/video/internal/av.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith::av {

/// A container format, chosen by the file name's extension.
struct Container {
  std::string_view ending;
  const char* muxer;
  AVRational grain;  ///< resolution of its times; 0: one frame
};

/// A codec, with its name in VideoOptions.
struct CodecChoice {
  std::string_view name;
  const char* encoder;
  AVPixelFormat format;
};

/// The container and codec for writing a video.
struct VideoChoice {
  const Container* container = nullptr;
  const CodecChoice* codec = nullptr;
};

/// E_CONFIG for an impossible choice.
Expected<VideoChoice> video_choice(const std::string& path, ImageSize size,
                                   const VideoOptions& options);

/// An encoder whose output is always the same bytes for the same input; not opened yet.
Codec make_encoder(const AVCodec& encoder, const VideoChoice& choice, ImageSize size,
                   const VideoOptions& options);

}  // namespace swarmsmith::av
