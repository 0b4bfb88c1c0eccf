#pragma once

#include <string>

namespace tenon {

/// The name of a frame's file, as OpenSCAD numbers them: turn.png is turn00000.png, turn00001.png, and so on.
std::string frame_path(const std::string& output, int frame);

/// The definition that sets `$t` for a frame: it goes from 0 up to 1, which belongs to the next turn.
std::string frame_definition(int frame, int frames);

}  // namespace tenon
