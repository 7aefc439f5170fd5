#include "MotionNoise.h"

#include "ParallelTasks.h"
#include "Skeleton/NeighbourSums.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

// A mean whose square is less than so many times that of its standard error is noise: of random
// velocities that holds for all but one in 2000.
constexpr double NoiseOfError = 6.0;
double GetShare(const NeighbourSums::Motion& motion)
{
  double square = 0.0;
  for (const double sum : motion.Velocity)
  {
    square += (sum / motion.Weight) * (sum / motion.Weight);
  }
  const double spread = std::max(motion.Square / motion.Weight - square, 0.0);
  const double error = spread * motion.SquareOfWeights / (motion.Weight * motion.Weight);
  const double noise = square > 0.0 ? std::min(NoiseOfError * error / square, 1.0) : 0.0;
  return 1.0 - GetShareOfNoise(motion.Bulk / motion.Weight) * noise;
}

// Of all that are near; fits and velocities: of those at home.
std::vector<NeighbourSums::Moving> GatherMoving(
  const LocalParticles& near, const ParticleFits& fits, const std::vector<double>& velocities)
{
  using Moving = NeighbourSums::Moving;
  const std::vector<std::size_t> home = near.ListAtHome();
  const auto boxOf = [&](std::size_t n)
  { return near.GetBall(home[n], MotionNeighbourhoodPerRadius); };
  const auto motionOf = [&](std::size_t n)
  {
    const double* v = &velocities[3 * n];
    return Moving{ { v[0], v[1], v[2] }, fits[n].Bulk };
  };
  std::vector<Moving> moving;
  moving.reserve(near.Get().size());
  for (const auto& told : near.Gather<Moving>(home, boxOf, motionOf))
  {
    moving.push_back(told.What);
  }
  return moving;
}

}

std::vector<double> FindSharesOfMotion(
  const LocalParticles& near, const ParticleFits& fits, const std::vector<double>& velocities)
{
  const std::vector<NeighbourSums::Moving> all = GatherMoving(near, fits, velocities);
  const NeighbourSums neighbours(near.Get(), MotionNeighbourhoodPerRadius, near.GetLargestRadius());
  const UnsetVector<BallCells::Index>& order = neighbours.GetOrder();
  UnsetVector<NeighbourSums::Moving> moving(order.size());
  RunEach(order.size(), [&](std::size_t k) { moving[k] = all[order[k]]; });
  std::vector<double> shares(order.size());
  const std::vector<std::size_t> wanted = near.ListAtHome(order);
  RunPieces(wanted.size(), ParticlesPerTask,
    [&](std::size_t first, std::size_t end)
    {
      const std::size_t count = end - first;
      const std::vector<double> places = near.ListPositions(&wanted[first], count);
      std::vector<NeighbourSums::Motion> motions(count);
      neighbours.FindMotions(count, places.data(), moving, motions.data());
      for (std::size_t k = 0; k < count; ++k)
      {
        shares[wanted[first + k]] = motions[k].Weight > 0.0 ? GetShare(motions[k]) : 1.0;
      }
    });
  return near.TakeHome(std::move(shares));
}

}
