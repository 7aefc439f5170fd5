#include "Simulation/ParticlesAtTime.h"

#include "Index/ParallelTasks.h"
#include "Targets/TargetFrames.h"

#include <limits>

namespace activesurface
{

namespace
{

// Returns the origins of the later step's particles: their indices in both steps.
std::vector<ParticleOrigin> FindOriginsOfLater(std::size_t count, const ParticleMatches* matches)
{
  std::vector<ParticleOrigin> origins(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    origins[i] = { NoPartner, i };
  }
  for (std::size_t i = 0; matches && i < matches->Partners.size(); ++i)
  {
    if (matches->Partners[i] != NoPartner)
    {
      origins[matches->Partners[i]].Earlier = i;
    }
  }
  return origins;
}

double GetVelocity(const ParticleFrame* frame, std::size_t particle, std::size_t axis)
{
  const bool isKnown = particle != NoPartner && frame->HasVelocities;
  return isKnown ? frame->Velocities[particle][axis] : std::numeric_limits<double>::quiet_NaN();
}

}

ParticlesAtTime FindParticlesAt(
  const TargetFrames& frames, int step, const PeriodicBox& box, double fraction)
{
  ParticlesAtTime moment;
  moment.Earlier = frames.Has(step) ? &frames.GetParticles(step) : nullptr;
  moment.Later = frames.Has(step + 1) ? &frames.GetParticles(step + 1) : nullptr;
  moment.Fraction = fraction;
  moment.Box = box;
  const ParticleMatches* matches = frames.FindMatches(step);
  if (fraction == 1.0)
  {
    const std::vector<ParticleOrigin> origins =
      FindOriginsOfLater(moment.Later->Particles.size(), matches);
    ParticleTrack(*moment.Later, nullptr, nullptr, box, 0.0).List(moment.Particles, moment.Origins);
    for (ParticleOrigin& origin : moment.Origins)
    {
      origin = origins[origin.Earlier];
    }
  }
  else
  {
    frames.GetTrack(step, box, fraction).List(moment.Particles, moment.Origins);
  }
  return moment;
}

double Mix(double earlier, double later, const ParticleOrigin& origin, double fraction)
{
  if (fraction == 0.0 || origin.Later == NoPartner)
  {
    return earlier;
  }
  return fraction == 1.0 || origin.Earlier == NoPartner ? later
                                                        : earlier + fraction * (later - earlier);
}

std::vector<double> ParticlesAtTime::FindVelocities(double duration) const
{
  std::vector<double> velocities;
  const bool given =
    (this->Earlier && this->Earlier->HasVelocities) || (this->Later && this->Later->HasVelocities);
  if (!given)
  {
    velocities.resize(3 * this->Origins.size());
    RunEach(this->Origins.size(),
      [&](std::size_t i)
      {
        double velocity[3];
        const bool isKnown =
          FindVelocity(this->Earlier, this->Later, this->Origins[i], this->Box, duration, velocity);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          velocities[3 * i + axis] =
            isKnown ? velocity[axis] : std::numeric_limits<double>::quiet_NaN();
        }
      });
    return velocities;
  }
  for (const ParticleOrigin& origin : this->Origins)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      velocities.push_back(Mix(GetVelocity(this->Earlier, origin.Earlier, axis),
        GetVelocity(this->Later, origin.Later, axis), origin, this->Fraction));
    }
  }
  return velocities;
}

}
