#include "accel/cells/cell_store.h"

namespace tenon::cells {

namespace {

template <class List>
void append(List& list, const List& more) {
  list.insert(list.end(), more.begin(), more.end());
}

/// Moves the records of a cell's pieces behind `first` others. @param kind_of  kind_of(kind) of each from now on
template <class KindOf>
void move_pieces(Cell& cell, std::size_t first, const KindOf& kind_of) {
  for (std::size_t i = 0; i < cell.leaf_count; ++i) {
    RecordRef& record = cell.records[i];
    const RecordKind kind = record.kind();
    if (settled(kind) != kind) record = {kind_of(kind), record.index() + first};
  }
}

}  // namespace

ChildRef CellStore::add(const Cell& cell) {
  cells.push_back(cell);
  return ChildRef::cell(cells.size() - 1);
}

ChildRef CellStore::add(const Cell& cell, const CellMedia& media_there) {
  ContentHash hash;
  for (const MediumId medium : media_there.media) hash.add(medium);
  for (const CellOwner owner : media_there.owners) hash.add(owner.leaf.get());
  for (const std::uint64_t bits : media_there.more_bits) hash.add(bits);
  const auto known =
      media_index_.find(hash.value(), [&](std::uint32_t i) { return i < media.size() && media[i] == media_there; });
  const std::uint32_t number = known.value_or(static_cast<std::uint32_t>(media.size()));
  if (!known) {
    media_index_.note(hash.value(), number);
    media.push_back(media_there);
  }
  const ChildRef added = add(cell);
  cells.back().owner_or_media = number;
  return added;
}

ChildRef CellStore::add_extended(std::span<const Symbol> expression, std::uint32_t leaf_count) {
  Cell cell;
  cell.extended = true;
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
  const std::size_t first_cell = cells.size(), first_extended = extended.size(), first_media = media.size();
  cells::append(cells, part.cells);
  cells::append(extended, part.extended);
  for (std::size_t i = first_cell; i < cells.size(); ++i) {
    if (cells[i].extended) cells[i].table += first_extended;
    if (cells[i].values != Cell::Values::solid) cells[i].owner_or_media += static_cast<std::uint32_t>(first_media);
  }
  for (std::size_t i = first_extended; i < extended.size(); ++i) {
    extended[i].first_symbol += static_cast<std::uint32_t>(symbols.size());
    extended[i].first_leaf += static_cast<std::uint32_t>(extended_leaves.size());
  }
  cells::append(symbols, part.symbols);
  cells::append(extended_leaves, part.extended_leaves);
  cells::append(media, part.media);
  if (part.pieces.empty()) return;
  for (std::size_t i = first_cell; i < cells.size(); ++i) {
    move_pieces(cells[i], pieces.size(), [](RecordKind kind) { return kind; });
  }
  cells::append(pieces, part.pieces);
}

void CellStore::settle_pieces(std::size_t first) {
  for (Cell& cell : cells) {
    move_pieces(cell, first, settled);
  }
}

void CellStore::rewind(const Mark& mark) {
  cells.resize(mark.cells);
  extended.resize(mark.extended);
  symbols.resize(mark.symbols);
  extended_leaves.resize(mark.extended_leaves);
  media.resize(mark.media);
  pieces.resize(mark.pieces);
}

std::size_t CellStore::memory_bytes() const {
  return cells.size() * sizeof(Cell) + extended.size() * sizeof(ExtendedCell) + symbols.size() * sizeof(Symbol) +
         extended_leaves.size() * sizeof(LeafId) + media.size() * sizeof(CellMedia);
}

}  // namespace tenon::cells
