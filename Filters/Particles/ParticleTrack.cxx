#include "ParticleTrack.h"

#include "Index/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace activesurface
{

namespace
{

double Between(double a, double b, double fraction)
{
  return a + fraction * (b - a);
}

// NaN for an absent particle, and for a frame without velocities.
double VelocityOf(const ParticleFrame* frame, std::size_t particle, std::size_t axis)
{
  const bool isKnown = particle != NoPartner && frame->HasVelocities;
  return isKnown ? frame->Velocities[particle][axis] : std::numeric_limits<double>::quiet_NaN();
}

SkeletonVertex Faded(SkeletonVertex particle, double share)
{
  particle.Strength *= share;
  return particle;
}

}

ParticleTrack::ParticleTrack(const ParticleFrame& earlier, const ParticleFrame* later,
  std::shared_ptr<const ParticleMatches> matches, const PeriodicBox& box, double fraction)
  : Earlier(&earlier)
  , Later(later)
  , Matches(std::move(matches))
  , Box(box)
  , Fraction(later ? fraction : 0.0)
  , Count(earlier.Particles.size())
{
  if (this->Fraction != 0.0)
  {
    const ParticleMatches& pairs = *this->Matches;
    this->Count += pairs.Births.size();
    const auto hasFaded = [](const SkeletonVertex& particle, double share)
    { return particle.Strength * share == 0.0; };
    if (std::any_of(pairs.Deaths.begin(), pairs.Deaths.end(),
          [&](std::size_t death) { return hasFaded(earlier.Particles[death], 1.0 - fraction); }) ||
      std::any_of(pairs.Births.begin(), pairs.Births.end(),
        [&](std::size_t birth) { return hasFaded(later->Particles[birth], fraction); }))
    {
      this->ListKept(this->Count);
    }
  }
  if (this->Box.Any())
  {
    this->ListCopies();
  }
}

void ParticleTrack::ListCopies()
{
  this->CheckBox(PeriodicBox::GetMargin(std::max(this->Earlier->Particles.GetLargestRadius(),
    this->Fraction > 0.0 ? this->Later->Particles.GetLargestRadius() : 0.0)));
  for (std::size_t n = 0; n < this->Count; ++n)
  {
    const auto particle = static_cast<std::uint32_t>(this->KeptAt(n));
    const SkeletonVertex placed = this->Place(this->OriginOf(particle));
    std::array<int, 2> range[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      range[axis] =
        this->Box.FindCopies(axis, placed.Position[axis], PeriodicBox::GetMargin(placed.Radius));
    }
    for (int x = range[0][0]; x <= range[0][1]; ++x)
    {
      for (int y = range[1][0]; y <= range[1][1]; ++y)
      {
        for (int z = range[2][0]; z <= range[2][1]; ++z)
        {
          this->Copies.push_back({ particle, { x, y, z } });
        }
      }
    }
  }
  this->Count = this->Copies.size();
}

// Throws if particles would need copies in more than four boxes on each side.
void ParticleTrack::CheckBox(double margin) const
{
  constexpr double mostLengths = 4.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = this->Box.Length[axis];
    if (length > 0.0 && margin > mostLengths * length)
    {
      std::ostringstream text;
      text << "PeriodicBounds is " << length << " long along "
           << "xyz"[axis] << ", less than a quarter of " << margin
           << ", the distance up to which particles affect the surface; enlarge PeriodicBounds, or "
              "reduce the radii, KernelRadius or ParticleSpacing.";
      throw std::invalid_argument(text.str());
    }
  }
}

SkeletonVertex ParticleTrack::Get(std::size_t n) const
{
  SkeletonVertex particle = this->Place(this->GetOrigin(n));
  for (std::size_t axis = 0; axis < 3 && !this->Copies.empty(); ++axis)
  {
    particle.Position[axis] += this->Box.Length[axis] * this->Copies[n].BoxLengths[axis];
  }
  return particle;
}

void ParticleTrack::ListKept(std::size_t all)
{
  for (std::size_t n = 0; n < all; ++n)
  {
    const ParticleOrigin origin = this->OriginOf(n);
    const bool isMatched = origin.Earlier != NoPartner && origin.Later != NoPartner;
    if (isMatched || this->Place(origin).Strength != 0.0)
    {
      this->Kept.push_back(static_cast<std::uint32_t>(n));
    }
  }
  this->Count = this->Kept.size();
}

ParticleOrigin ParticleTrack::OriginOf(std::size_t n) const
{
  const std::size_t earlier = this->Earlier->Particles.size();
  return n < earlier ? ParticleOrigin{ n, this->Matches ? this->Matches->Partners[n] : NoPartner }
                     : ParticleOrigin{ NoPartner, this->Matches->Births[n - earlier] };
}

SkeletonVertex ParticleTrack::Place(const ParticleOrigin& origin) const
{
  if (this->Fraction == 0.0)
  {
    return this->Earlier->Particles[origin.Earlier];
  }
  return origin.Later == NoPartner
    ? Faded(this->Earlier->Particles[origin.Earlier], 1.0 - this->Fraction)
    : origin.Earlier == NoPartner ? Faded(this->Later->Particles[origin.Later], this->Fraction)
                                  : this->Between(origin);
}

SkeletonVertex ParticleTrack::Between(const ParticleOrigin& origin) const
{
  const SkeletonVertex from = this->Earlier->Particles[origin.Earlier];
  const SkeletonVertex to = this->Later->Particles[origin.Later];
  SkeletonVertex moved;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double way = this->Box.Nearest(axis, to.Position[axis] - from.Position[axis]);
    moved.Position[axis] = from.Position[axis] + this->Fraction * way;
  }
  const double radius = activesurface::Between(from.Radius, to.Radius, this->Fraction);
  moved.Radius = radius > 0.0 ? radius : to.Radius; // rounding may make it 0
  moved.Strength = activesurface::Between(from.Strength, to.Strength, this->Fraction);
  return moved;
}

void ParticleTrack::List(std::vector<SkeletonVertex>& particles) const
{
  particles.resize(this->Count);
  RunEach(this->Count, [&](std::size_t n) { particles[n] = this->Get(n); });
}

void ParticleTrack::List(
  std::vector<SkeletonVertex>& particles, std::vector<ParticleOrigin>& origins) const
{
  this->List(particles);
  origins.resize(this->Count);
  RunEach(this->Count, [&](std::size_t n) { origins[n] = this->GetOrigin(n); });
}

bool ParticleTrack::FindVelocity(std::size_t n, double (&velocity)[3]) const
{
  return activesurface::FindVelocity(
    this->Earlier, this->Later, this->GetOrigin(n), this->Box, this->Duration, velocity);
}

double ParticleTrack::Interpolate(double earlier, double later, const ParticleOrigin& origin) const
{
  if (this->Fraction == 0.0 || origin.Later == NoPartner)
  {
    return earlier;
  }
  return origin.Earlier == NoPartner ? later
                                     : activesurface::Between(earlier, later, this->Fraction);
}

std::vector<double> ParticleTrack::ListVelocities() const
{
  const bool areGiven = this->Earlier->HasVelocities || (this->Later && this->Later->HasVelocities);
  std::vector<double> velocities(3 * this->Count, std::numeric_limits<double>::quiet_NaN());
  RunEach(this->Count,
    [&](std::size_t n)
    {
      double velocity[3];
      const ParticleOrigin origin = this->GetOrigin(n);
      for (std::size_t axis = 0; areGiven && axis < 3; ++axis)
      {
        velocity[axis] = this->Interpolate(VelocityOf(this->Earlier, origin.Earlier, axis),
          VelocityOf(this->Later, origin.Later, axis), origin);
      }
      if (areGiven || this->FindVelocity(n, velocity))
      {
        std::copy_n(velocity, 3, velocities.data() + 3 * n);
      }
    });
  return velocities;
}

}
