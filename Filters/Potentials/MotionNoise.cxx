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

class MotionOfNeighbours
{
public:
  MotionOfNeighbours(const std::vector<SkeletonVertex>& particles, const ParticleFits& fits,
    const std::vector<double>& velocities, double largestRadius)
    : Particles(particles)
    , Neighbours(particles, 1.0, largestRadius)
    , Moving(particles.size())
  {
    RunEach(this->Moving.size(),
      [&](std::size_t k)
      {
        const std::size_t i = this->GetOrder()[k];
        const double* v = &velocities[3 * i];
        this->Moving[k] = { { v[0], v[1], v[2] }, fits[i].Bulk };
      });
  }

  // Of the particles, by cells.
  const UnsetVector<BallCells::Index>& GetOrder() const { return this->Neighbours.GetOrder(); }

  void FindShares(const BallCells::Index* members, std::size_t count, double* shares) const
  {
    std::vector<double> places(3 * count);
    for (std::size_t k = 0; k < count; ++k)
    {
      std::copy_n(this->Particles[members[k]].Position, 3, &places[3 * k]);
    }
    std::vector<NeighbourSums::Motion> motions(count);
    this->Neighbours.FindMotions(count, places.data(), this->Moving, motions.data());
    for (std::size_t k = 0; k < count; ++k)
    {
      shares[members[k]] = motions[k].Weight > 0.0 ? GetShare(motions[k]) : 1.0;
    }
  }

private:
  const std::vector<SkeletonVertex>& Particles;
  const NeighbourSums Neighbours;
  UnsetVector<NeighbourSums::Moving> Moving; // in their order
};

}

std::vector<double> FindSharesOfMotion(const std::vector<SkeletonVertex>& particles,
  const ParticleFits& fits, const std::vector<double>& velocities, Agreement* ranks)
{
  const MotionOfNeighbours motion(particles, fits, velocities, 0.0);
  const UnsetVector<BallCells::Index>& order = motion.GetOrder();
  std::vector<double> shares(particles.size(), 1.0);
  SharePieces(
    ranks, order.size(), ParticlesPerTask,
    [&](std::size_t first, std::size_t end)
    { motion.FindShares(&order[first], end - first, shares.data()); },
    [&](std::size_t k, auto& pass) { pass(&shares[order[k]], 1); });
  return shares;
}

std::vector<double> FindSharesOfMotion(const std::vector<SkeletonVertex>& particles,
  const ParticleFits& fits, const std::vector<double>& velocities, const MovingPart& part)
{
  const MotionOfNeighbours motion(particles, fits, velocities, part.LargestRadius);
  std::vector<BallCells::Index> wanted;
  for (const BallCells::Index i : motion.GetOrder())
  {
    if (part.AreWanted[i])
    {
      wanted.push_back(i);
    }
  }
  std::vector<double> shares(particles.size(), 1.0);
  RunPieces(wanted.size(), ParticlesPerTask,
    [&](std::size_t first, std::size_t end)
    { motion.FindShares(&wanted[first], end - first, shares.data()); });
  return shares;
}

}
