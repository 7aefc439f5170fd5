/**
 * Sum of the reports of successive motions.
 */
#ifndef ReportSum_h
#define ReportSum_h

#include "Base/Motion.h"

#include <algorithm>

namespace activesurface
{

/** Adds the counts of a motion, and keeps the larger MaxSpeed. Does not change other members. */
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
