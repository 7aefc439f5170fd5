/**
 * Weights of tension through an implicit substep: they are known at the nodes that were active when
 * the target was sampled, and wanted at those that are when the stages begin.
 */
#ifndef StageWeights_h
#define StageWeights_h

#include "Leaves/ActiveSet.h"
#include "Motion.h"

#include <vector>

namespace activesurface
{

struct SubstepBuffers;

class StageWeights
{
public:
  /** To be called when the weights of the active leaves have been extended. */
  void Remember(const ActiveSet& set, const SubstepBuffers& buffers);

  /** Nodes that have entered the band get theirs from those that were there; else it is 1. */
  void ExtendToEntered(
    const LeafTable& table, const ActiveSet& set, const Motion& motion, SubstepBuffers& buffers);

private:
  std::vector<LeafMask> Known;
};

}

#endif
