#include "ParticleMeans.h"

#include "ParallelTasks.h"
#include "Skeleton/LaneEvaluation.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

struct ParticleMeans::Field
{
  static constexpr int Terms = 4; // velocity, bulk

  const ParticleMeans& Means;
  double* Velocities; // or null
  double* Bulks;      // or null

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Evaluate(
    const PlaceLanes<Width>& lanes, const HitList& hits, double (&terms)[Terms][Width]) const
  {
    Sums<Width> sums;
    hits.Visit([this, &lanes, &sums](const BallCells::Index* list, std::size_t count) ACTIVE_INLINED
      { this->Add(lanes, list, count, sums); });
    for (int i = 0; i < Width; ++i)
    {
      const double ofKnown = sums.KnownWeight[i] > 0.0 ? 1.0 / sums.KnownWeight[i] : std::nan("");
      for (int axis = 0; axis < 3; ++axis)
      {
        terms[axis][i] = sums.Velocity[axis][i] * ofKnown;
      }
      terms[3][i] = sums.Weight[i] > 0.0 ? sums.Bulk[i] / sums.Weight[i] : 0.0;
    }
  }

  ACTIVE_ALWAYS_INLINE void Write(std::size_t i, const double* terms) const
  {
    if (this->Velocities)
    {
      std::copy_n(terms, 3, this->Velocities + 3 * i);
    }
    if (this->Bulks)
    {
      this->Bulks[i] = terms[3];
    }
  }

private:
  template <int Width>
  struct Sums
  {
    double Weight[Width] = {};
    double KnownWeight[Width] = {};
    double Velocity[3][Width] = {};
    double Bulk[Width] = {};
  };

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const BallCells::Index* hits,
    std::size_t count, Sums<Width>& result) const
  {
    Sums<Width> sums = result; // a copy, so that it stays in registers
    for (std::size_t hit = 0; hit < count; ++hit)
    {
      const Element& element = this->Means.Elements[hits[hit]];
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        const double x = element.Position[0] - lanes.X[0][i];
        const double y = element.Position[1] - lanes.X[1][i];
        const double z = element.Position[2] - lanes.X[2][i];
        const double u = 1.0 - std::min((x * x + y * y + z * z) * element.InverseReach2, 1.0);
        const double weight = element.Weight * (u * u);
        const double known = element.KnownWeight * (u * u);
        sums.Weight[i] += weight;
        sums.KnownWeight[i] += known;
        sums.Velocity[0][i] += known * element.Velocity[0];
        sums.Velocity[1][i] += known * element.Velocity[1];
        sums.Velocity[2][i] += known * element.Velocity[2];
        sums.Bulk[i] += weight * element.Bulk;
      }
    }
    result = sums;
  }
};

void ParticleMeans::Build(
  const std::vector<SkeletonVertex>& particles, const Carried& carried, double largestRadius)
{
  this->Balls.clear();
  this->Numbers.clear();
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles[i].Strength > 0.0)
    {
      const double* p = particles[i].Position;
      this->Numbers.push_back(i);
      this->Balls.push_back({ { p[0], p[1], p[2] }, particles[i].Radius });
      largestRadius = std::max(largestRadius, particles[i].Radius);
    }
  }
  this->Near.Build(this->Balls, largestRadius);
  this->Elements.resize(this->Balls.size());
  RunEach(this->Elements.size(),
    [&](std::size_t k)
    {
      const std::size_t i = this->Numbers[this->Near.GetOrder()[k]];
      this->Elements[k] = MakeElement(particles[i], i, carried);
    });
}

ParticleMeans::Element ParticleMeans::MakeElement(
  const SkeletonVertex& particle, std::size_t i, const Carried& carried)
{
  const double* p = particle.Position;
  const double reach = particle.Radius;
  const double bulk = carried.Fits.empty() ? 1.0 : carried.Fits[i].Bulk;
  Element element{ { p[0], p[1], p[2] }, particle.Strength, 1.0 / (reach * reach), 0.0,
    { 0.0, 0.0, 0.0 }, bulk };
  const double* velocity = carried.Velocities.empty() ? nullptr : &carried.Velocities[3 * i];
  if (velocity && std::isfinite(velocity[0]) && std::isfinite(velocity[1]) &&
    std::isfinite(velocity[2]))
  {
    element.KnownWeight = particle.Strength;
    std::copy_n(velocity, 3, element.Velocity);
  }
  return element;
}

void ParticleMeans::Evaluate(
  std::size_t count, const double* points, double* velocities, double* bulks) const
{
  EvaluateInLanes(this->Near, count, points,
    [&](std::size_t first)
    {
      return Field{ *this, velocities ? velocities + 3 * first : nullptr,
        bulks ? bulks + first : nullptr };
    });
}

}
