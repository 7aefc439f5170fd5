// Particles that are born and die between two steps: the potential equals the formula, and is
// continuous in time. TestDroplet and TestLevelOfDetail test the response of the skin.

#include "Support/SkeletonShapes.h"

#include "Targets/NoShape.h"
#include "Targets/ParticleShape.h"
#include "Targets/ParticleTarget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestBirths
{

namespace
{

constexpr double Threshold = 0.5;

// The slope of Wyvill's kernel, 6 q (1 - q^2)^2, is largest at q = 1 / sqrt(5).
constexpr double SteepestKernel = 1.7173;

struct Numbered
{
  SkeletonVertex Vertex;
  int Id;
};

std::shared_ptr<InputShape> MakeFrame(const std::vector<Numbered>& cloud, bool hasIds = true)
{
  if (cloud.empty())
  {
    return std::make_shared<NoShape>();
  }
  ParticleFrame particles;
  particles.HasIds = hasIds;
  particles.HasRadii = true;
  for (const Numbered& particle : cloud)
  {
    particles.Ids.push_back(hasIds ? particle.Id : particles.Ids.size());
    particles.Particles.Add(particle.Vertex);
  }
  return std::make_shared<ParticleShape>(std::move(particles));
}

// Two frames, the steps 0 and 1, and the particles between them as a target.
struct Way
{
  Way(std::shared_ptr<InputShape> earlier, std::shared_ptr<InputShape> later)
  {
    this->Frames.Add(0, std::move(earlier));
    this->Frames.Add(1, std::move(later));
    this->Target.MoveAlong(0, 0.0, 1.0);
  }

  std::vector<SkeletonVertex> PlaceAt(double fraction)
  {
    std::vector<SkeletonVertex> particles;
    std::vector<ParticleOrigin> origins;
    this->Frames.GetTrack(0, {}, fraction).List(particles, origins);
    return particles;
  }

  double ValueAt(const Point& x) const
  {
    double value;
    double slope;
    this->Target.Evaluate(1, x.data(), { &value, &slope });
    return value;
  }

  TargetFrames Frames;
  static TargetOptions MakeOptions()
  {
    TargetOptions options;
    options.Threshold = Threshold;
    options.Normalize = false;
    return options;
  }
  ParticleTarget Target{ this->Frames, MakeOptions() };
};

// Adds particles to a reference shape, with their strengths multiplied by `share`.
void AddTo(SkeletonBuilder& shape, const std::vector<SkeletonVertex>& particles, double share = 1.0)
{
  for (const SkeletonVertex& p : particles)
  {
    shape.Add({ p.Position[0], p.Position[1], p.Position[2] }, p.Radius, share * p.Strength);
  }
}

SkeletonVertex HalfWay(const SkeletonVertex& a, const SkeletonVertex& b, double f)
{
  SkeletonVertex between = a;
  for (int axis = 0; axis < 3; ++axis)
  {
    between.Position[axis] = (1.0 - f) * a.Position[axis] + f * b.Position[axis];
  }
  between.Radius = (1.0 - f) * a.Radius + f * b.Radius;
  between.Strength = (1.0 - f) * a.Strength + f * b.Strength;
  return between;
}

std::vector<Numbered> MakeCloud(Random& random, int count, int firstId, double radius = 0.4)
{
  std::vector<Numbered> cloud;
  for (int i = 0; i < count; ++i)
  {
    const Point p = random.In(-0.5, 0.5);
    cloud.push_back(
      { { { p[0], p[1], p[2] }, radius * random.Between(1.0, 1.5), random.Between(0.5, 1.0) },
        firstId + i });
  }
  return cloud;
}

std::vector<SkeletonVertex> GetVertices(const std::vector<Numbered>& cloud)
{
  std::vector<SkeletonVertex> vertices;
  for (const Numbered& particle : cloud)
  {
    vertices.push_back(particle.Vertex);
  }
  return vertices;
}

// Tolerance 1e-12: terms of size 1 are added in another order, at positions that are rounded in
// another way.
void IsThePotential(Way& way, double fraction, SkeletonBuilder& byHand, const std::string& name)
{
  vtkNew<vtkSkeletonPotential> potential;
  byHand.GiveTo(potential);
  potential->SetThreshold(Threshold);
  way.Target.MoveTo(fraction);
  Random random(7);
  double largest = 0.0;
  for (int i = 0; i < 200; ++i)
  {
    const Point x = random.In(-0.8, 0.8);
    const double expected = ValueAt(potential, x);
    largest =
      std::max(largest, std::fabs(way.ValueAt(x) - expected) / std::max(1.0, std::fabs(expected)));
  }
  EXPECT_NEAR(largest, 0.0, 1e-12) << name << " at " << fraction;
}

constexpr double Fractions[] = { 0.0, 0.25, 0.5, 0.875, 1.0 };

// Checks that all particles of the earlier set die and all of the later set are born.
void IsACrossFade(Way& way, const std::vector<Numbered>& earlier,
  const std::vector<Numbered>& later, const std::string& name)
{
  for (const double f : Fractions)
  {
    SkeletonBuilder byHand;
    AddTo(byHand, GetVertices(earlier), 1.0 - f);
    AddTo(byHand, GetVertices(later), f);
    IsThePotential(way, f, byHand, name);
  }
}

bool AreSame(const SkeletonVertex& a, const SkeletonVertex& b)
{
  return a.Position[0] == b.Position[0] && a.Position[1] == b.Position[1] &&
    a.Position[2] == b.Position[2] && a.Radius == b.Radius && a.Strength == b.Strength;
}

bool AreSame(const std::vector<SkeletonVertex>& a, const std::vector<SkeletonVertex>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const SkeletonVertex& one, const SkeletonVertex& other) { return AreSame(one, other); });
}

}

TEST(TestBirths, PotentialIsTheFormula)
{
  Random random(1);
  std::vector<Numbered> earlier = MakeCloud(random, 12, 0);
  const std::vector<Numbered> moved = MakeCloud(random, 12, 0);
  const std::vector<Numbered> births = MakeCloud(random, 5, 100);
  std::vector<Numbered> later(births.begin(), births.end());
  later.insert(later.begin() + 2, moved.rbegin(), moved.rbegin() + 8); // the ids 11 to 4
  Way way(MakeFrame(earlier), MakeFrame(later));
  for (const double f : Fractions)
  {
    SkeletonBuilder byHand;
    for (int i = 4; i < 12; ++i)
    {
      AddTo(byHand, { HalfWay(earlier[i].Vertex, moved[i].Vertex, f) });
    }
    AddTo(byHand, GetVertices({ earlier.begin(), earlier.begin() + 4 }), 1.0 - f);
    AddTo(byHand, GetVertices(births), f);
    IsThePotential(way, f, byHand, "four die, five are born");
  }
}

TEST(TestBirths, ParticlesComeInTheirOrder)
{
  Random random(2);
  const std::vector<Numbered> old = MakeCloud(random, 3, 0);  // 0 1 2
  const std::vector<Numbered> born = MakeCloud(random, 2, 9); // 9 10
  const std::vector<Numbered> later = { born[1], old[2], born[0], old[0] };
  Way way(MakeFrame(old), MakeFrame(later));
  EXPECT_TRUE(AreSame(way.PlaceAt(0.0), GetVertices(old))) << "at 0 the earlier step, to the bit";
  std::vector<SkeletonVertex> expected = GetVertices({ old[0], old[1], old[2], born[1], born[0] });
  for (int i = 1; i < 5; i += i == 1 ? 2 : 1)
  {
    expected[i].Strength *= 0.5;
  }
  EXPECT_TRUE(AreSame(way.PlaceAt(0.5), expected)) << "half way the births come last";
  expected = GetVertices({ old[0], old[2], born[1], born[0] });
  EXPECT_TRUE(AreSame(way.PlaceAt(1.0), expected)) << "at 1 the dead are no more";
}

TEST(TestBirths, EqualIdsAreMatchedInTheirOrder)
{
  Random random(3);
  std::vector<Numbered> earlier = MakeCloud(random, 3, 0);
  std::vector<Numbered> later = MakeCloud(random, 2, 0);
  for (std::vector<Numbered>* cloud : { &earlier, &later })
  {
    for (Numbered& particle : *cloud)
    {
      particle.Id = 4;
    }
  }
  Way way(MakeFrame(earlier), MakeFrame(later));
  SkeletonBuilder byHand;
  AddTo(byHand, { HalfWay(earlier[0].Vertex, later[0].Vertex, 0.5) });
  AddTo(byHand, { HalfWay(earlier[1].Vertex, later[1].Vertex, 0.5) });
  AddTo(byHand, { earlier[2].Vertex }, 0.5);
  IsThePotential(way, 0.5, byHand, "the third one dies");
}

TEST(TestBirths, UnlikeSetsAreCrossFaded)
{
  Random random(4);
  const std::vector<Numbered> fine = MakeCloud(random, 400, 0, 0.1);
  const std::vector<Numbered> coarse = MakeCloud(random, 50, 1000, 0.2);
  const std::vector<Numbered> few = MakeCloud(random, 49, 0, 0.2);
  Way byIds(MakeFrame(fine), MakeFrame(coarse));
  IsACrossFade(byIds, fine, coarse, "another level of detail");
  Way byCount(MakeFrame(fine, false), MakeFrame(coarse, false));
  IsACrossFade(byCount, fine, coarse, "other counts without ids");
  Way oneLess(MakeFrame(coarse, false), MakeFrame(few, false));
  IsACrossFade(oneLess, coarse, few, "one less, without ids");
  Way mixed(MakeFrame(few), MakeFrame(coarse, false));
  IsACrossFade(mixed, few, coarse, "ids in one step only");
}

TEST(TestBirths, EqualCountsWithoutIdsAreMatched)
{
  Random random(5);
  const std::vector<Numbered> earlier = MakeCloud(random, 6, 0);
  const std::vector<Numbered> later = MakeCloud(random, 6, 100);
  Way way(MakeFrame(earlier, false), MakeFrame(later, false));
  SkeletonBuilder byHand;
  for (int i = 0; i < 6; ++i)
  {
    AddTo(byHand, { HalfWay(earlier[i].Vertex, later[i].Vertex, 0.5) });
  }
  IsThePotential(way, 0.5, byHand, "by number");
}

TEST(TestBirths, EmptyStepsFadeEverything)
{
  Random random(6);
  const std::vector<Numbered> cloud = MakeCloud(random, 10, 0);
  for (const bool hasIds : { true, false })
  {
    Way dying(MakeFrame(cloud, hasIds), MakeFrame({}));
    IsACrossFade(dying, cloud, {}, "all die");
    Way beingBorn(MakeFrame({}), MakeFrame(cloud, hasIds));
    IsACrossFade(beingBorn, {}, cloud, "all are born");
  }
  Way nothing(MakeFrame({}), MakeFrame({}));
  IsACrossFade(nothing, {}, {}, "nothing at all");
}

// Across the step F changes by at most the rates of its terms times the time. A particle has a
// strength up to 1 and a radius of at least 0.4. Within a step the particle moves by up to sqrt(3),
// and grows by up to 0.2.
TEST(TestBirths, PotentialIsContinuousAcrossSteps)
{
  constexpr double small = 1e-6;
  Random random(8);
  const std::vector<Numbered> first = MakeCloud(random, 10, 0);
  const std::vector<Numbered> second = MakeCloud(random, 10, 5);
  const std::vector<Numbered> third = MakeCloud(random, 4, 12);
  Way before(MakeFrame(first), MakeFrame(second));
  Way after(MakeFrame(second), MakeFrame(third));
  before.Target.MoveTo(1.0 - small);
  after.Target.MoveTo(small);
  const double rate = 15.0 * (1.0 + SteepestKernel * (std::sqrt(3.0) + 0.2) / 0.4);
  double largest = 0.0;
  for (int i = 0; i < 500; ++i)
  {
    const Point x = random.In(-0.8, 0.8);
    largest = std::max(largest, std::fabs(before.ValueAt(x) - after.ValueAt(x)));
  }
  EXPECT_LT(largest, 2.0 * small * rate) << "change across the step";
  EXPECT_LT(1e-3 * small, largest) << "it does change";
}

// 1 + (1e-17 - 1) is 0: a support of size 0.
TEST(TestBirths, RadiusStaysPositive)
{
  const Numbered large = { { { 0.0, 0.0, 0.0 }, 1.0, 1.0 }, 0 };
  Numbered small = large;
  small.Vertex.Radius = 1e-17;
  Way way(MakeFrame({ large }), MakeFrame({ small }));
  EXPECT_GT(way.PlaceAt(1.0)[0].Radius, 0.0) << "radius at the end";
  way.Target.MoveTo(1.0);
  EXPECT_NEAR(way.ValueAt({ 0.0, 0.0, 0.0 }), Threshold - 1.0, 1e-12) << "value at the centre";
}

}
