#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/claim.h"
#include "tenon/base/error.h"

namespace tenon {

/// A table as a paper printed it.
struct PaperTable {
  std::string id;      ///< of ours that measures it again
  std::string source;  ///< such as "table 3"
  std::vector<std::string> columns, rows;
  std::vector<std::vector<std::optional<double>>> figures;  ///< by row and column; none: not printed, or not legible
  std::vector<std::string> notes;

  /// The figure of a row and a column of these names.
  std::optional<double> figure(const std::string& row, const std::string& column) const;
};

/// What is read of a paper: where to find it, its figures, what it claims.
struct Paper {
  std::string id;  ///< of its page, such as "rr612"
  std::string title, reference;
  std::string summary;  ///< what the page begins with
  std::vector<PaperTable> tables;
  std::vector<Claim> claims;

  const PaperTable* table(const std::string& id) const;
  /// A claim that the file of the paper has.
  const Claim& claim(const std::string& id) const;
};

/// Reads FOLDER/ID.json.
/// @return the paper, or an input error: no such file, or not what a paper's file holds
Result<Paper> read_paper(const std::string& folder, const std::string& id);

}  // namespace tenon
