#include "lang/format.h"

namespace tenon::lang {

namespace {

/// Prints expressions as OpenSCAD shows them: operators in parentheses.
class ExpressionPrinter {
 public:
  ExpressionPrinter(const SymbolTable& symbols, std::string& out) : symbols_(symbols), out_(out) {}

  void print(const Expression& e) { std::visit(*this, e.node); }

  void print(const FunctionDefinition& function) {
    out_ += "function(";
    bool first = true;
    for (const Parameter& parameter : function.parameters) {
      separate(first);
      out_ += symbols_.text(parameter.name);
      if (parameter.fallback) {
        out_ += " = ";
        print(*parameter.fallback);
      }
    }
    out_ += ") ";
    print(*function.body);
  }

  void operator()(const Undef&) { out_ += "undef"; }
  void operator()(const Boolean& e) { out_ += e.value ? "true" : "false"; }
  void operator()(const Number& e) { out_ += format_number(e.value); }
  void operator()(const Variable& e) { out_ += symbols_.text(e.name); }
  void operator()(const Text& e) {
    out_ += '"';
    for (char c : e.value) {
      switch (c) {
        case '\n':
          out_ += "\\n";
          break;
        case '\t':
          out_ += "\\t";
          break;
        case '\r':
          out_ += "\\r";
          break;
        case '"':
          out_ += "\\\"";
          break;
        case '\\':
          out_ += "\\\\";
          break;
        default:
          out_ += c;
      }
    }
    out_ += '"';
  }
  void operator()(const Unary& e) {
    if (e.op != UnaryOperator::plus) out_ += spelling(e.op);
    print(*e.operand);
  }
  void operator()(const Binary& e) {
    out_ += '(';
    print(*e.left);
    out_ += ' ';
    out_ += spelling(e.op);
    out_ += ' ';
    print(*e.right);
    out_ += ')';
  }
  void operator()(const Conditional& e) {
    out_ += '(';
    print(*e.condition);
    out_ += " ? ";
    print(*e.yes);
    out_ += " : ";
    print(*e.no);
    out_ += ')';
  }
  void operator()(const Index& e) {
    print(*e.list);
    out_ += '[';
    print(*e.index);
    out_ += ']';
  }
  void operator()(const Member& e) {
    print(*e.object);
    out_ += '.' + symbols_.text(e.name);
  }
  void operator()(const Call& e) {
    const bool named = std::holds_alternative<Variable>(e.function->node);
    if (!named) out_ += '(';
    print(*e.function);
    if (!named) out_ += ')';
    list("(", e.arguments, ")");
  }
  void operator()(const ListLiteral& e) {
    out_ += '[';
    bool first = true;
    for (const Expression* element : e.elements) {
      separate(first);
      print(*element);
    }
    out_ += ']';
  }
  void operator()(const RangeLiteral& e) {
    out_ += '[';
    print(*e.begin);
    if (e.step) {
      out_ += " : ";
      print(*e.step);
    }
    out_ += " : ";
    print(*e.end);
    out_ += ']';
  }
  void operator()(const Let& e) {
    list("let(", e.bindings, ") ");
    print(*e.body);
  }
  void operator()(const Assert& e) {
    list("assert(", e.arguments, ")");
    body(e.body);
  }
  void operator()(const Echo& e) {
    list("echo(", e.arguments, ")");
    body(e.body);
  }
  void operator()(const FunctionLiteral& e) { print(*e.definition); }
  void operator()(const ForElement& e) {
    list("for(", e.bindings, ") ");
    enclosed(*e.body);
  }
  void operator()(const LoopElement& e) {
    list("for(", e.start, ";");
    print(*e.condition);
    list(";", e.step, ") ");
    print(*e.body);
  }
  void operator()(const IfElement& e) {
    out_ += "if(";
    print(*e.condition);
    out_ += ") ";
    enclosed(*e.yes);
    if (e.no) {
      out_ += " else ";
      enclosed(*e.no);
    }
  }
  void operator()(const LetElement& e) {
    list("let(", e.bindings, ") ");
    enclosed(*e.body);
  }
  void operator()(const EachElement& e) {
    out_ += "each ";
    enclosed(*e.operand);
  }

 private:
  void separate(bool& first) {
    if (!first) out_ += ", ";
    first = false;
  }
  void enclosed(const Expression& e) {
    out_ += '(';
    print(e);
    out_ += ')';
  }
  void body(const Expression* e) {
    if (!e) return;
    out_ += ' ';
    print(*e);
  }
  void list(std::string_view opening, const std::vector<Argument>& arguments, std::string_view closing) {
    out_ += opening;
    bool first = true;
    for (const Argument& argument : arguments) {
      separate(first);
      if (argument.name) out_ += symbols_.text(argument.name) + " = ";
      print(*argument.value);
    }
    out_ += closing;
  }

  const SymbolTable& symbols_;
  std::string& out_;
};

}  // namespace

std::string format_expression(const Expression& expression, const SymbolTable& symbols) {
  std::string out;
  ExpressionPrinter(symbols, out).print(expression);
  return out;
}

std::string format_function(const FunctionDefinition& function, const SymbolTable& symbols) {
  std::string out;
  ExpressionPrinter(symbols, out).print(function);
  return out;
}

}  // namespace tenon::lang
