#include "core/contract.h"

#include <gtest/gtest.h>

namespace grimaldi {
namespace {

TEST(Contract, TextHasTheFormOfTheHeader) {
  const Diagnostic full{Severity::error, "city.toml", 12, "coverage.cell_size", "PROBLEM", "WHY", "SUGGESTION"};
  EXPECT_EQ(to_string(full), "error: city.toml:12: coverage.cell_size: PROBLEM (WHY); SUGGESTION");
}

TEST(Contract, EmptyFieldsAreLeftOut) {
  EXPECT_EQ(to_string({Severity::warning, "", 0, "--tx", "two numbers", "", ""}), "warning: --tx: two numbers");
  EXPECT_EQ(to_string({Severity::error, "a.obj", 0, "", "not there", "", "look"}), "error: a.obj: not there; look");
  EXPECT_EQ(to_string({Severity::error, "", 0, "", "P", "W", ""}), "error: P (W)");
}

TEST(Contract, TextStaysOnOneLineAndKeepsUtf8) {
  const std::string text = to_string({Severity::error, "a\nb.toml", 1, "x", "2 µm\r\n", "", ""});
  EXPECT_EQ(text, "error: a b.toml:1: x: 2 µm  ");
}

TEST(Contract, ThrowsAllErrorsAndNoWarnings) {
  Diagnostics diagnostics;
  diagnostics.warning("f", 1, "a", "w");
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_NO_THROW(diagnostics.throw_if_errors());
  diagnostics.error("f", 2, "b", "p", "y", "s");
  diagnostics.error("f", 3, "c", "q");
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.all().size(), 3u);
  try {
    diagnostics.throw_if_errors();
    FAIL() << "nothing thrown";
  } catch (const InputErrors& errors) {
    ASSERT_EQ(errors.diagnostics().size(), 2u);
    EXPECT_EQ(errors.diagnostics()[0].suggestion, "s");
    EXPECT_STREQ(errors.what(), "error: f:2: b: p (y); s\nerror: f:3: c: q");
  }
}

TEST(Contract, InputErrorThrowsOneError) {
  try {
    input_error("f", 7, "o", "p");
  } catch (const InputErrors& errors) {
    ASSERT_EQ(errors.diagnostics().size(), 1u);
    EXPECT_EQ(errors.diagnostics()[0].line, 7);
    EXPECT_EQ(errors.diagnostics()[0].severity, Severity::error);
    return;
  }
  FAIL() << "nothing thrown";
}

TEST(Contract, SlipsAreRecognised) {
  const std::vector<std::string> keys = {"height", "cell_size", "area", "polarisation"};
  EXPECT_EQ(did_you_mean("cel_size", keys), "did you mean cell_size?");  // a letter left out
  EXPECT_EQ(did_you_mean("heigth", keys), "did you mean height?");       // two letters swapped: distance 1
  EXPECT_EQ(did_you_mean("AREA", keys), "did you mean area?");           // case alone
  EXPECT_EQ(did_you_mean("polarization", keys), "did you mean polarisation?");
  EXPECT_EQ(did_you_mean("arae", keys), "did you mean area?");  // 1 of 4
}

TEST(Contract, WhatIsFarFromEverythingGetsTheList) {
  EXPECT_EQ(did_you_mean("xyz", {"height", "area"}), "known: height, area");
  EXPECT_EQ(did_you_mean("tx", {"rx"}), "known: rx");  // one letter of two is more than a third
  EXPECT_EQ(did_you_mean("anything", {}), "");
  EXPECT_EQ(did_you_mean("", {"a"}), "known: a");
  std::vector<std::string> many;
  for (int i = 0; i < 23; ++i) many.push_back("key" + std::string(1, static_cast<char>('a' + i)));
  const std::string list = did_you_mean("0123456789", many);
  EXPECT_NE(list.find("keyt, and 3 more"), std::string::npos) << list;  // 20 names: keya … keyt
  EXPECT_EQ(list.find("keyu"), std::string::npos);
}

TEST(ContractDeathTest, ViolationNamesConditionAndPlaceAndAborts) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(contract_violation("EXPECT", "x > 0", "file.cpp", 42), "file\\.cpp:42: EXPECT\\(x > 0\\)");
}

}  // namespace
}  // namespace grimaldi
