// The frames of particles where each rank has a part: before the surface moves, each rank gets the
// particles near its part of space.

#ifndef SharedFrames_h
#define SharedFrames_h

#include "Targets/InputShape.h"
#include "Targets/ParticleMatches.h"
#include "Targets/TargetFrames.h"

#include <memory>

namespace activesurface
{

class Domain;
class NarrowBand;
class TargetBuilder;

class SharedFrames
{
public:
  // The shapes are the caller's.
  explicit SharedFrames(TargetBuilder& shapes)
    : Shapes(shapes)
  {
  }

  void Clear() { this->Homes.Clear(); }

  // A frame that has been added to the shapes too.
  void Add(int step, const std::shared_ptr<InputShape>& shape);

  // Shares out space for the next frame of a band, which is at the step `first` or starts there,
  // and gives each rank the particles of the steps up to `last` near its part. Makes band and
  // frames whole where the frames are. Collective, if there are several ranks.
  void Place(NarrowBand& band, int first, int last);

  // Gives all ranks all particles of the steps. Collective, if there are several ranks.
  void MakeWhole(int first, int last);

private:
  bool ArePlaceable(int first, int last) const;
  std::shared_ptr<const Domain> ShareSpace(const NarrowBand& band, int last) const;
  ParticleMatches MatchHomes(int first) const;
  void Send(int first, int last, const ParticleMatches& matches, const Domain& space);

  TargetBuilder& Shapes;
  TargetFrames Homes; // without the shapes that are whole on each rank
};

}

#endif
