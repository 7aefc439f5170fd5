// The warning of a motion that starts anew at every frame, as data are replaced between two times
// that are asked for: a loop that was meant to make a film.

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
  // Before other settings replace those of a surface that was asked for this time last.
  void Note(
    const SurfaceSettings& old, const SurfaceSettings& next, bool hasBegun, PipelineTime requested);

  // When a time is asked for; said once.
  void Tell(PipelineTime requested, const Warnings& messages);

private:
  static constexpr double Never = std::numeric_limits<double>::infinity();

  double LastTime = Never; // of a surface whose data have been replaced since
  bool IsTold = false;
};

}

#endif
