#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/claim.h"

namespace tenon {

/// How a figure is written.
enum class FigureForm {
  count,    ///< a whole number
  number,   ///< three digits
  seconds,  ///< with the unit that suits it, from ns to h
  bytes,    ///< in KiB or MiB
  percent,
  times,  ///< a ratio
};

/// A column of a table.
struct LabColumn {
  std::string name;
  FigureForm form = FigureForm::number;
};

/// A figure of a table.
struct LabFigure {
  std::optional<double> value;  ///< none: there is no such figure here
  double spread = 0;            ///< of the rounds, relative (Timing::spread); 0: counted, or timed once
  std::string instead;          ///< stands where there is no value: "over the time limit"
};

inline LabFigure counted(double value) {
  return {value, 0, ""};
}
inline LabFigure timed(const Measured& measured) {
  return {measured.value, measured.spread, ""};
}

struct LabRow {
  std::string name;
  std::vector<LabFigure> figures;  ///< by column
};

/// A curve of a plot.
struct LabSeries {
  std::string name;
  std::vector<double> x, y;
  bool cut_off = false;  ///< it ends at the time limit
};

struct LabPlot {
  std::string name;  ///< of its file, without suffix
  std::string title, x_label, y_label;
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<LabSeries> series;
};

/// A picture that an experiment made, PNG.
struct LabPicture {
  std::string name;  ///< of its file, without suffix
  std::string title;
  std::string bytes;
};

/// What an experiment found.
struct LabTable {
  std::string id;     ///< such as "rr612-3"
  std::string title;  ///< one line
  std::string about;  ///< how it was measured, and what stands in for what
  std::vector<LabColumn> columns;
  std::vector<LabRow> rows;
  std::vector<LabPlot> plots;
  std::vector<LabPicture> pictures;
  std::vector<JudgedClaim> claims;
  std::vector<std::string> notes;

  /// The largest spread of a figure.
  double largest_spread() const;
};

}  // namespace tenon
