/**
 * Measurement and output of the benchmarks.
 *
 * Contestants run in turns, once each per repetition, so that a slower machine slows down all of
 * them. A ratio is formed within a repetition. Every figure is a median with the least and the
 * largest value.
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

/** Processor time with one thread (WithThreads), which other programs do not lengthen; else wall
 * time. */
double SecondsOf(const std::function<void()>& work);

/** Runs `work` with this number of threads in TBB and in the parallel loops of VTK and OpenVDB. */
void WithThreads(int threads, const std::function<void()>& work);

/** Number of threads that TBB may use. */
int CountThreads();

/** 1, and the number of all threads if there are more. */
std::vector<int> ThreadsToMeasure();

struct Contestant
{
  std::string Name;
  std::function<double()> Cost; //< measures itself, so that preparations do not count
};

std::vector<Costs> MeasureInTurns(const std::vector<Contestant>& contestants, int repetitions);

/** Subject of a figure. */
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

/** Prints the costs of all contestants, and the ratios to the first one. */
void TellContest(const Work& work, const std::string& unit,
  const std::vector<Contestant>& contestants, const std::vector<Costs>& costs);

/** Returns true if the program was called with the argument "quick". */
bool IsQuick(int argc, char** argv);

}

#endif
