// A potential F as the target of a surface. Selects the level and the side of F. The attraction
// uses F, or the distance derived from F.

#ifndef PotentialTarget_h
#define PotentialTarget_h

#include "Base/InitialFunction.h"
#include "Base/Target.h"
#include "Targets/TargetOptions.h"

namespace activesurface
{

class PotentialTarget : public Target
{
public:
  explicit PotentialTarget(const TargetOptions& options);

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;

  // Returns F - iso (with Invert, iso - F), negative inside, never normalized. Only the zero set
  // and the sign are meaningful.
  void EvaluateLevel(std::size_t count, const double* points, double* values) const;

  // Also returns |grad F|, or 1 where |grad F| is 0 or not finite.
  void EvaluateLevel(std::size_t count, const double* points, double* values, double* slopes) const;

  // Returns true if the regions of VisitRegions contain the whole zero set.
  virtual bool IsWithinRegions() const { return false; }

  // Points near the zero set, for the start; none if unavailable.
  virtual SurfacePoints FindSurface() const { return {}; }

protected:
  const TargetOptions& GetOptions() const { return this->Options; }

  // Evaluates F at points (x y z each), and its gradient unless `gradients` is null.
  virtual void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const = 0;

private:
  double Side(double value) const;
  void FollowNoiseSlowly(double& value, double& slope) const;
  void TurnIntoDistance(double length, double& value, double& slope) const;

  TargetOptions Options;
};

}

#endif
