#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lang/budget.h"
#include "lang/ref.h"

namespace tenon::lang {

class Value;
class Scope;
struct FunctionDefinition;

class String : public RefCounted {
 public:
  String(std::string text, Budget& budget);

  const std::string& text() const { return text_; }
  /// In code points.
  std::size_t length() const { return length_; }
  /// One code point; only below length().
  std::string_view at(std::size_t index) const;

 private:
  std::string text_;
  std::size_t length_;
  Charge charge_;
};

class List : public RefCounted {
 public:
  List(std::vector<Value> items, int depth, Charge charge);

  const std::vector<Value>& items() const { return items_; }
  /// 1 for a list of no lists. Bounded when a list is built, so that what walks values may recurse.
  int depth() const { return depth_; }

 private:
  std::vector<Value> items_;
  int depth_;
  Charge charge_;
};

/// `[begin : step : end]`.
struct Range : RefCounted {
  Range(double begin_, double step_, double end_) : begin(begin_), step(step_), end(end_) {}
  double begin, step, end;

  /// How many numbers it holds; infinity for an infinite end, and for a step of zero unless the end is below the begin.
  double size() const;
  double at(std::size_t index) const { return index == 0 ? begin : begin + static_cast<double>(index) * step; }
};

/// A function literal with the variables it sees.
struct Closure : RefCounted {
  Closure(const FunctionDefinition* definition_, Ref<Scope> scope_);
  ~Closure() override;
  const FunctionDefinition* definition;
  Ref<Scope> scope;
};

/// A value of the language.
class Value {
 public:
  Value() = default;  ///< undef
  explicit Value(bool b) : data_(b) {}
  explicit Value(double d) : data_(d) {}
  explicit Value(Ref<String> s) : data_(std::move(s)) {}
  explicit Value(Ref<List> l) : data_(std::move(l)) {}
  explicit Value(Ref<Range> r) : data_(std::move(r)) {}
  explicit Value(Ref<Closure> c) : data_(std::move(c)) {}

  bool is_undef() const { return std::holds_alternative<std::monostate>(data_); }
  const bool* boolean() const { return std::get_if<bool>(&data_); }
  const double* number() const { return std::get_if<double>(&data_); }
  const String* string() const { return object<String>(); }
  const List* list() const { return object<List>(); }
  const Range* range() const { return object<Range>(); }
  const Closure* closure() const { return object<Closure>(); }
  Ref<Closure> closure_ref() const { return std::get<Ref<Closure>>(data_); }

  /// What `if` makes of it: false for undef, false, 0, "" and [].
  bool truth() const;
  /// The type as messages name it.
  std::string_view type_name() const;

  friend bool equal(const Value& a, const Value& b);

 private:
  template <class T>
  const T* object() const {
    const Ref<T>* ref = std::get_if<Ref<T>>(&data_);
    return ref ? ref->get() : nullptr;
  }

  std::variant<std::monostate, bool, double, Ref<String>, Ref<List>, Ref<Range>, Ref<Closure>> data_;
};

/// `==`: values of different types differ, and so do numbers that are not.
bool equal(const Value& a, const Value& b);

/// Collects the items of a list, within the budget.
class ListBuilder {
 public:
  /// Deeper lists would let what walks values overflow its stack.
  static constexpr int deepest = 1'000'000;

  explicit ListBuilder(Budget& budget) : charge_(budget) { charge_.add(sizeof(List)); }
  void add(Value value);
  std::size_t size() const { return items_.size(); }
  Value finish() &&;

 private:
  std::vector<Value> items_;
  int depth_ = 0;
  Charge charge_;
};

Value make_string(std::string text, Budget& budget);
Value make_list(const std::vector<double>& numbers, Budget& budget);

}  // namespace tenon::lang
