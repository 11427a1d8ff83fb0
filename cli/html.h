#pragma once
// What the report pages are made of: one style, text and pictures inside the page.

#include <string>

namespace grimaldi {

/// The style sheet of every page: figures, tables (td.n and th.n numbers, table.narrow no wider than its text, td.v
/// verdicts), p.lead, p.why.
extern const char* const page_style;

/// `text` as it stands in a page: & < > " written out, what is not valid UTF-8 replaced.
std::string escaped(const std::string& text);

/// As `escaped`, and what stands between ` and ` as code.
std::string marked(const std::string& text);

/// `bytes` in base 64, for a picture inside the page: src="data:image/png;base64,…".
std::string base64(const std::string& bytes);

}  // namespace grimaldi
