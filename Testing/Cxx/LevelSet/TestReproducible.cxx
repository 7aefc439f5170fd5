// The potential is bitwise identical for the same times and motion. The number of threads,
// interruptions, the unit of length and earlier computations have no effect.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"

#include "Base/InstructionSets.h"
#include "NarrowBandGrid.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestReproducible
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

std::vector<Scene> MakeScenes()
{
  std::vector<Scene> scenes = { MakeScene("tracking", 0.6, 1.0, 0.0),
    MakeScene("tracking under tension", 0.6, 1.0, 0.02), MakeScene("only tension", 0.3, 0.0, 0.1) };
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

struct Course
{
  Shape Start;
  Shape End;
};

std::unique_ptr<NarrowBand> StartScene(int threads, const Shape& start)
{
  auto band = std::make_unique<NarrowBand>(VoxelSizeOf(48));
  band->SetNumberOfThreads(threads);
  StartOn(*band, start);
  return band;
}

std::unique_ptr<NarrowBand> RunScene(const Scene& scene, int threads, const Course& course)
{
  std::unique_ptr<NarrowBand> band = StartScene(threads, course.Start);
  ShapeTarget target(course.End);
  band->Advance(scene.Time, scene.Way, target);
  return band;
}

bool AreSameMeshes(const Mesh& first, const Mesh& second)
{
  return first.Points == second.Points && first.Normals == second.Normals &&
    first.Corners == second.Corners;
}

void CheckThreads(const Course& course)
{
  // Four threads are used on machines with two cores too.
  const tbb::global_control fourThreads(tbb::global_control::max_allowed_parallelism, 4);
  for (const Scene& scene : Scenes)
  {
    const auto reference = RunScene(scene, 1, course);
    EXPECT_TRUE(!reference->IsEmpty()) << scene.Name << " leaves a surface to compare";
    for (const int threads : { 1, 2, 4 })
    {
      const auto band = RunScene(scene, threads, course);
      const std::string name = scene.Name + ", threads: " + std::to_string(threads);
      EXPECT_TRUE(AreIdentical(*reference, *band)) << "the same potential, " << name;
      EXPECT_TRUE(AreSameMeshes(Polygonise(*reference), Polygonise(*band)))
        << "the same skin, " << name;
    }
  }
}

TEST(TestReproducible, AnyNumberOfThreadsGivesTheSameBytes)
{
  CheckThreads({ MakeSixMetaballs(), MakeRing() });
}

TEST(TestReproducible, AnyNumberOfThreadsGivesTheSameBytesAtRandom)
{
  RandomShapes random(14);
  const Shape metaballs = Scale(MakeSixMetaballs(), random.DrawLengthNear(1.0));
  const Shape start = Move(metaballs, random.DrawPointNear({ 0.0, 0.0, 0.0 }));
  const Point centre = random.DrawPointNear({ 0.01, 0.02, 0.013 });
  const double ring = random.DrawLengthNear(0.5);
  const Shape torus = MakeTorus(centre, ring, random.DrawLengthNear(0.22));
  CheckThreads({ start, torus });
}

// A processor without an instruction set uses the best set below; this set is then compared with
// itself.
TEST(TestReproducible, AnyInstructionSetGivesTheSameBytes)
{
  const InstructionSet usual = GetInstructionSet();
  for (const Scene& scene : Scenes)
  {
    SetInstructionSet(InstructionSet::Baseline);
    const auto reference = RunScene(scene, 2, { MakeSixMetaballs(), MakeRing() });
    for (const InstructionSet set : { InstructionSet::Avx2, InstructionSet::Avx512 })
    {
      const bool has = SetInstructionSet(set) == set;
      const auto band = RunScene(scene, 2, { MakeSixMetaballs(), MakeRing() });
      const std::string name = scene.Name + (set == InstructionSet::Avx2 ? ", AVX2" : ", AVX-512") +
        (has ? "" : " (not on this machine)");
      EXPECT_TRUE(AreIdentical(*reference, *band)) << "the same potential, " << name;
      EXPECT_TRUE(AreSameMeshes(Polygonise(*reference), Polygonise(*band)))
        << "the same skin, " << name;
    }
  }
  SetInstructionSet(usual);
}

TEST(TestReproducible, RunningTwiceGivesTheSameBytes)
{
  for (const Scene& scene : Scenes)
  {
    const Course course = { MakeSixMetaballs(), MakeRing() };
    EXPECT_TRUE(AreIdentical(*RunScene(scene, 0, course), *RunScene(scene, 0, course)))
      << scene.Name;
  }
}

// Each update is aborted after one substep and resumed to the same time: the substeps are the same.
TEST(TestReproducible, InterruptionLeavesNoTrace)
{
  for (const Scene& scene : Scenes)
  {
    const auto reference = RunScene(scene, 2, { MakeSixMetaballs(), MakeRing() });
    const auto band = StartScene(2, MakeSixMetaballs());
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
    EXPECT_GT(calls, 3.0) << scene.Name << ", number of interruptions";
    EXPECT_EQ(band->GetTime(), scene.Time) << scene.Name << ", time reached";
    EXPECT_TRUE(AreIdentical(*reference, *band)) << scene.Name << ", the same potential";
  }
}

TEST(TestReproducible, FormerUseLeavesNoTrace)
{
  const auto reference = RunScene(Scenes[1], 2, { MakeSixMetaballs(), MakeRing() });
  const auto band = StartScene(2, MakeSixMetaballs());
  ShapeTarget elsewhere(MakeBall({ -0.2, 0.1, 0.3 }, 0.8));
  band->Advance(2.0, Scenes[1].Way, elsewhere);
  StartOn(*band, MakeSixMetaballs());
  ShapeTarget target(MakeRing());
  band->Advance(Scenes[1].Time, Scenes[1].Way, target);
  EXPECT_TRUE(AreIdentical(*reference, *band)) << "a second start gives the same potential";
}

TEST(TestReproducible, CloneIsABranch)
{
  const Scene& scene = Scenes[1];
  const auto band = StartScene(2, MakeSixMetaballs());
  ShapeTarget target(MakeRing());
  const double half = 0.5 * scene.Time;
  band->Advance(half, scene.Way, target);
  const auto unmoved = band->Clone();
  const auto branch = band->Clone();
  branch->Advance(scene.Time, scene.Way, target);
  EXPECT_TRUE(AreIdentical(*unmoved, *band)) << "moving a clone leaves the original as it was";
  EXPECT_EQ(band->GetTime(), half) << "time of the original";
  band->Advance(scene.Time, scene.Way, target);
  EXPECT_TRUE(AreIdentical(*branch, *band)) << "a clone moves as the original does";
  EXPECT_FALSE(AreIdentical(*unmoved, *band)) << "the comparison detects another time";
}

// Powers of two are exact in floating point. Lengths are scaled by 2^10 and tension [length^2/time]
// by 2^20. The second case, 2^-30 and 2^-60, corresponds to a scene of some nanometres in metres.
void CheckUnits(const Ball& from, const Ball& to)
{
  const auto run = [&](double unit)
  {
    auto band = std::make_unique<NarrowBand>(VoxelSizeOf(32) * unit);
    const double box[6] = { -unit, unit, -unit, unit, -unit, unit };
    band->Start(0.0, box, MakeInitialFunction(Scale(MakeBall(from.Centre, from.Radius), unit)));
    Motion motion = MakeMotion(1.0, 0.0);
    motion.Tension = 0.02 * unit * unit;
    ShapeTarget target(Scale(MakeBall(to.Centre, to.Radius), unit));
    band->Advance(2.5, motion, target);
    return band;
  };
  const auto reference = run(1.0);
  EXPECT_TRUE(!reference->IsEmpty()) << "there is a surface to compare";
  EXPECT_TRUE(AreIdentical(*reference, *run(1024.0)))
    << "the same potential in a box 1024 times as large";
  EXPECT_TRUE(AreIdentical(*reference, *run(std::ldexp(1.0, -30)))) << "and in one of a nanometre";
}

TEST(TestReproducible, UnitOfLengthDoesNotMatter)
{
  CheckUnits({ CentreA, 0.6 }, { { 0.1, 0.0, 0.0 }, 0.6 });
}

TEST(TestReproducible, UnitOfLengthDoesNotMatterAtRandom)
{
  RandomShapes random(141);
  for (int i = 0; i < 3; ++i)
  {
    const Ball from = random.DrawBallNear({ CentreA, 0.6 });
    CheckUnits(from, random.DrawBallNear({ { 0.1, 0.0, 0.0 }, 0.6 }));
  }
}

using openvdb::Coord;

// Symmetry of the lattice: axis a of the image is axis Axes[a] of the original, times Signs[a].
struct Symmetry
{
  const char* Name;
  int Axes[3];
  int Signs[3];
};

constexpr Symmetry Symmetries[] = { { "mirrored", { 0, 1, 2 }, { -1, 1, 1 } },
  { "with x and y swapped", { 1, 0, 2 }, { 1, 1, 1 } },
  { "with x, y, z permuted", { 1, 2, 0 }, { 1, 1, 1 } } };

template <class Triple>
Triple GetImage(const Triple& original, const Symmetry& symmetry)
{
  Triple image = original;
  for (int axis = 0; axis < 3; ++axis)
  {
    image[axis] = symmetry.Signs[axis] * original[symmetry.Axes[axis]];
  }
  return image;
}

// Largest difference near the surface [voxels] between the image of a potential and another
// potential.
double GetAsymmetry(const NarrowBand& band, const NarrowBand& other, const Symmetry& symmetry)
{
  const openvdb::FloatGrid::ConstPtr grid = GetPotential(band);
  const openvdb::FloatGrid::ConstPtr otherGrid = GetPotential(other);
  const openvdb::FloatGrid::ConstAccessor potential = otherGrid->getConstAccessor();
  double largest = 0.0;
  for (auto node = grid->cbeginValueOn(); node; ++node)
  {
    if (std::abs(*node) < 1.f)
    {
      const double image = potential.getValue(GetImage(node.getCoord(), symmetry));
      largest = std::max(largest, std::abs(*node - image));
    }
  }
  return largest;
}

std::unique_ptr<NarrowBand> Shrink(const Ball& ball)
{
  const double h = VoxelSizeOf(32);
  auto band = std::make_unique<NarrowBand>(h);
  StartOn(*band, MakeBall(ball.Centre, ball.Radius));
  Motion motion = MakeMotion(1.0, 0.0);
  motion.Attraction = 0.0;
  motion.Tension = 1.0;
  motion.CFL = 0.8;
  ShapeTarget none(MakeConstant(0.0));
  const AdvanceReport report = band->Advance(60 * 0.2 * h * h, motion, none);
  EXPECT_TRUE(!band->IsEmpty()) << "there is a surface to compare";
  EXPECT_LT(double(report.Substeps), 100.0) << "number of substeps";
  return band;
}

// Sums over three axes are rounded in another order: by 6e-8 |u| <= 2.4e-7 per substep. Tension
// only averages, so 100 substeps add up to at most 2.4e-5.
void CheckSymmetries(const Ball& ball)
{
  const auto band = Shrink(ball);
  for (const Symmetry& symmetry : Symmetries)
  {
    const auto image = Shrink({ GetImage(ball.Centre, symmetry), ball.Radius });
    EXPECT_LT(GetAsymmetry(*band, *image, symmetry), 2.4e-5)
      << "difference to the ball " << symmetry.Name << " [h]";
  }
}

TEST(TestReproducible, MirroredAndTurnedBallsAreTheSame)
{
  CheckSymmetries({ { 0.0, 0.0, 0.0 }, 0.6 });
}

TEST(TestReproducible, MirroredAndTurnedBallsAreTheSameAtRandom)
{
  RandomShapes random(142);
  CheckSymmetries(random.DrawBallNear({ CentreA, 0.6 }));
}
}
