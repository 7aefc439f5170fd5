// What ranks that advance a band together tell each other, counted: no time is measured, so that
// they can be more than there are cores.
//
// Run: BenchmarkRanks [quick]
//
// A pool under waves, n nodes along it, is advanced by three time steps, by explicit substeps.
// The ranks are threads. Of the last step, for each substep and rank: rounds, in
// which all ranks wait for each other; bytes to neighbours, and to all other ranks, of the rank
// that sends most of them. What makes the band whole at the end of the step is among the bytes to
// all. Imbalance: crossings of the rank that has most of them, over the mean.

#include "Leaves/LeafTable.h"
#include "Leaves/RankedLeaves.h"
#include "Measuring.h"
#include "Support/ThreadRanks.h"

#include "NarrowBand.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

using namespace activesurface;

namespace
{

class Pool : public Target
{
public:
  void MoveTo(double time) override { this->Time = time; }

  double Find(const double* x) const
  {
    const double level = .1 * std::sin(6.0 * x[0] - 2.0 * this->Time) + .05 * std::cos(9.0 * x[1]);
    return std::max({ std::fabs(x[0]) - .9, std::fabs(x[1]) - .9, x[2] - level, -.4 - x[2] });
  }

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override
  {
    for (std::size_t n = 0; n < count; ++n)
    {
      results.Values[n] = this->Find(points + 3 * n);
      results.Slopes[n] = 1.3;
    }
    SetStill(count, results);
  }

private:
  double Time = 0.0;
};

struct Traffic
{
  double Rounds = 0.0;
  double ToNeighbours = 0.0;
  double ToAll = 0.0;
};

class CountingCommunicator final : public ThreadCommunicator
{
public:
  CountingCommunicator(MeetingPoint& place, int rank, Traffic& traffic)
    : ThreadCommunicator(place, rank)
    , Counted(traffic)
  {
  }

  std::int64_t Max(std::int64_t own) override
  {
    this->Counted.Rounds += 1.0;
    return ThreadCommunicator::Max(own);
  }
  std::vector<Bytes> AllGather(const Bytes& own) override
  {
    this->Counted.ToAll += static_cast<double>(own.size());
    return ThreadCommunicator::AllGather(own);
  }
  std::vector<Bytes> Swap(
    const std::vector<Bytes>& toEach, const std::vector<std::size_t>& sizes) override
  {
    for (const Bytes& bytes : toEach)
    {
      this->Counted.ToNeighbours += static_cast<double>(bytes.size());
    }
    return ThreadCommunicator::Swap(toEach, sizes);
  }

private:
  Traffic& Counted;
};

std::unique_ptr<NarrowBand> StartPool(int nodes)
{
  auto band = std::make_unique<NarrowBand>(2.0 / nodes);
  band->SetNumberOfThreads(1);
  const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  InitialFunction function;
  function.ThreadSafe = true;
  function.Evaluate = [pool = Pool()](std::size_t count, const double* points, double* values)
  {
    for (std::size_t n = 0; n < count; ++n)
    {
      values[n] = pool.Find(points + 3 * n);
    }
  };
  band->Start(0.0, bounds, function);
  return band;
}

Motion MakeLaw()
{
  Motion law;
  law.Attraction = 20.0;
  law.Tension = .002;
  return law;
}

struct Run
{
  std::vector<Traffic> Ranks; //< of the last step
  double Substeps = 0.0;
  double Imbalance = 1.0;
};

double FindImbalance(Agreement& ranks, const NarrowBand& band)
{
  const LeafTable& table = band.GetLeaves();
  const RankedLeaves shared(ranks, table);
  std::vector<double> crossings(static_cast<std::size_t>(ranks.GetSize()));
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    crossings[shared.GetOwner(i)] += table[i].Crossings;
  }
  double sum = 0.0;
  for (const double of : crossings)
  {
    sum += of;
  }
  return *std::max_element(crossings.begin(), crossings.end()) * ranks.GetSize() / sum;
}

Run RunPool(int size, int nodes)
{
  constexpr double step = .04;
  Run run;
  run.Ranks.resize(static_cast<std::size_t>(size));
  RunOnRanks(size,
    [&](MeetingPoint& place, int rank)
    {
      Traffic& traffic = run.Ranks[static_cast<std::size_t>(rank)];
      Agreement ranks(std::make_unique<CountingCommunicator>(place, rank, traffic));
      const std::unique_ptr<NarrowBand> band = StartPool(nodes);
      band->SetRanks(&ranks);
      Pool pool;
      for (int frame = 1; frame <= 3; ++frame)
      {
        traffic = Traffic();
        const AdvanceReport report = band->Advance(step * frame, MakeLaw(), pool);
        run.Substeps = rank == 0 ? static_cast<double>(report.Substeps) : run.Substeps;
      }
      if (rank == 0)
      {
        run.Imbalance = FindImbalance(ranks, *band);
      }
    });
  return run;
}

void TellRun(const Run& run)
{
  const auto most = [&](double Traffic::*number)
  {
    double largest = 0.0;
    for (const Traffic& traffic : run.Ranks)
    {
      largest = std::max(largest, traffic.*number);
    }
    return largest / run.Substeps;
  };
  std::printf("%6zu %9.0f %8.0f %18.1f %14.1f %10.2f\n", run.Ranks.size(), run.Substeps,
    most(&Traffic::Rounds), 1e-3 * most(&Traffic::ToNeighbours), 1e-3 * most(&Traffic::ToAll),
    run.Imbalance);
}

}

int main(int argc, char* argv[])
{
  const bool isQuick = argc > 1 && std::strcmp(argv[1], "quick") == 0;
  const int nodes = isQuick ? 64 : 192;
  std::printf("n = %d, %zu leaves; kB and rounds for each substep and rank\n", nodes,
    StartPool(nodes)->GetLeaves().Size());
  std::printf("%6s %9s %8s %18s %14s %10s\n", "ranks", "substeps", "rounds", "kB to neighbours",
    "kB to all", "imbalance");
  for (const int ranks : { 2, 4, 8, 16, 32, 64 })
  {
    TellRun(RunPool(ranks, nodes));
  }
  return 0;
}
