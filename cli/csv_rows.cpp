#include "cli/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>

namespace grimaldi {
namespace {

// A faulty file is faulty in every line as a rule: these are enough to see it.
constexpr std::size_t most_faults = 10;

std::string trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return std::string(text);
}

// Walks through the text field by field.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ >= text_.size(); }
  int line() const { return line_; }

  // Leaves out empty lines and those that begin with #.
  void skip_lines() {
    while (!at_end()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      const std::string_view line = text_.substr(at_, end - at_);
      const bool empty = line.find_first_not_of(" \t\r") == std::string_view::npos;
      if (!empty && line.front() != '#') return;
      at_ = std::min(end + 1, text_.size());
      ++line_;
    }
  }

  // The fields of the record that begins here. False if a quote is not closed.
  bool record(std::vector<std::string>& fields) {
    fields.clear();
    while (true) {
      std::string field;
      if (!read_field(field)) return false;
      fields.push_back(std::move(field));
      if (at_end()) return true;
      const char next = text_[at_++];
      if (next == '\n') {
        ++line_;
        return true;
      }
    }
  }

 private:
  // Up to the comma or line end behind the field, which stays.
  bool read_field(std::string& field) {
    while (!at_end() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    if (at_end() || text_[at_] != '"') {
      const std::size_t end = std::min(text_.find_first_of(",\n", at_), text_.size());
      std::string_view rest = text_.substr(at_, end - at_);
      if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
      field = trimmed(rest);
      at_ = end;
      return true;
    }
    ++at_;
    while (!at_end()) {
      const char c = text_[at_++];
      if (c == '\n') ++line_;
      if (c != '"') {
        field += c;
      } else if (!at_end() && text_[at_] == '"') {
        field += '"';
        ++at_;
      } else {
        // What stands between the quote and the comma is blank or belongs to the field.
        const std::size_t end = std::min(text_.find_first_of(",\n", at_), text_.size());
        std::string_view rest = text_.substr(at_, end - at_);
        if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
        field += trimmed(rest);
        at_ = end;
        return true;
      }
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void check_names(const CsvRows& csv, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < csv.names.size(); ++i) {
    const std::string place = fmt::format("column {}", i + 1);
    if (csv.names[i].empty())
      diagnostics.error(csv.file, csv.names_line, place, "has no name", "columns are found by their names",
                        "give it a name, or take the comma away");
    else if (std::find(csv.names.begin(), csv.names.begin() + static_cast<std::ptrdiff_t>(i), csv.names[i]) !=
             csv.names.begin() + static_cast<std::ptrdiff_t>(i))
      diagnostics.error(csv.file, csv.names_line, csv.names[i], "two columns of one name",
                        "which of them is meant cannot be known", "rename one of them");
  }
}

}  // namespace

std::optional<std::size_t> CsvRows::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return static_cast<std::size_t>(found - names.begin());
}

CsvRows read_csv(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  Reader reader(text);
  CsvRows csv;
  csv.file = file;
  const auto unclosed = [&](int line) {
    diagnostics.error(file, line, "", "a quote is not closed", "the field that begins here has no end",
                      "write a quote inside a quoted field twice");
  };
  reader.skip_lines();
  if (reader.at_end()) {
    diagnostics.error(file, 0, "", "no line of names", "the first line that does not begin with # names the columns",
                      "write the names of the columns above the rows");
    return csv;
  }
  csv.names_line = reader.line();
  if (!reader.record(csv.names)) return unclosed(csv.names_line), csv;
  check_names(csv, diagnostics);
  std::size_t faults = 0;
  for (reader.skip_lines(); !reader.at_end(); reader.skip_lines()) {
    const int line = reader.line();
    std::vector<std::string> fields;
    if (!reader.record(fields)) return unclosed(line), csv;
    if (fields.size() == csv.names.size()) {
      csv.rows.push_back(std::move(fields));
      csv.lines.push_back(line);
    } else if (++faults <= most_faults) {
      diagnostics.error(file, line, "", fmt::format("{} fields, {} are needed", fields.size(), csv.names.size()),
                        fmt::format("line {} names {} columns", csv.names_line, csv.names.size()),
                        "add or remove commas; quote a field that holds one");
    }
  }
  return csv;
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    const std::string& field = fields[i];
    const bool comment = i == 0 && !field.empty() && field.front() == '#';
    const bool blank = !field.empty() && (field.front() == ' ' || field.back() == ' ');
    if (!comment && !blank && field.find_first_of(",\"\r\n") == std::string::npos) {
      line += field;
      continue;
    }
    line += '"';
    for (const char c : field) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + '\n';
}

std::string csv_number(double value) { return fmt::format("{:.17g}", value == 0 ? 0.0 : value); }

}  // namespace grimaldi
