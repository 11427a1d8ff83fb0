#include "core/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>
#include <vector>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

// How a unit becomes the unit of the dimension: value · times / over + offset, then perhaps watts to dBm. Both factors
// are exact doubles, so that "550nm" is the double nearest to 550e-9 (a factor 1e-9 would round twice).
struct Unit {
  std::string_view name;
  double times = 1, over = 1, offset = 0;
  bool watts = false;
};

struct Kind {
  Dimension dimension;
  std::string_view with_article;
  std::string_view usual_units;
  std::string_view example;
  std::span<const Unit> units;
  Unit bare;  // what a number without a unit is
};

constexpr Unit number_units[] = {{"%", 1, 100}};
constexpr Unit length_units[] = {{"m"},          {"km", 1e3},    {"cm", 1, 1e2}, {"mm", 1, 1e3},
                                 {"um", 1, 1e6}, {"µm", 1, 1e6}, {"nm", 1, 1e9}};
constexpr Unit frequency_units[] = {{"Hz"}, {"kHz", 1e3}, {"MHz", 1e6}, {"GHz", 1e9}, {"THz", 1e12}};
constexpr Unit time_units[] = {{"s"},          {"ms", 1, 1e3},  {"us", 1, 1e6}, {"µs", 1, 1e6},
                               {"ns", 1, 1e9}, {"ps", 1, 1e12}, {"min", 60},    {"h", 3600}};
constexpr Unit power_units[] = {
    {"dBm"}, {"dBW", 1, 1, 30}, {"W", 1, 1, 30, true}, {"mW", 1, 1, 0, true}, {"kW", 1, 1, 60, true}};
constexpr Unit decibel_units[] = {{"dB"}};
constexpr Unit angle_units[] = {{"deg"}, {"°"}, {"rad", 180 / pi}};
constexpr Unit temperature_units[] = {{"K"}, {"degC", 1, 1, 273.15}, {"°C", 1, 1, 273.15}};
constexpr Unit pressure_units[] = {{"Pa"}, {"hPa", 100}, {"kPa", 1000}, {"mbar", 100}, {"bar", 1e5}, {"atm", 101325}};
constexpr Unit conductivity_units[] = {{"S/m"}, {"mS/m", 1, 1e3}};

constexpr Kind kinds[] = {
    {Dimension::number, "a plain number", "no unit, or %", "0.5", number_units, {}},
    {Dimension::length, "a length", "m, km, cm, mm, µm, nm", "2.5m", length_units, {}},
    {Dimension::frequency, "a frequency", "Hz, kHz, MHz, GHz", "3.5GHz", frequency_units, {}},
    {Dimension::time, "a time", "s, ms, µs, ns, ps, min, h", "60s", time_units, {}},
    {Dimension::power_level, "a power", "dBm, dBW, W, mW, kW", "30dBm", power_units, {"", 1, 1, 30, true}},
    {Dimension::sound_level, "a sound level", "dB", "93dB", decibel_units, {}},
    {Dimension::ratio, "a ratio", "dB", "60dB", decibel_units, {}},
    {Dimension::angle, "an angle", "deg, °, rad", "45deg", angle_units, {}},
    {Dimension::temperature, "a temperature", "K, degC, °C", "20degC", temperature_units, {}},
    {Dimension::pressure, "a pressure", "Pa, hPa, kPa, mbar, bar, atm", "1013.25hPa", pressure_units, {}},
    {Dimension::conductivity, "a conductivity", "S/m, mS/m", "0.12S/m", conductivity_units, {}},
};

const Kind& kind_of(Dimension dimension) {
  const auto* kind =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return k.dimension == dimension; });
  GRIMALDI_EXPECT(kind != std::end(kinds));
  return *kind;
}

const Unit* find_unit(const Kind& kind, std::string_view name) {
  const auto unit = std::find_if(kind.units.begin(), kind.units.end(), [&](const Unit& u) { return u.name == name; });
  return unit == kind.units.end() ? nullptr : &*unit;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// The two signs that stand for micro, U+00B5 and the Greek letter U+03BC, look the same: take both.
std::string with_micro_sign(std::string_view unit) {
  constexpr std::string_view greek = "\xCE\xBC";
  std::string result(unit);
  if (unit.substr(0, greek.size()) == greek) result.replace(0, greek.size(), "\xC2\xB5");
  return result;
}

// from_chars says "out of range" for 1e999 and for 1e-999 alike; the text tells which.
bool is_underflow(std::string_view number) {
  const auto exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos) return number.substr(exponent + 1, 1) == "-";
  return number.front() == '0' || number.front() == '.';
}

struct Number {
  double value;
  std::string_view rest;  // what follows it
};

std::optional<Number> parse_number(std::string_view text, const Kind& kind, QuantityFault& fault) {
  const std::string quoted = fmt::format("\"{}\"", text);
  const auto refuse = [&](std::string problem, std::string why) -> std::optional<Number> {
    fault = {std::move(problem), std::move(why), fmt::format("write {}", kind.example)};
    return std::nullopt;
  };
  if (text.empty())
    return refuse("not a number", fmt::format("nothing stands here, {} is needed", describe(kind.dimension)));
  const bool negative = text.front() == '-';
  const std::string_view digits = negative || text.front() == '+' ? text.substr(1) : text;
  if (digits.empty() || digits.front() == '-' || digits.front() == '+')
    return refuse("not a number", quoted + " does not begin with a number");
  if (is_letter(digits.front())) {  // from_chars would read "nan", "inf" and the beginning of "info"
    const auto end = std::find_if_not(digits.begin(), digits.end(), is_letter);
    const std::string word = lower(digits.substr(0, static_cast<std::size_t>(end - digits.begin())));
    if (word == "nan" || word == "inf" || word == "infinity")
      return refuse("not finite", quoted + " is not a finite number");
    return refuse("not a number", quoted + " does not begin with a number");
  }
  double value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc::invalid_argument) return refuse("not a number", quoted + " does not begin with a number");
  const auto length = static_cast<std::size_t>(end - digits.data());
  if (status == std::errc::result_out_of_range) {
    if (is_underflow(digits.substr(0, length)))
      return refuse("not a number",
                    quoted + " is too small for a number of double precision; write 0 if that is meant");
    return refuse("not finite", quoted + " is too large for a number of double precision");
  }
  return Number{negative ? -value : value, digits.substr(length)};
}

QuantityFault unit_fault(std::string_view text, const std::string& unit, const Kind& kind) {
  const std::string example = fmt::format("write {}", kind.example);
  for (const Kind& other : kinds)
    if (find_unit(other, unit) != nullptr)
      return {"unit of the wrong kind",
              fmt::format("{} is {}, {} is needed", text, other.with_article, describe(kind.dimension)), example};
  for (const Unit& candidate : kind.units)
    if (lower(candidate.name) == lower(unit))
      return {"unknown unit", fmt::format("\"{}\" in \"{}\": upper and lower case count", unit, text),
              fmt::format("did you mean {}?", candidate.name)};
  if (unit.front() == ',' || unit.front() == '.')
    return {"not a number", fmt::format("\"{}\": the decimal mark is one point", text), example};
  std::vector<std::string> names;
  for (const Unit& candidate : kind.units) names.emplace_back(candidate.name);
  return {"unknown unit", fmt::format("\"{}\" in \"{}\", {} is needed", unit, text, describe(kind.dimension)),
          did_you_mean(unit, names)};
}

}  // namespace

std::optional<double> parse_quantity(std::string_view text, Dimension dimension, QuantityFault& fault) {
  const Kind& kind = kind_of(dimension);
  text = trimmed(text);
  const auto number = parse_number(text, kind, fault);
  if (!number) return std::nullopt;
  const std::string name = with_micro_sign(trimmed(number->rest));
  const Unit* unit = name.empty() ? &kind.bare : find_unit(kind, name);
  if (unit == nullptr) {
    fault = unit_fault(text, name, kind);
    return std::nullopt;
  }
  double value = number->value * unit->times / unit->over;
  if (unit->watts) {
    if (value <= 0) {
      fault = {value < 0 ? "negative power" : "not finite",
               fmt::format("{} W has no level in dBm, a power above 0 is needed", number->value), "write 30dBm or 1W"};
      return std::nullopt;
    }
    value = 10 * std::log10(value);
  }
  value += unit->offset;
  if (!std::isfinite(value)) {
    fault = {"not finite", fmt::format("\"{}\" is too large for a number of double precision", text),
             fmt::format("write {}", kind.example)};
    return std::nullopt;
  }
  return value;
}

std::string describe(Dimension dimension) {
  const Kind& kind = kind_of(dimension);
  return fmt::format("{} ({})", kind.with_article, kind.usual_units);
}

std::string format_frequency(double hertz) {
  struct Prefix {
    double factor;
    const char* unit;
  };
  constexpr std::array<Prefix, 7> prefixes = {
      {{1e15, "PHz"}, {1e12, "THz"}, {1e9, "GHz"}, {1e6, "MHz"}, {1e3, "kHz"}, {1.0, "Hz"}, {1e-3, "mHz"}}};
  if (hertz == 0) return "0 Hz";
  // 999.96 kHz has to become 1 MHz: a number that four digits round to 1000 belongs to the next prefix.
  constexpr double rounds_up = 0.99995;
  for (const Prefix& prefix : prefixes)
    if (std::fabs(hertz) >= rounds_up * prefix.factor)
      return fmt::format("{:.4g} {}", hertz / prefix.factor, prefix.unit);
  return fmt::format("{:.4g} Hz", hertz);
}

}  // namespace grimaldi
