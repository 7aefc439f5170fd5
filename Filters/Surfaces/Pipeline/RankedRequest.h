// Checks that all ranks of a parallel program request the same skin, and reports lack of memory.

#ifndef RankedRequest_h
#define RankedRequest_h

#include "Pipeline/SurfaceProperties.h"
#include "Ranks/Agreement.h"
#include "Simulation/Times.h"

#include <functional>
#include <string>

namespace activesurface
{

// Request of one output.
struct OutputRequest
{
  int Port;
  PipelineTime Time;
  std::string Velocities; // describes the array of the particles' velocities; empty: not needed
};

// Compares the settings, the request and the state of the surface on all ranks. Returns false if
// the states differ: then all ranks must restart. Throws std::invalid_argument, with the same
// message on each rank, if settings or requests differ. Collective.
bool AgreeOnRequest(Agreement& ranks, const SurfaceProperties& properties,
  const SurfaceSimulation& simulation, const OutputRequest& output);

// Runs a task. After std::bad_alloc or RankMemoryError, calls startAnew() and throws
// std::runtime_error with the given sentence.
void RunWithinMemory(
  const std::function<void()>& task, const std::function<void()>& startAnew, const char* sentence);

}

#endif
