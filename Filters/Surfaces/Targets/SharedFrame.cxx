#include "Targets/SharedFrame.h"

#include "NumberedValues.h"
#include "Ranks/PieceGather.h"
#include "Targets/ParticleNumbers.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

// What a rank has read.
struct FactsOfPiece
{
  std::size_t Points;
  std::size_t Particles;
  std::size_t Ignored;
  bool HasIds;
  bool HasRadii;
  bool HasVelocities;
};

// Where particles are that have their radii.
struct FactsOfPlaces
{
  double Bounds[6];
  double LargestRadius;
  double LargestRadiusOfActive;
};

// To the numbers that points have in the order of the ranks.
void CountFrom(std::size_t first, ParticleFrame& frame)
{
  for (vtkIdType& point : frame.Points)
  {
    point += static_cast<vtkIdType>(first);
  }
  if (!frame.HasIds)
  {
    frame.Ids.assign(frame.Points.begin(), frame.Points.end());
  }
}

// It has what this rank has read, of so many points.
void ShareFrame(Agreement& ranks, std::size_t points, ParticleFrame& frame)
{
  const FactsOfPiece own{ points, frame.Particles.size(), frame.Ignored, frame.HasIds,
    frame.HasRadii, frame.HasVelocities };
  const std::vector<FactsOfPiece> all = GatherValues(ranks, own);
  frame.Shared = std::make_shared<SharedParticles>(SharedParticles{ ranks });
  frame.Ignored = 0;
  std::size_t before = 0;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    before += rank < static_cast<std::size_t>(ranks.GetRank()) ? all[rank].Points : 0;
    frame.Shared->CountOfAll += all[rank].Particles;
    frame.Ignored += all[rank].Ignored;
    frame.HasIds = frame.HasIds || all[rank].HasIds;
    frame.HasRadii = frame.HasRadii || all[rank].HasRadii;
    frame.HasVelocities = frame.HasVelocities || all[rank].HasVelocities;
  }
  CountFrom(before, frame);
  frame.Shared->Numbers = FindParticleNumbers(ranks, frame);
}

void MoveHome(double ballPerRadius, ParticleFrame& frame)
{
  SharedParticles& shared = *frame.Shared;
  shared.Homes = std::make_shared<ParticleHomes>(shared.Ranks, frame.Particles, ballPerRadius);
  std::vector<int> homes;
  homes.reserve(frame.Particles.size());
  for (const SkeletonVertex& particle : frame.Particles)
  {
    homes.push_back(shared.Homes->FindHome(particle.Position));
  }
  const NumberedMove move(shared.Ranks, std::move(homes), shared.Numbers);
  frame.Particles = move.Bring(frame.Particles);
  frame.Ids = move.Bring(frame.Ids);
  if (frame.Passed)
  {
    frame.Points = move.Bring(frame.Points);
  }
  if (frame.HasVelocities)
  {
    frame.Velocities = move.Bring(frame.Velocities);
  }
  shared.Numbers = move.GetNumbers();
}

void FindPlaces(ParticleFrame& frame)
{
  SharedParticles& shared = *frame.Shared;
  FactsOfPlaces own{ {}, FindLargestRadius(frame.Particles),
    FindLargestRadiusOfActive(frame.Particles) };
  FindBoundsOf(frame.Particles, own.Bounds);
  FindBoundsOf({}, shared.Bounds);
  shared.LargestRadius = shared.LargestRadiusOfActive = 0.0;
  for (const FactsOfPlaces& facts : GatherValues(shared.Ranks, own))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      double* bounds = shared.Bounds + 2 * axis;
      bounds[0] = std::min(bounds[0], facts.Bounds[2 * axis]);
      bounds[1] = std::max(bounds[1], facts.Bounds[2 * axis + 1]);
    }
    shared.LargestRadius = std::max(shared.LargestRadius, facts.LargestRadius);
    shared.LargestRadiusOfActive =
      std::max(shared.LargestRadiusOfActive, facts.LargestRadiusOfActive);
  }
}

// What ranks have of numbered particles, numbers as of GatherLists: of all.
template <class Value>
std::vector<Value> GatherAll(
  Agreement& ranks, const std::vector<std::size_t>& numbers, const std::vector<Value>& own)
{
  const std::vector<Value> gathered = GatherLists(ranks, own);
  std::vector<Value> all(gathered.size());
  for (std::size_t i = 0; i < gathered.size(); ++i)
  {
    all[numbers[i]] = gathered[i];
  }
  return all;
}

}

ParticleFrame ReadSharedParticles(vtkPointSet* points, const PointArrays& arrays, Agreement& ranks)
{
  ParticleFrame frame = ReadWithPoints(points, arrays);
  ShareFrame(ranks, static_cast<std::size_t>(points->GetNumberOfPoints()), frame);
  if (!frame.Passed)
  {
    frame.Points = {};
  }
  return frame;
}

void BringHome(double ballPerRadius, ParticleFrame& frame)
{
  if (!frame.Shared->Homes)
  {
    MoveHome(ballPerRadius, frame);
  }
  FindPlaces(frame);
}

ParticleFrame GatherFrame(const ParticleFrame& frame)
{
  Agreement& ranks = frame.Shared->Ranks;
  const std::vector<std::size_t> numbers = GatherLists(ranks, frame.Shared->Numbers);
  ParticleFrame all;
  all.HasIds = frame.HasIds;
  all.HasRadii = frame.HasRadii;
  all.HasVelocities = frame.HasVelocities;
  all.Ignored = frame.Ignored;
  all.Particles = GatherAll(ranks, numbers, frame.Particles);
  all.Ids = GatherAll(ranks, numbers, frame.Ids);
  if (frame.HasVelocities)
  {
    all.Velocities = GatherAll(ranks, numbers, frame.Velocities);
  }
  if (frame.Passed)
  {
    all.Points = GatherAll(ranks, numbers, frame.Points);
    all.Passed = GatherPointData(ranks, frame.Passed, "The input of port 0");
  }
  return all;
}

}
