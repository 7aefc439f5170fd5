#include "Targets/NearParticles.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  void AddEnd(const WayEnd& end)
  {
    const SkeletonVertex& particle = end.Particle;
    this->Reach = std::max(this->Reach, particle.Radius);
    this->Add(particle.Position, nullptr, 0.0, this->Centres);
    if (end.Fit)
    {
      this->Reach = std::max(this->Reach, end.Fit->Reach);
      this->Add(particle.Position, end.Fit->Offset, 1.0, this->Centres);
      this->Add(particle.Position, end.Fit->Outward, FarthestHollow, this->Hollows);
    }
  }

  // The same or more, where the fit is known by its bounds alone.
  void AddEnd(const SkeletonVertex& particle, const FitBounds& bounds)
  {
    constexpr double rounding = 1.0 + 1e-9;
    const double reach = std::max(bounds.Reach + bounds.Offset, FarthestHollow * bounds.Outward);
    this->Reach = std::max(this->Reach, rounding * reach * particle.Radius);
    this->Add(particle.Position, nullptr, 0.0, this->Centres);
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

void AddEnd(const WayEnd& end, ParticleFrame& chosen)
{
  chosen.Particles.push_back(end.Particle);
  if (end.Fit)
  {
    chosen.Fits.push_back(*end.Fit);
  }
}

bool IsNear(const WayBox& box, const OwnPlaces* places)
{
  return !places || box.Touches(*places);
}

char IsCounted(const WayEnd& end, const OwnPlaces* places)
{
  return !places || places->Has(end.Particle.Position) ? 1 : 0;
}

// Those of the numbers up to count for which isNear(number).
template <class Predicate>
std::vector<std::size_t> ListNear(std::size_t count, Predicate&& isNear)
{
  std::vector<char> near(count);
  RunEach(count, [&](std::size_t n) { near[n] = isNear(n) ? 1 : 0; });
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < count; ++n)
  {
    if (near[n])
    {
      numbers.push_back(n);
    }
  }
  return numbers;
}

// Some particles of a frame, with what is known of them.
struct Picked
{
  const std::vector<SkeletonVertex>* Particles;
  std::vector<std::size_t> Numbers;
  ParticleFits Fits; // of these, or empty

  WayEnd GetEnd(std::size_t n) const
  {
    return { (*this->Particles)[this->Numbers[n]], this->Fits.empty() ? nullptr : &this->Fits[n] };
  }
};

FitBounds FindBounds(const ParticleFrame& frame)
{
  if (frame.Shared)
  {
    return frame.Shared->GetBounds();
  }
  FitBounds bounds;
  for (std::size_t i = 0; i < frame.Fits.size(); ++i)
  {
    bounds.Add(frame.Particles[i], frame.Fits[i]);
  }
  return bounds;
}

// A round of ranks, if they are shared. known: of all particles, or of those at home.
template <class Values>
Values PickKnown(
  const ParticleFrame& frame, const std::vector<std::size_t>& numbers, const Values& known)
{
  if (frame.Shared)
  {
    return frame.Shared->Fetch(frame.Particles, numbers, known);
  }
  Values picked;
  picked.reserve(known.empty() ? 0 : numbers.size());
  for (std::size_t n = 0; n < numbers.size() && !known.empty(); ++n)
  {
    picked.push_back(known[numbers[n]]);
  }
  return picked;
}

Picked Pick(const ParticleFrame& frame, std::vector<std::size_t> numbers)
{
  ParticleFits fits =
    PickKnown(frame, numbers, frame.Shared ? frame.Shared->GetAtHome() : frame.Fits);
  return { &frame.Particles, std::move(numbers), std::move(fits) };
}

std::size_t FindPartner(const ParticleWay& whole, std::size_t i)
{
  return whole.Later ? whole.Matches->Partners[i] : NoPartner;
}

}

// Those that may be near, by the bounds of the fits.
struct NearParticles::Candidates
{
  Picked Earlier;
  Picked Later;                       // the partners, then the births
  std::size_t Births;                 // how many
  std::vector<double> SharesOfMotion; // of the earlier ones, or empty

  Candidates(const ParticleWay& whole, const OwnPlaces* places)
  {
    std::vector<std::size_t> earlier = ListEarlier(whole, places), later;
    for (const std::size_t i : earlier)
    {
      if (FindPartner(whole, i) != NoPartner)
      {
        later.push_back(FindPartner(whole, i));
      }
    }
    const std::vector<std::size_t> births = ListBirths(whole, places);
    later.insert(later.end(), births.begin(), births.end());
    this->Births = births.size();
    this->Earlier = Pick(*whole.Earlier, std::move(earlier));
    if (whole.Later)
    {
      this->Later = Pick(*whole.Later, std::move(later));
    }
    if (whole.SharesOfMotion)
    {
      this->SharesOfMotion =
        PickKnown(*whole.Earlier, this->Earlier.Numbers, *whole.SharesOfMotion);
    }
  }

private:
  static std::vector<std::size_t> ListEarlier(const ParticleWay& whole, const OwnPlaces* places)
  {
    FitBounds bounds = FindBounds(*whole.Earlier); // of both ends: one may be wide, the other far
    bounds.Add(whole.Later ? FindBounds(*whole.Later) : FitBounds());
    return ListNear(whole.Earlier->Particles.size(),
      [&](std::size_t i)
      {
        WayBox box;
        box.AddEnd(whole.Earlier->Particles[i], bounds);
        const std::size_t partner = FindPartner(whole, i);
        if (partner != NoPartner)
        {
          box.AddEnd(whole.Later->Particles[partner], bounds);
        }
        return IsNear(box, places);
      });
  }

  static std::vector<std::size_t> ListBirths(const ParticleWay& whole, const OwnPlaces* places)
  {
    if (!whole.Later)
    {
      return {};
    }
    const FitBounds later = FindBounds(*whole.Later);
    std::vector<std::size_t> births;
    for (const std::size_t birth : whole.Matches->Births)
    {
      WayBox box;
      box.AddEnd(whole.Later->Particles[birth], later);
      if (IsNear(box, places))
      {
        births.push_back(birth);
      }
    }
    return births;
  }
};

void NearParticles::Choose(const ParticleWay& whole, const OwnPlaces* places)
{
  *this = NearParticles();
  this->HasLater = whole.Later != nullptr;
  this->HasShares = whole.SharesOfMotion != nullptr;
  const Candidates candidates(whole, places);
  this->AddEarlier(whole, places, candidates);
  this->AddBirths(places, candidates);
}

std::size_t NearParticles::AddLater(const WayEnd& end, char isCounted)
{
  AddEnd(end, this->Later);
  this->CountsLater.push_back(isCounted);
  return this->CountsLater.size() - 1;
}

void NearParticles::AddEarlier(
  const ParticleWay& whole, const OwnPlaces* places, const Candidates& candidates)
{
  this->Earlier.Particles.reserve(candidates.Earlier.Numbers.size());
  this->Earlier.Fits.reserve(candidates.Earlier.Fits.size());
  this->Later.Particles.reserve(candidates.Later.Numbers.size());
  this->Later.Fits.reserve(candidates.Later.Fits.size());
  std::size_t next = 0;
  for (std::size_t n = 0; n < candidates.Earlier.Numbers.size(); ++n)
  {
    const WayEnd end = candidates.Earlier.GetEnd(n);
    const bool hasPartner = FindPartner(whole, candidates.Earlier.Numbers[n]) != NoPartner;
    const std::size_t partner = hasPartner ? next++ : NoPartner;
    WayBox box;
    box.AddEnd(end);
    if (hasPartner)
    {
      box.AddEnd(candidates.Later.GetEnd(partner));
    }
    if (!IsNear(box, places))
    {
      continue;
    }
    AddEnd(end, this->Earlier);
    this->CountsEarlier.push_back(IsCounted(end, places));
    if (!candidates.SharesOfMotion.empty())
    {
      this->SharesOfMotion.push_back(candidates.SharesOfMotion[n]);
    }
    this->Matches.Partners.push_back(
      hasPartner ? this->AddLater(candidates.Later.GetEnd(partner), 0) : NoPartner);
  }
}

void NearParticles::AddBirths(const OwnPlaces* places, const Candidates& candidates)
{
  const std::size_t end = candidates.Later.Numbers.size();
  for (std::size_t n = end - candidates.Births; n < end; ++n)
  {
    const WayEnd birth = candidates.Later.GetEnd(n);
    WayBox box;
    box.AddEnd(birth);
    if (IsNear(box, places))
    {
      this->Matches.Births.push_back(this->AddLater(birth, IsCounted(birth, places)));
    }
  }
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
