// Warns if the motion restarts because the input's data were replaced between requests for two
// ascending times, as in a loop that is meant to animate the skin.

#ifndef RestartWarning_h
#define RestartWarning_h

#include "Simulation/SurfaceSettings.h"
#include "Simulation/Times.h"

#include <limits>

namespace activesurface
{

class Warnings;

class RestartWarning
{
public:
  // Has to be called before the settings change. requested: last requested time of the surface.
  void Note(
    const SurfaceSettings& old, const SurfaceSettings& next, bool hasBegun, PipelineTime requested);

  // Has to be called with each requested time. Warns once at most.
  void Tell(PipelineTime requested, const Warnings& messages);

private:
  static constexpr double Never = std::numeric_limits<double>::infinity();

  double LastTime = Never; // last one requested before the data were replaced
  bool IsTold = false;
};

}

#endif
