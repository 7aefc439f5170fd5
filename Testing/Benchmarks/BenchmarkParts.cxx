// Distribution of time over the parts of a substep, and cost of a substep if nine tenths of the
// surface have converged.
//
// Run: BenchmarkParts [quick]
//
// The library has no clocks in its hot path. This program calls the passes of a substep one by one,
// in the order of BandState for attraction and tension, on a band of its own. The program fails
// unless its final potential is bitwise identical to that of a NarrowBand after as many substeps.
// Relaxation is a term of the step's kernel: its time is that of the kernel with relaxation less
// that of the kernel without. Polygonising is no part of the substep, but has the same unit.
// Fractions are of the sum of the substep's parts.
//
// Row of balls: ten converged balls, n nodes along the row. The target is the same row, of which
// the first ball or all balls begin to oscillate. Runs once without and once with a Tension that
// smooths a third of a voxel. Prints seconds per substep; all substeps have the same length.

#include "Front/ConvergedLeaves.h"
#include "Front/SamplePoints.h"
#include "Front/StepForward.h"
#include "Front/SubstepBuffers.h"
#include "Front/TargetSpeed.h"
#include "Front/TimeStep.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Measuring.h"
#include "NarrowBandGrid.h"
#include "Scenes.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

using namespace activesurface;

namespace
{

/** A band whose passes can be called one by one. */
struct OpenBand
{
  double VoxelSize;
  double Time = 0.0;
  openvdb::FloatGrid::Ptr Potential;
  LeafTable Leaves;
  ActiveSet Set;
  SubstepBuffers Buffers;
  std::map<std::string, double> Seconds; //< per part, since the last clear

  explicit OpenBand(const NarrowBand& band)
    : VoxelSize(band.GetVoxelSize())
    , Time(band.GetTime())
    , Potential(GetPotential(band)->deepCopy())
  {
    this->Leaves.SetBackground(Far);
    this->Leaves.Rebuild(this->Potential->tree());
    ReadActiveMasks(this->Leaves);
    this->Set.ChooseAll(this->Leaves);
    RebuildLayers(this->Leaves, this->Set, this->Potential->tree());
  }

  template <class Pass>
  void Clock(const std::string& part, const Pass& pass)
  {
    this->Seconds[part] += SecondsOf(pass);
  }

  std::size_t CountActive() const
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
    {
      count += this->Leaves[i].Active.Count();
    }
    return count;
  }

  TargetLimits FollowTarget(const Motion& motion, Target& target)
  {
    this->Set.ChooseAll(this->Leaves);
    const LeafList all = this->Set.Active;
    target.MoveTo(this->Time);
    this->Clock("target",
      [&]
      {
        SampleLeaves({ this->Leaves, this->Potential->tree(), this->VoxelSize }, all, motion,
          target, this->Buffers);
      });
    TargetLimits limits;
    this->Clock("speed at the surface",
      [&]
      {
        ApplySamples(this->Leaves, all, motion, this->Buffers);
        RememberSpeeds(this->Leaves, all, this->Buffers);
        limits = FindLimits(this->Leaves);
      });
    this->Clock("rest",
      [&]
      {
        const ConvergenceRule rule{ motion, this->VoxelSize, limits.TargetSlope };
        this->Set.Choose(this->Leaves,
          this->Leaves.FindAround(FindActiveLeaves(this->Leaves, all, rule, this->Buffers)));
      });
    this->Clock("extension", [&] { ExtendSpeed(this->Leaves, this->Set, motion, this->Buffers); });
    return limits;
  }

  void StepForwardWith(StepCoefficients coefficients)
  {
    std::vector<float> speeds(512 * this->Leaves.Size()); // each step overwrites them
    for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
    {
      std::copy_n(this->Buffers.SpeedOf(i), 512, speeds.data() + 512 * i);
    }
    const auto seconds = [&]
    {
      for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
      {
        std::copy_n(speeds.data() + 512 * i, 512, this->Buffers.SpeedOf(i));
      }
      return SecondsOf([&] { StepForward(this->Leaves, this->Set, coefficients, this->Buffers); });
    };
    const double whole = seconds();
    // Compares two runs after the first, so that both find the data in the caches. The last run
    // leaves the result of the step.
    const float relaxation = coefficients.Relaxation;
    coefficients.Relaxation = 0.f;
    const double without = seconds();
    coefficients.Relaxation = relaxation;
    const double share = seconds() - without;
    this->Seconds["relaxation"] += share;
    this->Seconds["update"] += whole - share;
    this->Clock("update", [&] { CommitStep(this->Leaves, this->Set, this->Buffers); });
  }

  void RebuildBand()
  {
    this->Clock("layers", [&] { RebuildLayers(this->Leaves, this->Set, this->Potential->tree()); });
    this->Clock("ghosts", [&] { FillGhosts(this->Leaves, this->Set); });
    this->Clock("layers",
      [&]
      {
        const std::size_t empty =
          this->Leaves.Count([](const LeafSummary& leaf) { return !leaf.IsUsed; });
        if (8 * empty > this->Leaves.Size())
        {
          DropEmptyLeaves(this->Leaves, this->Potential->tree());
        }
      });
  }

  void Substep(const Motion& motion, Target& target)
  {
    const TargetLimits limits = this->FollowTarget(motion, target);
    const double size = this->VoxelSize;
    const double step = StableStep(motion, size, limits, PenaltyForce());
    StepCoefficients coefficients;
    coefficients.HasTargetSpeed = true;
    coefficients.Advection = AdvectionFactor(step, size);
    coefficients.Tension = static_cast<float>(step * motion.Tension / (size * size));
    coefficients.Relaxation = static_cast<float>(
      RelaxationFor(step * TrackingRate(motion, size, limits), step * limits.Speed / size));
    this->StepForwardWith(coefficients);
    this->RebuildBand();
    this->Time += step;
  }

  void RequireSameAs(const NarrowBand& band) const
  {
    auto values = this->Potential->getConstAccessor();
    std::size_t count = 0;
    for (auto node = GetPotential(band)->cbeginValueOn(); node; ++node, ++count)
    {
      if (values.getValue(node.getCoord()) != *node)
      {
        std::fprintf(stderr, "The passes here are no longer those of the library's substep.\n");
        std::exit(1);
      }
    }
    if (count != this->CountActive())
    {
      std::fprintf(stderr, "The band here is no longer that of the library's substep.\n");
      std::exit(1);
    }
  }
};

double Polygonise(const NarrowBand& band)
{
  return SecondsOf(
    [&]
    {
      const Skin skin(band);
      const std::size_t count = skin.GetNumberOfPoints();
      const std::unique_ptr<float[]> points(new float[3 * count]);
      const std::unique_ptr<float[]> normals(new float[3 * count]);
      const std::unique_ptr<std::int64_t[]> corners(
        new std::int64_t[3 * skin.GetNumberOfTriangles()]);
      skin.Write(points.get(), normals.get(), corners.get());
    });
}

using Parts = std::map<std::string, Costs>;

/** Nanoseconds per active voxel and substep of each part, and of their sum. */
void AddTurn(OpenBand& open, NarrowBand& band, int substeps, Parts& parts)
{
  const Motion motion = MakeMotion(10.0, 0.001);
  MovingBall target;
  const double units = 1e-9 * substeps * band.GetNumberOfActiveNodes();
  open.Seconds.clear();
  for (int i = 0; i < substeps; ++i)
  {
    open.Substep(motion, target);
  }
  double sum = 0.0;
  for (const auto& [part, seconds] : open.Seconds)
  {
    parts[part].push_back(seconds / units);
    sum += seconds;
  }
  parts["sum of the parts"].push_back(sum / units);
  parts["Advance"].push_back(
    SecondsOf([&] { AdvanceSubsteps(band, substeps, motion, target); }) / units);
  parts["polygonise"].push_back(Polygonise(band) / units);
}

void TakeApart(int n, int threads, int repetitions)
{
  NarrowBand band(VoxelSizeOf(n));
  band.SetNumberOfThreads(threads);
  band.Start(0.0, Box, MakeInitial(BallDistance()));
  OpenBand open(band);
  Parts parts;
  WithThreads(threads,
    [&]
    {
      for (int repetition = 0; repetition < repetitions; ++repetition)
      {
        AddTurn(open, band, std::max(4, 1280 / n), parts);
      }
    });
  open.RequireSameAs(band);
  const Work work = { "parts", "n = " + std::to_string(n), threads };
  const double sum = MedianOf(parts["sum of the parts"]);
  for (const auto& [part, costs] : parts)
  {
    Costs shares = costs;
    std::for_each(shares.begin(), shares.end(), [sum](double& cost) { cost *= 100.0 / sum; });
    Tell(work, part, "ns", costs);
    Tell(work, "share of " + part, "%", shares);
  }
}

class SwingingBalls : public FormulaTarget<RowOfBalls>
{
public:
  explicit SwingingBalls(int moving)
    : FormulaTarget<RowOfBalls>(RowOfBalls{ moving })
  {
  }
  void MoveTo(double time) override { this->Form.Y = 0.02 * std::sin(30.0 * time); }
  bool MayHaveChanged(const double bounds[6]) const override
  {
    return bounds[0] <= 2.0 * this->Form.Moving / RowOfBalls::Count - 1.0;
  }
};

Contestant MakeRow(const std::string& name, int n, int moving, double tension)
{
  Motion motion = MakeMotion(30.0, tension);
  auto band = std::make_shared<NarrowBand>(VoxelSizeOf(n));
  const double bounds[6] = { -1.0, 1.0, -0.2, 0.2, -0.2, 0.2 };
  band->Start(-1.0, bounds, MakeInitial(RowOfBalls()));
  FormulaTarget<RowOfBalls> still{ RowOfBalls() };
  band->Advance(0.0, motion, still);
  auto target = std::make_shared<SwingingBalls>(moving);
  motion.LongestStep = 1e-3; // same step for all contestants
  return { name,
    [=]
    {
      const int substeps = 10;
      return SecondsOf([&] { AdvanceSubsteps(*band, substeps, motion, *target); }) / substeps;
    } };
}

void RestPartly(int n, int repetitions)
{
  const double size = VoxelSizeOf(n);
  for (const double tension : { 0.0, 3.0 * size * size })
  {
    const std::string under = tension > 0.0 ? " under tension" : "";
    const std::vector<Contestant> contestants = {
      MakeRow("90 % steady" + under, n, 1, tension),
      MakeRow("all moving" + under, n, RowOfBalls::Count, tension),
    };
    std::vector<Costs> costs;
    WithThreads(1, [&] { costs = MeasureInTurns(contestants, repetitions); });
    TellContest({ "parts", "row of balls, n = " + std::to_string(n), 1 }, "s", contestants, costs);
  }
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const bool isQuick = IsQuick(argc, argv);
  for (const int threads : ThreadsToMeasure())
  {
    TakeApart(isQuick ? 128 : 256, threads, isQuick ? 5 : 15);
  }
  RestPartly(isQuick ? 256 : 512, isQuick ? 7 : 15);
}
