#include "Targets/NearParticles.h"

#include "Targets/ParticleParcels.h"

namespace activesurface
{

namespace
{

// fit: if there are.
void AddParticle(const SkeletonVertex& particle, const ParticleFit* fit, ParticleFrame& frame)
{
  frame.Particles.push_back(particle);
  if (fit)
  {
    frame.Fits.push_back(*fit);
  }
}

char IsCounted(const SkeletonVertex& particle, const OwnPlaces* places)
{
  return !places || places->Has(particle.Position) ? 1 : 0;
}

}

void NearParticles::Choose(const ParticleWay& whole, const OwnPlaces* places)
{
  *this = NearParticles();
  this->HasLater = whole.Later != nullptr;
  const ParticleParcels parcels = SendParcels(whole, places);
  this->MakeRoom(parcels);
  for (const std::size_t n : parcels.Order)
  {
    this->Add(parcels, n, places);
  }
}

// No more than is needed.
void NearParticles::MakeRoom(const ParticleParcels& parcels)
{
  std::size_t earlier = 0, later = 0;
  for (const ParticleParcel& parcel : parcels.Parcels)
  {
    earlier += parcel.HasEarlier ? 1 : 0;
    later += parcel.HasLater ? 1 : 0;
  }
  this->Earlier.Particles.reserve(earlier);
  this->Later.Particles.reserve(later);
  this->Earlier.Fits.reserve(parcels.FitsOfEach > 0 ? earlier : 0);
  this->Later.Fits.reserve(parcels.FitsOfEach > 1 ? later : 0);
}

void NearParticles::Add(const ParticleParcels& parcels, std::size_t n, const OwnPlaces* places)
{
  const ParticleParcel& parcel = parcels.Parcels[n];
  const ParticleFit* fits =
    parcels.FitsOfEach > 0 ? &parcels.Fits[parcels.FitsOfEach * n] : nullptr;
  const std::size_t later = this->Later.Particles.size();
  if (parcel.HasLater)
  {
    AddParticle(parcel.Later, fits ? fits + 1 : nullptr, this->Later);
    this->CountsLater.push_back(parcel.HasEarlier ? 0 : IsCounted(parcel.Later, places));
  }
  if (!parcel.HasEarlier)
  {
    this->Matches.Births.push_back(later);
    return;
  }
  AddParticle(parcel.Earlier, fits, this->Earlier);
  this->CountsEarlier.push_back(IsCounted(parcel.Earlier, places));
  this->Matches.Partners.push_back(parcel.HasLater ? later : NoPartner);
}

ParticleWay NearParticles::GetWay() const
{
  ParticleWay way{ &this->Earlier };
  way.Later = this->HasLater ? &this->Later : nullptr;
  way.Matches = this->HasLater ? &this->Matches : nullptr;
  return way;
}

}
