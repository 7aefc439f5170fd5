#include "ParticleFit.h"

#include "LocalParticles.h"
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

// Neighbours are looked for within so many own radii, by usual proportions. For AveragedCentre it
// has to be the reach. For the others wider is flatter, and dearer.
double GetNeighbourhoodPerOwnRadius(ParticleModel model)
{
  return model == ParticleModel::AveragedCentre ? 6.0 : 7.25;
}

class Fitting
{
public:
  Fitting(const FitOptions& options, const std::vector<SkeletonVertex>& own,
    const SharedParticles* shared)
    : Options(options)
    , NeighbourhoodFactor(GetNeighbourhoodPerRadius(options.Model))
    , LargestRadius(shared ? shared->LargestRadius : FindLargestRadius(own))
    , LargestRadiusOfActive(shared ? shared->LargestRadiusOfActive : 0.0)
    , Local(own, shared, this->NeighbourhoodFactor, this->GetFarthestPlace())
    , Particles(this->Local.Get())
    , Fits(this->Particles.size())
    , Surface(this->Particles.size())
    , Outside(this->Particles.size())
    , Neighbours(this->Particles, this->NeighbourhoodFactor, this->LargestRadius)
    , Wanted(this->Local.ListAtHome(this->Neighbours.GetOrder()))
  {
  }

  ParticleFits Find()
  {
    if (this->HasTooManyNeighbours())
    {
      if (!this->Options.SparesCrowds)
      {
        RefuseNeighbours(this->Local.CountAll());
      }
      return ParticleFits(this->Wanted.size(), ParticleFit());
    }
    this->RunInOrder(this->Wanted, [this](const Batch& batch) { this->FindNeighbourhoods(batch); });
    if (this->Options.Model != ParticleModel::Sum)
    {
      const std::vector<std::size_t> surface = this->ListSurface();
      this->FindLack(surface);
      this->ShareLack(surface);
    }
    return this->Local.TakeHome(std::move(this->Fits));
  }

private:
  // A particle, and something of it, for other ranks.
  template <class Value>
  struct Of
  {
    SkeletonVertex Particle;
    Value What;
  };

  template <class Value>
  static std::vector<SkeletonVertex> ListParticles(
    const std::vector<LocalParticles::Told<Of<Value>>>& told)
  {
    std::vector<SkeletonVertex> particles;
    particles.reserve(told.size());
    for (const auto& one : told)
    {
      particles.push_back(one.What.Particle);
    }
    return particles;
  }

  // By a sample that is spread over the list.
  bool HasTooManyNeighbours() const
  {
    if (this->Local.CountAll() <= FewParticles)
    {
      return false;
    }
    constexpr std::size_t most = MostNeighbours * ParticlesOfSample;
    std::size_t neighbours = 0;
    for (const SkeletonVertex& particle : this->Local.PickSample(ParticlesOfSample))
    {
      if (neighbours <= most && this->Local.HasAtHome(particle.Position))
      {
        neighbours += this->Neighbours.CountNear(particle.Position);
      }
    }
    return this->Local.AddUp(neighbours) > most;
  }

  // Some particles, near one another.
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
    return this->Local.ListPositions(batch.Members, batch.Count);
  }

  // From a particle to a place where its surface should be, at most.
  double GetFarthestPlace() const
  {
    const double own = this->Options.OwnRadius > 0.0
      ? this->Options.OwnRadius
      : this->LargestRadius / (2.0 * GetReachPerSpacing(this->Options.Model));
    return SurfacePlaces::Farthest * own;
  }

  double GetOwnRadius(std::size_t i) const
  {
    return this->Options.OwnRadius > 0.0
      ? this->Options.OwnRadius
      : this->Particles[i].Radius / (2.0 * GetReachPerSpacing(this->Options.Model));
  }

  bool IsAnisotropic() const { return this->Options.Model == ParticleModel::Anisotropic; }

  // What a lone particle has: the surface is at its own radius.
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

  // At the place where the surface should be: the distance from the averaged centre, or the sum of
  // kernels, over what a lone particle has.
  void FindLack(const std::vector<std::size_t>& surface)
  {
    ParticlePotential body;
    if (this->IsAnisotropic())
    {
      this->BuildBody(body);
    }
    this->RunInOrder(surface, [&](const Batch& batch) { this->FindLacks(batch, body); });
  }

  // Of those particles that reach a place beside one at home.
  void BuildBody(ParticlePotential& body) const
  {
    if (!this->Local.AreShared())
    {
      body.Build(ParticleModel::Anisotropic, this->Particles, this->Fits);
      return;
    }
    std::vector<SkeletonVertex> particles;
    ParticleFits fits;
    this->GatherBody(particles, fits);
    body.Build(ParticleModel::Anisotropic, particles, fits, this->LargestRadiusOfActive);
  }

  void GatherBody(std::vector<SkeletonVertex>& particles, ParticleFits& fits) const
  {
    const std::vector<std::size_t> home = this->Local.ListAtHome();
    const auto told = this->Local.Gather<Of<ParticleFit>>(
      home, [&](std::size_t n) { return this->GetBoxOfFit(home[n]); },
      [&](std::size_t n) {
        return Of<ParticleFit>{ this->Particles[home[n]], this->Fits[home[n]] };
      });
    particles = ListParticles(told);
    fits.reserve(told.size());
    for (const auto& one : told)
    {
      fits.push_back(one.What.What);
    }
  }

  LocalParticles::Box GetBoxOfFit(std::size_t i) const
  {
    const ParticleFit& fit = this->Fits[i];
    double centre[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      centre[axis] = this->Particles[i].Position[axis] + fit.Offset[axis];
    }
    return LocalParticles::MakeBox(centre, fit.Reach + this->GetFarthestPlace());
  }

  // In the order of those wanted.
  std::vector<std::size_t> ListSurface()
  {
    std::vector<std::size_t> members;
    for (const std::size_t i : this->Wanted)
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

  // At one of the places of each particle, if it counts; else 0.
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

  // Not a number where the centre is not known, as nothing is near.
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

  // Most particles are no surface, and share nothing.
  void ShareLack(const std::vector<std::size_t>& surface)
  {
    using Lack = Of<NeighbourSums::Shares>;
    const auto told = this->Local.Gather<Lack>(
      surface,
      [&](std::size_t n) { return this->Local.GetBall(surface[n], this->NeighbourhoodFactor); },
      [&](std::size_t n) {
        return Lack{ this->Particles[surface[n]], this->Surface[surface[n]] };
      });
    const NeighbourSums neighbours(this->Neighbours, ListParticles(told));
    UnsetVector<NeighbourSums::Shares> shares(told.size());
    for (std::size_t k = 0; k < told.size(); ++k)
    {
      shares[k] = told[neighbours.GetOrder()[k]].What.What;
    }
    this->RunInOrder(
      this->Wanted, [&](const Batch& batch) { this->GiveShares(batch, neighbours, shares); });
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
  const double LargestRadius;         // of all
  const double LargestRadiusOfActive; // of those that add something, where ranks share; else 0
  const LocalParticles Local;
  const std::vector<SkeletonVertex>& Particles; // that are near; others are numbers among these
  ParticleFits Fits;
  UnsetVector<NeighbourSums::Shares> Surface;
  UnsetVector<SurfacePlaces> Outside;
  const NeighbourSums Neighbours;
  const std::vector<std::size_t> Wanted; // those at home, near ones together
};

}

double GetNeighbourhoodPerRadius(ParticleModel model)
{
  return GetNeighbourhoodPerOwnRadius(model) / (2.0 * GetReachPerSpacing(model));
}

ParticleFits FitParticles(const FitOptions& options, const std::vector<SkeletonVertex>& particles,
  const SharedParticles* shared)
{
  return Fitting(options, particles, shared).Find();
}

}
