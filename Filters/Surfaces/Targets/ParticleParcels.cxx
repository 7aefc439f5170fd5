#include "Targets/ParticleParcels.h"

#include "NumberedValues.h"
#include "ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace activesurface
{

namespace
{

constexpr std::size_t InRound = 16384; // so that messages take little memory

// As far as a hollow beside a particle is sought, in its Outward.
constexpr double FarthestHollow = 1.5;

// Where a particle may add something on its way: between its ends, as its fits are.
class WayBox
{
public:
  // fit: null without.
  void AddEnd(const SkeletonVertex& particle, const ParticleFit* fit)
  {
    this->Reach = std::max(this->Reach, particle.Radius);
    Add(particle.Position, nullptr, 0.0, this->Centres);
    if (fit)
    {
      this->Reach = std::max(this->Reach, fit->Reach);
      Add(particle.Position, fit->Offset, 1.0, this->Centres);
      Add(particle.Position, fit->Outward, FarthestHollow, this->Hollows);
    }
  }

  void GetBounds(double bounds[6]) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int low = 2 * axis, high = low + 1;
      bounds[low] = std::min(this->Centres[low] - this->Reach, this->Hollows[low]);
      bounds[high] = std::max(this->Centres[high] + this->Reach, this->Hollows[high]);
    }
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

// The fits of the partners of those at home, in their order; others have none.
std::vector<ParticleFit> FetchFitsOfPartners(const ParticleWay& way)
{
  const std::vector<std::size_t>& partners = way.Matches->Partners;
  const SharedParticles& later = *way.Later->Shared;
  std::vector<std::vector<std::size_t>> asked(static_cast<std::size_t>(later.Ranks.GetSize()));
  std::vector<std::size_t> homes(partners.size());
  for (std::size_t i = 0; i < partners.size(); ++i)
  {
    if (partners[i] != NoPartner)
    {
      homes[i] = static_cast<std::size_t>(later.Homes->FindHome(way.Matches->Ends[i].Position));
      asked[homes[i]].push_back(partners[i]);
    }
  }
  const std::vector<std::vector<ParticleFit>> answers =
    AnswerNumbered(later.Ranks, asked, later.Numbers, way.Later->Fits);
  std::vector<std::size_t> next(answers.size(), 0);
  std::vector<ParticleFit> fits(partners.size());
  for (std::size_t i = 0; i < partners.size(); ++i)
  {
    if (partners[i] != NoPartner)
    {
      fits[i] = answers[homes[i]][next[homes[i]]++];
    }
  }
  return fits;
}

// Whether there are fits of all particles.
bool HaveFits(const ParticleWay& way)
{
  const auto haveFits = [](const ParticleFrame* frame)
  { return !frame || frame->HasFits || frame->CountAll() == 0; };
  return haveFits(way.Earlier) && haveFits(way.Later);
}

// The particles at home, and who is to be told of them.
class Sender
{
public:
  Sender(const ParticleWay& way, const OwnPlaces* places)
    : Way(way)
    , Places(places)
    , Ranks((way.Earlier->Shared ? *way.Earlier : *way.Later).Shared->Ranks)
    , Earlier(way.Earlier->Particles.size())
    , HasFits(HaveFits(way))
    , FitsOfEach(!this->HasFits ? 0
          : way.Later           ? 2
                                : 1)
  {
    if (this->HasFits && way.Earlier->Shared && way.Later && way.Later->Shared)
    {
      this->FitsOfPartners = FetchFitsOfPartners(way);
    }
  }

  ParticleParcels Send() const
  {
    ParticleParcels all;
    all.FitsOfEach = this->FitsOfEach;
    const std::size_t rounds = this->CountRounds();
    for (std::size_t round = 0; round < rounds; ++round)
    {
      const std::size_t first = std::min(round * InRound, this->Count());
      this->SendSome(first, std::min(first + InRound, this->Count()), all);
    }
    return all;
  }

private:
  std::size_t Count() const
  {
    return this->Earlier + (this->Way.Later ? this->Way.Matches->Births.size() : 0);
  }

  // The most that a rank needs.
  std::size_t CountRounds() const
  {
    const std::vector<std::size_t> all = GatherValues(this->Ranks, this->Count());
    return (*std::max_element(all.begin(), all.end()) + InRound - 1) / InRound;
  }

  void SendSome(std::size_t first, std::size_t end, ParticleParcels& all) const
  {
    const auto size = static_cast<std::size_t>(this->Ranks.GetSize());
    std::vector<std::vector<int>> wanted(end - first);
    RunEach(end - first, [&](std::size_t n) { this->FindRanks(first + n, wanted[n]); });
    std::vector<std::vector<ParticleParcel>> parcels(size);
    std::vector<std::vector<ParticleFit>> fits(size);
    for (std::size_t n = 0; n < wanted.size(); ++n)
    {
      const ParticleParcel parcel = this->GetParcel(first + n);
      for (const int rank : wanted[n])
      {
        parcels[static_cast<std::size_t>(rank)].push_back(parcel);
        this->AddFits(first + n, fits[static_cast<std::size_t>(rank)]);
      }
    }
    const std::vector<ParticleParcel> told = SwapAll(this->Ranks, std::move(parcels));
    all.Parcels.insert(all.Parcels.end(), told.begin(), told.end());
    if (this->HasFits)
    {
      const std::vector<ParticleFit> some = SwapAll(this->Ranks, std::move(fits));
      all.Fits.insert(all.Fits.end(), some.begin(), some.end());
    }
  }

  bool IsBirth(std::size_t n) const { return n >= this->Earlier; }
  std::size_t GetBirth(std::size_t n) const { return this->Way.Matches->Births[n - this->Earlier]; }
  const SkeletonVertex* FindEnd(std::size_t n) const
  {
    return this->Way.Later ? this->Way.Matches->FindEnd(n, *this->Way.Later) : nullptr;
  }

  ParticleParcel GetParcel(std::size_t n) const
  {
    if (this->IsBirth(n))
    {
      const std::size_t birth = this->GetBirth(n);
      return { this->Way.Later->Shared->Numbers[birth], false, true, {},
        this->Way.Later->Particles[birth] };
    }
    const SkeletonVertex* end = this->FindEnd(n);
    return { this->Way.Earlier->Shared->Numbers[n], true, end != nullptr,
      this->Way.Earlier->Particles[n], end ? *end : SkeletonVertex{} };
  }

  // Null for an end that is not there, or without fits.
  const ParticleFit* FindFit(std::size_t n, bool isLater) const
  {
    if (!this->HasFits || (this->IsBirth(n) && !isLater))
    {
      return nullptr;
    }
    if (this->IsBirth(n))
    {
      return &this->Way.Later->Fits[this->GetBirth(n)];
    }
    if (isLater)
    {
      return this->FindEnd(n) ? &this->FitsOfPartners[n] : nullptr;
    }
    return &this->Way.Earlier->Fits[n];
  }

  void AddFits(std::size_t n, std::vector<ParticleFit>& fits) const
  {
    for (std::size_t end = 0; end < this->FitsOfEach; ++end)
    {
      const ParticleFit* fit = this->FindFit(n, end > 0);
      fits.push_back(fit ? *fit : ParticleFit());
    }
  }

  void FindRanks(std::size_t n, std::vector<int>& ranks) const
  {
    if (!this->Places)
    {
      ranks.resize(static_cast<std::size_t>(this->Ranks.GetSize()));
      std::iota(ranks.begin(), ranks.end(), 0);
      return;
    }
    WayBox box;
    if (!this->IsBirth(n))
    {
      box.AddEnd(this->Way.Earlier->Particles[n], this->FindFit(n, false));
    }
    if (const SkeletonVertex* end =
          this->IsBirth(n) ? &this->Way.Later->Particles[this->GetBirth(n)] : this->FindEnd(n))
    {
      box.AddEnd(*end, this->FindFit(n, true));
    }
    double bounds[6];
    box.GetBounds(bounds);
    this->Places->FindRanks(bounds, ranks);
  }

  const ParticleWay& Way;
  const OwnPlaces* Places;
  Agreement& Ranks;
  const std::size_t Earlier; // how many; births come after them
  const bool HasFits;
  const std::size_t FitsOfEach;
  std::vector<ParticleFit> FitsOfPartners; // of the earlier ones
};

std::vector<std::size_t> FindOrder(const std::vector<ParticleParcel>& parcels)
{
  std::vector<std::size_t> order(parcels.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto keyOf = [&](std::size_t n)
  { return std::pair(!parcels[n].HasEarlier, parcels[n].Number); };
  std::sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keyOf(a) < keyOf(b); });
  return order;
}

}

ParticleParcels SendParcels(const ParticleWay& way, const OwnPlaces* places)
{
  ParticleParcels parcels = Sender(way, places).Send();
  parcels.Order = FindOrder(parcels.Parcels);
  return parcels;
}

}
