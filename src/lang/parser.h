#pragma once

#include <string>

#include "lang/ast.h"
#include "lang/source_files.h"
#include "tenon/base/diagnostics.h"

namespace tenon::lang {

/// Where parsed text goes: one per evaluation.
struct ParseContext {
  SourceFiles& files;
  SymbolTable& symbols;
  Ast& ast;
  Diagnostics& diagnostics;
  /// The unit of a used file, parsed when it is first asked for.
  std::unordered_map<std::string, Unit*> units;
};

/// Parses a file and all it includes and uses. `definitions` are statements that are read after the file's own.
Unit& parse_unit(const SourceText& source, const SourceText* definitions, ParseContext& context);

}  // namespace tenon::lang
