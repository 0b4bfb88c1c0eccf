#pragma once

#include <OpenEXR/ImfPixelType.h>

#include "tenon/image/picture.h"

namespace tenon {

inline Imf::PixelType exr_type(ChannelType type) {
  switch (type) {
    case ChannelType::half:
      return Imf::HALF;
    case ChannelType::float32:
      return Imf::FLOAT;
    case ChannelType::uint32:
      break;
  }
  return Imf::UINT;
}

inline ChannelType channel_type(Imf::PixelType type) {
  return type == Imf::HALF ? ChannelType::half : type == Imf::FLOAT ? ChannelType::float32 : ChannelType::uint32;
}

}  // namespace tenon
