// What the ranks of a parallel program ask of their filters has to be the same: one skin, one time.

#ifndef RankedRequest_h
#define RankedRequest_h

#include "Agreement.h"
#include "Pipeline/SurfaceProperties.h"
#include "Simulation/Times.h"

#include <functional>

namespace activesurface
{

// A round of the ranks: each tells its settings, what is requested, and where its surface is.
// Returns whether all surfaces are at the same place: if not, all have to start anew. Throws
// std::invalid_argument, with the same sentence on each rank, where requests differ.
bool AgreeOnRequest(Agreement& ranks, const SurfaceProperties& properties,
  const SurfaceSimulation& simulation, int port, PipelineTime time);

// Where memory ends in a task, on this rank or on another one: startAnew(), and an error with this
// sentence.
void RunWithinMemory(
  const std::function<void()>& task, const std::function<void()>& startAnew, const char* sentence);

}

#endif
