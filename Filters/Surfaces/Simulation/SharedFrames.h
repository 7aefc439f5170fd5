// Distributed frames of particles. Each rank owns some of the particles of a frame. Before the
// surface moves, each rank receives all particles near its partition of space.

#ifndef SharedFrames_h
#define SharedFrames_h

#include "Frames/ParticleMatches.h"
#include "Targets/InputShape.h"
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
  // Keeps a reference to the shapes.
  explicit SharedFrames(TargetBuilder& shapes)
    : Shapes(shapes)
  {
  }

  void Clear() { this->OwnedFrames.Clear(); }

  // Adds a frame, which the caller also adds to the shapes.
  void Add(int step, const std::shared_ptr<InputShape>& shape);

  // Partitions space for a band that is at the step `first` or starts there. Sends to each rank the
  // particles of the steps `first` to `last` near the rank's partition. If one of these frames is
  // missing or not distributed, gathers band and frames on all ranks instead. Collective.
  void Place(NarrowBand& band, int first, int last);

  // Gathers the particles of distributed steps on all ranks. Collective.
  void MakeWhole(int first, int last);

private:
  bool ArePlaceable(int first, int last) const;
  std::shared_ptr<const Domain> ShareSpace(const NarrowBand& band, int last) const;
  ParticleMatches MatchOwned(int first) const;
  void Send(int first, int last, const ParticleMatches& matches, const Domain& space);

  TargetBuilder& Shapes;
  TargetFrames
    OwnedFrames; // particles that this rank owns; NoShape for a frame that is not distributed
};

}

#endif
