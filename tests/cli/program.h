#pragma once
// The program as it is shipped, run as a user runs it, each test in a folder of its own.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

extern char** environ;

namespace grimaldi::test {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;    // exit code, −1 if a signal ended it
  int signal = 0;   // that signal
  std::string out;  // stdout
  std::string err;  // stderr
};

// A folder of its own for each test, in which the program runs.
class Program : public testing::Test {
 protected:
  Program() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("program_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  ~Program() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  std::string contents(const fs::path& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  bool exists(const std::string& name) const { return fs::exists(folder_ / name); }

  std::vector<std::string> files_in(const std::string& name) const {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_ / name)) files.push_back(entry.path().filename().string());
    std::sort(files.begin(), files.end());
    return files;
  }

  pid_t start(std::vector<std::string> words) const {
    words.insert(words.begin(), GRIMALDI_PROGRAM);
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "stdout.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&actions, 2, "stderr.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    pid_t child = -1;
    const int fault = posix_spawn(&child, GRIMALDI_PROGRAM, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    EXPECT_EQ(fault, 0) << GRIMALDI_PROGRAM;
    return child;
  }

  Outcome wait(pid_t child) const {
    Outcome outcome;
    int status = 0;
    if (child > 0 && waitpid(child, &status, 0) == child) {
      if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
      if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    }
    outcome.out = contents("stdout.txt");
    outcome.err = contents("stderr.txt");
    return outcome;
  }

  // The first line of progress is printed just before; at most 30 s, the time of a sanitizer on a busy machine.
  void wait_until_it_traces() const {
    for (int i = 0; i < 1500 && contents("stderr.txt").find('%') == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }

  Outcome run(const std::vector<std::string>& words) const { return wait(start(words)); }

  // A small scenario: a street canyon at few rays; more options may follow.
  static std::vector<std::string> small(const std::string& verb, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {verb,   "--scene",  "street-canyon", "--frequency", "1GHz",    "--tx", "0,0,10",
                                      "--rx", "20,1,1.5", "--rays",        "20000",       "--depth", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  fs::path folder_;
};

}  // namespace grimaldi::test
