// The program: verb → function; exit 0 done, 1 bad input, 2 a fault of ours, 3 a validation missed.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/arguments.h"
#include "cli/compare_verb.h"
#include "cli/eval_verb.h"
#include "cli/run_verb.h"
#include "cli/scene_verb.h"
#include "cli/validate_verb.h"

namespace {

int run(int argc, char** argv, std::chrono::steady_clock::time_point start) {
  using namespace grimaldi;
  Diagnostics diagnostics;
  const Arguments arguments = parse_arguments(argc, argv, diagnostics);
  diagnostics.throw_if_errors();
  if (arguments.print) {
    fmt::print("{}", *arguments.print);
    return arguments.exit_code;
  }
  if (arguments.verb == Verb::eval) return eval_verb(arguments);
  if (arguments.verb == Verb::compare) return compare_verb(arguments);
  if (arguments.verb == Verb::validate) return validate_verb(arguments);
  return arguments.verb == Verb::scene ? scene_verb(arguments) : run_verb(arguments, start);
}

}  // namespace

int main(int argc, char** argv) {
  const auto start = std::chrono::steady_clock::now();
  try {
    const int code = run(argc, argv, start);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    std::fputs("error: standard output cannot be written\n", stderr);
    return 2;
  } catch (const grimaldi::InputErrors& errors) {
    std::fputs(errors.what(), stderr);
    std::fputs("\n", stderr);
    return 1;
  } catch (const std::bad_alloc&) {
    std::fputs("error: out of memory (coarser cells, fewer bands or a smaller area need less)\n", stderr);
  } catch (const std::exception& fault) {
    std::fputs("error: a fault of the program: ", stderr);
    std::fputs(fault.what(), stderr);
    std::fputs("\n", stderr);
  }
  return 2;
}
