#pragma once

#include <nlohmann/json.hpp>

#include "lab/lab_table.h"
#include "lab/origin.h"
#include "lab/paper.h"

namespace tenon {

/// A measured table as it is kept: with the paper's figures beside ours, what it was measured with, and how long it
/// took. Pages are made of this, and programs may read it.
nlohmann::ordered_json lab_json(const LabTable& table, const Paper& paper, const LabOrigin& origin,
                                const std::string& effort, double seconds);

}  // namespace tenon
