// Particles on ranks: each keeps those that reach its own places, and there tells the same bytes as
// one process does.

#include "Support/ParticleClouds.h"
#include "Support/SkeletonShapes.h"
#include "Support/ThreadRanks.h"

#include "ParticleFit.h"
#include "Targets/ParticleShape.h"
#include "Targets/ParticleTarget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestNearParticles
{

namespace
{

// The box is shared by ranks in layers along x.
class Layers : public OwnPlaces
{
public:
  Layers(int rank, int size)
    : Rank(rank)
    , Size(size)
  {
  }

  int GetRank() const override { return this->Rank; }
  void FindRanks(const double bounds[6], std::vector<int>& ranks) const override
  {
    ranks.clear();
    for (int rank = this->FindRank(bounds[0]); rank <= this->FindRank(bounds[1]); ++rank)
    {
      ranks.push_back(rank);
    }
  }
  bool Has(const double x[3]) const override { return this->FindRank(x[0]) == this->Rank; }

private:
  int FindRank(double x) const
  {
    const double rank = std::floor(0.5 * (x + 1.0) * this->Size);
    return static_cast<int>(std::min(std::max(rank, 0.0), this->Size - 1.0));
  }

  const int Rank, Size;
};

struct Case
{
  std::string Name;
  ParticleModel Model;
  bool Moves;
  int Count = 3000;
  bool HasFits = true;

  double Spacing() const { return 0.1 * std::cbrt(3000.0 / this->Count); }
};

// A body, a few of which are born and die, of which all or a few move; of any radii.
ParticleFrame MakeFrame(const Case& wanted, int step, Agreement* ranks)
{
  Cloud cloud;
  Random random(7);
  for (int i = 0; i < wanted.Count; ++i)
  {
    const Point place = { random.Between(-0.9, 0.9), random.Between(-0.3, 0.3),
      random.Between(-0.3, 0.3) };
    const double size = random.Between(0.8, 1.4);
    const bool isMoved = wanted.Moves || i < 40;
    const double way = step > 0 && isMoved ? 0.3 * std::sin(3.0 * place[1] + i % 7) : 0.0;
    if (i % 50 == (step > 0 ? 1 : 2))
    {
      continue;
    }
    cloud.Add(place[0] + way, place[1], place[2] - 0.1 * way,
      size * GetReachPerSpacing(wanted.Model) * wanted.Spacing(), 1.0, i);
  }
  FitOptions fit;
  fit.Model = wanted.Model;
  ParticleFrame frame = ReadCloudHome(cloud, ranks, wanted.Model);
  if (wanted.HasFits)
  {
    frame.FindFits(fit);
  }
  return frame;
}

ShapeOptions MakeOptions(const Case& wanted, Agreement* ranks)
{
  ShapeOptions options;
  options.Model = wanted.Model;
  options.Carries = true;
  options.Level.Reach = 3.0 * wanted.Spacing();
  options.WeighsTension = options.OpensHollows = wanted.HasFits;
  options.Level.Noise = wanted.HasFits ? 0.1 * wanted.Spacing() : 0.0;
  options.Ranks = ranks;
  return options;
}

// What a target tells, at places and in boxes, while it moves.
struct Told
{
  std::vector<double> Numbers; // at all places, at each time
  std::vector<bool> Changes;   // of all boxes, at each time
  std::vector<std::size_t> Sources;
};

const double Times[] = { 0.0, 0.3, 0.300001, 0.7, 1.0 };
constexpr int CountOfPlaces = 400;

Told Ask(const Case& wanted, Agreement* ranks, const OwnPlaces* places)
{
  TargetFrames frames;
  for (const int step : { 0, 1 })
  {
    frames.Add(step, std::make_shared<ParticleShape>(MakeFrame(wanted, step, ranks)));
  }
  ParticleTarget target(frames, MakeOptions(wanted, ranks));
  target.MoveAlong(0, 0.0, 1.0);
  target.KeepNear(places);
  Told told;
  for (const double time : Times)
  {
    Random random(3);
    target.MoveTo(time);
    told.Sources.push_back(target.CountRegionSources());
    for (int n = 0; n < CountOfPlaces; ++n)
    {
      const Point x = { random.Between(-1.1, 1.1), random.Between(-0.5, 0.5),
        random.Between(-0.5, 0.5) };
      std::array<double, 2> numbers{};
      if (!places || places->Has(x.data()))
      {
        target.Evaluate(1, x.data(), { &numbers[0], &numbers[1] });
      }
      told.Numbers.insert(told.Numbers.end(), numbers.begin(), numbers.end());
      const double box[] = { x[0], x[0] + 0.05, x[1], x[1] + 0.05, x[2], x[2] + 0.05 };
      told.Changes.push_back(target.MayHaveChanged(box));
    }
  }
  return told;
}

bool AreSame(const double* a, const double* b)
{
  return std::memcmp(a, b, 2 * sizeof(double)) == 0;
}

void CheckOnRanks(const Case& wanted, int size)
{
  const std::string name = wanted.Name + ", " + std::to_string(size) + " ranks";
  const Told alone = Ask(wanted, nullptr, nullptr);
  std::vector<Told> ofRanks(static_cast<std::size_t>(size));
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      const Layers own(ranks.GetRank(), size);
      ofRanks[static_cast<std::size_t>(ranks.GetRank())] = Ask(wanted, &ranks, &own);
    });
  std::size_t told = 0, different = 0;
  const double nothing[2] = {};
  for (const Told& rank : ofRanks)
  {
    for (std::size_t n = 0; n < alone.Numbers.size(); n += 2)
    {
      const bool isTold = !AreSame(&rank.Numbers[n], nothing);
      told += isTold;
      different += isTold && !AreSame(&rank.Numbers[n], &alone.Numbers[n]);
    }
    EXPECT_EQ(rank.Changes, alone.Changes) << "where something has changed, " << name;
    EXPECT_LT(rank.Sources[1], alone.Sources[1]) << "particles, " << name;
    EXPECT_GT(rank.Sources[1], 0u) << "particles, " << name;
  }
  EXPECT_EQ(told, std::size(Times) * CountOfPlaces) << "each place is one rank's, " << name;
  EXPECT_EQ(different, 0u) << "values and slopes, " << name;
}

}

TEST(TestNearParticles, RanksTellTheSameBytesAtTheirOwnPlaces)
{
  for (const int size : { 2, 3 })
  {
    for (const bool moves : { true, false })
    {
      const std::string all = moves ? ", all move" : ", some move";
      CheckOnRanks({ "sum" + all, ParticleModel::Sum, moves }, size);
      CheckOnRanks({ "averaged centres" + all, ParticleModel::AveragedCentre, moves }, size);
      CheckOnRanks({ "anisotropic" + all, ParticleModel::Anisotropic, moves }, size);
    }
  }
}

// More than are told in a round of messages.
TEST(TestNearParticles, ManyAreToldInRounds)
{
  CheckOnRanks({ "many without fits", ParticleModel::Sum, true, 40000, false }, 2);
  CheckOnRanks({ "many", ParticleModel::Sum, true, 40000, true }, 2);
}

// At the start each tells the regions of the particles at home, and all together all of them.
TEST(TestNearParticles, RegionsOfAllRanksAreThoseOfTheWhole)
{
  const Case wanted{ "anisotropic", ParticleModel::Anisotropic, true };
  const auto listRegions = [&](Agreement* ranks)
  {
    TargetFrames frames;
    frames.Add(0, std::make_shared<ParticleShape>(MakeFrame(wanted, 0, ranks)));
    ParticleTarget target(frames, MakeOptions(wanted, ranks));
    target.KeepRegions();
    target.MoveAlong(0, 0.0, 0.0);
    target.MoveTo(0.0);
    std::vector<std::array<double, 7>> regions;
    target.ForEachRegion(
      [&](const TargetRegion& region)
      {
        regions.push_back({ double(static_cast<int>(region.Seeds)) });
        std::copy_n(region.Bounds, 6, regions.back().begin() + 1);
      });
    return regions;
  };
  auto alone = listRegions(nullptr);
  std::sort(alone.begin(), alone.end());
  RunOnRanks(3,
    [&](Agreement& ranks)
    {
      const auto own = listRegions(&ranks);
      EXPECT_LT(own.size(), alone.size() / 2) << "those at home";
      auto all = GatherLists(ranks, own);
      std::sort(all.begin(), all.end());
      EXPECT_EQ(all, alone);
    });
}

// Between two updates it is asked anywhere again.
TEST(TestNearParticles, WhatIsForgottenComesBack)
{
  const Case wanted{ "anisotropic", ParticleModel::Anisotropic, true };
  RunOnRanks(2,
    [&](Agreement& ranks)
    {
      TargetFrames frames;
      for (const int step : { 0, 1 })
      {
        frames.Add(step, std::make_shared<ParticleShape>(MakeFrame(wanted, step, &ranks)));
      }
      ParticleTarget target(frames, MakeOptions(wanted, &ranks));
      target.MoveAlong(0, 0.0, 1.0);
      target.MoveTo(0.5);
      const std::size_t all = target.CountRegionSources();
      const Layers own(ranks.GetRank(), 2);
      target.KeepNear(&own);
      target.MoveTo(0.5);
      EXPECT_LT(target.CountRegionSources(), all);
      target.KeepNear(nullptr);
      target.MoveTo(0.5);
      EXPECT_EQ(target.CountRegionSources(), all);
    });
}

}
