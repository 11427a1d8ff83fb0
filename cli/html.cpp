#include "cli/html.h"

#include <cstddef>

#include "cli/plot.h"

namespace grimaldi {

const char* const page_style = R"(
:root{--ink:#1b2430;--soft:#5b6675;--line:#d9dee5;--paper:#fff;--wash:#f5f7fa;--good:#1a7f4b;--bad:#b3261e}
*{box-sizing:border-box}
body{font:16px/1.55 system-ui,"DejaVu Sans",sans-serif;color:var(--ink);background:var(--wash);margin:0}
main{max-width:1180px;margin:0 auto;padding:2.2rem 1.6rem 4rem;background:var(--paper);min-height:100vh}
h1{font-size:1.9rem;margin:0 0 .2rem}h2{font-size:1.3rem;margin:2.6rem 0 .6rem;border-bottom:2px solid var(--line);padding-bottom:.25rem}
h3{font-size:1.02rem;margin:1.6rem 0 .3rem}p{max-width:78ch;margin:.5rem 0}
.lead{color:var(--soft);margin:0 0 1.2rem}.verdict{display:inline-block;font-weight:600;padding:.3rem .9rem;border-radius:999px;color:#fff;background:var(--good)}
.verdict.bad{background:var(--bad)}
nav a{margin-right:1.1rem}a{color:#0b5cad;text-decoration:none}a:hover{text-decoration:underline}
table{border-collapse:collapse;font-size:.86rem;width:100%}th{text-align:left;font-weight:600;color:var(--soft);border-bottom:2px solid var(--line);padding:.35rem .5rem;vertical-align:bottom}
td{border-bottom:1px solid var(--line);padding:.28rem .5rem;vertical-align:top}
td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}th.n{text-align:right}table.narrow{width:auto}table.narrow td.n,table.narrow th.n{padding-left:1.6rem}td.v{white-space:nowrap;font-weight:600;color:var(--good)}
tr.known td.v{color:var(--soft)}tr.miss td{background:#fdecea}tr.miss td.v{color:var(--bad)}code{font:.92em ui-monospace,"DejaVu Sans Mono",monospace}
.why{color:var(--soft);font-size:.84rem;max-width:none;margin:.15rem 0 .5rem}.note{color:var(--soft);font-size:.82rem}
.heat td{text-align:center;border:1px solid #fff;font-variant-numeric:tabular-nums;padding:.3rem .2rem}.heat th{text-align:center;border-bottom:1px solid var(--line)}
.heat td.h{text-align:left;color:var(--soft);background:none}.scroll{overflow-x:auto}
figure{margin:1.6rem 0;padding:0}figure img{width:100%;height:auto;border:1px solid var(--line);border-radius:6px;background:#fff}
figcaption{font-size:.88rem;color:var(--soft);max-width:90ch;margin-top:.3rem}
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string marked(const std::string& text) {
  std::string out;
  bool code = false;
  for (const char c : escaped(text)) {
    if (c == '`') {
      out += code ? "</code>" : "<code>";
      code = !code;
    } else {
      out += c;
    }
  }
  return code ? out + "</code>" : out;
}

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return out;
}

}  // namespace grimaldi
