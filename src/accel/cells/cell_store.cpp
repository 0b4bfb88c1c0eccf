#include "accel/cells/cell_store.h"

namespace tenon::cells {

namespace {

template <class List>
void append(List& list, const List& more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

ChildRef CellStore::add(const Cell& cell) {
  cells.push_back(cell);
  return ChildRef::cell(cells.size() - 1);
}

ChildRef CellStore::add_extended(std::span<const Symbol> expression, std::uint32_t leaf_count) {
  Cell cell;
  cell.extended = true;
  cell.owner = Owner::varies;
  cell.table = extended.size();
  ExtendedCell more;
  more.first_symbol = static_cast<std::uint32_t>(symbols.size());
  more.first_leaf = static_cast<std::uint32_t>(extended_leaves.size());
  more.leaf_count = leaf_count;
  if (leaf_count <= Cell::most_followed) {
    more.symbol_count = static_cast<std::uint32_t>(expression.size());
    symbols.insert(symbols.end(), expression.begin(), expression.end());
    for (const Symbol& s : expression) {
      if (s.kind == Symbol::Kind::leaf) extended_leaves.push_back(s.leaf);
    }
  }
  extended.push_back(more);
  return add(cell);
}

void CellStore::append(const CellStore& part) {
  const std::size_t first_cell = cells.size(), first_extended = extended.size();
  cells::append(cells, part.cells);
  cells::append(extended, part.extended);
  for (std::size_t i = first_cell; i < cells.size(); ++i) {
    if (cells[i].extended) cells[i].table += first_extended;
  }
  for (std::size_t i = first_extended; i < extended.size(); ++i) {
    extended[i].first_symbol += static_cast<std::uint32_t>(symbols.size());
    extended[i].first_leaf += static_cast<std::uint32_t>(extended_leaves.size());
  }
  cells::append(symbols, part.symbols);
  cells::append(extended_leaves, part.extended_leaves);
}

void CellStore::rewind(const Mark& mark) {
  cells.resize(mark.cells);
  extended.resize(mark.extended);
  symbols.resize(mark.symbols);
  extended_leaves.resize(mark.extended_leaves);
}

std::size_t CellStore::memory_bytes() const {
  return cells.size() * sizeof(Cell) + extended.size() * sizeof(ExtendedCell) + symbols.size() * sizeof(Symbol) +
         extended_leaves.size() * sizeof(LeafId);
}

}  // namespace tenon::cells
