// The checks that all other tests rely on: each passes when it should and fails when it should.

#include "Check.h"

#include <limits>
#include <stdexcept>

namespace
{
const double NotANumber = std::numeric_limits<double>::quiet_NaN();

bool IsHeld(const std::function<void(Check&)>& run)
{
  return Holds({ "made up", run }, false);
}

bool Runs(std::vector<std::string> arguments, const std::vector<Fact>& facts)
{
  arguments.insert(arguments.begin(), "TestMadeUp");
  std::vector<char*> argv;
  for (std::string& argument : arguments)
  {
    argv.push_back(argument.data());
  }
  return RunFacts(static_cast<int>(argv.size()), argv.data(), facts) == 0;
}
}

void ChecksPassAndFail(Check& check)
{
  check.True(IsHeld([](Check& c) { c.True(true, ""); }), "True passes");
  check.True(!IsHeld([](Check& c) { c.True(false, ""); }), "True fails");
  check.True(IsHeld([](Check& c) { c.Near(1.0, 1.25, 0.25, ""); }), "Near passes at the tolerance");
  check.True(!IsHeld([](Check& c) { c.Near(1.0, 1.26, 0.25, ""); }), "Near fails beyond it");
  check.True(!IsHeld([](Check& c) { c.Near(NotANumber, 0, 1, ""); }), "Near fails for NaN");
  check.True(IsHeld([](Check& c) { c.Less(1, 2, ""); }), "Less passes");
  check.True(!IsHeld([](Check& c) { c.Less(2, 2, ""); }), "Less fails at the bound");
  check.True(!IsHeld([](Check& c) { c.Less(NotANumber, 2, ""); }), "Less fails for NaN");
  check.True(IsHeld([](Check& c) { c.Equal(3u, std::size_t(3), ""); }), "Equal passes");
  check.True(!IsHeld([](Check& c) { c.Equal("a", std::string("b"), ""); }), "Equal fails");
}

void ThrowsWantsTheSentence(Check& check)
{
  const auto fail = [] { throw std::runtime_error("the band is full"); };
  check.True(IsHeld([&](Check& c) { c.Throws<std::runtime_error>(fail, "full", ""); }), "passes");
  check.True(!IsHeld([&](Check& c) { c.Throws<std::runtime_error>(fail, "empty", ""); }),
    "fails for another sentence");
  check.True(!IsHeld([&](Check& c) { c.Throws<std::invalid_argument>(fail, "full", ""); }),
    "fails for another exception");
  check.True(!IsHeld([&](Check& c) { c.Throws<std::runtime_error>([] {}, "full", ""); }),
    "fails when nothing is thrown");
}

void FactsFailWhenTheyThrowOrCheckNothing(Check& check)
{
  check.True(!IsHeld([](Check&) {}), "a fact that checks nothing");
  check.True(!IsHeld(
               [](Check& c)
               {
                 c.True(true, "");
                 throw std::runtime_error("made up");
               }),
    "a fact that throws");
}

void RunFactsRunsWhatIsAskedFor(Check& check)
{
  const std::vector<Fact> facts = { { "Good", [](Check& c) { c.True(true, ""); } },
    { "Bad", [](Check& c) { c.True(false, ""); } } };
  check.True(Runs({ "Good" }, facts), "a fact that holds");
  check.True(!Runs({ "Bad" }, facts), "a fact that does not");
  check.True(!Runs({}, facts), "all facts, of which one does not hold");
  check.True(!Runs({ "Absent" }, facts), "a fact that is not in the list");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "ChecksPassAndFail", ChecksPassAndFail },
      { "ThrowsWantsTheSentence", ThrowsWantsTheSentence },
      { "FactsFailWhenTheyThrowOrCheckNothing", FactsFailWhenTheyThrowOrCheckNothing },
      { "RunFactsRunsWhatIsAskedFor", RunFactsRunsWhatIsAskedFor } });
}
