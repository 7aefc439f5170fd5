#include "Targets/NearParticles.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// As far as a hollow beside a particle is sought, in its Outward.
constexpr double FarthestHollow = 1.5;

// Where a particle may add something on its way: between its ends, as its fits are.
class WayBox
{
public:
  void AddEnd(const ParticleFrame& frame, std::size_t i)
  {
    const SkeletonVertex& particle = frame.Particles[i];
    this->Reach = std::max(this->Reach, particle.Radius);
    this->Add(particle.Position, nullptr, 0.0, this->Centres);
    if (!frame.Fits.empty())
    {
      const ParticleFit& fit = frame.Fits[i];
      this->Reach = std::max(this->Reach, fit.Reach);
      this->Add(particle.Position, fit.Offset, 1.0, this->Centres);
      this->Add(particle.Position, fit.Outward, FarthestHollow, this->Hollows);
    }
  }

  bool Touches(const OwnPlaces& places) const
  {
    double bounds[6];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int low = 2 * axis, high = low + 1;
      bounds[low] = std::min(this->Centres[low] - this->Reach, this->Hollows[low]);
      bounds[high] = std::max(this->Centres[high] + this->Reach, this->Hollows[high]);
    }
    return places.Touches(bounds);
  }

private:
  static void Add(const double* position, const double* offset, double factor, double* box)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double x = position[axis] + (offset ? factor * offset[axis] : 0.0);
      box[2 * axis] = std::min(box[2 * axis], x);
      box[2 * axis + 1] = std::max(box[2 * axis + 1], x);
    }
  }

  double Centres[6] = { HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL };
  double Hollows[6] = { HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL };
  double Reach = 0.0;
};

void Add(const ParticleFrame& whole, std::size_t i, ParticleFrame& chosen)
{
  chosen.Particles.push_back(whole.Particles[i]);
  if (!whole.Fits.empty())
  {
    chosen.Fits.push_back(whole.Fits[i]);
  }
}

template <class IsNear>
std::vector<char> FindNear(std::size_t count, IsNear&& isNear)
{
  std::vector<char> near(count);
  RunEach(count, [&](std::size_t n) { near[n] = isNear(n) ? 1 : 0; });
  return near;
}

}

void NearParticles::Choose(const ParticleWay& whole, const OwnPlaces& places)
{
  *this = NearParticles();
  this->HasLater = whole.Later != nullptr;
  this->HasShares = whole.SharesOfMotion != nullptr;
  this->ChooseEarlier(whole, places);
  if (whole.Later)
  {
    this->ChooseBirths(whole, places);
  }
}

void NearParticles::ChooseEarlier(const ParticleWay& whole, const OwnPlaces& places)
{
  const ParticleFrame& earlier = *whole.Earlier;
  const auto partnerOf = [&whole](std::size_t i)
  { return whole.Later ? whole.Matches->Partners[i] : NoPartner; };
  const std::vector<char> near = FindNear(earlier.Particles.size(),
    [&](std::size_t i)
    {
      WayBox box;
      box.AddEnd(earlier, i);
      if (partnerOf(i) != NoPartner)
      {
        box.AddEnd(*whole.Later, partnerOf(i));
      }
      return box.Touches(places);
    });
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    if (near[i])
    {
      this->AddEarlier(earlier, i, places.Has(earlier.Particles[i].Position));
      const std::size_t partner = partnerOf(i);
      this->Matches.Partners.push_back(
        partner != NoPartner ? this->AddLater(*whole.Later, partner, false) : NoPartner);
      if (whole.SharesOfMotion)
      {
        this->SharesOfMotion.push_back((*whole.SharesOfMotion)[i]);
      }
    }
  }
}

void NearParticles::ChooseBirths(const ParticleWay& whole, const OwnPlaces& places)
{
  const std::vector<std::size_t>& births = whole.Matches->Births;
  const std::vector<char> near = FindNear(births.size(),
    [&](std::size_t n)
    {
      WayBox box;
      box.AddEnd(*whole.Later, births[n]);
      return box.Touches(places);
    });
  for (std::size_t n = 0; n < near.size(); ++n)
  {
    if (near[n])
    {
      const bool counts = places.Has(whole.Later->Particles[births[n]].Position);
      this->Matches.Births.push_back(this->AddLater(*whole.Later, births[n], counts));
    }
  }
}

void NearParticles::AddEarlier(const ParticleFrame& whole, std::size_t i, bool counts)
{
  Add(whole, i, this->Earlier);
  this->CountsEarlier.push_back(counts ? 1 : 0);
}

std::size_t NearParticles::AddLater(const ParticleFrame& whole, std::size_t i, bool counts)
{
  Add(whole, i, this->Later);
  this->CountsLater.push_back(counts ? 1 : 0);
  return this->CountsLater.size() - 1;
}

ParticleWay NearParticles::GetWay() const
{
  ParticleWay way{ &this->Earlier };
  way.Later = this->HasLater ? &this->Later : nullptr;
  way.Matches = this->HasLater ? &this->Matches : nullptr;
  way.SharesOfMotion = this->HasShares ? &this->SharesOfMotion : nullptr;
  return way;
}

}
