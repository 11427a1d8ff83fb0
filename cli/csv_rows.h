#pragma once
// Tables as comma-separated text, read and written whole.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contract.h"

namespace grimaldi {

/// Rows of fields under names.
struct CsvRows {
  std::string file;                            ///< as the user wrote it, for messages
  std::vector<std::string> names;              ///< of the columns
  int names_line = 0;                          ///< 1-based line of the names
  std::vector<std::vector<std::string>> rows;  ///< each as long as `names`
  std::vector<int> lines;                      ///< 1-based line on which each row begins

  /// Number of the column of that name; nothing if there is none.
  std::optional<std::size_t> column(const std::string& name) const;
};

/// Reads RFC 4180: fields between commas, quoted where they hold commas, quotes (doubled) or line ends; blanks around
/// unquoted fields are dropped; lines that begin with # and empty ones are left out; the first line left has the names.
/// Line ends LF or CRLF; a byte order mark is passed over.
/// Errors to `diagnostics`, with the line: no names, an empty or double name, a row of another length than the names, a
/// quote that is not closed.
CsvRows read_csv(std::string_view text, const std::string& file, Diagnostics& diagnostics);

/// One line of fields, quoted where needed, with its line end.
std::string csv_line(const std::vector<std::string>& fields);

/// A number of 17 digits, so that reading it gives the same double. A negative zero is written as 0.
std::string csv_number(double value);

}  // namespace grimaldi
