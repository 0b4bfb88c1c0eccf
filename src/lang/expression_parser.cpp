#include <array>

#include "lang/deep_stack.h"
#include "lang/failure.h"
#include "lang/parser_state.h"

namespace tenon::lang {

namespace {

struct Operator {
  std::string_view text;
  BinaryOperator op;
};

// From the loosest to the tightest; `^` binds tighter than a sign and is parsed apart.
const std::array<std::vector<Operator>, 6> levels{{
    {{"||", BinaryOperator::or_}},
    {{"&&", BinaryOperator::and_}},
    {{"==", BinaryOperator::equal}, {"!=", BinaryOperator::not_equal}},
    {{"<", BinaryOperator::less},
     {"<=", BinaryOperator::less_equal},
     {">", BinaryOperator::greater},
     {">=", BinaryOperator::greater_equal}},
    {{"+", BinaryOperator::add}, {"-", BinaryOperator::subtract}},
    {{"*", BinaryOperator::multiply}, {"/", BinaryOperator::divide}, {"%", BinaryOperator::modulo}},
}};

bool is_element(const Expression& e) {
  return std::holds_alternative<ForElement>(e.node) || std::holds_alternative<LoopElement>(e.node) ||
         std::holds_alternative<IfElement>(e.node) || std::holds_alternative<LetElement>(e.node) ||
         std::holds_alternative<EachElement>(e.node);
}

}  // namespace

std::string_view spelling(UnaryOperator op) {
  constexpr std::string_view texts[] = {"-", "+", "!"};
  return texts[static_cast<std::size_t>(op)];
}

std::string_view spelling(BinaryOperator op) {
  constexpr std::string_view texts[] = {"*", "/", "%", "^", "+", "-", "<", "<=", ">", ">=", "==", "!=", "&&", "||"};
  return texts[static_cast<std::size_t>(op)];
}

const Expression* Parser::expression() {
  check_depth();
  const Token& token = peek();
  const Place at = token.at;
  switch (token.kind) {
    case TokenKind::keyword_function:
      take();
      return function_literal(at);
    case TokenKind::keyword_let: {
      take();
      std::vector<Argument> bindings = arguments();
      return make(at, Let{std::move(bindings), expression()});
    }
    case TokenKind::keyword_assert: {
      take();
      std::vector<Argument> list = arguments();
      return make(at, Assert{std::move(list), starts_body() ? expression() : nullptr});
    }
    case TokenKind::keyword_echo: {
      take();
      std::vector<Argument> list = arguments();
      return make(at, Echo{std::move(list), starts_body() ? expression() : nullptr});
    }
    default:
      return conditional();
  }
}

// After `echo(...)` and `assert(...)` a value may follow, or what ends an expression.
bool Parser::starts_body() const {
  switch (peek().kind) {
    case TokenKind::end:
    case TokenKind::use:
    case TokenKind::keyword_else:
      return false;
    case TokenKind::symbol:
      return peek().is("(") || peek().is("[") || peek().is("-") || peek().is("+") || peek().is("!");
    default:
      return true;
  }
}

const Expression* Parser::conditional() {
  const Expression* condition = binary(0);
  if (!peek().is("?")) return condition;
  const Place at = take().at;
  const Expression* yes = expression();
  expect(":", "between the two values of '?'");
  return make(at, Conditional{condition, yes, expression()});
}

const Expression* Parser::binary(std::size_t level) {
  if (level == levels.size()) return unary();
  const Expression* left = binary(level + 1);
  for (;;) {
    const Operator* found = nullptr;
    for (const Operator& candidate : levels[level]) {
      if (peek().is(candidate.text)) found = &candidate;
    }
    if (!found) return left;
    const Place at = take().at;
    left = make(at, Binary{found->op, left, binary(level + 1)});
  }
}

const Expression* Parser::unary() {
  check_depth();
  const Place at = peek().at;
  if (accept("-")) return make(at, Unary{UnaryOperator::minus, unary()});
  if (accept("+")) return make(at, Unary{UnaryOperator::plus, unary()});
  if (accept("!")) return make(at, Unary{UnaryOperator::not_, unary()});
  return power();
}

const Expression* Parser::power() {
  const Expression* base = postfix();
  if (!peek().is("^")) return base;
  const Place at = take().at;
  return make(at, Binary{BinaryOperator::power, base, unary()});
}

const Expression* Parser::postfix() {
  const Expression* value = primary();
  for (;;) {
    const Token& token = peek();
    const Place at = token.at;
    if (token.is("(")) {
      value = make(value->at, Call{value, arguments()});
    } else if (token.is("[")) {
      const Token open = take();
      const Expression* index = expression();
      expect_closing("]", open);
      value = make(at, Index{value, index});
    } else if (token.is(".")) {
      take();
      if (peek().kind != TokenKind::identifier) unexpected("a name after '.'");
      value = make(at, Member{value, context_.symbols.intern(take().text)});
    } else {
      return value;
    }
  }
}

const Expression* Parser::primary() {
  if (peek().is("[")) return list_or_range();
  if (peek().is("(")) {
    const Token open = take();
    // Parentheses may enclose an element of a list comprehension too.
    const Expression* inner = element();
    expect_closing(")", open);
    return inner;
  }
  const Place at = peek().at;
  switch (peek().kind) {
    case TokenKind::keyword_true:
      take();
      return make(at, Boolean{true});
    case TokenKind::keyword_false:
      take();
      return make(at, Boolean{false});
    case TokenKind::keyword_undef:
      take();
      return make(at, Undef{});
    case TokenKind::number:
      return make(at, Number{take().number});
    case TokenKind::string:
      return make(at, Text{take().string});
    case TokenKind::identifier:
      return make(at, Variable{context_.symbols.intern(take().text)});
    default:
      unexpected("a value");
  }
}

const Expression* Parser::function_literal(Place at) {
  std::vector<Parameter> list = parameters();
  const Expression* body = expression();
  const FunctionDefinition& made =
      context_.ast.functions.emplace_back(FunctionDefinition{{}, std::move(list), body, at});
  return make(at, FunctionLiteral{&made});
}

const Expression* Parser::list_or_range() {
  const Token open = take();
  std::vector<const Expression*> elements;
  accept_commas();
  while (!peek().is("]")) {
    const Expression* first = element();
    if (elements.empty() && accept(":")) {
      const Expression* second = expression();
      const Expression* third = accept(":") ? expression() : nullptr;
      expect_closing("]", open);
      return third ? make(open.at, RangeLiteral{first, second, third})
                   : make(open.at, RangeLiteral{first, nullptr, second});
    }
    elements.push_back(first);
    if (!accept_commas()) break;
  }
  expect_closing("]", open);
  return make(open.at, ListLiteral{std::move(elements)});
}

const Expression* Parser::element() {
  check_depth();
  const Place at = peek().at;
  switch (peek().kind) {
    case TokenKind::keyword_for:
      take();
      return for_element(at);
    case TokenKind::keyword_if:
      take();
      return if_element(at);
    case TokenKind::keyword_each:
      take();
      return make(at, EachElement{element()});
    case TokenKind::keyword_let: {
      take();
      std::vector<Argument> bindings = arguments();
      const Expression* body = element();
      if (is_element(*body)) return make(at, LetElement{std::move(bindings), body});
      return make(at, Let{std::move(bindings), body});
    }
    default:
      break;
  }
  return expression();
}

const Expression* Parser::for_element(Place at) {
  const Token open = expect("(", "after 'for'");
  std::vector<Argument> bindings = arguments_until(";");
  if (!accept(";")) {
    expect_closing(")", open);
    return make(at, ForElement{std::move(bindings), element()});
  }
  LoopElement loop{std::move(bindings), expression(), {}, nullptr};
  expect(";", "after the condition of 'for'");
  loop.step = arguments_until(")");
  expect_closing(")", open);
  loop.body = element();
  return make(at, std::move(loop));
}

const Expression* Parser::if_element(Place at) {
  const Token open = expect("(", "after 'if'");
  const Expression* condition = expression();
  expect_closing(")", open);
  const Expression* yes = element();
  const Expression* no = accept(TokenKind::keyword_else) ? element() : nullptr;
  return make(at, IfElement{condition, yes, no});
}

}  // namespace tenon::lang
