#include "ParticlePotential.h"

#include "Index/ParallelTasks.h"
#include "Index/PointGroups.h"

#include "vtkBoundingBox.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Node indices are 32-bit integers.
constexpr double Farthest = 1e9;

class ParticlesAtRest final : public NodeParticles
{
public:
  explicit ParticlesAtRest(const std::vector<SkeletonVertex>& particles)
    : Particles(particles)
  {
  }

  std::size_t Size() const override { return this->Particles.size(); }
  SkeletonVertex Get(std::size_t n) const override { return this->Particles[n]; }
  bool FindVelocity(std::size_t, double (&)[3]) const override { return false; }

private:
  const std::vector<SkeletonVertex>& Particles;
};

}

void ParticlePotential::Build(
  const std::vector<SkeletonVertex>& particles, NodeParticleOptions options)
{
  const std::size_t count = particles.size();
  const double least = -FindMost(count, -HUGE_VAL,
    [&](std::size_t n)
    {
      return -(
        options.OwnRadius > 0.0 ? options.OwnRadius : particles[n].Radius / options.ReachPerRadius);
    });
  this->Unit = count > 0 ? least : 1.0;
  const double farthest = FindMost(count, 0.0,
    [&](std::size_t n)
    {
      const double* x = particles[n].Position;
      return std::max({ std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2]) });
    });
  if (!(farthest < Farthest * this->Unit))
  {
    throw std::invalid_argument(
      "A particle is farther from the origin than 10^9 times the smallest particle radius, too far "
      "for the lattice (in a filter, the origin is near the first time step's particles, or near "
      "ModelBounds, if set); move the particles nearer, remove those far from all others, or check "
      "ParticleSpacing and the radii.");
  }
  options.VoxelSize = this->Unit;
  options.WantsBulks = true;
  options.AreForPoints = true;
  this->Nodes.Build(ParticlesAtRest(particles), options);
  const UnsetVector<std::uint32_t>& order = this->Nodes.GetBlocks().GetOrder();
  this->Places.resize(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    this->Places[order[k]] = static_cast<std::uint32_t>(k);
  }
}

// A batch of points and their results.
class ParticlePotential::Batch
{
public:
  Batch(const ParticlePotential& potential, const double* points, double* values, double* gradients)
    : Potential(potential)
    , Blocks(potential.Nodes.GetBlocks())
    , Points(points)
    , Values(values)
    , Gradients(gradients)
  {
  }

  // Evaluates groups of points in one part of a block. Positions are relative to the block, so that
  // a sum does not depend on the other points.
  void Evaluate(std::size_t count) const
  {
    const PointGroups groups(
      count, [this](std::size_t i, NodeIndex& part) { return this->FindPart(i, part); });
    groups.ForEach(
      [this](const NodeIndex& part, const std::size_t* members, int size) {
        this->EvaluateGroup({ part[0] >> 2, part[1] >> 2, part[2] >> 2 }, members, size);
      });
  }

private:
  // Returns false, after writing the value, if the point is not finite, a coordinate is beyond
  // Farthest units, or there are no particles.
  bool FindPart(std::size_t i, NodeIndex& part) const
  {
    const double* x = this->Points + 3 * i;
    const double farthest = std::max({ std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2]) });
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      this->Write(i, none, none, none, none);
      return false;
    }
    if (!(farthest < Farthest * this->Potential.Unit) || this->Potential.Places.empty())
    {
      this->Write(i, 0.5, 0.0, 0.0, 0.0);
      return false;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      part[axis] = this->Blocks.CellOf(x[axis] / this->Potential.Unit) >> 1;
    }
    return true;
  }

  void EvaluateGroup(const NodeIndex& block, const std::size_t* members, int count) const
  {
    FitGroup group;
    group.Count = count;
    for (int i = 0; i < 8; ++i)
    {
      const double* x = this->Points + 3 * members[std::min(i, count - 1)];
      for (int axis = 0; axis < 3; ++axis)
      {
        group.Place[axis][i] = static_cast<float>(
          x[axis] / this->Potential.Unit - this->Blocks.GetBlockSize() * block[axis]);
      }
    }
    PointSums sums;
    this->Potential.Nodes.GetFits().SumAt(block, group, sums);
    const double half = 0.5 / this->Potential.Unit;
    for (int i = 0; i < count; ++i)
    {
      this->Write(members[i], 0.5 - 0.5 * static_cast<double>(sums.Sum[i]),
        -half * static_cast<double>(sums.Gradient[0][i]),
        -half * static_cast<double>(sums.Gradient[1][i]),
        -half * static_cast<double>(sums.Gradient[2][i]));
    }
  }

  void Write(std::size_t i, double value, double x, double y, double z) const
  {
    this->Values[i] = value;
    if (this->Gradients)
    {
      this->Gradients[3 * i] = x;
      this->Gradients[3 * i + 1] = y;
      this->Gradients[3 * i + 2] = z;
    }
  }

  const ParticlePotential& Potential;
  const ParticleBlocks& Blocks;
  const double* Points;
  double* Values;
  double* Gradients;
};

void ParticlePotential::Evaluate(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  for (std::size_t first = 0; first < count; first += PointGroups::Capacity)
  {
    Batch(*this, points + 3 * first, values + first, gradients ? gradients + 3 * first : nullptr)
      .Evaluate(std::min(count - first, PointGroups::Capacity));
  }
}

bool ParticlePotential::FindSupport(std::size_t particle, double (&bounds)[6]) const
{
  float box[6];
  const std::uint32_t k = this->Places[particle];
  if (!this->Nodes.GetFits().FindBox(k, box))
  {
    return false;
  }
  const ParticleBlocks& blocks = this->Nodes.GetBlocks();
  const NodeIndex& at = blocks[blocks.GetBlockOf()[k]].At;
  for (int side = 0; side < 6; ++side)
  {
    bounds[side] =
      this->Unit * (blocks.GetBlockSize() * at[side / 2] + static_cast<double>(box[side]));
  }
  return true;
}

bool ParticlePotential::FindOutward(std::size_t particle, double (&outward)[3]) const
{
  float away[3];
  if (!this->Nodes.GetFits().FindOutward(this->Places[particle], away))
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    outward[axis] = this->Unit * static_cast<double>(away[axis]);
  }
  return true;
}

bool ParticlePotential::FindBounds(double (&bounds)[6]) const
{
  vtkBoundingBox all;
  for (std::size_t n = 0; n < this->Places.size(); ++n)
  {
    if (this->FindSupport(n, bounds))
    {
      all.AddBounds(bounds);
    }
  }
  all.GetBounds(bounds);
  return all.IsValid();
}

}
