// The time steps of a filter: those of its target, of which equal neighbours count as one, or its
// own, where the target has one at most.
//
// In situ the target's steps are not all known. Either its list of time steps grows, or it says
// that no time can be had twice (VTK 9.4 and later); then the steps are the times that were asked
// for.

#ifndef InputClock_h
#define InputClock_h

#include "SurfaceSettings.h"

#include <vector>

class vtkActiveImplicitSurface;
class vtkInformation;

namespace activesurface
{

class InputClock
{
public:
  // From the filter's properties and what the target says; null: there is none.
  void Read(vtkActiveImplicitSurface* filter, vtkInformation* target);

  // Before data for a time are asked for. Whether all that was before is to be forgotten.
  bool Ask(vtkInformation* target, double time);

  // InputMoves, OnlyForward, Steps and InputSteps.
  void WriteTo(SurfaceSettings& settings) const;

  // To be published. No time is known, and this empty, before the first is asked for in situ.
  const std::vector<double>& GetPublishedSteps() const { return this->Published; }

private:
  bool InputMoves = false;
  bool OnlyForward = false;
  std::vector<double> Asked;      // in situ
  std::vector<double> InputSteps; // all, even if only one
  std::vector<double> Steps;
  std::vector<double> Published;
};

}

#endif
