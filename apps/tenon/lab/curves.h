#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/lab.h"
#include "lab/lab_table.h"

namespace tenon {

/// A curve for each structure: a row for each scene of a series, a column for each structure. A curve ends at the time
/// limit of the lab's effort, and is marked there.
class Curves {
 public:
  /// @param table  gets the columns, and must outlive this
  /// @param plot   without its series
  Curves(Lab& lab, std::vector<std::string> structures, LabTable& table, LabPlot plot);

  std::size_t size() const { return structures_.size(); }

  /// The next row: the time a ray of all structures whose curves have not ended.
  /// @param x       of the points
  /// @param rounds  0: the lab's
  Status add(const std::string& row_name, double x, const LabScene& scene, int rounds = 0);

  /// A figure measured before; none where the curve had ended.
  std::optional<Measured> at(std::size_t row, const std::string& structure) const;

  /// Hands the plot to the table.
  void finish() { table_.plots.push_back(std::move(plot_)); }

 private:
  double expected_seconds(std::size_t structure) const;
  std::size_t index_of(const std::string& structure) const;

  Lab& lab_;
  std::vector<std::string> structures_;
  LabTable& table_;
  LabPlot plot_;
  std::vector<std::vector<double>> seconds_;  // by structure, of its points: built, and one picture taken
};

/// Where curves end, in words.
std::string curve_limit_text(const Lab& lab);

}  // namespace tenon
