#include "Targets/ParticleWay.h"

namespace activesurface
{

void PlaceParticles(
  const ParticleWay& way, double fraction, const PlacedNeeds& needs, PlacedParticles& placed)
{
  placed.Fits.clear();
  placed.Velocities.clear();
  if (fraction == 0.0 || !way.Later)
  {
    placed.Particles = way.Earlier->Particles;
    FindOriginsOfEarlier(placed.Particles.size(), way.Matches, placed.Origins);
    if (needs.Fits)
    {
      placed.Fits = way.Earlier->Fits;
    }
  }
  else
  {
    InterpolateParticles(
      *way.Earlier, *way.Later, *way.Matches, fraction, placed.Particles, &placed.Origins);
    if (needs.Fits)
    {
      InterpolateFits(*way.Earlier, *way.Later, fraction, placed.Origins, placed.Fits);
    }
  }
  if (needs.Velocities)
  {
    FindMotion(way.Earlier, way.Later, needs.Duration, placed.Origins, placed.Velocities);
  }
}

}
