#include "ParticleFit.h"

#include "ParallelTasks.h"
#include "ParticlePotential.h"
#include "Skeleton/Ellipsoid.h"
#include "Skeleton/NeighbourSums.h"
#include "Skeleton/SmoothStep.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace activesurface
{
namespace
{

constexpr std::size_t ParticlesPerTask = 256;

// Neighbours are looked for within so many own radii, by usual proportions. For AveragedCentre it
// has to be the reach. For the others wider is flatter, and dearer.
double GetNeighbourhoodPerOwnRadius(ParticleModel model)
{
  return model == ParticleModel::AveragedCentre ? 6.0 : 7.25;
}

// A particle counts as one of the surface by how far it is from the mean of its neighbourhood, in
// reaches of that: .24 in a flat layer of a deep body, below .1 inside.
constexpr double LeastDepth = 0.1;
constexpr double FullDepth = 0.22;

// How much farther than its own radius the surface is from a particle of a body, for what the edges
// of the body lose.
constexpr double OffsetOfBody = 0.1;

// Sum of weights of the neighbours, in that of a whole ball with one particle in each (2 r)^3, from
// which on there is a body: .28 in a sheet of one layer, .63 in the outermost layer of a deep body
// (which then has .73 of its tension), .87 in the next.
constexpr double LeastBody = 0.3;
constexpr double FullBody = 0.8;

// Of fewer particles each may have all as neighbours; else so many on the average, a hundred times
// what is usual, are refused: each is visited for each, so that it would take hours.
constexpr std::size_t FewParticles = 30000;
constexpr std::size_t MostNeighbours = 20000;
constexpr std::size_t ParticlesOfSample = 256;

class Fitting
{
public:
  Fitting(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
    : Options(options)
    , Particles(particles)
    , Fits(particles.size())
    , Surface(particles.size())
    , Outside(particles.size())
    , NeighbourhoodFactor(
        GetNeighbourhoodPerOwnRadius(options.Model) / (2.0 * GetReachPerSpacing(options.Model)))
    , Neighbours(particles, this->NeighbourhoodFactor)
    , Order(this->Neighbours.GetOrder())
  {
  }

  ParticleFits Find()
  {
    if (this->IsCrowd())
    {
      if (!this->Options.SparesCrowds)
      {
        this->RefuseCrowd();
      }
      return ParticleFits(this->Particles.size(), ParticleFit());
    }
    this->ShareInOrder([this](const Batch& batch) { this->FindNeighbourhoods(batch); },
      [this](std::size_t i, auto& pass)
      {
        SurfacePlaces& places = this->Outside[i];
        pass(&this->Fits[i], 1);
        pass(&places.Deep, 1);
        pass(&places.Thin, 1);
        if (places.AreOfSurface()) // elsewhere only the rank that has found them reads them
        {
          pass(&places, 1);
        }
      });
    if (this->Options.Model != ParticleModel::Sum)
    {
      const std::vector<BallCells::Index> surface = this->ListSurface();
      this->FindLack(surface);
      this->ShareLack(surface);
    }
    return std::move(this->Fits);
  }

private:
  // Where the surface should be, and how much each place counts.
  struct SurfacePlaces
  {
    double Away[3]; // from the mean of the neighbours, which counts at the edge of a body
    double Deep;
    double Across[3]; // of a sheet or a thread
    double Thin;
    double ShapeShare; // of what the neighbours lack, in place of the particle's own lack

    bool AreOfSurface() const { return this->Deep > 0.0 || this->Thin > 0.0; }
  };

  // By a sample that is spread over the list.
  bool IsCrowd() const
  {
    const std::size_t count = this->Particles.size();
    std::size_t neighbours = 0;
    for (std::size_t i = 0; i < ParticlesOfSample && count > FewParticles; ++i)
    {
      const SkeletonVertex& particle = this->Particles[i * count / ParticlesOfSample];
      neighbours += this->Neighbours.CountNear(particle.Position);
      if (neighbours > MostNeighbours * ParticlesOfSample)
      {
        return true;
      }
    }
    return false;
  }

  [[noreturn]] void RefuseCrowd() const
  {
    throw std::invalid_argument("The " + std::to_string(this->Particles.size()) +
      " particles have more than " + std::to_string(MostNeighbours) +
      " neighbours in reach on the average, where some 200 are usual; check whether many are "
      "in the same place, and whether ParticleSpacing and ParticleRadius (or the array of "
      "radii) are in the particles' own units, or set ParticleModel to SUM.");
  }

  // Some particles, near one another.
  struct Batch
  {
    std::size_t First; // in their order
    const BallCells::Index* Members;
    std::size_t Count;
  };

  // Ranks share the batches; visit names what is found for a particle, see SharedResults.h.
  template <class Function, class Visit>
  void ShareInOrder(Function function, Visit visit)
  {
    const auto run = [&](std::size_t first, std::size_t end) {
      function(Batch{ first, &this->Order[first], end - first });
    };
    this->Share(this->Order.size(), run,
      [&](std::size_t place, auto& pass) { visit(std::size_t(this->Order[place]), pass); });
  }

  template <class Run, class Visit>
  void Share(std::size_t count, Run run, Visit visit)
  {
    SharePieces(this->Options.Ranks, count, ParticlesPerTask, run, visit);
  }

  std::vector<double> GetPositions(const Batch& batch) const
  {
    return this->Neighbours.ListPlaces(batch.First, batch.Count);
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
    this->Neighbours.FindMoments(batch.Count, this->GetPositions(batch).data(), sums.data());
    for (std::size_t k = 0; k < batch.Count; ++k)
    {
      this->FindNeighbourhood(batch.Members[k], sums[k]);
    }
  }

  void FindNeighbourhood(std::size_t i, const NeighbourMoments& sums)
  {
    const SkeletonVertex& particle = this->Particles[i];
    const double reach = this->NeighbourhoodFactor * particle.Radius;
    const double own = this->GetOwnRadius(i);
    // The integral of (1 - d^2/R^2)^2 over the ball of radius R, over (2 r)^3.
    const double cells = reach / (2.0 * own);
    const double whole = 32.0 * 3.14159265358979 / 105.0 * cells * cells * cells;
    const double others = sums.Weight - std::max(particle.Strength, 0.0);
    ParticleFit& fit = this->Fits[i] = ParticleFit();
    fit.Bulk = SmoothStep(LeastBody, FullBody, others / whole);
    fit.OwnRadius = own;
    fit.Strength = 1.0; // until it is known

    const NeighbourhoodShape shape(sums);
    const double depth = std::hypot(shape.Mean[0], shape.Mean[1], shape.Mean[2]);
    SurfacePlaces& places = this->Outside[i];
    places.Deep = SmoothStep(LeastDepth, FullDepth, depth / reach);
    places.ShapeShare = GetShapeShare(sums.Near);
    places.Thin = shape.GetThinness(reach);
    const double inward = shape.Frame[0][2] * shape.Mean[0] + shape.Frame[1][2] * shape.Mean[1] +
      shape.Frame[2][2] * shape.Mean[2];
    const double offset = own * (1.0 + OffsetOfBody * fit.Bulk);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double away = depth > 0.0 ? -shape.Mean[axis] / depth : 0.0;
      const double across = inward > 0.0 ? -shape.Frame[axis][2] : shape.Frame[axis][2];
      places.Away[axis] = particle.Position[axis] + offset * away;
      places.Across[axis] = particle.Position[axis] + offset * across;
      fit.Outward[axis] = places.Deep > 0.0 ? 2.0 * own * away : 0.0;
    }
    if (this->IsAnisotropic())
    {
      FitEllipsoid(shape, { particle.Radius, this->Options.Anisotropy, places.ShapeShare }, fit);
    }
  }

  // At the place where the surface should be: the distance from the averaged centre, or the sum of
  // kernels, over what a lone particle has.
  void FindLack(const std::vector<BallCells::Index>& surface)
  {
    ParticlePotential body;
    if (this->IsAnisotropic())
    {
      body.Build(ParticleModel::Anisotropic, this->Particles, this->Fits);
    }
    this->Share(
      surface.size(),
      [&](std::size_t first, std::size_t end)
      { this->FindLacks(&surface[first], end - first, body); },
      [&](std::size_t k, auto& pass) { pass(&this->Surface[surface[k]], 1); });
  }

  // In their order. The others have no share.
  std::vector<BallCells::Index> ListSurface()
  {
    std::vector<BallCells::Index> members;
    for (const BallCells::Index i : this->Order)
    {
      this->Surface[i] = { 0.0, 0.0 };
      if (this->Outside[i].AreOfSurface())
      {
        members.push_back(i);
      }
    }
    return members;
  }

  void FindLacks(const BallCells::Index* members, std::size_t size, const ParticlePotential& body)
  {
    const std::vector<double> away =
      this->FindValues(members, size, body, &SurfacePlaces::Deep, &SurfacePlaces::Away);
    const std::vector<double> across =
      this->FindValues(members, size, body, &SurfacePlaces::Thin, &SurfacePlaces::Across);
    for (std::size_t k = 0; k < size; ++k)
    {
      const std::size_t i = members[k];
      const SurfacePlaces& places = this->Outside[i];
      const double value =
        (places.Deep * away[k] + places.Thin * across[k]) / (places.Deep + places.Thin);
      this->Surface[i] = { 1.0 - (1.0 - places.Deep) * (1.0 - places.Thin),
        value - this->GetLoneValue(i) };
    }
  }

  // At one of the places of each particle, if it counts; else 0.
  std::vector<double> FindValues(const BallCells::Index* members, std::size_t size,
    const ParticlePotential& body, double SurfacePlaces::*share,
    double (SurfacePlaces::*place)[3]) const
  {
    std::vector<std::size_t> counting;
    std::vector<double> points;
    for (std::size_t k = 0; k < size; ++k)
    {
      const SurfacePlaces& places = this->Outside[members[k]];
      if (places.*share > 0.0)
      {
        counting.push_back(k);
        points.insert(points.end(), places.*place, places.*place + 3);
      }
    }
    std::vector<double> found(counting.size()), values(size, 0.0);
    this->FindValuesAt(points, body, found.data());
    for (std::size_t n = 0; n < counting.size(); ++n)
    {
      const bool isNowhere = std::isnan(found[n]);
      values[counting[n]] = isNowhere ? this->GetOwnRadius(members[counting[n]]) : found[n];
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
  void ShareLack(const std::vector<BallCells::Index>& surface)
  {
    std::vector<SkeletonVertex> particles;
    particles.reserve(surface.size());
    for (const BallCells::Index i : surface)
    {
      particles.push_back(this->Particles[i]);
    }
    const NeighbourSums neighbours(this->Neighbours, particles);
    UnsetVector<NeighbourSums::Shares> shares(surface.size());
    for (std::size_t k = 0; k < surface.size(); ++k)
    {
      shares[k] = this->Surface[surface[neighbours.GetOrder()[k]]];
    }
    this->ShareInOrder([&](const Batch& batch) { this->GiveShares(batch, neighbours, shares); },
      [this](std::size_t i, auto& pass)
      {
        pass(&this->Fits[i].Strength, 1);
        pass(&this->Fits[i].OwnRadius, 1);
      });
  }

  void GiveShares(const Batch& batch, const NeighbourSums& neighbours,
    const UnsetVector<NeighbourSums::Shares>& shares)
  {
    std::vector<NeighbourSums::Shares> sums(batch.Count);
    neighbours.FindShares(batch.Count, this->GetPositions(batch).data(), shares, sums.data());
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
  const std::vector<SkeletonVertex>& Particles;
  ParticleFits Fits;
  UnsetVector<NeighbourSums::Shares> Surface;
  UnsetVector<SurfacePlaces> Outside;
  const double NeighbourhoodFactor;
  const NeighbourSums Neighbours;
  const UnsetVector<BallCells::Index>& Order; // of the particles
};

}

ParticleFits FitParticles(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
{
  return Fitting(options, particles).Find();
}

}
