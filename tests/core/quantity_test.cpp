#include "core/quantity.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

double value(std::string_view text, Dimension dimension) {
  QuantityFault fault;
  const auto result = parse_quantity(text, dimension, fault);
  EXPECT_TRUE(result.has_value()) << text << ": " << fault.problem << " (" << fault.why << ")";
  return result.value_or(-1e300);
}

QuantityFault fault_of(std::string_view text, Dimension dimension) {
  QuantityFault fault;
  const auto result = parse_quantity(text, dimension, fault);
  EXPECT_FALSE(result.has_value()) << text << " gave " << *result;
  EXPECT_FALSE(fault.problem.empty()) << text;
  EXPECT_FALSE(fault.why.empty()) << text;
  EXPECT_FALSE(fault.suggestion.empty()) << text;
  return fault;
}

TEST(Quantity, EveryUnit) {  // exact: the factors are exact doubles, one rounding each
  using D = Dimension;
  EXPECT_EQ(value("0.5", D::number), 0.5);
  EXPECT_EQ(value("40%", D::number), 0.4);
  EXPECT_EQ(value("5", D::length), 5);
  EXPECT_EQ(value("5m", D::length), 5);
  EXPECT_EQ(value("1.5km", D::length), 1500);
  EXPECT_EQ(value("12cm", D::length), 0.12);
  EXPECT_EQ(value("3mm", D::length), 0.003);
  EXPECT_EQ(value("7um", D::length), 7e-6);
  EXPECT_EQ(value("7µm", D::length), 7e-6);
  EXPECT_EQ(value("7\xCE\xBCm", D::length), 7e-6);  // the Greek letter
  EXPECT_EQ(value("550nm", D::length), 550e-9);
  EXPECT_EQ(value("500Hz", D::frequency), 500);
  EXPECT_EQ(value("8kHz", D::frequency), 8000);
  EXPECT_EQ(value("2.4GHz", D::frequency), 2.4e9);
  EXPECT_EQ(value("900MHz", D::frequency), 900e6);
  EXPECT_EQ(value("0.3THz", D::frequency), 3e11);
  EXPECT_EQ(value("60s", D::time), 60);
  EXPECT_EQ(value("20ms", D::time), 0.02);
  EXPECT_EQ(value("5us", D::time), 5e-6);
  EXPECT_EQ(value("5µs", D::time), 5e-6);
  EXPECT_EQ(value("1ns", D::time), 1e-9);
  EXPECT_EQ(value("3ps", D::time), 3e-12);
  EXPECT_EQ(value("2min", D::time), 120);
  EXPECT_EQ(value("1h", D::time), 3600);
  EXPECT_EQ(value("44dBm", D::power_level), 44);
  EXPECT_EQ(value("3dBW", D::power_level), 33);
  EXPECT_EQ(value("1W", D::power_level), 30);
  EXPECT_EQ(value("100mW", D::power_level), 20);
  EXPECT_EQ(value("1kW", D::power_level), 60);
  EXPECT_EQ(value("10", D::power_level), 40);  // a bare number is in watts
  EXPECT_EQ(value("93dB", D::sound_level), 93);
  EXPECT_EQ(value("93", D::sound_level), 93);
  EXPECT_EQ(value("-60 dB", D::ratio), -60);
  EXPECT_EQ(value("45deg", D::angle), 45);
  EXPECT_EQ(value("45°", D::angle), 45);
  EXPECT_EQ(value("-45", D::angle), -45);
  EXPECT_DOUBLE_EQ(value("3.14159265358979323846rad", D::angle), 180);
  EXPECT_EQ(value("293.15K", D::temperature), 293.15);
  EXPECT_EQ(value("20degC", D::temperature), 293.15);
  EXPECT_EQ(value("20 °C", D::temperature), 293.15);
  EXPECT_EQ(value("1013.25hPa", D::pressure), 101325);
  EXPECT_EQ(value("1atm", D::pressure), 101325);
  EXPECT_EQ(value("1bar", D::pressure), 1e5);
  EXPECT_EQ(value("990mbar", D::pressure), 99000);
  EXPECT_EQ(value("100kPa", D::pressure), 1e5);
  EXPECT_EQ(value("7Pa", D::pressure), 7);
  EXPECT_EQ(value("0.12S/m", D::conductivity), 0.12);
  EXPECT_EQ(value("5mS/m", D::conductivity), 0.005);
}

TEST(Quantity, WaysToWriteANumber) {
  EXPECT_EQ(value("  3.5  GHz \t", Dimension::frequency), 3.5e9);
  EXPECT_EQ(value("+1e3m", Dimension::length), 1000);
  EXPECT_EQ(value("-2.5E-1 km", Dimension::length), -250);
  EXPECT_EQ(value(".5m", Dimension::length), 0.5);
  EXPECT_EQ(value("5.m", Dimension::length), 5);
  EXPECT_EQ(value("0.0000m", Dimension::length), 0);
}

TEST(Quantity, ThePointIsAPointInEveryLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;  // C.UTF-8 at least is on every Debian
    EXPECT_EQ(value("2.5m", Dimension::length), 2.5) << name;
    EXPECT_EQ(format_frequency(2.5e9), "2.5 GHz") << name;
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Quantity, NotFinite) {
  for (const char* text :
       {"nan", "NaN", "-nan", "inf", "-INF", "infinity m", "1e999", "-1e999m", "1e308km", "nan(5)", "0.1e999"})
    EXPECT_EQ(fault_of(text, Dimension::length).problem, "not finite") << text;
  EXPECT_EQ(fault_of("0W", Dimension::power_level).problem, "not finite");  // −∞ dBm
  EXPECT_EQ(fault_of("-1", Dimension::power_level).problem, "negative power");
}

TEST(Quantity, NotANumber) {
  for (const char* text : {"", "   ", "GHz", "--5", "+-5", "+", "-", ".", "abc", "info", "1e-999", "3,5GHz", "1.2.3"})
    EXPECT_EQ(fault_of(text, Dimension::frequency).problem, "not a number") << text;
}

TEST(Quantity, WrongKindNamesBothKinds) {
  const auto fault = fault_of("5m", Dimension::frequency);
  EXPECT_EQ(fault.problem, "unit of the wrong kind");
  EXPECT_EQ(fault.why, "5m is a length, a frequency (Hz, kHz, MHz, GHz) is needed");
  EXPECT_EQ(fault.suggestion, "write 3.5GHz");
  EXPECT_EQ(fault_of("5GHz", Dimension::length).problem, "unit of the wrong kind");
  EXPECT_EQ(fault_of("20 dBm", Dimension::sound_level).problem, "unit of the wrong kind");
  EXPECT_EQ(fault_of("5%", Dimension::length).problem, "unit of the wrong kind");
}

TEST(Quantity, UnknownUnitsAndWrongCase) {
  const auto by_case = fault_of("3.5ghz", Dimension::frequency);
  EXPECT_EQ(by_case.problem, "unknown unit");
  EXPECT_EQ(by_case.suggestion, "did you mean GHz?");
  EXPECT_EQ(fault_of("100MW", Dimension::power_level).suggestion, "did you mean mW?");  // mW ≠ MW
  EXPECT_EQ(fault_of("30dbm", Dimension::power_level).suggestion, "did you mean dBm?");
  EXPECT_EQ(fault_of("5GHzz", Dimension::frequency).suggestion, "did you mean GHz?");
  EXPECT_EQ(fault_of("5 parsec", Dimension::length).problem, "unknown unit");
  EXPECT_EQ(fault_of("0x10", Dimension::length).problem, "unknown unit");
  EXPECT_EQ(fault_of("5 5m", Dimension::length).problem, "unknown unit");
}

TEST(Quantity, Describe) {
  EXPECT_EQ(describe(Dimension::frequency), "a frequency (Hz, kHz, MHz, GHz)");
  EXPECT_NE(describe(Dimension::conductivity).find("S/m"), std::string::npos);
}

TEST(Quantity, FormatFrequency) {
  EXPECT_EQ(format_frequency(3.5e9), "3.5 GHz");
  EXPECT_EQ(format_frequency(500), "500 Hz");
  EXPECT_EQ(format_frequency(63.09573), "63.1 Hz");
  EXPECT_EQ(format_frequency(7943.28), "7.943 kHz");
  EXPECT_EQ(format_frequency(999.96e3), "1 MHz");  // not 1000 kHz
  EXPECT_EQ(format_frequency(999.94e3), "999.9 kHz");
  EXPECT_EQ(format_frequency(speed_of_light / 550e-9), "545.1 THz");
  EXPECT_EQ(format_frequency(0), "0 Hz");
  EXPECT_EQ(format_frequency(-2e6), "-2 MHz");
  EXPECT_EQ(format_frequency(0.25), "250 mHz");
}

}  // namespace
}  // namespace grimaldi
