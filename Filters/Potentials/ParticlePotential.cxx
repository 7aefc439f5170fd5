#include "ParticlePotential.h"

#include "ParallelTasks.h"
#include "Skeleton/LaneEvaluation.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{
namespace
{
// Support of the presence kernel, in support radii. The presence is 0.77 on the surface of an
// isolated particle, and at least 0.7 for a layer with a spacing of up to 3 r. It is 0.32 halfway
// between two layers that are 5 r apart.
constexpr double NearPerReach = 3.5 / 6.0;
constexpr double LeastPresence = 0.1;
constexpr double FullPresence = 0.5;
// Ratio of an ellipsoid's longest half-axis to the particle's support radius, in a body.
constexpr double UsualStretch = 1.3;
}

// Destination of values and gradients.
struct ParticlePotential::Results
{
  static constexpr int Terms = 4; // gradient, value

  double* Values;
  double* Gradients; // or null

  ACTIVE_ALWAYS_INLINE void Write(std::size_t i, const double* terms) const
  {
    this->Values[i] = terms[3];
    if (this->Gradients)
    {
      std::copy_n(terms, 3, this->Gradients + 3 * i);
    }
  }
};

// Evaluates lane after lane; all lanes use the same operations.
struct ParticlePotential::CentreField : ParticlePotential::Results
{
  const ParticlePotential& Body;

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Evaluate(
    const PlaceLanes<Width>& lanes, const HitList& hits, double (&terms)[Terms][Width]) const
  {
    Sums<Width> sums;
    hits.Visit([this, &lanes, &sums](const BallCells::Index* list, std::size_t count) ACTIVE_INLINED
      { this->Add(lanes, list, count, sums); });
    Slopes<Width> slopes;
    for (int i = 0; i < Width; ++i)
    {
      terms[3][i] = this->FindValue(sums, i, slopes);
      terms[0][i] = terms[1][i] = terms[2][i] = 0.0;
    }
    if (!this->Gradients)
    {
      return;
    }
    hits.Visit([this, &lanes, &slopes](const BallCells::Index* list, std::size_t count)
                 ACTIVE_INLINED { this->Add(lanes, list, count, slopes); });
    for (int axis = 0; axis < 3; ++axis)
    {
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        terms[axis][i] = slopes.Gradient[axis][i];
      }
    }
  }

private:
  template <int Width>
  struct Sums
  {
    double Weight[Width] = {};
    double Offset[3][Width] = {}; // to the particles
    double Radius[Width] = {};
    double Presence[Width] = {};
  };

  // Coefficients of the gradient, which is a sum of offsets times a factor, from the first sums.
  // OfWeight (offset . ToCentre - Level - Step * own radius) is the change of a particle's weight.
  // OfPresence is the change of its presence.
  template <int Width>
  struct Slopes
  {
    double ToCentre[3][Width];
    double OfWeight[Width];
    double Level[Width];
    double Step[Width];
    double OfPresence[Width];
    double Gradient[3][Width];
  };

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const BallCells::Index* hits,
    std::size_t count, Sums<Width>& result) const
  {
    Sums<Width> sums = result; // a copy, so that it stays in registers
    for (std::size_t hit = 0; hit < count; ++hit)
    {
      const CentreElement& element = this->Body.Centres[hits[hit]];
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        const double x = element.Position[0] - lanes.X[0][i];
        const double y = element.Position[1] - lanes.X[1][i];
        const double z = element.Position[2] - lanes.X[2][i];
        const double d2 = x * x + y * y + z * z;
        const double u = 1.0 - std::min(d2 * element.InverseReach2, 1.0);
        const double p = 1.0 - std::min(d2 * element.InverseNear2, 1.0);
        const double weight = element.Weight * (u * u);
        sums.Weight[i] += weight;
        sums.Offset[0][i] += weight * x;
        sums.Offset[1][i] += weight * y;
        sums.Offset[2][i] += weight * z;
        sums.Radius[i] += weight * element.OwnRadius;
        sums.Presence[i] += element.Presence * (p * p * p);
      }
    }
    result = sums;
  }

  template <int Width>
  ACTIVE_ALWAYS_INLINE double FindValue(const Sums<Width>& sums, int i, Slopes<Width>& slopes) const
  {
    const double weight = sums.Weight[i];
    const bool isReached = weight > 0.0;
    const double inverse = isReached ? 1.0 / weight : 0.0;
    const double* offset[3] = { sums.Offset[0], sums.Offset[1], sums.Offset[2] };
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      square += (offset[axis][i] * inverse) * (offset[axis][i] * inverse);
    }
    const double distance = std::sqrt(square);
    const double radius = sums.Radius[i] * inverse;
    constexpr double width = FullPresence - LeastPresence;
    const double t = std::min(std::max((sums.Presence[i] - LeastPresence) / width, 0.0), 1.0);
    const double step = 2.0 * (t * t * (3.0 - 2.0 * t)) - 1.0;
    const double toUnit = distance > 0.0 ? inverse / distance : 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      slopes.ToCentre[axis][i] = offset[axis][i] * toUnit;
      slopes.Gradient[axis][i] = -slopes.ToCentre[axis][i];
    }
    slopes.OfWeight[i] = inverse;
    slopes.Level[i] = distance - step * radius;
    slopes.Step[i] = step;
    slopes.OfPresence[i] = -radius * (12.0 * t * (1.0 - t) / width);
    return isReached ? slopes.Level[i] : this->Body.GetOutside();
  }

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const BallCells::Index* hits,
    std::size_t count, Slopes<Width>& result) const
  {
    Slopes<Width> slopes = result;
    for (std::size_t hit = 0; hit < count; ++hit)
    {
      const CentreElement& element = this->Body.Centres[hits[hit]];
      const double ofWeight = 4.0 * element.Weight * element.InverseReach2;
      const double ofPresence = 6.0 * element.Presence * element.InverseNear2;
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        const double x = element.Position[0] - lanes.X[0][i];
        const double y = element.Position[1] - lanes.X[1][i];
        const double z = element.Position[2] - lanes.X[2][i];
        const double d2 = x * x + y * y + z * z;
        const double u = 1.0 - std::min(d2 * element.InverseReach2, 1.0);
        const double p = 1.0 - std::min(d2 * element.InverseNear2, 1.0);
        const double along =
          x * slopes.ToCentre[0][i] + y * slopes.ToCentre[1][i] + z * slopes.ToCentre[2][i];
        const double factor = slopes.OfWeight[i] * (ofWeight * u) *
            (along - slopes.Level[i] - slopes.Step[i] * element.OwnRadius) +
          slopes.OfPresence[i] * (ofPresence * (p * p));
        slopes.Gradient[0][i] += factor * x;
        slopes.Gradient[1][i] += factor * y;
        slopes.Gradient[2][i] += factor * z;
      }
    }
    result = slopes;
  }
};

struct ParticlePotential::AnisotropicField : ParticlePotential::Results
{
  const ParticlePotential& Body;

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Evaluate(
    const PlaceLanes<Width>& lanes, const HitList& hits, double (&terms)[Terms][Width]) const
  {
    Sums<Width> sums;
    hits.Visit([this, &lanes, &sums](const BallCells::Index* list, std::size_t count) ACTIVE_INLINED
      { this->Add(lanes, list, count, sums); });
    for (int term = 0; term < Terms; ++term)
    {
      for (int i = 0; i < Width; ++i)
      {
        terms[term][i] = sums.Terms[term][i];
      }
    }
    for (int i = 0; i < Width; ++i)
    {
      terms[3][i] = 0.5 - terms[3][i];
    }
  }

private:
  template <int Width>
  struct Sums
  {
    double Terms[Results::Terms][Width] = {};
  };

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const BallCells::Index* hits,
    std::size_t count, Sums<Width>& result) const
  {
    Sums<Width> sums = result;
    for (std::size_t hit = 0; hit < count; ++hit)
    {
      const AnisotropicElement& element = this->Body.Ellipsoids[hits[hit]];
      const double* m = element.Metric;
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        const double x = lanes.X[0][i] - element.Position[0];
        const double y = lanes.X[1][i] - element.Position[1];
        const double z = lanes.X[2][i] - element.Position[2];
        const double mx = m[0] * x + m[1] * y + m[2] * z;
        const double my = m[1] * x + m[3] * y + m[4] * z;
        const double mz = m[2] * x + m[4] * y + m[5] * z;
        const double u = 1.0 - std::min(x * mx + y * my + z * mz, 1.0);
        const double rate = element.Strength * (u * u);
        sums.Terms[0][i] += 6.0 * rate * mx;
        sums.Terms[1][i] += 6.0 * rate * my;
        sums.Terms[2][i] += 6.0 * rate * mz;
        sums.Terms[3][i] += rate * u;
      }
    }
    result = sums;
  }
};

void ParticlePotential::Build(
  ParticleModel model, const std::vector<SkeletonVertex>& particles, const ParticleFits& fits)
{
  this->Model = model;
  this->LargestRadius = 0.0; // fluctuates less than the ellipsoids' radii
  this->Numbers.clear();
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles[i].Strength > 0.0)
    {
      this->Numbers.push_back(i);
      this->LargestRadius = std::max(this->LargestRadius, particles[i].Radius);
    }
  }
  const bool isAnisotropic = model == ParticleModel::Anisotropic;
  this->Balls.resize(this->Numbers.size());
  RunEach(this->Balls.size(),
    [&](std::size_t k)
    { this->Balls[k] = this->MakeBall(particles[this->Numbers[k]], fits[this->Numbers[k]]); });
  this->Near.Build(this->Balls, (isAnisotropic ? UsualStretch : 1.0) * this->LargestRadius);
  this->Centres.resize(isAnisotropic ? 0 : this->Balls.size());
  this->Ellipsoids.resize(isAnisotropic ? this->Balls.size() : 0);
  RunEach(this->Balls.size(),
    [&](std::size_t k)
    {
      const std::size_t i = this->Numbers[this->Near.GetOrder()[k]];
      if (isAnisotropic)
      {
        this->Ellipsoids[k] = MakeEllipsoid(particles[i], fits[i]);
      }
      else
      {
        this->Centres[k] = MakeCentre(particles[i], fits[i]);
      }
    });
}

BallCells::Ball ParticlePotential::MakeBall(
  const SkeletonVertex& particle, const ParticleFit& fit) const
{
  const bool isAnisotropic = this->Model == ParticleModel::Anisotropic;
  BallCells::Ball ball{ {}, isAnisotropic ? fit.Reach : particle.Radius };
  for (int axis = 0; axis < 3; ++axis)
  {
    ball.Centre[axis] = particle.Position[axis] + (isAnisotropic ? fit.Offset[axis] : 0.0);
  }
  return ball;
}

ParticlePotential::CentreElement ParticlePotential::MakeCentre(
  const SkeletonVertex& particle, const ParticleFit& fit)
{
  const double* p = particle.Position;
  const double reach = particle.Radius, near = NearPerReach * reach;
  return { { p[0], p[1], p[2] }, particle.Strength, 1.0 / (reach * reach), fit.OwnRadius,
    std::min(particle.Strength, 1.0), 1.0 / (near * near) };
}

ParticlePotential::AnisotropicElement ParticlePotential::MakeEllipsoid(
  const SkeletonVertex& particle, const ParticleFit& fit)
{
  AnisotropicElement element{ {}, particle.Strength * fit.Strength, {} };
  for (int axis = 0; axis < 3; ++axis)
  {
    element.Position[axis] = particle.Position[axis] + fit.Offset[axis];
  }
  std::copy_n(fit.Metric, 6, element.Metric);
  return element;
}

template <class Field>
void ParticlePotential::EvaluateField(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  EvaluateInLanes(this->Near, count, points,
    [&](std::size_t first) {
      return Field{ { values + first, gradients ? gradients + 3 * first : nullptr }, *this };
    });
}

void ParticlePotential::Evaluate(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  if (this->Model == ParticleModel::Anisotropic)
  {
    this->EvaluateField<AnisotropicField>(count, points, values, gradients);
  }
  else
  {
    this->EvaluateField<CentreField>(count, points, values, gradients);
  }
}

}
