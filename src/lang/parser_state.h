#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lang/parser.h"
#include "lang/token_stream.h"

namespace tenon::lang {

/// A recursive-descent parser of one unit; it runs on the deep stack.
class Parser {
 public:
  Parser(const SourceText& source, const SourceText* definitions, ParseContext& context);

  void parse(Unit& unit);

 private:
  // A block as it grows, with the place of each name in its list of assignments.
  struct OpenBlock {
    Block* block;
    std::unordered_map<Symbol, std::size_t> assigned;
  };

  // Tokens.
  const Token& peek() const { return tokens_.peek(); }
  Token take() { return tokens_.take(); }
  bool accept(std::string_view symbol);
  bool accept(TokenKind kind);
  bool accept_commas();
  Token expect(std::string_view symbol, std::string_view why);
  Token expect_closing(std::string_view symbol, const Token& opening);
  [[noreturn]] void unexpected(std::string_view wanted) const;
  void check_depth() const;

  // Statements: parser.cpp.
  void statement(OpenBlock& open);
  void use_statement();
  void module_definition(Block& block);
  void function_definition(Block& block);
  void assignment(const Token& name, OpenBlock& open);
  const Instantiation* instantiation();
  const Instantiation* if_statement(Instantiation made);
  const Block* children();
  void statements_until_brace(const Token& opening, OpenBlock& open);
  bool starts_instantiation() const;

  // Lists in parentheses: parser.cpp.
  std::vector<Argument> arguments();
  std::vector<Argument> arguments_until(std::string_view closing);
  std::vector<Parameter> parameters();

  // Expressions: expression_parser.cpp.
  const Expression* expression();
  const Expression* conditional();
  const Expression* binary(std::size_t level);
  const Expression* unary();
  const Expression* power();
  const Expression* postfix();
  const Expression* primary();
  const Expression* function_literal(Place at);
  const Expression* list_or_range();
  const Expression* element();
  const Expression* for_element(Place at);
  const Expression* if_element(Place at);
  bool starts_body() const;
  template <class Node>
  const Expression* make(Place at, Node node) {
    return &context_.ast.expressions.emplace_back(Expression{at, std::move(node)});
  }

  ParseContext& context_;
  const SourceText* main_;
  TokenStream tokens_;
  Unit* unit_ = nullptr;
};

}  // namespace tenon::lang
