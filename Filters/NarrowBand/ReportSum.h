/**
 * Reports of motions that follow one another.
 */
#ifndef ReportSum_h
#define ReportSum_h

#include "Motion.h"

#include <algorithm>

namespace activesurface
{

/** Adds the work of a motion: counts, and the largest speed. How it has ended is not added. */
inline void AddWork(AdvanceReport& sum, const AdvanceReport& report)
{
  sum.Substeps += report.Substeps;
  sum.SkippedSubsteps += report.SkippedSubsteps;
  sum.TargetEvaluations += report.TargetEvaluations;
  sum.DroppedSamples += report.DroppedSamples;
  sum.UniformPulls += report.UniformPulls;
  sum.CreatedParts += report.CreatedParts;
  sum.MaxSpeed = std::max(sum.MaxSpeed, report.MaxSpeed);
}

}

#endif
