/**
 * How the benchmarks measure, and how they tell it.
 *
 * What is compared runs in turns, once each per repetition, so that a machine that becomes slower
 * does so for all; a ratio is formed within a repetition. Every figure is a median with the least
 * and the largest value.
 */
#ifndef Measuring_h
#define Measuring_h

#include <functional>
#include <string>
#include <vector>

namespace activesurface
{

/** One number per repetition. */
using Costs = std::vector<double>;

double MedianOf(Costs costs);

/** With one thread (WithThreads) the processor's time, which other programs do not lengthen; else
 * the clock's. */
double SecondsOf(const std::function<void()>& work);

/** Runs work where TBB has that many threads, and VTK's and OpenVDB's parallel loops with it. */
void WithThreads(int threads, const std::function<void()>& work);

/** All that TBB may use. */
int CountThreads();

/** 1, and all if there are more. */
std::vector<int> ThreadsToMeasure();

struct Contestant
{
  std::string Name;
  std::function<double()> Cost; //< measured by itself, so that preparations are not
};

/** The costs of each contestant, in turns. */
std::vector<Costs> MeasureInTurns(const std::vector<Contestant>& contestants, int repetitions);

/** What a figure belongs to. */
struct Work
{
  std::string Part;
  std::string Case;
  int Threads = 1;
};

///@{
/**
 * Prints a line, and appends it as a JSON object to the file that the environment variable
 * ACTIVE_BENCHMARK_RESULTS names: part, case, threads, name, unit, median, min, max. A ratio is
 * theirs / ours, repetition by repetition: how many times faster, unit "x".
 */
void Tell(const Work& work, const std::string& name, const std::string& unit, const Costs& costs);
void TellRatio(const Work& work, const std::string& name, const Costs& theirs, const Costs& ours);
///@}

/** Tells the costs of all, and how many times faster the first one is than each other. */
void TellContest(const Work& work, const std::string& unit,
  const std::vector<Contestant>& contestants, const std::vector<Costs>& costs);

/** Whether the program was called with the argument "quick". */
bool IsQuick(int argc, char** argv);

}

#endif
