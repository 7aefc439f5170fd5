#include "ParticleFit.h"

#include "NeighbourLimit.h"
#include "ParallelTasks.h"
#include "ParticlePotential.h"
#include "Skeleton/NeighbourSums.h"
#include "Skeleton/SurfacePlaces.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{
namespace
{

// Radius of the neighbourhood in own radii, at usual proportions. For AveragedCentre it has to be
// the support radius. For the others, larger values are flatter and more expensive.
double GetNeighbourhoodPerOwnRadius(ParticleModel model)
{
  return model == ParticleModel::AveragedCentre ? 6.0 : 7.25;
}

class Fitting
{
public:
  Fitting(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
    : Options(options)
    , NeighbourhoodFactor(GetNeighbourhoodPerRadius(options.Model))
    , Particles(particles)
    , Fits(particles.size())
    , Surface(particles.size())
    , Outside(particles.size())
    , Neighbours(particles, this->NeighbourhoodFactor)
    , Order(this->Neighbours.GetOrder().begin(), this->Neighbours.GetOrder().end())
  {
  }

  ParticleFits Find()
  {
    if (this->HasTooManyNeighbours())
    {
      if (!this->Options.SparesCrowds)
      {
        RefuseNeighbours(this->Particles.size());
      }
      return ParticleFits(this->Particles.size(), ParticleFit());
    }
    this->RunInOrder(this->Order, [this](const Batch& batch) { this->FindNeighbourhoods(batch); });
    if (this->Options.Model != ParticleModel::Sum)
    {
      const std::vector<std::size_t> surface = this->ListSurface();
      this->FindLack(surface);
      this->ShareLack(surface);
    }
    return std::move(this->Fits);
  }

private:
  // Counts the neighbours of a sample that is spread over the list.
  bool HasTooManyNeighbours() const
  {
    const std::size_t count = this->Particles.size();
    constexpr std::size_t most = MostNeighbours * ParticlesOfSample;
    std::size_t neighbours = 0;
    for (std::size_t n = 0; n < ParticlesOfSample && count > FewParticles; ++n)
    {
      const SkeletonVertex& particle = this->Particles[n * count / ParticlesOfSample];
      neighbours += this->Neighbours.CountNear(particle.Position);
      if (neighbours > most)
      {
        return true;
      }
    }
    return false;
  }

  // Particles near one another.
  struct Batch
  {
    const std::size_t* Members;
    std::size_t Count;
  };

  template <class Function>
  static void RunInOrder(const std::vector<std::size_t>& members, Function function)
  {
    RunPieces(members.size(), ParticlesPerTask,
      [&](std::size_t first, std::size_t end) {
        function(Batch{ &members[first], end - first });
      });
  }

  std::vector<double> ListPositions(const Batch& batch) const
  {
    std::vector<double> positions;
    positions.reserve(3 * batch.Count);
    for (std::size_t k = 0; k < batch.Count; ++k)
    {
      const double* x = this->Particles[batch.Members[k]].Position;
      positions.insert(positions.end(), x, x + 3);
    }
    return positions;
  }

  double GetOwnRadius(std::size_t i) const
  {
    return this->Options.OwnRadius > 0.0
      ? this->Options.OwnRadius
      : this->Particles[i].Radius / (2.0 * GetReachPerSpacing(this->Options.Model));
  }

  bool IsAnisotropic() const { return this->Options.Model == ParticleModel::Anisotropic; }

  // Value of an isolated particle, whose surface is at its own radius.
  double GetLoneValue(std::size_t i) const
  {
    if (!this->IsAnisotropic())
    {
      return this->GetOwnRadius(i);
    }
    const double q = std::min(this->GetOwnRadius(i) / this->Particles[i].Radius, 0.999);
    return (1.0 - q * q) * (1.0 - q * q) * (1.0 - q * q);
  }

  void FindNeighbourhoods(const Batch& batch)
  {
    std::vector<NeighbourMoments> sums(batch.Count);
    this->Neighbours.FindMoments(batch.Count, this->ListPositions(batch).data(), sums.data());
    for (std::size_t k = 0; k < batch.Count; ++k)
    {
      const std::size_t i = batch.Members[k];
      const double reach = this->NeighbourhoodFactor * this->Particles[i].Radius;
      FitNeighbourhood(
        { this->Options.Model, this->Options.Anisotropy, reach, this->GetOwnRadius(i) },
        this->Particles[i], sums[k], this->Fits[i], this->Outside[i]);
    }
  }

  // Finds the deficiency at the expected points of the surface. It is the distance from the
  // averaged centre, or the sum of kernels, minus the value of an isolated particle.
  void FindLack(const std::vector<std::size_t>& surface)
  {
    ParticlePotential body;
    if (this->IsAnisotropic())
    {
      body.Build(ParticleModel::Anisotropic, this->Particles, this->Fits);
    }
    this->RunInOrder(surface, [&](const Batch& batch) { this->FindLacks(batch, body); });
  }

  std::vector<std::size_t> ListSurface()
  {
    std::vector<std::size_t> members;
    for (const std::size_t i : this->Order)
    {
      this->Surface[i] = { 0.0, 0.0 };
      if (this->Outside[i].AreOfSurface())
      {
        members.push_back(i);
      }
    }
    return members;
  }

  void FindLacks(const Batch& batch, const ParticlePotential& body)
  {
    const std::vector<double> away =
      this->FindValues(batch, body, &SurfacePlaces::Deep, &SurfacePlaces::Away);
    const std::vector<double> across =
      this->FindValues(batch, body, &SurfacePlaces::Thin, &SurfacePlaces::Across);
    for (std::size_t k = 0; k < batch.Count; ++k)
    {
      const std::size_t i = batch.Members[k];
      const SurfacePlaces& places = this->Outside[i];
      const double value =
        (places.Deep * away[k] + places.Thin * across[k]) / (places.Deep + places.Thin);
      this->Surface[i] = { 1.0 - (1.0 - places.Deep) * (1.0 - places.Thin),
        value - this->GetLoneValue(i) };
    }
  }

  // Evaluates one of the points of each particle if its weight is positive; else 0.
  std::vector<double> FindValues(const Batch& batch, const ParticlePotential& body,
    double SurfacePlaces::*share, double (SurfacePlaces::*place)[3]) const
  {
    std::vector<std::size_t> counting;
    std::vector<double> points;
    for (std::size_t k = 0; k < batch.Count; ++k)
    {
      const SurfacePlaces& places = this->Outside[batch.Members[k]];
      if (places.*share > 0.0)
      {
        counting.push_back(k);
        points.insert(points.end(), places.*place, places.*place + 3);
      }
    }
    std::vector<double> found(counting.size()), values(batch.Count, 0.0);
    this->FindValuesAt(points, body, found.data());
    for (std::size_t n = 0; n < counting.size(); ++n)
    {
      const bool isNowhere = std::isnan(found[n]);
      values[counting[n]] = isNowhere ? this->GetOwnRadius(batch.Members[counting[n]]) : found[n];
    }
    return values;
  }

  // NaN if no particle is near, so that there is no averaged centre.
  void FindValuesAt(
    const std::vector<double>& points, const ParticlePotential& body, double* values) const
  {
    const std::size_t count = points.size() / 3;
    if (this->IsAnisotropic())
    {
      body.Evaluate(count, points.data(), values, nullptr);
      std::transform(values, values + count, values, [](double value) { return 0.5 - value; });
      return;
    }
    std::vector<NeighbourMoments> moments(count);
    this->Neighbours.FindMoments(count, points.data(), moments.data());
    for (std::size_t n = 0; n < count; ++n)
    {
      const NeighbourMoments& sums = moments[n];
      values[n] = sums.Weight > 0.0
        ? std::hypot(sums.First[0], sums.First[1], sums.First[2]) / sums.Weight
        : std::nan("");
    }
  }

  // Averages the deficiency over particles of the surface, which are a minority.
  void ShareLack(const std::vector<std::size_t>& surface)
  {
    std::vector<SkeletonVertex> particles;
    particles.reserve(surface.size());
    for (const std::size_t i : surface)
    {
      particles.push_back(this->Particles[i]);
    }
    const NeighbourSums neighbours(this->Neighbours, particles);
    UnsetVector<NeighbourSums::Shares> shares(surface.size());
    for (std::size_t k = 0; k < shares.size(); ++k)
    {
      shares[k] = this->Surface[surface[neighbours.GetOrder()[k]]];
    }
    this->RunInOrder(
      this->Order, [&](const Batch& batch) { this->GiveShares(batch, neighbours, shares); });
  }

  void GiveShares(const Batch& batch, const NeighbourSums& neighbours,
    const UnsetVector<NeighbourSums::Shares>& shares)
  {
    std::vector<NeighbourSums::Shares> sums(batch.Count);
    neighbours.FindShares(batch.Count, this->ListPositions(batch).data(), shares, sums.data());
    for (std::size_t k = 0; k < batch.Count; ++k)
    {
      this->GiveShare(batch.Members[k], sums[k]);
    }
  }

  void GiveShare(std::size_t i, const NeighbourSums::Shares& sums)
  {
    const NeighbourSums::Shares& surface = this->Surface[i];
    const double mean = sums.Share > 0.0 ? sums.Value / sums.Share : 0.0;
    const double shape = this->Outside[i].ShapeShare;
    const double own = surface.Share * surface.Value;
    const double value =
      this->GetLoneValue(i) + shape * mean * std::min(sums.Share, 1.0) + (1.0 - shape) * own;
    ParticleFit& fit = this->Fits[i];
    if (this->IsAnisotropic())
    {
      fit.Strength = 0.5 / value;
    }
    else
    {
      fit.OwnRadius = value;
    }
  }

  const FitOptions Options;
  const double NeighbourhoodFactor;
  const std::vector<SkeletonVertex>& Particles;
  ParticleFits Fits;
  UnsetVector<NeighbourSums::Shares> Surface;
  UnsetVector<SurfacePlaces> Outside;
  const NeighbourSums Neighbours;
  const std::vector<std::size_t> Order; // particles near one another are adjacent
};

}

double GetNeighbourhoodPerRadius(ParticleModel model)
{
  return GetNeighbourhoodPerOwnRadius(model) / (2.0 * GetReachPerSpacing(model));
}

ParticleFits FitParticles(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
{
  return Fitting(options, particles).Find();
}

}
