#include "lab/lab_table.h"

#include <algorithm>

namespace tenon {

double LabTable::largest_spread() const {
  double largest = 0;
  for (const LabRow& row : rows) {
    for (const LabFigure& figure : row.figures) largest = std::max(largest, figure.spread);
  }
  return largest;
}

}  // namespace tenon
