#pragma once
// Rows of a reference file (CSV, lines that begin with # dropped), for the tests of this folder.

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace grimaldi {

/// The fields of every data row of GRIMALDI_SHARED/reference/`name`, without the line of names; empty if the file is
/// not there. A quoted field with a comma falls apart: no column used here stands right of one.
inline std::vector<std::vector<std::string>> reference_rows(const std::string& name) {
  std::ifstream file(std::string(GRIMALDI_SHARED) + "/reference/" + name);
  std::vector<std::vector<std::string>> rows;
  bool names_read = false;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (!names_read) {
      names_read = true;
      continue;
    }
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    rows.push_back(fields);
  }
  return rows;
}

}  // namespace grimaldi
