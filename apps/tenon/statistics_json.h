#pragma once

#include <string>

#include "scene_arguments.h"
#include "tenon/render/renderer.h"

namespace tenon {

/// What `--stats` writes.
std::string statistics_json(const std::string& accelerator, const TraceableScene& traceable,
                            const Rendering& rendering);

}  // namespace tenon
