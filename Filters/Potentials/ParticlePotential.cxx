#include "ParticlePotential.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace activesurface
{

namespace
{

// Node numbers are 32-bit integers.
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
  const std::vector<SkeletonVertex>& particles, const Options& options)
{
  const std::size_t count = particles.size();
  const double least = -FindMost(count, -HUGE_VAL,
    [&](std::size_t n)
    {
      return -(options.OwnRadius > 0.0 ? options.OwnRadius
                                       : particles[n].Radius / options.ReachPerRadius);
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
      "A point is more than 10^9 of its own radii from the origin, which single precision cannot "
      "resolve; move the points, or check ParticleSpacing and the radii.");
  }
  NodeParticleOptions nodes;
  nodes.Model = options.Model;
  nodes.VoxelSize = this->Unit;
  nodes.OwnRadius = options.OwnRadius;
  nodes.ReachPerRadius = options.ReachPerRadius;
  nodes.Anisotropy = options.Anisotropy;
  nodes.AreForPoints = true;
  this->Nodes.Build(ParticlesAtRest(particles), nodes);
  const UnsetVector<std::uint32_t>& order = this->Nodes.GetBlocks().GetOrder();
  this->Places.resize(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    this->Places[order[k]] = static_cast<std::uint32_t>(k);
  }
}

// Points sorted by the part of a block that they are in. Places are relative to the block, so that
// a sum does not depend on the other points.
class ParticlePotential::Batch
{
public:
  static constexpr std::size_t Capacity = 256;

  Batch(const ParticlePotential& potential, std::size_t count, const double* points, double* values,
    double* gradients)
    : Potential(potential)
    , Blocks(potential.Nodes.GetBlocks())
    , Points(points)
    , Values(values)
    , Gradients(gradients)
  {
    for (std::uint32_t i = 0; i < count; ++i)
    {
      this->Add(i);
    }
    std::sort(this->Items, this->Items + this->Count);
  }

  void Evaluate()
  {
    for (std::size_t first = 0; first < this->Count;)
    {
      std::size_t end = first + 1;
      while (end < this->Count && end - first < 8 && this->Items[end].IsBeside(this->Items[first]))
      {
        ++end;
      }
      this->EvaluateGroup(first, static_cast<int>(end - first));
      first = end;
    }
  }

private:
  struct Item
  {
    NodeIndex Block;
    std::uint32_t Part;
    std::uint32_t Point;

    bool operator<(const Item& other) const
    {
      return std::tie(this->Block, this->Part, this->Point) <
        std::tie(other.Block, other.Part, other.Point);
    }
    bool IsBeside(const Item& other) const
    {
      return AreSame(this->Block, other.Block) && this->Part == other.Part;
    }
  };

  // Points beyond all particles get their values here.
  void Add(std::uint32_t i)
  {
    const double* x = this->Points + 3 * i;
    const double farthest = std::max({ std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2]) });
    if (!std::isfinite(x[0] + x[1] + x[2]))
    {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      this->Write(i, none, none, none, none);
      return;
    }
    if (!(farthest < Farthest * this->Potential.Unit) || this->Potential.Places.empty())
    {
      this->Write(i, 0.5, 0.0, 0.0, 0.0);
      return;
    }
    Item& item = this->Items[this->Count++];
    item.Part = 0;
    item.Point = i;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int cell = this->Blocks.CellOf(x[axis] / this->Potential.Unit);
      item.Block[axis] = cell >> 3;
      item.Part = 4 * item.Part + static_cast<std::uint32_t>((cell & 7) >> 1);
    }
  }

  void EvaluateGroup(std::size_t first, int count)
  {
    FitGroup group;
    group.Count = count;
    const NodeIndex& home = this->Items[first].Block;
    for (int i = 0; i < 8; ++i)
    {
      const double* x =
        this->Points + 3 * this->Items[first + static_cast<std::size_t>(std::min(i, count - 1))].Point;
      for (int axis = 0; axis < 3; ++axis)
      {
        group.Place[axis][i] = static_cast<float>(
          x[axis] / this->Potential.Unit - this->Blocks.GetBlockSize() * home[axis]);
      }
    }
    PointSums sums;
    this->Potential.Nodes.GetFits().SumAt(home, group, sums);
    for (int i = 0; i < count; ++i)
    {
      const double half = 0.5 / this->Potential.Unit;
      this->Write(this->Items[first + static_cast<std::size_t>(i)].Point, 0.5 - 0.5 * sums.Sum[i],
        -half * sums.Gradient[0][i], -half * sums.Gradient[1][i], -half * sums.Gradient[2][i]);
    }
  }

  void Write(std::uint32_t i, double value, double x, double y, double z)
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
  std::size_t Count = 0;
  Item Items[Capacity];
};

void ParticlePotential::Evaluate(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  for (std::size_t first = 0; first < count; first += Batch::Capacity)
  {
    Batch(*this, std::min(count - first, Batch::Capacity), points + 3 * first, values + first,
      gradients ? gradients + 3 * first : nullptr)
      .Evaluate();
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
    bounds[side] = this->Unit * (blocks.GetBlockSize() * at[side / 2] + static_cast<double>(box[side]));
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
  bool isAny = false;
  for (std::size_t n = 0; n < this->Places.size(); ++n)
  {
    double own[6];
    if (this->FindSupport(n, own))
    {
      for (int side = 0; side < 6; ++side)
      {
        const double both = side % 2 == 0 ? std::min(bounds[side], own[side])
                                          : std::max(bounds[side], own[side]);
        bounds[side] = isAny ? both : own[side];
      }
      isAny = true;
    }
  }
  return isAny;
}

}
