#include "Targets/NearParticles.h"

#include "MotionNoise.h"
#include "ParallelTasks.h"
#include "ParticleLengths.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace activesurface
{

namespace
{

// As far as a hollow beside a particle is sought, in its Outward.
constexpr double FarthestHollow = 1.5;

// Where a particle may count on its way: between its ends, as its fits are.
class WayBox
{
public:
  // Of a fit that is not known.
  void AddEnd(const double position[3], double influence)
  {
    this->Reach = std::max(this->Reach, influence);
    this->Add(position, nullptr, 0.0, this->Centres);
  }

  void AddEnd(const SkeletonVertex& particle, const ParticleFit& fit)
  {
    this->AddEnd(particle.Position, std::max(particle.Radius, fit.Reach));
    this->Add(particle.Position, fit.Offset, 1.0, this->Centres);
    this->Add(particle.Position, fit.Outward, FarthestHollow, this->Hollows);
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

// The particles at an end of the way: what of their fits is known.
class WayEnd
{
public:
  explicit WayEnd(const ParticleFrame& frame)
    : Frame(frame)
    , LargestReach(FindLargestRadius(frame.Particles))
  {
  }

  // Comes before GetFits and FindFit; ascending.
  void Fit(const std::vector<std::size_t>& wanted)
  {
    this->Fits = this->Frame.Fits.AreWanted()
      ? &this->Frame.Fits.GetSome(this->Frame.Particles, wanted)
      : nullptr;
  }

  // The same; null where nobody wants any, as of no particles.
  const SomeFits* GetFits() const { return this->Fits; }
  double GetLargestReach() const { return this->LargestReach; }

  // Among those that are fitted, of which it is one.
  std::size_t FindPlace(std::size_t i) const
  {
    const std::vector<std::size_t>& numbers = this->Fits->Numbers;
    const auto at = std::lower_bound(numbers.begin(), numbers.end(), i);
    return static_cast<std::size_t>(at - numbers.begin());
  }

  // Null where nobody wants any.
  const ParticleFit* FindFit(std::size_t i) const
  {
    return this->Fits ? &this->Fits->Fits[this->FindPlace(i)] : nullptr;
  }

  const ParticleFrame& GetFrame() const { return this->Frame; }

  void AddTo(ParticleFrame& chosen, std::size_t i) const
  {
    chosen.Particles.push_back(this->Frame.Particles[i]);
    if (const ParticleFit* fit = this->FindFit(i))
    {
      chosen.Fits.Add(*fit);
    }
  }

  // By its fit, if this is known.
  void AddTo(WayBox& box, std::size_t i) const
  {
    const SkeletonVertex& particle = this->Frame.Particles[i];
    const ParticleFit* fit = this->FindFit(i);
    fit ? box.AddEnd(particle, *fit)
        : box.AddEnd(particle.Position,
            this->Frame.Fits.GetFarthestInfluence(particle.Radius, this->LargestReach));
  }

private:
  const ParticleFrame& Frame;
  const double LargestReach;
  const SomeFits* Fits = nullptr;
};

template <class IsNear>
std::vector<std::size_t> Keep(const std::vector<std::size_t>& numbers, IsNear&& isNear)
{
  std::vector<char> near(numbers.size());
  RunEach(numbers.size(), [&](std::size_t n) { near[n] = isNear(numbers[n]) ? 1 : 0; });
  std::vector<std::size_t> kept;
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    if (near[n])
    {
      kept.push_back(numbers[n]);
    }
  }
  return kept;
}

std::vector<std::size_t> ListAll(std::size_t count)
{
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

}

// Particles of the whole way, and which of them are near.
struct NearParticles::Choice
{
  Choice(const ParticleWay& whole, const OwnPlaces& places)
    : Whole(whole)
    , Places(places)
    , AtBegin(*whole.Earlier)
    , AtEnd(whole.Later ? *whole.Later : *whole.Earlier)
    , Earlier(ListAll(whole.Earlier->Particles.size()))
  {
    if (whole.Later)
    {
      this->Births = whole.Matches->Births;
    }
  }

  std::size_t GetPartner(std::size_t earlier) const
  {
    return this->Whole.Later ? this->Whole.Matches->Partners[earlier] : NoPartner;
  }

  // By what is known of their fits.
  void Narrow()
  {
    this->Earlier = Keep(this->Earlier,
      [this](std::size_t i)
      {
        WayBox box;
        this->AtBegin.AddTo(box, i);
        if (this->GetPartner(i) != NoPartner)
        {
          this->AtEnd.AddTo(box, this->GetPartner(i));
        }
        return box.Touches(this->Places);
      });
    this->Births = Keep(this->Births,
      [this](std::size_t i)
      {
        WayBox box;
        this->AtEnd.AddTo(box, i);
        return box.Touches(this->Places);
      });
  }

  void Fit()
  {
    this->AtBegin.Fit(this->Earlier);
    std::vector<std::size_t> later = this->Births;
    for (const std::size_t i : this->Earlier)
    {
      if (this->GetPartner(i) != NoPartner)
      {
        later.push_back(this->GetPartner(i));
      }
    }
    if (this->Whole.Later)
    {
      std::sort(later.begin(), later.end());
      this->AtEnd.Fit(later);
    }
  }

  // By the motions of all neighbours, of those that have been fitted.
  void FindShares()
  {
    const SomeFits* some = this->AtBegin.GetFits();
    if (!some)
    {
      return;
    }
    std::vector<SkeletonVertex> particles;
    std::vector<ParticleOrigin> origins;
    for (const std::size_t i : some->Numbers)
    {
      particles.push_back(this->Whole.Earlier->Particles[i]);
      origins.push_back({ i, this->GetPartner(i) });
    }
    std::vector<double> velocities;
    FindMotion(this->Whole.Earlier, this->Whole.Later, 1.0, origins, velocities);
    this->Shares = FindSharesOfMotion(particles, some->Fits, velocities,
      MovingPart{ some->AreWhole, this->AtBegin.GetLargestReach() });
  }

  double FindShare(std::size_t earlier) const
  {
    return this->Shares[this->AtBegin.FindPlace(earlier)];
  }

  const ParticleWay& Whole;
  const OwnPlaces& Places;
  WayEnd AtBegin;
  WayEnd AtEnd;
  std::vector<std::size_t> Earlier; // ascending, and so are births
  std::vector<std::size_t> Births;
  std::vector<double> Shares; // of motion, of those that have been fitted
};

void NearParticles::Choose(const ParticleWay& whole, const OwnPlaces& places, bool leavesNoise)
{
  *this = NearParticles();
  this->HasLater = whole.Later != nullptr;
  this->HasShares = leavesNoise && this->HasLater;
  Choice choice(whole, places);
  choice.Narrow();
  choice.Fit();
  if (this->HasShares)
  {
    choice.FindShares();
  }
  choice.Narrow();
  this->Add(choice);
}

void NearParticles::Add(const Choice& choice)
{
  const auto isOwn = [&choice](const ParticleFrame& frame, std::size_t i)
  { return choice.Places.Has(frame.Particles[i].Position); };
  const ParticleFrame& earlier = choice.AtBegin.GetFrame();
  const ParticleFrame& later = choice.AtEnd.GetFrame();
  for (const std::size_t i : choice.Earlier)
  {
    choice.AtBegin.AddTo(this->Earlier, i);
    this->CountsEarlier.push_back(isOwn(earlier, i) ? 1 : 0);
    const std::size_t partner = choice.GetPartner(i);
    this->Matches.Partners.push_back(
      partner != NoPartner ? this->AddLater(choice, partner, false) : NoPartner);
    if (this->HasShares)
    {
      this->SharesOfMotion.push_back(choice.FindShare(i));
    }
  }
  for (const std::size_t i : choice.Births)
  {
    this->Matches.Births.push_back(this->AddLater(choice, i, isOwn(later, i)));
  }
}

std::size_t NearParticles::AddLater(const Choice& choice, std::size_t i, bool counts)
{
  choice.AtEnd.AddTo(this->Later, i);
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
