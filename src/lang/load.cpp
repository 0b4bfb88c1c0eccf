#include "tenon/lang/load.h"

#include <filesystem>
#include <functional>
#include <new>
#include <optional>

#include "lang/deep_stack.h"
#include "lang/format.h"
#include "lang/module_evaluator.h"
#include "lang/parser.h"
#include "mesh/load_mesh.h"

namespace tenon {

namespace {

using namespace lang;

std::string definitions_text(const LoadOptions& options) {
  std::string text;
  for (const auto& [name, value] : options.definitions) text += name + " = " + value + ";\n";
  return text;
}

// On the deep stack: everything that may recurse, the destruction of values included, begins and ends in here.
Model evaluate_source(const std::function<const SourceText&(SourceFiles&)>& open, SourceFiles& files,
                      const LoadOptions& options, Diagnostics& diagnostics, Place& current) {
  SymbolTable symbols;
  Ast ast;
  ParseContext context{files, symbols, ast, diagnostics, {}};
  const SourceText& source = open(files);
  const SourceText* definitions = nullptr;
  if (!options.definitions.empty()) definitions = &files.add("-D", source.directory, definitions_text(options));
  const lang::Unit& unit = parse_unit(source, definitions, context);
  Environment environment(symbols, diagnostics);
  try {
    ModuleEvaluator evaluator(environment, options);
    evaluator.evaluate(unit);
    return std::move(evaluator.builder().model());
  } catch (...) {
    current = environment.current;
    throw;
  }
}

Result<Model> load(const std::function<const SourceText&(SourceFiles&)>& open, const LoadOptions& options,
                   Diagnostics& diagnostics) {
  std::optional<Result<Model>> result;
  run_on_deep_stack([&] {
    SourceFiles files;
    Place current;
    try {
      result.emplace(evaluate_source(open, files, options, diagnostics, current));
    } catch (Failure& failure) {
      result.emplace(std::move(failure.error));
    } catch (const BudgetExceeded& exceeded) {
      result.emplace(Error{ErrorKind::input, std::string(exceeded.what) + "; make the scene smaller", locate(current)});
    } catch (const std::bad_alloc&) {
      result.emplace(Error{ErrorKind::machine, "there is not enough memory for this scene", locate(current)});
    } catch (const std::exception& error) {
      result.emplace(Error{ErrorKind::machine, error.what(), locate(current)});
    }
  });
  return std::move(*result);
}

}  // namespace

Result<Model> load_model(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics) {
  const std::filesystem::path file(path);
  std::error_code ignored;
  // A mesh file is the scene of that mesh.
  if (is_mesh_file(path) && std::filesystem::is_regular_file(file, ignored)) {
    return load_model_text("import(" + quoted(file.filename().string()) + ");\n", path, options, diagnostics);
  }
  return load([&](SourceFiles& files) -> const SourceText& { return files.read(path); }, options, diagnostics);
}

Result<Model> load_model_text(const std::string& text, const std::string& name, const LoadOptions& options,
                              Diagnostics& diagnostics) {
  return load(
      [&](SourceFiles& files) -> const SourceText& {
        return files.add(name, std::filesystem::path(name).parent_path().string(), text);
      },
      options, diagnostics);
}

}  // namespace tenon
