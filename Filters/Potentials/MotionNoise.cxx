#include "MotionNoise.h"

#include "ParallelTasks.h"
#include "ParticleModel.h"
#include "Skeleton/NeighbourSums.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// A mean whose square is less than so many times that of its standard error is noise: of random
// velocities that holds for all but one in 2000.
constexpr double NoiseOfError = 6.0;
constexpr std::size_t ParticlesPerTask = 256;

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

}

std::vector<double> FindSharesOfMotion(const std::vector<SkeletonVertex>& particles,
  const ParticleFits& fits, const std::vector<double>& velocities, Agreement* ranks)
{
  const NeighbourSums neighbours(particles, 1.0);
  const UnsetVector<BallCells::Index>& order = neighbours.GetOrder();
  UnsetVector<NeighbourSums::Moving> moving(order.size());
  RunEach(order.size(),
    [&](std::size_t k)
    {
      const double* v = &velocities[3 * std::size_t(order[k])];
      moving[k] = { { v[0], v[1], v[2] }, fits[order[k]].Bulk };
    });
  std::vector<double> shares(particles.size(), 1.0);
  const auto find = [&](std::size_t first, std::size_t end)
  {
    const std::size_t count = end - first;
    const std::vector<double> places = neighbours.ListPlaces(first, count);
    std::vector<NeighbourSums::Motion> motions(count);
    neighbours.FindMotions(count, places.data(), moving, motions.data());
    for (std::size_t k = 0; k < count; ++k)
    {
      shares[order[first + k]] = motions[k].Weight > 0.0 ? GetShare(motions[k]) : 1.0;
    }
  };
  SharePieces(ranks, order.size(), ParticlesPerTask, find,
    [&](std::size_t k, auto& pass) { pass(&shares[order[k]], 1); });
  return shares;
}

}
