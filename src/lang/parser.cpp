#include "lang/parser.h"

#include <filesystem>

#include "base/input_file.h"
#include "lang/deep_stack.h"
#include "lang/failure.h"
#include "lang/parser_state.h"
#include "text/find_font.h"

namespace tenon::lang {

namespace {

bool is_font(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".ttf" || ending == ".otf" || ending == ".ttc";
}

}  // namespace

Unit& parse_unit(const SourceText& source, const SourceText* definitions, ParseContext& context) {
  Unit& unit = context.ast.units.emplace_back();
  Parser(source, definitions, context).parse(unit);
  return unit;
}

Parser::Parser(const SourceText& source, const SourceText* definitions, ParseContext& context)
    : context_(context), main_(&source), tokens_(source, definitions, context.files) {}

void Parser::parse(Unit& unit) {
  unit_ = &unit;
  OpenBlock open{&unit.block, {}};
  while (peek().kind != TokenKind::end) {
    if (peek().kind == TokenKind::use) {
      use_statement();
    } else {
      statement(open);
    }
  }
}

bool Parser::accept(std::string_view symbol) {
  if (!peek().is(symbol)) return false;
  take();
  return true;
}

bool Parser::accept(TokenKind kind) {
  if (peek().kind != kind) return false;
  take();
  return true;
}

Token Parser::expect(std::string_view symbol, std::string_view why) {
  if (!peek().is(symbol)) unexpected("'" + std::string(symbol) + "' " + std::string(why));
  return take();
}

Token Parser::expect_closing(std::string_view symbol, const Token& opening) {
  if (peek().kind == TokenKind::end) {
    fail(opening.at, "this '" + std::string(opening.text) + "' is never closed; add '" + std::string(symbol) + "'");
  }
  std::string why = "to close '" + std::string(opening.text) + "'";
  // Slips of those who think in another language.
  if (peek().is("=")) why += " (to compare, write '==')";
  if (peek().is(":")) why += " (a range is written [first : last])";
  return expect(symbol, why);
}

void Parser::unexpected(std::string_view wanted) const {
  fail(peek().at, "expected " + std::string(wanted) + ", but found " + describe(peek()));
}

void Parser::check_depth() const {
  if (!stack_remains()) fail(peek().at, "the text is nested too deep; use a recursive module instead");
}

void Parser::statement(OpenBlock& open) {
  check_depth();
  if (accept(";")) return;
  if (peek().is("{")) {
    const Token brace = take();
    return statements_until_brace(brace, open);
  }
  if (accept(TokenKind::keyword_module)) return module_definition(*open.block);
  if (peek().kind == TokenKind::keyword_function) return function_definition(*open.block);
  if (peek().kind == TokenKind::identifier) {
    // A name begins an assignment or an instantiation; the next token tells.
    const Token name = take();
    if (peek().is("=")) return assignment(name, open);
    if (!peek().is("(")) unexpected("'=' or '(' after '" + std::string(name.text) + "'");
    Instantiation made;
    made.name = context_.symbols.intern(name.text);
    made.at = name.at;
    made.arguments = arguments();
    made.children = children();
    open.block->instantiations.push_back(&context_.ast.instantiations.emplace_back(std::move(made)));
    return;
  }
  if (peek().kind == TokenKind::use) fail(peek().at, "'use' stands at the top of a file, outside all braces");
  if (!starts_instantiation()) unexpected("a statement");
  if (const Instantiation* made = instantiation()) open.block->instantiations.push_back(made);
}

void Parser::statements_until_brace(const Token& opening, OpenBlock& open) {
  while (!peek().is("}")) {
    if (peek().kind == TokenKind::end) fail(opening.at, "this '{' is never closed; add '}'");
    statement(open);
  }
  take();
}

void Parser::use_statement() {
  const Token token = take();
  accept(";");
  if (is_builtin_library(token.string)) return;
  const std::string path = SourceFiles::find(token.string, token.at);
  if (is_font(path)) {
    if (const Status added = add_font_file(path); !added) fail(token.at, added.error().message);
    return;
  }
  std::error_code unknown;
  std::string key = std::filesystem::weakly_canonical(path, unknown).string();
  if (unknown) key = path;
  auto [entry, is_new] = context_.units.emplace(key, nullptr);
  if (is_new) {
    Unit& used = context_.ast.units.emplace_back();
    entry->second = &used;  // before parsing, so that files may use each other
    check_depth();
    Parser(context_.files.read(path, token.at), nullptr, context_).parse(used);
    unit_->used.insert(unit_->used.begin(), &used);
  } else {
    unit_->used.insert(unit_->used.begin(), entry->second);
  }
}

void Parser::module_definition(Block& block) {
  if (peek().kind != TokenKind::identifier) unexpected("a name after 'module'");
  const Token name = take();
  ModuleDefinition& made = context_.ast.modules.emplace_back();
  made.name = context_.symbols.intern(name.text);
  made.at = name.at;
  made.parameters = parameters();
  OpenBlock open{&context_.ast.blocks.emplace_back(), {}};
  made.body = open.block;
  statement(open);
  block.modules[made.name] = &made;
}

void Parser::function_definition(Block& block) {
  take();
  if (peek().kind != TokenKind::identifier) unexpected("a name after 'function'");
  const Token name = take();
  FunctionDefinition& made = context_.ast.functions.emplace_back();
  made.name = context_.symbols.intern(name.text);
  made.at = name.at;
  made.parameters = parameters();
  expect("=", "before the value of the function");
  made.body = expression();
  expect(";", "after the function");
  block.functions[made.name] = &made;
}

void Parser::assignment(const Token& name, OpenBlock& open) {
  take();
  const Symbol symbol = context_.symbols.intern(name.text);
  const Expression* value = expression();
  expect(";", "after the assignment");
  const auto [known, is_new] = open.assigned.emplace(symbol, open.block->assignments.size());
  if (is_new) {
    open.block->assignments.push_back({symbol, value, name.at});
    return;
  }
  Assignment& first = open.block->assignments[known->second];
  // What a file overrides of the files it includes, and what the command line overrides, is meant.
  const bool override_is_meant = name.at.source != first.at.source && name.at.source->name != first.at.source->name &&
                                 (name.at.source == main_ || first.at.source != main_ || name.at.source->name == "-D");
  if (!override_is_meant) {
    const SourceLocation earlier = locate(first.at);
    context_.diagnostics.warn("'" + std::string(name.text) + "' was assigned in line " + std::to_string(earlier.line) +
                                  " already; the last value holds in the whole scope",
                              locate(name.at));
  }
  first.value = value;
  first.at = name.at;
}

bool Parser::starts_instantiation() const {
  switch (peek().kind) {
    case TokenKind::identifier:
    case TokenKind::keyword_if:
    case TokenKind::keyword_for:
    case TokenKind::keyword_let:
    case TokenKind::keyword_assert:
    case TokenKind::keyword_echo:
    case TokenKind::keyword_each:
      return true;
    default:
      return peek().is("!") || peek().is("#") || peek().is("%") || peek().is("*");
  }
}

const Instantiation* Parser::instantiation() {
  check_depth();
  Instantiation made;
  bool disabled = false;
  for (;;) {
    if (accept("!")) {
      made.root = true;
    } else if (accept("%")) {
      made.background = true;
    } else if (accept("*")) {
      disabled = true;
    } else if (!accept("#")) {
      break;
    }
  }
  if (!starts_instantiation()) unexpected("a module");
  const Token name = take();
  made.name = context_.symbols.intern(name.text);
  made.at = name.at;
  const Instantiation* result = nullptr;
  if (name.kind == TokenKind::keyword_if) {
    result = if_statement(std::move(made));
  } else {
    made.arguments = arguments();
    made.children = children();
    result = &context_.ast.instantiations.emplace_back(std::move(made));
  }
  return disabled ? nullptr : result;
}

const Instantiation* Parser::if_statement(Instantiation made) {
  const Token open = expect("(", "after 'if'");
  made.arguments.push_back({{}, expression(), peek().at});
  expect_closing(")", open);
  made.children = children();
  if (accept(TokenKind::keyword_else)) made.else_children = children();
  return &context_.ast.instantiations.emplace_back(std::move(made));
}

const Block* Parser::children() {
  OpenBlock open{&context_.ast.blocks.emplace_back(), {}};
  if (accept(";")) return open.block;
  if (peek().is("{")) {
    const Token brace = take();
    statements_until_brace(brace, open);
  } else if (starts_instantiation()) {
    if (const Instantiation* child = instantiation()) open.block->instantiations.push_back(child);
  } else {
    unexpected("';', '{' or a child");
  }
  return open.block;
}

std::vector<Argument> Parser::arguments() {
  const Token open = expect("(", "before the arguments");
  std::vector<Argument> list = arguments_until(")");
  expect_closing(")", open);
  return list;
}

std::vector<Argument> Parser::arguments_until(std::string_view closing) {
  std::vector<Argument> list;
  accept_commas();
  while (!peek().is(closing) && !peek().is(")") && peek().kind != TokenKind::end) {
    Argument argument;
    argument.at = peek().at;
    argument.value = expression();
    if (peek().is("=")) {
      const auto* variable = std::get_if<Variable>(&argument.value->node);
      if (!variable) unexpected("',' or '" + std::string(closing) + "'");
      take();
      argument.name = variable->name;
      argument.value = expression();
    }
    list.push_back(argument);
    if (!accept_commas()) break;
  }
  return list;
}

// As many as there are: OpenSCAD passes over those that nothing stands between.
bool Parser::accept_commas() {
  if (!accept(",")) return false;
  while (accept(",")) continue;
  return true;
}

std::vector<Parameter> Parser::parameters() {
  const Token open = expect("(", "before the parameters");
  std::vector<Parameter> list;
  accept_commas();
  while (!peek().is(")")) {
    if (peek().kind != TokenKind::identifier) unexpected("the name of a parameter");
    Parameter parameter;
    parameter.name = context_.symbols.intern(take().text);
    if (accept("=")) parameter.fallback = expression();
    list.push_back(parameter);
    if (!accept_commas()) break;
  }
  expect_closing(")", open);
  return list;
}

}  // namespace tenon::lang
