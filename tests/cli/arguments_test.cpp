// The command line: options become keys of the scenario, and slips are named.

#include "cli/arguments.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace grimaldi {
namespace {

Arguments parse(std::vector<const char*> words, Diagnostics& diagnostics) {
  words.insert(words.begin(), "grimaldi");
  return parse_arguments(static_cast<int>(words.size()), words.data(), diagnostics);
}

Arguments parse(const std::vector<const char*>& words) {
  Diagnostics diagnostics;
  Arguments arguments = parse(words, diagnostics);
  for (const auto& fault : diagnostics.all()) ADD_FAILURE() << to_string(fault);
  return arguments;
}

std::string value_of(const Arguments& arguments, const std::string& key) {
  std::string value = "(not set)";
  for (const auto& option : arguments.options)
    if (option.key == key) value = option.value;
  return value;
}

TEST(Arguments, TheExampleOfTheContract) {
  const Arguments arguments =
      parse({"coverage", "--scene", "munich.xml", "--frequency", "3.5GHz", "--tx", "8.5,21,27", "--height", "1.5",
             "--cell-size", "5", "--rays", "1e6", "--depth", "3", "--diffraction", "fsd", "-o", "out"});
  EXPECT_EQ(arguments.verb, Verb::coverage);
  EXPECT_EQ(arguments.input, "");
  EXPECT_EQ(value_of(arguments, "scene.file"), "munich.xml");
  EXPECT_EQ(value_of(arguments, "wave.frequency"), "3.5GHz");
  EXPECT_EQ(value_of(arguments, "transmitter.0.position"), "[8.5,21,27]");
  EXPECT_EQ(value_of(arguments, "coverage.height"), "1.5");
  EXPECT_EQ(value_of(arguments, "coverage.cell_size"), "5");
  EXPECT_EQ(value_of(arguments, "budget.rays"), "1e6");
  EXPECT_EQ(value_of(arguments, "propagation.depth"), "3");
  EXPECT_EQ(value_of(arguments, "propagation.diffraction"), "fsd");
  EXPECT_EQ(arguments.output, "out");
  EXPECT_EQ(arguments.threads, 0u);
  EXPECT_FALSE(arguments.overwrite || arguments.quiet || arguments.json || arguments.progress);
}

TEST(Arguments, ListsAndRepeatedOptions) {
  const Arguments arguments = parse({"profile",
                                     "city.toml",
                                     "--tx=-8,21,27",
                                     "--tx",
                                     "1,2,3m",
                                     "--rx",
                                     "-4,5,6",
                                     "--frequency",
                                     "900MHz,3.5GHz",
                                     "--mechanisms",
                                     "direct,reflection",
                                     "--set",
                                     "transmitter.0.power=30dBm",
                                     "--set",
                                     "a.b=c=d",
                                     "--seed",
                                     "7",
                                     "--threads",
                                     "2",
                                     "--quiet",
                                     "--json",
                                     "--overwrite",
                                     "--progress"});
  EXPECT_EQ(arguments.verb, Verb::profile);
  EXPECT_EQ(arguments.input, "city.toml");
  EXPECT_EQ(value_of(arguments, "transmitter.0.position"), "[-8,21,27]");
  EXPECT_EQ(value_of(arguments, "transmitter.1.position"), "[1,2,3m]");
  EXPECT_EQ(value_of(arguments, "receiver.0.position"), "[-4,5,6]");
  EXPECT_EQ(value_of(arguments, "wave.frequency"), "[900MHz,3.5GHz]");
  EXPECT_EQ(value_of(arguments, "propagation.mechanisms"), "[direct,reflection]");
  EXPECT_EQ(value_of(arguments, "transmitter.0.power"), "30dBm");
  EXPECT_EQ(value_of(arguments, "a.b"), "c=d");
  EXPECT_EQ(value_of(arguments, "budget.seed"), "7");
  EXPECT_EQ(arguments.options.back().option, "--set a.b=c=d");  // --set after the direct options
  EXPECT_EQ(arguments.threads, 2u);
  EXPECT_TRUE(arguments.overwrite && arguments.quiet && arguments.json && arguments.progress);
}

TEST(Arguments, ASceneIsABuiltInNameOrAFileOfTheWorkingFolder) {
  EXPECT_EQ(value_of(parse({"coverage", "--scene", "demo-city"}), "scene.builtin"), "demo-city");
  // With a scenario, whose folder may be another, the name is made absolute.
  EXPECT_EQ(value_of(parse({"coverage", "dir/city.toml", "--scene", "a.xml"}), "scene.file"),
            std::filesystem::absolute("a.xml").string());
  const Arguments scene = parse({"scene", "box", "--json"});
  EXPECT_EQ(scene.verb, Verb::scene);
  EXPECT_EQ(scene.input, "box");
  EXPECT_TRUE(scene.json);
}

TEST(Arguments, TheOptionAfterARepeatableOneIsNotItsValue) {
  const Arguments arguments = parse({"coverage", "--tx", "1,2,3", "city.toml", "--set", "a.b=1", "--json"});
  EXPECT_EQ(arguments.input, "city.toml");
  EXPECT_EQ(value_of(arguments, "transmitter.1.position"), "(not set)");
}

TEST(Arguments, HelpAndVersion) {
  const Arguments alone = parse(std::vector<const char*>{});
  ASSERT_TRUE(alone.print);
  EXPECT_EQ(alone.exit_code, 1);
  const Arguments help = parse({"--help"});
  ASSERT_TRUE(help.print);
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.print->find("grimaldi coverage city.toml"), std::string::npos);
  const Arguments verb_help = parse({"coverage", "--help"});
  ASSERT_TRUE(verb_help.print);
  for (const char* option :
       {"--scene",     "--frequency", "--tx",          "--rx",         "--height", "--cell-size", "--area",
        "--rays",      "--depth",     "--diffraction", "--mechanisms", "--seed",   "--threads",   "--output",
        "--overwrite", "--quiet",     "--json",        "--progress",   "--wave",   "--set"})
    EXPECT_NE(verb_help.print->find(option), std::string::npos) << option;
  const Arguments version = parse({"--version"});
  ASSERT_TRUE(version.print);
  EXPECT_EQ(version.print->rfind("grimaldi ", 0), 0u);
  EXPECT_EQ(version.exit_code, 0);
}

TEST(Arguments, SlipsAreNamed) {
  const struct {
    std::vector<const char*> words;
    std::string option, problem, hint;
  } cases[] = {
      {{"covrage", "a.toml"}, "covrage", "unknown verb", "coverage"},
      {{"a.toml"}, "a.toml", "no verb", "grimaldi coverage a.toml"},
      {{"--json", "coverage"}, "--json", "no verb", "coverage"},
      {{"tradeoff"}, "tradeoff", "not in this version", ""},
      {{"validate", "--lst"}, "--lst", "unknown option", "--list"},
      {{"validate", "-o", ""}, "-o", "an empty name", ""},
      {{"eval", "utd", "--on", "x"}, "--on", "unknown option", ""},
      {{"eval", "utd", "--out", ""}, "--out", "an empty name", "stdout"},
      {{"report", "x.h5"}, "report", "not in this version", ""},
      {{"coverage", "a.toml", "--cel-size", "5"}, "--cel-size", "unknown option", "--cell-size"},
      {{"coverage", "a.toml", "--cel-size=5"}, "--cel-size", "unknown option", "--cell-size"},
      {{"profile", "a.toml", "--area", "1,2,3,4"}, "--area", "unknown option", ""},
      {{"coverage", "a.toml", "b.toml"}, "b.toml", "one argument too many", "a.toml"},
      {{"coverage", "--set", "depth"}, "--set depth", "not KEY=VALUE", ""},
      {{"coverage", "--set", "=3"}, "--set =3", "not KEY=VALUE", ""},
      {{"coverage", "--threads", "two"}, "--threads two", "out of range", "whole number"},
      {{"coverage", "--threads", "-1"}, "--threads -1", "out of range", "whole number"},
      {{"coverage", "--threads", "99999999999"}, "--threads 99999999999", "out of range", "whole number"},
      {{"coverage", "-o", ""}, "-o", "an empty name", ""},
      {{"scene"}, "scene", "no scene given", "demo-city"},
  };
  for (const auto& one : cases) {
    std::string line;
    for (const char* word : one.words) line += std::string(word) + " ";
    SCOPED_TRACE(line);
    Diagnostics diagnostics;
    parse(one.words, diagnostics);
    ASSERT_FALSE(diagnostics.all().empty());
    const Diagnostic& fault = diagnostics.all().front();
    EXPECT_EQ(fault.severity, Severity::error);
    EXPECT_EQ(fault.option, one.option);
    EXPECT_EQ(fault.problem, one.problem);
    EXPECT_NE(to_string(fault).find(one.hint), std::string::npos) << to_string(fault);
  }
}

TEST(Arguments, AnOptionWithoutItsValueIsNamed) {
  Diagnostics diagnostics;
  parse({"coverage", "a.toml", "--depth"}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_NE(to_string(diagnostics.all()[0]).find("--depth"), std::string::npos);
}

}  // namespace
}  // namespace grimaldi
