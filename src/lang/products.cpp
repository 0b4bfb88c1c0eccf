#include "lang/products.h"

#include <optional>

namespace tenon::lang {

namespace {

using Row = std::vector<double>;
using Matrix = std::vector<Row>;

std::optional<Row> to_row(const List& list) {
  Row row;
  row.reserve(list.items().size());
  for (const Value& item : list.items()) {
    if (!item.number()) return std::nullopt;
    row.push_back(*item.number());
  }
  return row;
}

std::optional<Matrix> to_matrix(const List& list) {
  Matrix matrix;
  for (const Value& item : list.items()) {
    std::optional<Row> row = item.list() ? to_row(*item.list()) : std::nullopt;
    if (!row || (!matrix.empty() && matrix.front().size() != row->size())) return std::nullopt;
    matrix.push_back(std::move(*row));
  }
  return matrix;
}

double dot(const Row& a, const Row& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Row multiply(const Row& row, const Matrix& matrix) {
  Row out(matrix.front().size(), 0.0);
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (std::size_t j = 0; j < out.size(); ++j) out[j] += row[i] * matrix[i][j];
  }
  return out;
}

}  // namespace

Value multiply_lists(const List& left, const List& right, Place at, Environment& environment) {
  const auto undefined = [&](const std::string& why) {
    environment.warn(at, "vector * vector is undefined here: " + why + "; its value is undef");
    return Value();
  };
  if (left.items().empty() || right.items().empty()) return undefined("one of them is empty");
  const std::optional<Row> a = to_row(left), b = to_row(right);
  if (a && b) {
    if (a->size() != b->size()) {
      return undefined("they have " + std::to_string(a->size()) + " and " + std::to_string(b->size()) + " members");
    }
    return Value(dot(*a, *b));
  }
  const std::optional<Matrix> m = a ? std::nullopt : to_matrix(left), n = b ? std::nullopt : to_matrix(right);
  if ((!a && !m) || (!b && !n)) return undefined("they are neither vectors of numbers nor matrices with equal rows");
  const std::size_t inner_left = a ? a->size() : m->front().size();
  const std::size_t inner_right = b ? b->size() : n->size();
  if (inner_left != inner_right) {
    return undefined("the left one has " + std::to_string(inner_left) + " columns, the right one " +
                     std::to_string(inner_right) + " rows");
  }
  if (a) return make_list(multiply(*a, *n), environment.budget);
  ListBuilder out(environment.budget);
  for (const Row& row : *m) {
    if (b) {
      out.add(Value(dot(row, *b)));
    } else {
      out.add(make_list(multiply(row, *n), environment.budget));
    }
  }
  return std::move(out).finish();
}

}  // namespace tenon::lang
