// The potential depends on the times and the motion alone, to the bit: not on the number of
// threads, on interruptions, on the unit of length, on what was computed before.

#include "Check.h"
#include "InstructionSets.h"
#include "SurfaceMeasures.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace
{
struct Scene
{
  std::string Name;
  double Time;
  Motion Way;
};

Scene MakeScene(const char* name, double time, double attraction, double tension)
{
  Scene scene = { name, time, Motion() };
  scene.Way.Attraction = attraction;
  scene.Way.Tension = tension;
  return scene;
}

/** Every kind of motion and every part of a substep. */
std::vector<Scene> MakeScenes()
{
  std::vector<Scene> scenes = { MakeScene("tracking", 0.6, 1.0, 0.0),
    MakeScene("tracking under tension", 0.6, 1.0, 0.02),
    MakeScene("tension alone", 0.3, 0.0, 0.1) };
  Scene held = MakeScene("penalties", 0.3, 1.0, 0.05);
  held.Way.AreaControl = held.Way.VolumeControl = Control::Penalty;
  scenes.push_back(held);
  held = MakeScene("exact volume", 0.3, 1.0, 0.05);
  held.Way.VolumeControl = Control::Exact;
  scenes.push_back(held);
  held = MakeScene("exact area", 0.1, 0.0, 0.1);
  held.Way.AreaControl = Control::Exact;
  scenes.push_back(held);
  Scene other = MakeScene("at the nodes, central", 0.6, 1.0, 0.0);
  other.Way.Evaluation = TargetEvaluation::Node;
  other.Way.Gradient = GradientScheme::Central;
  scenes.push_back(other);
  other = MakeScene("at the closest points", 0.3, 1.0, 0.0);
  other.Way.Evaluation = TargetEvaluation::ClosestPoint;
  scenes.push_back(other);
  other = MakeScene("the paper's", 0.3, 1.0, 0.02);
  other.Way.Paper = true;
  scenes.push_back(other);
  other = MakeScene("within walls", 0.6, 1.0, 0.02);
  other.Way.Box = { true, { -0.6, 0.6, -0.6, 0.6, -0.6, 0.6 } };
  scenes.push_back(other);
  return scenes;
}

const std::vector<Scene> Scenes = MakeScenes();

Shape MakeRing()
{
  return MakeTorus({ 0.01, 0.02, 0.013 }, 0.5, 0.22);
}

std::unique_ptr<NarrowBand> StartScene(int threads)
{
  auto band = std::make_unique<NarrowBand>(VoxelSizeOf(48));
  band->SetNumberOfThreads(threads);
  StartOn(*band, MakeSixMetaballs());
  return band;
}

std::unique_ptr<NarrowBand> RunScene(const Scene& scene, int threads)
{
  std::unique_ptr<NarrowBand> band = StartScene(threads);
  ShapeTarget target(MakeRing());
  band->Advance(scene.Time, scene.Way, target);
  return band;
}

bool AreSameMeshes(const Mesh& first, const Mesh& second)
{
  return first.Points == second.Points && first.Normals == second.Normals &&
    first.Corners == second.Corners;
}

void AnyNumberOfThreadsGivesTheSameBytes(Check& check)
{
  // On a machine with two cores too.
  const tbb::global_control fourThreads(tbb::global_control::max_allowed_parallelism, 4);
  for (const Scene& scene : Scenes)
  {
    const auto reference = RunScene(scene, 1);
    check.True(!reference->IsEmpty(), scene.Name + " leaves a surface to compare");
    for (const int threads : { 1, 2, 4 })
    {
      const auto band = RunScene(scene, threads);
      const std::string name = scene.Name + ", threads: " + std::to_string(threads);
      check.True(AreIdentical(*reference, *band), "the same potential, " + name);
      check.True(
        AreSameMeshes(Polygonise(*reference), Polygonise(*band)), "the same skin, " + name);
    }
  }
}

// The machine decides; where it lacks one, the best below it runs, and is compared with itself.
void AnyInstructionSetGivesTheSameBytes(Check& check)
{
  const InstructionSet usual = GetInstructionSet();
  for (const Scene& scene : Scenes)
  {
    SetInstructionSet(InstructionSet::Baseline);
    const auto reference = RunScene(scene, 2);
    for (const InstructionSet set : { InstructionSet::Avx2, InstructionSet::Avx512 })
    {
      const bool has = SetInstructionSet(set) == set;
      const auto band = RunScene(scene, 2);
      const std::string name = scene.Name + (set == InstructionSet::Avx2 ? ", AVX2" : ", AVX-512") +
        (has ? "" : " (not on this machine)");
      check.True(AreIdentical(*reference, *band), "the same potential, " + name);
      check.True(
        AreSameMeshes(Polygonise(*reference), Polygonise(*band)), "the same skin, " + name);
    }
  }
  SetInstructionSet(usual);
}

void RunningTwiceGivesTheSameBytes(Check& check)
{
  for (const Scene& scene : Scenes)
  {
    check.True(AreIdentical(*RunScene(scene, 0), *RunScene(scene, 0)), scene.Name);
  }
}

// Stopped before every substep and told to go on to the same time: the same substeps.
void InterruptionLeavesNoTrace(Check& check)
{
  for (const Scene& scene : Scenes)
  {
    const auto reference = RunScene(scene, 2);
    const auto band = StartScene(2);
    ShapeTarget target(MakeRing());
    bool more = true;
    int calls = 0;
    while (more && calls < 10000)
    {
      bool first = true;
      const ProgressFunction once = [&first](double) { return std::exchange(first, false); };
      more = band->Advance(scene.Time, scene.Way, target, once).Aborted;
      ++calls;
    }
    check.Less(3.0, calls, scene.Name + ", number of interruptions");
    check.Near(band->GetTime(), scene.Time, 0.0, scene.Name + ", time reached");
    check.True(AreIdentical(*reference, *band), scene.Name + ", the same potential");
  }
}

// The same object, used for something else before.
void FormerUseLeavesNoTrace(Check& check)
{
  const auto reference = RunScene(Scenes[1], 2);
  const auto band = StartScene(2);
  ShapeTarget elsewhere(MakeBall({ -0.2, 0.1, 0.3 }, 0.8));
  band->Advance(2.0, Scenes[1].Way, elsewhere);
  StartOn(*band, MakeSixMetaballs());
  ShapeTarget target(MakeRing());
  band->Advance(Scenes[1].Time, Scenes[1].Way, target);
  check.True(AreIdentical(*reference, *band), "a second start gives the same potential");
}

void CloneIsABranch(Check& check)
{
  const Scene& scene = Scenes[1];
  const auto band = StartScene(2);
  ShapeTarget target(MakeRing());
  const double half = 0.5 * scene.Time;
  band->Advance(half, scene.Way, target);
  const auto unmoved = band->Clone();
  const auto branch = band->Clone();
  branch->Advance(scene.Time, scene.Way, target);
  check.True(AreIdentical(*unmoved, *band), "moving a clone leaves the original as it was");
  check.Near(band->GetTime(), half, 0.0, "time of the original");
  band->Advance(scene.Time, scene.Way, target);
  check.True(AreIdentical(*branch, *band), "a clone goes the way of the original");
  check.True(!AreIdentical(*unmoved, *band), "the comparison tells two times apart");
}

// Powers of two are exact in floating point: lengths by 2^10, tension [length^2/time] by 2^20; and
// by 2^-30 and 2^-60, as for a scene of some nanometres in metres.
void UnitOfLengthDoesNotMatter(Check& check)
{
  const auto run = [](double unit)
  {
    auto band = std::make_unique<NarrowBand>(VoxelSizeOf(32) * unit);
    const double box[6] = { -unit, unit, -unit, unit, -unit, unit };
    band->Start(0.0, box, MakeInitialFunction(Scale(MakeBall(CentreA, 0.6), unit)));
    Motion motion;
    motion.Tension = 0.02 * unit * unit;
    ShapeTarget target(Scale(MakeBall({ 0.1, 0.0, 0.0 }, 0.6), unit));
    band->Advance(2.5, motion, target);
    return band;
  };
  const auto reference = run(1.0);
  check.True(!reference->IsEmpty(), "there is a surface to compare");
  check.True(
    AreIdentical(*reference, *run(1024.0)), "the same potential in a box 1024 times as large");
  check.True(AreIdentical(*reference, *run(std::ldexp(1.0, -30))), "and in one of a nanometre");
}

using Reorder = std::function<openvdb::Coord(const openvdb::Coord&)>;

// Largest difference near the surface [voxels] between a potential and its image under a symmetry
// of the lattice.
double GetAsymmetry(const NarrowBand& band, const Reorder& reorder)
{
  const openvdb::FloatGrid::ConstPtr grid = band.GetPotential();
  const openvdb::FloatGrid::ConstAccessor potential = grid->getConstAccessor();
  double largest = 0.0;
  for (auto node = grid->cbeginValueOn(); node; ++node)
  {
    if (std::abs(*node) < 1.f)
    {
      const double other = potential.getValue(reorder(node.getCoord()));
      largest = std::max(largest, std::abs(*node - other));
    }
  }
  return largest;
}

// A ball at the origin is the same for all symmetries of the lattice, and so must be its potential.
// Sums of three axes are rounded in another order: 6e-8 * |u| <= 2.4e-7 (|u| < 4) per substep and
// node. Tension only averages, so that they add up at worst: 100 substeps give 2.4e-5.
void MirroredAndTurnedBallsAreTheSame(Check& check)
{
  const double h = VoxelSizeOf(32);
  NarrowBand band(h);
  StartOn(band, MakeBall({ 0.0, 0.0, 0.0 }, 0.6));
  Motion motion;
  motion.Attraction = 0.0;
  motion.Tension = 1.0;
  motion.CFL = 0.8;
  ShapeTarget none(MakeConstant(0.0));
  const AdvanceReport report = band.Advance(60 * 0.2 * h * h, motion, none);
  check.True(!band.IsEmpty(), "there is a surface to compare");
  check.Less(double(report.Substeps), 100.0, "number of substeps");
  using openvdb::Coord;
  const double mirrored = GetAsymmetry(band, [](Coord c) { return Coord(-c[0], c[1], c[2]); });
  const double swapped = GetAsymmetry(band, [](Coord c) { return Coord(c[1], c[0], c[2]); });
  const double turned = GetAsymmetry(band, [](Coord c) { return Coord(c[1], c[2], c[0]); });
  check.Less(mirrored, 2.4e-5, "difference to the mirror image [h]");
  check.Less(swapped, 2.4e-5, "difference to the image with x and y swapped [h]");
  check.Less(turned, 2.4e-5, "difference to the image with x, y, z permuted [h]");
}
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "AnyNumberOfThreadsGivesTheSameBytes", AnyNumberOfThreadsGivesTheSameBytes },
      { "AnyInstructionSetGivesTheSameBytes", AnyInstructionSetGivesTheSameBytes },
      { "RunningTwiceGivesTheSameBytes", RunningTwiceGivesTheSameBytes },
      { "InterruptionLeavesNoTrace", InterruptionLeavesNoTrace },
      { "FormerUseLeavesNoTrace", FormerUseLeavesNoTrace }, { "CloneIsABranch", CloneIsABranch },
      { "UnitOfLengthDoesNotMatter", UnitOfLengthDoesNotMatter },
      { "MirroredAndTurnedBallsAreTheSame", MirroredAndTurnedBallsAreTheSame } });
}
