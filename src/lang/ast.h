#pragma once

#include <deque>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "lang/source_text.h"
#include "lang/symbol.h"

namespace tenon::lang {

struct Expression;
struct Block;
struct Unit;

/// `name = value` or `value`: in calls, in `let`, in `for`.
struct Argument {
  Symbol name;  ///< none for a positional one
  const Expression* value = nullptr;
  Place at;
};

struct Parameter {
  Symbol name;
  const Expression* fallback = nullptr;  ///< null when there is none
};

/// A named function, or a function literal (without name).
struct FunctionDefinition {
  Symbol name;
  std::vector<Parameter> parameters;
  const Expression* body = nullptr;
  Place at;
};

struct ModuleDefinition {
  Symbol name;
  std::vector<Parameter> parameters;
  const Block* body = nullptr;
  Place at;
};

enum class UnaryOperator { minus, plus, not_ };
enum class BinaryOperator {
  multiply,
  divide,
  modulo,
  power,
  add,
  subtract,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  and_,
  or_
};
std::string_view spelling(UnaryOperator op);
std::string_view spelling(BinaryOperator op);

struct Undef {};
struct Boolean {
  bool value;
};
struct Number {
  double value;
};
struct Text {
  std::string value;
};
struct Variable {
  Symbol name;
};
struct Unary {
  UnaryOperator op;
  const Expression* operand;
};
struct Binary {
  BinaryOperator op;
  const Expression* left;
  const Expression* right;
};
struct Conditional {
  const Expression* condition;
  const Expression* yes;
  const Expression* no;
};
struct Index {
  const Expression* list;
  const Expression* index;
};
struct Member {
  const Expression* object;
  Symbol name;
};
struct Call {
  const Expression* function;
  std::vector<Argument> arguments;
};
struct ListLiteral {
  std::vector<const Expression*> elements;
};
struct RangeLiteral {
  const Expression* begin;
  const Expression* step;
  const Expression* end;
};  ///< step may be null
struct Let {
  std::vector<Argument> bindings;
  const Expression* body;
};
struct Assert {
  std::vector<Argument> arguments;
  const Expression* body;
};  ///< body may be null
struct Echo {
  std::vector<Argument> arguments;
  const Expression* body;
};  ///< body may be null
struct FunctionLiteral {
  const FunctionDefinition* definition;
};
// Elements of list comprehensions: they give any number of values.
struct ForElement {
  std::vector<Argument> bindings;
  const Expression* body;
};
struct LoopElement {
  std::vector<Argument> start;
  const Expression* condition;
  std::vector<Argument> step;
  const Expression* body;
};
struct IfElement {
  const Expression* condition;
  const Expression* yes;
  const Expression* no;
};  ///< no may be null
struct LetElement {
  std::vector<Argument> bindings;
  const Expression* body;
};
struct EachElement {
  const Expression* operand;
};

struct Expression {
  Place at;
  std::variant<Undef, Boolean, Number, Text, Variable, Unary, Binary, Conditional, Index, Member, Call, ListLiteral,
               RangeLiteral, Let, Assert, Echo, FunctionLiteral, ForElement, LoopElement, IfElement, LetElement,
               EachElement>
      node;
};

struct Assignment {
  Symbol name;
  const Expression* value = nullptr;
  Place at;
};

/// A statement that makes something: `name(arguments) children`.
struct Instantiation {
  Symbol name;
  std::vector<Argument> arguments;
  const Block* children = nullptr;       ///< never null
  const Block* else_children = nullptr;  ///< of an `if`; null when there is none
  bool root = false;                     ///< `!`
  bool background = false;               ///< `%`
  Place at;
};

/// The statements of a scope. Bare braces make none, as in OpenSCAD.
struct Block {
  std::vector<Assignment> assignments;  ///< each name once: at its first place, with its last value
  std::vector<const Instantiation*> instantiations;
  std::unordered_map<Symbol, const FunctionDefinition*> functions;
  std::unordered_map<Symbol, const ModuleDefinition*> modules;
};

/// A file with all it includes.
struct Unit {
  Block block;
  std::vector<Unit*> used;  ///< the last named first: its definitions hide the earlier ones'
};

/// Everything that was parsed. Nodes point at each other and are owned here, flat, so that no depth of nesting makes
/// their destruction recurse.
struct Ast {
  std::deque<Expression> expressions;
  std::deque<FunctionDefinition> functions;
  std::deque<ModuleDefinition> modules;
  std::deque<Instantiation> instantiations;
  std::deque<Block> blocks;
  std::deque<Unit> units;
};

}  // namespace tenon::lang
