#include "Measuring.h"

#include "vtkSMPTools.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>

namespace activesurface
{

double MedianOf(Costs costs)
{
  std::sort(costs.begin(), costs.end());
  return 0.5 * (costs.at((costs.size() - 1) / 2) + costs.at(costs.size() / 2));
}

namespace
{

double ReadProcessorTime()
{
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

}

double SecondsOf(const std::function<void()>& work)
{
  const std::size_t threads =
    tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const double before = ReadProcessorTime();
  const auto begin = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  return threads == 1 ? ReadProcessorTime() - before : spent.count();
}

void WithThreads(int threads, const std::function<void()>& work)
{
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(threads);
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads }, [&] { arena.execute(work); });
}

int CountThreads()
{
  return tbb::this_task_arena::max_concurrency();
}

std::vector<int> ThreadsToMeasure()
{
  const int all = CountThreads();
  return all > 1 ? std::vector<int>{ 1, all } : std::vector<int>{ 1 };
}

std::vector<Costs> MeasureInTurns(const std::vector<Contestant>& contestants, int repetitions)
{
  std::vector<Costs> costs(contestants.size());
  for (int repetition = 0; repetition < repetitions; ++repetition)
  {
    for (std::size_t i = 0; i < contestants.size(); ++i)
    {
      costs[i].push_back(contestants[i].Cost());
    }
  }
  return costs;
}

namespace
{

void AppendJSON(const Work& work, const std::string& name, const std::string& unit, double median,
  double least, double largest)
{
  const char* path = std::getenv("ACTIVE_BENCHMARK_RESULTS");
  if (!path)
  {
    return;
  }
  std::ofstream file(path, std::ios::app);
  file.precision(6);
  file << "{\"part\": \"" << work.Part << "\", \"case\": \"" << work.Case
       << "\", \"threads\": " << work.Threads << ", \"name\": \"" << name << "\", \"unit\": \""
       << unit << "\", \"median\": " << median << ", \"min\": " << least << ", \"max\": " << largest
       << "}\n";
  if (!file.flush())
  {
    throw std::runtime_error(std::string("Cannot write ") + path + ".");
  }
}

}

void Tell(const Work& work, const std::string& name, const std::string& unit, const Costs& costs)
{
  const auto ends = std::minmax_element(costs.begin(), costs.end());
  const double median = MedianOf(costs);
  std::printf("%-9s %-28s %2d thr  %-44s %9.4g (%.4g .. %.4g) %s\n", work.Part.c_str(),
    work.Case.c_str(), work.Threads, name.c_str(), median, *ends.first, *ends.second, unit.c_str());
  std::fflush(stdout);
  AppendJSON(work, name, unit, median, *ends.first, *ends.second);
}

void TellRatio(const Work& work, const std::string& name, const Costs& theirs, const Costs& ours)
{
  Costs ratios;
  for (std::size_t i = 0; i < theirs.size(); ++i)
  {
    ratios.push_back(theirs[i] / ours.at(i));
  }
  Tell(work, name, "x", ratios);
}

void TellContest(const Work& work, const std::string& unit,
  const std::vector<Contestant>& contestants, const std::vector<Costs>& costs)
{
  for (std::size_t i = 0; i < contestants.size(); ++i)
  {
    Tell(work, contestants[i].Name, unit, costs[i]);
  }
  for (std::size_t i = 1; i < contestants.size(); ++i)
  {
    TellRatio(work, contestants[0].Name + " over " + contestants[i].Name, costs[i], costs[0]);
  }
}

bool IsQuick(int argc, char** argv)
{
  return argc > 1 && std::string(argv[1]) == "quick";
}

}
