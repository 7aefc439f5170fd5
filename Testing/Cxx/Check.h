/**
 * What a C++ test is written with: facts that check, and a main that runs them.
 *
 *   void GrowingBallHasExactRadius(Check& check)
 *   {
 *     check.Near(radius, std::sqrt(expected), 0.1 * voxel, "radius at t = 1");
 *   }
 *
 *   int main(int argc, char** argv)
 *   {
 *     return RunFacts(argc, argv, { { "GrowingBallHasExactRadius", GrowingBallHasExactRadius } });
 *   }
 *
 * `TestBall` runs all its facts, `TestBall GrowingBallHasExactRadius` that one (ctest does so),
 * `--list` prints their names, `--verbose` the passing checks with their values too. A fact fails
 * when a check fails, when it throws, and when it checks nothing.
 */
#ifndef Check_h
#define Check_h

#include "OutputFiles.h"
#include "TestFolders.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

class Check
{
public:
  explicit Check(bool verbose)
    : Verbose(verbose)
  {
  }

  void True(bool condition, const std::string& sentence)
  {
    this->Count(condition, sentence, condition ? "true" : "false, expected true");
  }

  /** Passes when |value - expected| <= tolerance; never for NaN. */
  void Near(double value, double expected, double tolerance, const std::string& sentence)
  {
    const bool passed = value == expected || std::abs(value - expected) <= tolerance;
    this->Count(passed, sentence,
      Text(value) + ", expected " + Text(expected) + ", tolerance " + Text(tolerance) +
        ", off by " + Text(value - expected));
  }

  /** Passes when value < bound; never for NaN. */
  void Less(double value, double bound, const std::string& sentence)
  {
    this->Count(value < bound, sentence, Text(value) + ", expected less than " + Text(bound));
  }

  /** Passes when the two are equal by ==; for counts, texts and bits. */
  template <class Value, class Expected>
  void Equal(const Value& value, const Expected& expected, const std::string& sentence)
  {
    this->Count(value == expected, sentence, Text(value) + ", expected " + Text(expected));
  }

  /** Passes when action() throws an Exception whose sentence contains words. */
  template <class Exception, class Action>
  void Throws(Action action, const std::string& words, const std::string& sentence)
  {
    try
    {
      action();
      this->Count(false, sentence, "nothing thrown, expected \"" + words + "\"");
    }
    catch (const Exception& error)
    {
      const std::string said = error.what();
      this->Count(said.find(words) != std::string::npos, sentence,
        "\"" + said + "\", expected \"" + words + "\"");
    }
  }

  void Fail(const std::string& sentence) { this->Count(false, sentence, "failed"); }

  int GetChecks() const { return this->Checks; }
  int GetFailures() const { return this->Failures; }

private:
  /** Digits enough to tell any two doubles apart. */
  template <class Value>
  static std::string Text(const Value& value)
  {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
  }

  void Count(bool passed, const std::string& sentence, const std::string& found)
  {
    constexpr int failuresShown = 20;
    this->Checks += 1;
    this->Failures += passed ? 0 : 1;
    if (passed ? this->Verbose : this->Failures <= failuresShown)
    {
      std::printf("  %s: %s: %s\n", passed ? "ok" : "FAILED", sentence.c_str(), found.c_str());
    }
  }

  bool Verbose;
  int Checks = 0;
  int Failures = 0;
};

struct Fact
{
  std::string Name;
  std::function<void(Check&)> Run;
};

inline bool Holds(const Fact& fact, bool verbose)
{
  std::printf("%s\n", fact.Name.c_str());
  std::fflush(stdout);
  Check check(verbose);
  try
  {
    fact.Run(check);
    if (check.GetChecks() == 0)
    {
      check.Fail("a fact must check something");
    }
  }
  catch (const std::exception& error)
  {
    check.Fail(std::string("threw \"") + error.what() + "\"");
  }
  std::printf("  %d checks, %d failed\n", check.GetChecks(), check.GetFailures());
  std::fflush(stdout);
  return check.GetFailures() == 0;
}

/** The exit code of main: 0 when all facts asked for hold. */
inline int RunFacts(int argc, char** argv, const std::vector<Fact>& facts)
{
  std::vector<std::string> names(argv + 1, argv + argc);
  const auto take = [&names](const char* option)
  {
    const auto found = std::find(names.begin(), names.end(), option);
    const bool given = found != names.end();
    if (given)
    {
      names.erase(found);
    }
    return given;
  };
  const bool list = take("--list");
  const bool verbose = take("--verbose");

  const auto program = std::filesystem::path(argv[0]).stem();
  int failed = 0;
  for (const std::string& name : names)
  {
    const auto hasName = [&name](const Fact& fact) { return fact.Name == name; };
    if (std::none_of(facts.begin(), facts.end(), hasName))
    {
      std::printf("%s is not in the list that main gives to RunFacts\n", name.c_str());
      ++failed;
    }
  }
  for (const Fact& fact : facts)
  {
    if (list)
    {
      std::printf("%s\n", fact.Name.c_str());
    }
    else if (names.empty() || std::find(names.begin(), names.end(), fact.Name) != names.end())
    {
      FolderOfTheFact = std::filesystem::path(TestOutputFolder) / program / fact.Name;
      failed += Holds(fact, verbose) ? 0 : 1;
    }
  }
  return failed == 0 ? 0 : 1;
}

#endif
