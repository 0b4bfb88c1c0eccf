#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/error.h"
#include "tenon/base/function_ref.h"
#include "tenon/scene/model.h"

namespace tenon {

/// When a small `$fn` is a wish for a polygon, and when round means round.
enum class Facets {
  automatic,  ///< `$fn` from 3 up to facets_threshold - 1 gives facets, anything else is round
  always,     ///< as OpenSCAD: every round primitive becomes the polyhedron that $fn, $fa and $fs ask for
  never,      ///< round whatever $fn says
};

inline constexpr int facets_threshold = 13;

struct LoadOptions {
  Facets facets = Facets::automatic;
  /// `-D name=value`: assignments in the scene language that override the file's own.
  std::vector<std::pair<std::string, std::string>> definitions = {};
  double time = 0;  ///< `$t`, of an animation: from 0 up to 1
};

/// Evaluates a scene file.
/// @param path         the file, of a scene or of a mesh; "-" reads standard input
/// @param options      see LoadOptions
/// @param diagnostics  receives warnings and the lines of `echo`
/// @return the model, or the first error with its place
Result<Model> load_model(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

/// Evaluates scene text. `name` stands for the file in messages; files it includes are sought beside it.
Result<Model> load_model_text(const std::string& text, const std::string& name, const LoadOptions& options,
                              Diagnostics& diagnostics);

/// The evaluated tree as text that load_model() reads back to the same model (`tenon convert -o x.csg`).
std::string print_csg(const Model& model);

/// What print_csg() says around the tree, and then each node that the root reaches, once, with the numbers of its
/// children: what tells two models apart, and is no longer than the graph is large.
void print_csg_nodes(const Model& model, FunctionRef<void(std::string_view)> take);

}  // namespace tenon
